-- Neovim 0.11 and newer: put this file into ~/.config/nvim/plugin/.
vim.filetype.add({
  extension = { urdf = 'xml', xacro = 'xml', sdf = 'xml', mjcf = 'xml' },
  pattern = {
    ['.*%.urdf%.ya?ml'] = 'yamaro',
    ['.*%.yamaro%.ya?ml'] = 'yamaro',
    ['.*%.ya?ml'] = {
      function(path, buffer)
        if path:find('%.test%.ya?ml$') then -- for `yamaro test`
          return nil
        end
        local lines = vim.api.nvim_buf_get_lines(buffer, 0, 200, false)
        local text = table.concat(lines, '\n')
        local is_robot = vim.fn.match(lines, '^\\(robot\\|model\\)\\s*[:/]') >= 0
        local has_functions = ('\n' .. text):find('\nfunctions:.*\n[ -]+%u[%w_]*[(/:]')
        return (is_robot or has_functions) and 'yamaro' or nil
      end,
      { priority = 10 },
    },
  },
})
vim.treesitter.language.register('yaml', 'yamaro')
vim.env.NoDefaultCurrentDirectoryInExePath = '1' -- Windows would start a yamaro.exe of the working directory
local yamaro = vim.fn.exepath('yamaro')
vim.lsp.config('yamaro', {
  cmd = { yamaro ~= '' and yamaro or 'yamaro', 'lsp' },
  filetypes = { 'yamaro', 'xml' },
  root_dir = function(buffer, attach) -- not for XML of other kinds
    local name = vim.api.nvim_buf_get_name(buffer)
    local head = table.concat(vim.api.nvim_buf_get_lines(buffer, 0, 200, false), '\n')
    local is_xml = vim.bo[buffer].filetype == 'xml' and name:find('%.xml$')
    if is_xml and not (head:find('<robot[%s>]') or head:find('<mujoco') or head:find('<sdf[%s>]')) then
      return
    end
    attach(vim.fs.root(buffer, '.git') or vim.fs.root(buffer, 'package.xml') or vim.fs.dirname(name))
  end,
})
vim.lsp.enable('yamaro')
