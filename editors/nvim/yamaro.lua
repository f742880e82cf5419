-- Neovim 0.11 and newer: put this file into ~/.config/nvim/lsp/, and vim.lsp.enable('yamaro') into init.lua.
vim.filetype.add({
  pattern = {
    ['.*%.urdf%.ya?ml'] = 'yamaro',
    ['.*%.yamaro%.ya?ml'] = 'yamaro',
    ['.*%.ya?ml'] = function(_, buffer)
      local lines = vim.api.nvim_buf_get_lines(buffer, 0, 200, false)
      local is_robot = vim.fn.match(lines, [[^\(robot\|model\)\s*[:/]]) >= 0
      return is_robot and 'yamaro' or nil
    end,
  },
})
vim.treesitter.language.register('yaml', 'yamaro')
return { cmd = { 'yamaro', 'lsp' }, filetypes = { 'yamaro' }, root_markers = { 'package.xml', '.git' } }
