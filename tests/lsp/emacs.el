;;; emacs.el --- a session of Emacs with `rung lsp`  -*- lexical-binding: t -*-
;; SPDX-License-Identifier: Apache-2.0
;; In a folder with the files of tests/golden/lsp/emacs.test and init.el, the settings of docs/editors/emacs.md:
;;   emacs -q --batch -L RUNG/tools/editors/emacs -l init.el -l emacs.el
;; Prints what the editor shows; lines and columns from 1.

(require 'package)
(unless (fboundp 'eglot-ensure) (package-initialize))
(require 'eglot)
(require 'xref)
(setq xref-prompt-for-identifier nil eglot-confirm-server-initiated-edits nil eglot-sync-connect 60)
(defvar seconds 60)

(defun say (text &rest arguments) (princ (concat (apply #'format text arguments) "\n")))

(defun wait-for (what test)
  (let ((end (+ (float-time) seconds)))
    (while (and (not (funcall test)) (< (float-time) end))
      (accept-process-output nil 0.02)
      (sit-for 0.02))
    (unless (funcall test) (say "no %s" what))))

;; In batch there is no idle time, after which eglot tells the server what has changed.
(defun tell-changes () (eglot--signal-textDocument/didChange))

(defun place () (format "%s %d:%d" (buffer-name) (line-number-at-pos) (1+ (current-column))))

(defun go (line column)
  (goto-char (point-min))
  (forward-line (1- line))
  (forward-char (1- column)))

(defun replace-line (line text)
  (go line 1)
  (delete-region (point) (line-end-position))
  (insert text))

(defun errors () (flymake-diagnostics))
(defun say-errors ()
  (dolist (one (sort (errors) (lambda (a b) (< (flymake-diagnostic-beg a) (flymake-diagnostic-beg b)))))
    (save-excursion
      (goto-char (flymake-diagnostic-beg one))
      (say "diagnostic %s %s" (place) (car (split-string (flymake-diagnostic-text one) "\n"))))))

(find-file "main.st")
(eglot-ensure)
(run-hooks 'post-command-hook)  ; where eglot-ensure connects
(wait-for "server" (lambda () (eglot-current-server)))
(say "%s, %s" major-mode (if (eglot-managed-p) "managed" "not managed"))
(flymake-start)
(wait-for "diagnostic" #'errors)
(say-errors)

(go 7 12)
(call-interactively #'xref-find-definitions)
(wait-for "definition" (lambda () (= (line-number-at-pos) 1)))
(say "definition %s" (place))

(replace-line 9 "n := m2;")
(tell-changes)
(wait-for "other diagnostic" (lambda () (and (errors) (string-match-p "m2" (flymake-diagnostic-text (car (errors)))))))
(go 9 6)
(let ((last-nonmenu-event ?x))
  (cl-letf (((symbol-function 'completing-read)
             (lambda (_prompt actions &rest _) (or (car (seq-find (lambda (one) (string-match-p "^Declare" (car one))) actions)) (caar actions)))))
    (eglot-code-actions (point) (point) nil t)))
(tell-changes)
(wait-for "fix" (lambda () (null (errors))))
(say "diagnostics %d" (length (errors)))
(go 7 1)
(say "fixed %s" (string-trim (buffer-substring (point) (line-end-position))))

(goto-char (point-min))
(search-forward "n := m2;")
(replace-match "ramp.")
(let* ((capf (eglot-completion-at-point)) (names (all-completions "" (nth 2 capf))))
  (say "completion %s" (string-join (sort (mapcar #'substring-no-properties names) #'string<) " ")))
(delete-region (line-beginning-position) (line-end-position))
(insert "n:=n+1;")
(eglot-format-buffer)
(say "formatted %s" (buffer-substring (line-beginning-position) (line-end-position)))

(find-file-noselect "other.st")  ; of files that are not open eglot asks first
(tell-changes)
(go 2 11)
(eglot-rename "increment")
(wait-for "rename" (lambda () (save-excursion (goto-char (point-min)) (search-forward "increment := 1.0" nil t))))
(say "renamed %d times here, %d in other.st" (count-matches "increment" (point-min) (point-max))
     (with-current-buffer (find-file-noselect "other.st") (count-matches "increment" (point-min) (point-max))))

(font-lock-ensure)
(go 1 1)
(say "colours %s %s" (get-text-property (point) 'face) (get-text-property (+ (point) 16) 'face))
(replace-line 9 "IF TRUE THEN")
(end-of-line)
(insert "\nn := 2;\nEND_IF")
(indent-region (point-min) (point-max))
(go 10 1)
(say "indented `%s`" (buffer-substring (point) (line-end-position)))

(find-file "Motor.TcPOU")
(eglot--maybe-activate-editing-mode)
(wait-for "server of XML" (lambda () (eglot-managed-p)))
(flymake-start)
(wait-for "diagnostic in XML" #'errors)
(say-errors)
(kill-emacs 0)
