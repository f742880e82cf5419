"""The language server: `yamaro lsp`."""
