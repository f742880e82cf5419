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
(define-derived-mode yamaro-xml-mode nxml-mode "Robot" "Robots in URDF, xacro, MJCF and SDF; other XML stays in nxml-mode.")
(add-to-list 'auto-mode-alist '("\\.\\(urdf\\|xacro\\|sdf\\|world\\|mjcf\\)\\'" . yamaro-xml-mode))
(defun yamaro-is-xml-robot ()
  "Whether a .xml file holds a robot, by its first element."
  (and (string-match-p "\\.xml\\'" (or (buffer-file-name) ""))
       (re-search-forward "<[a-zA-Z]" 20000 t)
       (progn (goto-char (match-beginning 0)) (looking-at-p "<\\(robot\\|mujoco\\|mujocoinclude\\|sdf\\)[ \t\n>]"))))
(add-to-list 'magic-mode-alist '(yamaro-is-xml-robot . yamaro-xml-mode))
(add-to-list 'eglot-server-programs '((yamaro-mode yamaro-xml-mode) . ("yamaro" "lsp")))
(add-hook 'yamaro-mode-hook #'eglot-ensure)
(add-hook 'yamaro-xml-mode-hook #'eglot-ensure)
(provide 'yamaro)
;;; yamaro.el ends here
