;;; lsys-mode.el --- Major mode for L-system grammars -*- lexical-binding: t -*-

;; SPDX-License-Identifier: MIT
;; Package-Requires: ((emacs "26.1"))
;; Keywords: languages

;;; Commentary:

;; Made by write_syntax from editors/syntax/lsys-mode.el.in and the tables of the compiler.
;; Colours grammars (.lsys), indents the lines of a statement, and gives them to the language
;; server `lsc lsp' if Eglot is installed: M-x eglot.  To start the server with every grammar:
;;
;;   (add-to-list 'load-path "FOLDER OF THIS FILE")
;;   (require 'lsys-mode)
;;   (add-hook 'lsys-mode-hook #'eglot-ensure)

;;; Code:

(defgroup lsys nil
  "L-system grammars."
  :group 'languages
  :prefix "lsys-")

(defcustom lsys-program "lsc"
  "The compiler of grammars, which is also the language server."
  :type 'string)

(defcustom lsys-indent-offset 4
  "Columns by which the second and later lines of a statement are indented."
  :type 'natnum)

(defconst lsys-value-statements '("contour" "curve" "define" "function" "include" "module" "n" "object" "param")
  "Statements of values, without `#'.")
(defconst lsys-functions '("abs" "acos" "asin" "atan" "atan2" "binomial" "ceil" "clamp" "cos" "exp" "floor" "if" "log" "max" "min" "mix" "mod" "normal" "poisson" "pow" "round" "sign" "sin" "sqrt" "step" "steps" "tan")
  "Functions of the language.")
(defconst lsys-settings '("angle" "angle_scale" "at_depth" "choice" "collar" "colour" "colour_increment" "damping" "decompose_depth" "density" "elasticity" "flare" "height" "interpret_depth" "load" "names" "pipe" "random" "rewriting" "scale" "seed" "sides" "spring" "step" "step_scale" "tips" "tropism" "tropisms" "turtle" "weights" "width" "width_increment" "width_scale" "width_unit" "word_shape")
  "Keys of `#set'.")
(defconst lsys-values '("abop" "any" "auto" "broken" "carey" "carried" "characters" "cpfg" "cyclic" "error" "flat" "fractint" "generation" "glibc" "houdini" "l3d" "l3d_program" "leftmost" "letters" "line" "lplus" "lplus_program" "lsys" "metres" "module" "one" "own" "parallel" "philox" "pixels" "ring" "round" "sequential" "sidefx" "stop" "sys" "thesis" "words")
  "Words that are values of settings.")
(defconst lsys-material-keys '("colour" "normal" "picture" "roughness" "translucency" "two_sided")
  "Keys of `#material'.")
(defconst lsys-sense-keys '("angle" "at" "cell" "count" "directions" "extinction" "file" "high" "kill" "levels" "low" "mesh" "plane" "radius" "ratio" "shape" "size" "strength")
  "Keys of `#sense'.")
(defconst lsys-sense-kinds '("ball" "box" "cone" "crowd" "dome" "map" "program" "shadow" "sky" "solid" "space")
  "Kinds and shapes of `#sense'.")
(defconst lsys-commands '("F" "f")
  "Turtle commands of the default profile that are letters.")

