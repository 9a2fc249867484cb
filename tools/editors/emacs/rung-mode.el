;;; rung-mode.el --- Structured Text and the other sources of Rung  -*- lexical-binding: t -*-
;; SPDX-License-Identifier: Apache-2.0

;;; Commentary:
;; Colours and indentation for the text sources that Rung reads, and `rung lsp` for eglot.  `rung-mode' is for Structured
;; Text, IL, charts and networks, `rung-ladder-mode' for the ladder of NCT, `rung-data-mode' for cams, messages and the
;; project file; files of TwinCAT open in `nxml-mode'.  docs/editors/emacs.md says how it is set up.

;;; Code:
(defgroup rung nil "Programs in the languages of IEC 61131-3." :group 'languages)
(defcustom rung-program '("rung" "lsp") "The language server and its options." :type '(repeat string))
(defcustom rung-indent 2 "Columns of a level." :type 'integer)

(defconst rung--keywords
  (concat "\\_<\\(?:END_[A-Z_]+\\|VAR\\(?:_[A-Z_]+\\)?\\|PROGRAM\\|FUNCTION\\(?:_BLOCK\\)?\\|METHOD\\|PROPERTY\\|INTERFACE"
          "\\|CLASS\\|ACTION\\|NAMESPACE\\|USING\\|CONFIGURATION\\|RESOURCE\\|TASK\\|TYPE\\|STRUCT\\|UNION\\|ARRAY\\|OF\\|REF_TO"
          "\\|POINTER\\|REFERENCE\\|EXTENDS\\|IMPLEMENTS\\|ABSTRACT\\|FINAL\\|OVERRIDE\\|PUBLIC\\|PRIVATE\\|PROTECTED\\|INTERNAL"
          "\\|CONSTANT\\|RETAIN\\|NON_RETAIN\\|PERSISTENT\\|AT\\|WITH\\|ON\\|INITIAL_STEP\\|STEP\\|TRANSITION\\|FROM\\|IF\\|THEN\\|ELSIF"
          "\\|ELSE\\|CASE\\|FOR\\|TO\\|BY\\|DO\\|WHILE\\|REPEAT\\|UNTIL\\|EXIT\\|CONTINUE\\|RETURN\\|JMP\\|AND\\(?:_THEN\\)?"
          "\\|OR\\(?:_ELSE\\)?\\|XOR\\|NOT\\|MOD\\|GET\\|SET\\|__TRY\\|__CATCH\\|__FINALLY\\|__ENDTRY\\)\\_>"))
(defconst rung--types
  (concat "\\_<\\(?:BOOL\\|BYTE\\|L?D?WORD\\|U?[SDL]?INT\\|L?REAL\\|L?TIME\\(?:_OF_DAY\\)?\\|L?DATE\\(?:_AND_TIME\\)?\\|L?TOD\\|L?DT"
          "\\|W?CHAR\\|W?STRING\\)\\_>"))

(defvar rung--font-lock
  `(("\\_<\\(?:PROGRAM\\|FUNCTION\\(?:_BLOCK\\)?\\|METHOD\\|INTERFACE\\|CLASS\\|TYPE\\)[ \t]+\\([A-Za-z_][A-Za-z0-9_.]*\\)"
     1 font-lock-function-name-face)
    (,rung--keywords . font-lock-keyword-face)
    (,rung--types . font-lock-type-face)
    ("\\_<\\(?:TRUE\\|FALSE\\|NULL\\)\\_>" . font-lock-constant-face)
    ("{[^}\n]*}" 0 font-lock-preprocessor-face t)
    ("%[IQM][XBWDL*]?[0-9.]*" . font-lock-constant-face)
    ("\\_<L?T\\(?:IME\\)?#[0-9a-zA-Z_.]+" . font-lock-constant-face)))

(defvar rung-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?_ "_" table)
    (modify-syntax-entry ?\( "()1n" table)  ; (* comment *)
    (modify-syntax-entry ?\) ")(4n" table)
    (modify-syntax-entry ?* ". 23n" table)
    (modify-syntax-entry ?/ ". 12c" table)  ; // comment
    (modify-syntax-entry ?\n "> c" table)
    (modify-syntax-entry ?$ "\\" table)
    (modify-syntax-entry ?' "\"" table)
    (modify-syntax-entry ?\" "\"" table)
    table))

