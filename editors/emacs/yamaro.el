;;; yamaro.el --- Yamaro files in Emacs, with eglot  -*- lexical-binding: t -*-
(require 'eglot)
(define-derived-mode yamaro-mode prog-mode "Yamaro"
  "Robots in YAML."
  (setq-local comment-start "# " indent-tabs-mode nil)
  (setq font-lock-defaults '((("#.*" . font-lock-comment-face)
                              ("\\$([^)]*)" . font-lock-variable-name-face)
                              ("^[ -]*\\([^:#\n]+\\):" 1 font-lock-keyword-face)))))
(add-to-list 'auto-mode-alist '("\\.\\(urdf\\|yamaro\\)\\.ya?ml\\'" . yamaro-mode))
(defconst yamaro-begin
  "\\(.*\n\\)\\{,50\\}\\(\\(robot\\|model\\)[ \t]*[:/]\\|functions:.*\n\\(.*\n\\)\\{,20\\}[ -]+[A-Z][A-Za-z0-9_]*[(/:]\\)")
(defun yamaro-is-robot ()
  "Whether a YAML file holds a robot, or functions of one; tests of robots are no robots."
  (let ((name (or (buffer-file-name) "")) (case-fold-search nil))
    (and (string-match-p "\\.ya?ml\\'" name) (not (string-match-p "\\.test\\.ya?ml\\'" name))
         (looking-at yamaro-begin))))
(add-to-list 'magic-mode-alist '(yamaro-is-robot . yamaro-mode))
(add-to-list 'auto-mode-alist '("\\.\\(urdf\\|xacro\\|sdf\\|world\\|mjcf\\)\\'" . nxml-mode))
(add-to-list 'eglot-server-programs '((yamaro-mode nxml-mode) . ("yamaro" "lsp")))
(add-hook 'yamaro-mode-hook #'eglot-ensure)
(defconst yamaro-xml "<\\(robot\\|mujoco\\|sdf\\)[ \t\n>]")
(defun yamaro-ensure-xml ()
  "Start the server in an XML file that holds a robot."
  (when (save-excursion (goto-char (point-min)) (re-search-forward yamaro-xml 20000 t))
    (eglot-ensure)))
(add-hook 'nxml-mode-hook #'yamaro-ensure-xml)
(provide 'yamaro)
;;; yamaro.el ends here
