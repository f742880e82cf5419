;;; yamaro.el --- Yamaro files in Emacs, with eglot  -*- lexical-binding: t -*-
(require 'eglot)
(define-derived-mode yamaro-mode prog-mode "Yamaro"
  "Robots in YAML."
  (setq-local comment-start "# " indent-tabs-mode nil)
  (setq font-lock-defaults '((("#.*" . font-lock-comment-face)
                              ("\\$([^)]*)" . font-lock-variable-name-face)
                              ("^[ -]*\\([^:#\n]+\\):" 1 font-lock-keyword-face)))))
(add-to-list 'auto-mode-alist '("\\.\\(urdf\\|yamaro\\)\\.ya?ml\\'" . yamaro-mode))
(add-to-list 'magic-mode-alist '("\\(.*\n\\)\\{,50\\}\\(robot\\|model\\)[ \t]*[:/]" . yamaro-mode))
(add-to-list 'eglot-server-programs '(yamaro-mode . ("yamaro" "lsp")))
(add-hook 'yamaro-mode-hook #'eglot-ensure)
(provide 'yamaro)
;;; yamaro.el ends here