(defconst rung--opens
  (concat "^[ \t]*\\(?:\\(?:VAR\\(?:_[A-Z_]+\\)?\\|ELSE\\|REPEAT\\|GET\\|SET\\|\\(?:INITIAL_\\)?STEP\\)\\_>"
          "\\|.*\\_<\\(?:THEN\\|DO\\|OF\\|STRUCT\\|UNION\\)[ \t]*\\(?://.*\\)?$\\)"))
(defconst rung--closes
  (concat "^[ \t]*\\(?:END_\\(?:IF\\|CASE\\|FOR\\|WHILE\\|REPEAT\\|VAR\\|STRUCT\\|UNION\\|GET\\|SET\\|STEP\\)"
          "\\|ELSE\\|ELSIF\\|UNTIL\\)\\_>"))

(defun rung--column ()
  "The column of the line at point, from the line before it."
  (save-excursion
    (beginning-of-line)
    (let ((closes (let ((case-fold-search t)) (looking-at-p rung--closes))) (case-fold-search t))
      (if (zerop (progn (skip-chars-backward " \t\n") (point)))
          0
        (beginning-of-line)
        (let ((opens (and (looking-at-p rung--opens) (not (looking-at-p ".+\\_<END_")))))
          (max 0 (+ (current-indentation) (if opens rung-indent 0) (if closes (- rung-indent) 0))))))))

(defun rung-indent-line ()
  "Indents the line at point; the style of the project comes with `eglot-format'."
  (interactive)
  (let ((column (rung--column)))
    (save-excursion (indent-line-to column))
    (when (< (current-column) column) (move-to-column column))))

;;;###autoload
(define-derived-mode rung-mode prog-mode "Rung"
  "Structured Text, IL, charts and networks."
  (setq font-lock-defaults '(rung--font-lock nil t))
  (setq-local comment-start "// " comment-end "" comment-start-skip "\\(?://+\\|(\\*+\\)[ \t]*")
  (setq-local indent-line-function #'rung-indent-line indent-tabs-mode nil))

(defvar rung-ladder--font-lock
  '(("^[ \t]*\\(RUNG\\|PROGRAM\\|MODULE\\|\\(?:END_\\)?\\(?:SYMBOLS\\|MESSAGES\\|BUTTONS\\)\\|END_MODULE\\|SEC\\)\\_>"
     1 font-lock-keyword-face)
    ("^[ \t]*\\([-+*/]?[A-Z]+\\)\\_>" 1 font-lock-builtin-face)
    ("[#*][-$]?[0-9A-F.]+" . font-lock-constant-face)))

;;;###autoload
(define-derived-mode rung-ladder-mode prog-mode "Ladder"
  "The ladder of NCT."
  :syntax-table rung-mode-syntax-table
  (setq font-lock-defaults '(rung-ladder--font-lock nil t))
  (setq-local comment-start "// " comment-end "" indent-tabs-mode nil))

;;;###autoload
(define-derived-mode rung-data-mode conf-unix-mode "Rung data"
  "Cams, messages of NCT and the file rung.project.")

;;;###autoload
(progn
  (add-to-list 'auto-mode-alist '("\\.\\(?:st\\|iecst\\|il\\|pou\\|decl\\|impl\\|exp\\|ST\\|EXP\\)\\'" . rung-mode))
  (add-to-list 'auto-mode-alist '("\\.nct\\'" . rung-ladder-mode))
  (add-to-list 'auto-mode-alist '("\\.\\(?:cam\\|mes\\)\\'\\|/rung\\.project\\'" . rung-data-mode))
  (add-to-list 'auto-mode-alist '("\\.\\(?:Tc\\(?:POU\\|DUT\\|GVL\\|IO\\|TTO\\|TLEO\\)\\|plcproj\\|cfc\\)\\'" . nxml-mode)))

(defvar eglot-server-programs)
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs `((rung-mode rung-ladder-mode rung-data-mode nxml-mode) . ,rung-program)))

(provide 'rung-mode)
;;; rung-mode.el ends here
