;;; emacs.el --- Eglot as a client of `lsc lsp'  -*- lexical-binding: t; -*-
;; SPDX-License-Identifier: MIT
;; Opens, edits, diagnoses, fixes, renames, completes and formats a grammar by Eglot.
;; Usage: emacs --batch -q -l emacs.el
;;   LSC: the program; FOLDER: an empty folder for the grammars

(package-initialize)
(require 'eglot)
(require 'flymake)

(defvar test-folder (file-name-as-directory (getenv "FOLDER")))

(define-derived-mode lsys-mode prog-mode "L-system"
  (setq-local comment-start "// "))
(add-to-list 'auto-mode-alist '("\\.lsys\\'" . lsys-mode))
(add-to-list 'eglot-server-programs (list 'lsys-mode (getenv "LSC") "lsp"))
(setq eglot-sync-connect 30
      eglot-autoshutdown t
      eglot-confirm-server-initiated-edits nil
      make-backup-files nil)
(fset 'y-or-n-p (lambda (_) t)) ; the edit of several files

(defun test-fail (format &rest arguments)
  (message "emacs: %s" (apply #'format format arguments))
  (kill-emacs 1))

(defun test-check (truth format &rest arguments)
  (unless truth (apply #'test-fail format arguments)))

(defun test-await (what done)
  "Wait until DONE returns a value, which is returned."
  (let ((end (+ (float-time) 10)) found)
    (while (and (not (setq found (funcall done))) (< (float-time) end))
      (accept-process-output nil 0.02))
    (test-check found "%s did not happen" what)
    found))

(defun test-write (name text)
  (with-temp-file (concat test-folder name) (insert text)))

(defun test-line (number)
  (save-excursion
    (goto-char (point-min))
    (forward-line (1- number))
    (buffer-substring-no-properties (line-beginning-position) (line-end-position))))

(defun test-goto (line column)
  (goto-char (point-min))
  (forward-line (1- line))
  (forward-char column))

(defun test-messages ()
  (mapconcat #'flymake-diagnostic-text (flymake-diagnostics) "\n"))

(test-write "part.lsys" "#leaf : L : * : F(size);\n")
(test-write "tree.lsys" "#n = 2;
#define size 2;
#include \"part.lsys\";
#w : A(1) L;
#grow : A(x) : x < size : F(x) A(x + 1);
#stop : A(x) : x > size : F(zz);
")
(find-file (concat test-folder "tree.lsys"))
(test-check (eq major-mode 'lsys-mode) "another mode: %s" major-mode)
(apply #'eglot (eglot--guess-contact))
(test-check (eglot-current-server) "no server")

;; Diagnose.
(test-await "an error" (lambda () (string-match-p "zz" (test-messages))))

;; Edit.
(test-goto 6 28)
(delete-char 2)
(insert "3")
(eglot--signal-textDocument/didChange)
(test-await "its end" (lambda ()
                        (let ((all (test-messages)))
                          (and (not (string-match-p "zz" all)) (> (length all) 0)))))

;; Fix.
(test-goto 6 18)
(let ((actions (eglot-code-actions (line-beginning-position) (line-end-position) "quickfix")))
  (test-check actions "no fixes")
  (eglot--apply-workspace-edit
   (plist-get (if (vectorp actions) (aref actions 0) (car actions)) :edit)))
(eglot--signal-textDocument/didChange)
(test-await "no message" (lambda () (string-empty-p (test-messages))))

;; Rename in both files.
(test-goto 2 9)
(eglot-rename "reach")
(test-check (equal (test-line 2) "#define reach 2;") "not renamed: %s" (test-line 2))
(with-current-buffer (find-file-noselect (concat test-folder "part.lsys"))
  (test-check (equal (test-line 1) "#leaf : L : * : F(reach);") "not renamed: %s" (test-line 1)))
(save-some-buffers t)

;; Complete.
(goto-char (point-max))
(insert "#define half re")
(let* ((found (run-hook-with-args-until-success 'completion-at-point-functions))
       (words (all-completions "re" (nth 2 found))))
  (test-check (member "reach" words) "no completion: %s" words))
(delete-region (line-beginning-position) (line-end-position))
(eglot--signal-textDocument/didChange)

;; Hover and definition.
(test-goto 2 9)
(let ((hover (jsonrpc-request (eglot--current-server-or-lose) :textDocument/hover
                              (eglot--TextDocumentPositionParams))))
  (test-check (string-match-p "value: 2" (plist-get (plist-get hover :contents) :value))
              "no value: %s" hover))
(test-goto 5 19)
(let ((places (xref-backend-definitions 'eglot (xref-backend-identifier-at-point 'eglot))))
  (test-check (= 1 (length places)) "no definition: %s" places))

;; Format.
(goto-char (point-min))
(delete-region (line-beginning-position) (line-end-position))
(insert "#n   =2;")
(eglot-format-buffer)
(test-check (equal (test-line 1) "#n = 2;") "not formatted: %s" (test-line 1))
(test-await "no message at the end" (lambda () (string-empty-p (test-messages))))

;; End.
(let ((server (eglot-current-server)))
  (eglot-shutdown server)
  (test-await "the end" (lambda () (not (jsonrpc-running-p server)))))
(message "emacs: all passed")
(kill-emacs 0)
