;;; The language server in Emacs: a mistake is shown, a name explained, a file formatted.  -*- lexical-binding: t -*-
;; emacs -Q --batch -l tests/clients/eglot.el; CAVEAT names the program, FOLDER a copy of the folder.

(dolist (folder (file-expand-wildcards "/usr/share/emacs/site-lisp/elpa/*"))
  (add-to-list 'load-path folder))
(require 'eglot)
(require 'flymake)

(define-derived-mode pddl-mode lisp-data-mode "PDDL")
(add-to-list 'eglot-server-programs (list 'pddl-mode (getenv "CAVEAT") "lsp"))
(setq eglot-sync-connect 10 eglot-autoshutdown t flymake-no-changes-timeout 0.1)

(defun check (condition message)
  (unless condition
    (message "eglot: %s" message)
    (kill-emacs 1)))

(defun wait-for (condition)
  (let ((rounds 100) result)
    (while (and (not (setq result (funcall condition))) (> rounds 0))
      (accept-process-output nil 0.05)
      (setq rounds (1- rounds)))
    result))

(find-file (expand-file-name "domain.pddl" (getenv "FOLDER")))
(pddl-mode)
(apply #'eglot (eglot--guess-contact))
(check (eglot-current-server) "the server does not start")
(flymake-mode 1)

(goto-char (point-min))
(search-forward ":effect (clean ?c)")
(replace-match ":effect (claen ?c)" t t)
(eglot--signal-textDocument/didChange)
(check (wait-for (lambda () (flymake-start) (flymake-diagnostics))) "no diagnostic is shown")
(check (string-match-p "claen" (flymake-diagnostic-text (car (flymake-diagnostics))))
       "the diagnostic speaks of something else")

(goto-char (point-min))
(search-forward "(at ?c sink)")
(goto-char (1+ (match-beginning 0)))
(let* ((hover (jsonrpc-request (eglot-current-server) :textDocument/hover
                               (eglot--TextDocumentPositionParams)))
       (text (plist-get (plist-get hover :contents) :value)))
  (check (and text (string-match-p "where a cup stands" text)) "the hover has no comment"))

(goto-char (point-min))
(search-forward "  (:types cup")
(replace-match "       (:types   cup" t t)
(eglot-format-buffer)
(goto-char (point-min))
(check (search-forward "\n  (:types cup" nil t) "the buffer is not formatted")

(set-buffer-modified-p nil)
(message "eglot: diagnostics, hover and formatting work")
(kill-emacs 0)