(defvar lsys-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?_ "w" table)
    (modify-syntax-entry ?/ "." table)
    (modify-syntax-entry ?* "." table)
    (modify-syntax-entry ?\\ "." table)
    (modify-syntax-entry ?\" "." table)
    (modify-syntax-entry ?' "." table)
    (modify-syntax-entry ?& "." table)
    (modify-syntax-entry ?% "." table)
    (modify-syntax-entry ?` "\"" table)
    table)
  "Syntax table of `lsys-mode'.  Comments are marked by `lsys-mark-comments'.")

(defun lsys-mark-comments (start end)
  "Mark the comments between START and END, for `syntax-propertize-function'.
`//' begins a comment only between statements: in a list of modules it is two
turtle commands."
  (goto-char start)
  (let ((fence (string-to-syntax "!"))
        (in-statement nil))
    (while (re-search-forward "/\\*\\|//\\|`[^`\n]*`\\|#include\\s-*\"[^\"\n]*\"\\|#object[^;\"]*\"[^\"\n]*\"\\|#\\|;" end t)
      (let ((begin (match-beginning 0)))
        (pcase (char-after begin)
          (?\; (setq in-statement nil))
          (?# (setq in-statement t))
          (?/ (cond
               ((eq (char-after (1+ begin)) ?*)
                (put-text-property begin (1+ begin) 'syntax-table fence)
                (when (search-forward "*/" nil 'move)
                  (put-text-property (1- (point)) (point) 'syntax-table fence)))
               ((not in-statement)
                (put-text-property begin (1+ begin) 'syntax-table fence)
                (end-of-line)
                (unless (eobp)
                  (put-text-property (point) (1+ (point)) 'syntax-table fence)
                  (forward-char))))))))))

(defun lsys-from-begin (start end)
  "Extend START to the begin of the buffer, where no statement is open; keep END."
  (unless (= start (point-min))
    (cons (point-min) end)))

(defvar lsys-font-lock-keywords
  `((,(concat "\\(#" (regexp-opt lsys-value-statements) "\\)\\_>\\(?:\\s-*[^:[:space:]]\\|$\\)")
     1 font-lock-keyword-face)
    ("\\(#set\\)\\s-+\\(\\w+\\)"
     (1 font-lock-keyword-face)
     (2 (if (member (match-string 2) lsys-settings) 'font-lock-type-face 'font-lock-warning-face))
     (,(concat "\\_<" (regexp-opt lsys-values) "\\_>")
      (save-excursion (search-forward ";" nil 'move) (point))
      nil
      (0 font-lock-constant-face)))
    ("\\(#material\\)\\s-+[0-9]"
     (1 font-lock-keyword-face)
     (,(concat "\\_<" (regexp-opt lsys-material-keys) "\\_>")
      (save-excursion (search-forward ";" nil 'move) (point))
      nil
      (0 font-lock-type-face)))
    ("\\(#sense\\)\\s-+\\(\\w+\\)"
     (1 font-lock-keyword-face)
     (2 font-lock-variable-name-face)
     (,(concat "\\_<" (regexp-opt (append lsys-sense-keys lsys-sense-kinds)) "\\_>")
      (save-excursion (search-forward ";" nil 'move) (point))
      nil
      (0 font-lock-type-face)))
    ("\\(#\\(?:w\\|ignore\\|consider\\)\\)\\s-*[:~]" 1 font-lock-keyword-face)
    ("\\(#\\(?:decompose\\|interpret\\|down\\|up\\)\\)\\s-+\\(\\w+\\)\\s-*:"
     (1 font-lock-keyword-face)
     (2 font-lock-function-name-face))
    ("\\(#\\w+\\)\\s-*:" 1 font-lock-function-name-face)
    ("\\(#\\(?:define\\|param\\|function\\|curve\\|contour\\)\\)\\s-+\\(\\w+\\)"
     2 font-lock-variable-name-face)
    ("\\(#\\(?:object\\|include\\)\\)[^;\"]*\\(\"[^\"\n]*\"\\)" 2 font-lock-string-face)
    (,(concat "\\_<" (regexp-opt lsys-functions) "\\_>\\s-*(") 0 font-lock-builtin-face)
    ("(" 0 'default t)
    ("\\_<let\\_>\\s-+\\w+\\s-*=[^=]" 0 font-lock-keyword-face)
    (,(concat "\\_<" (regexp-opt lsys-commands) "\\_>") 0 font-lock-builtin-face)
    ("[][{}%]" 0 font-lock-builtin-face)
    ("\\_<[0-9]+\\.?[0-9]*\\(?:[eE][-+]?[0-9]+\\)?" 0 font-lock-constant-face))
  "Colours of `lsys-mode'.")

(defun lsys-indent-line ()
  "Indent the line by `lsys-indent-offset' if a statement goes on, else not at all."
  (interactive)
  (let* ((goes-on
          (save-excursion
            (beginning-of-line)
            (let ((here (point)) (open nil))
              (goto-char (point-min))
              (while (re-search-forward "[#;]" here t)
                ;; `syntax-ppss' moves point.
                (unless (nth 8 (save-excursion (syntax-ppss (match-beginning 0))))
                  (setq open (eq (char-before) ?#))))
              open)))
         (column (if goes-on lsys-indent-offset 0)))
    (if (<= (current-column) (current-indentation))
        (indent-line-to column)
      (save-excursion (indent-line-to column)))))

;;;###autoload
(define-derived-mode lsys-mode prog-mode "L-system"
  "Major mode for L-system grammars."
  (setq-local comment-start "// ")
  (setq-local comment-end "")
  (setq-local comment-start-skip "\\(?://+\\|/\\*+\\)\\s-*")
  (setq-local comment-use-syntax t)
  (setq-local parse-sexp-lookup-properties t)
  (setq-local syntax-propertize-function #'lsys-mark-comments)
  (add-hook 'syntax-propertize-extend-region-functions #'lsys-from-begin nil t)
  (setq-local font-lock-defaults '(lsys-font-lock-keywords))
  (setq-local indent-line-function #'lsys-indent-line)
  (setq-local imenu-generic-expression
              '(("Productions" "^\\s-*#\\(?:\\(?:decompose\\|interpret\\|down\\|up\\)\\s-+\\)?\\(\\w+\\)\\s-*:" 1)
                ("Constants" "^\\s-*#\\(?:define\\|param\\)\\s-+\\(\\w+\\)" 1)
                ("Functions" "^\\s-*#\\(?:function\\|curve\\|contour\\)\\s-+\\(\\w+\\)" 1))))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.lsys\\'" . lsys-mode))

(defvar eglot-server-programs)
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs `(lsys-mode . (,lsys-program "lsp"))))

(provide 'lsys-mode)

;;; lsys-mode.el ends here
