;;; mode-test.el --- Tests of lsys-mode -*- lexical-binding: t -*-
;; SPDX-License-Identifier: MIT
;; Usage: emacs -Q --batch -L FOLDER-OF-THE-MODE -l mode-test.el -f ert-run-tests-batch-and-exit
;;; Code:
(require 'ert)
(require 'imenu)
(require 'lsys-mode)

(defconst lsys-sample
  (expand-file-name "sample.lsys" (file-name-directory (or load-file-name buffer-file-name))))

(defun lsys-face-of (line text)
  "The face of TEXT in LINE of the current buffer."
  (goto-char (point-min))
  (forward-line (1- line))
  (search-forward text (line-end-position))
  (get-text-property (match-beginning 0) 'face))

(ert-deftest lsys-colours ()
  (with-temp-buffer
    (insert-file-contents lsys-sample)
    (lsys-mode)
    (font-lock-ensure)
    (pcase-dolist (`(,line ,text ,face)
                   '((1 "A grammar" font-lock-comment-face)
                     (2 "#n" font-lock-keyword-face)
                     (2 "generations" font-lock-comment-face)
                     (3 "angle" font-lock-type-face)
                     (4 "parallel" font-lock-constant-face)
                     (5 "ratio" font-lock-variable-name-face)
                     (5 "0.75" font-lock-constant-face)
                     (5 "// a" font-lock-comment-delimiter-face)
                     (5 "b" font-lock-comment-face)
                     (7 "colour" font-lock-type-face)
                     (10 "allow" font-lock-comment-face)
                     (11 "#w" font-lock-keyword-face)
                     (11 "//F" nil)
                     (11 "F(1" font-lock-builtin-face)
                     (11 "trunk" font-lock-comment-face)
                     (11 "L;" nil)
                     (12 "#grow" font-lock-function-name-face)
                     (12 "sin" font-lock-builtin-face)
                     (13 "let" font-lock-keyword-face)
                     (14 "[+" font-lock-builtin-face)
                     (14 "//(" nil)
                     (14 "A(l)" nil)
                     (14 "`;`" font-lock-string-face)
                     (16 "#define" font-lock-function-name-face)
                     (16 "production" font-lock-comment-face)
                     (17 "#decompose" font-lock-keyword-face)
                     (17 "d :" font-lock-function-name-face)))
      (ert-info ((format "line %d: %s" line text))
        (let ((found (lsys-face-of line text)))
          (should (if (listp found) (or (eq found face) (memq face found)) (eq found face))))))))

(ert-deftest lsys-comments-after-an-edit ()
  (with-temp-buffer
    (insert "#w : F;\n// comment\n")
    (lsys-mode)
    (font-lock-ensure)
    (should (eq (lsys-face-of 2 "comment") 'font-lock-comment-face))
    (goto-char (point-min))
    (search-forward ";")
    (delete-char -1)
    (font-lock-ensure)
    (should-not (eq (lsys-face-of 2 "comment") 'font-lock-comment-face))))

(ert-deftest lsys-indentation ()
  (with-temp-buffer
    (insert "#w : A;\n#p : A : * :\nF\n// a comment\nA;\n#q : B : * : A;\n")
    (lsys-mode)
    (indent-region (point-min) (point-max))
    (should (equal (buffer-string)
                   "#w : A;\n#p : A : * :\n    F\n    // a comment\n    A;\n#q : B : * : A;\n"))))

(ert-deftest lsys-file-type ()
  (with-current-buffer (find-file-noselect lsys-sample)
    (should (eq major-mode 'lsys-mode))
    (should (member "grow" (mapcar #'car (cdr (assoc "Productions" (funcall imenu-create-index-function))))))
    (kill-buffer)))

(provide 'mode-test)
;;; mode-test.el ends here
