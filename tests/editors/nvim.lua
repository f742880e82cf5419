-- Drives `yamaro lsp` from Neovim 0.7 or newer, and writes what the buffer holds to a file.
local command = vim.json and vim.json.decode(vim.env.YAMARO_COMMAND) or vim.fn.json_decode(vim.env.YAMARO_COMMAND)
local told = {}
local is_new = vim.fn.has('nvim-0.11') == 1

local function finish()
  vim.fn.writefile({ vim.fn.json_encode(told) }, vim.env.YAMARO_RESULT)
  vim.cmd('qall!')
end

local function need(what, condition)
  local ok = vim.wait(300000, condition, 20)
  told['reached ' .. what] = ok
  if not ok then
    finish()
  end
end

local function buffer()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), '\n')
end

local function go(mark, after)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    local at = string.find(line, mark, 1, true)
    if at then
      vim.api.nvim_win_set_cursor(0, { number, at - 1 + (after or 0) })
      return
    end
  end
  error('no ' .. mark)
end

local function codes()
  local found = {}
  for _, each in ipairs(vim.diagnostic.get(0)) do
    table.insert(found, each.code)
  end
  return table.concat(found, ' ')
end

local client = vim.lsp.start_client({
  name = 'yamaro',
  cmd = command,
  root_dir = vim.fn.getcwd(),
  init_options = { inlayHints = true, timeout = 300000, packages = { rover_description = vim.fn.getcwd() } },
  capabilities = vim.lsp.protocol.make_client_capabilities(),
})
vim.lsp.buf_attach_client(0, client)

local function request(method, more)
  local parameters
  if is_new then
    parameters = vim.lsp.util.make_position_params(0, vim.lsp.get_client_by_id(client).offset_encoding)
  else
    parameters = vim.lsp.util.make_position_params()
  end
  for key, value in pairs(more or {}) do
    parameters[key] = value
  end
  local answer = vim.lsp.buf_request_sync(0, method, parameters, 300000)
  return answer and answer[client] and answer[client].result
end

local function run()
  -- diagnostics: of a build, then gone with an edit
  need('diagnostics', function() return codes() == 'unknown-parent' end)
  local first = vim.diagnostic.get(0)[1]
  told.diagnostic = { first.lnum, first.col, first.message }
  go('parent: bse', 9)
  vim.api.nvim_set_current_line((vim.api.nvim_get_current_line():gsub('bse', 'base')))
  need('no diagnostics', function() return codes() == '' end)

  -- definition
  go('$(length)', 3)
  vim.lsp.buf.definition()
  need('definition', function() return vim.api.nvim_win_get_cursor(0)[1] == 3 end)
  told.definition = vim.api.nvim_get_current_line()

  -- references
  vim.lsp.buf.references(nil, nil)
  need('references', function() return #vim.fn.getqflist() == 3 end)
  vim.cmd('cclose')

  -- symbols
  vim.fn.setqflist({})
  vim.lsp.buf.document_symbol()
  need('symbols', function() return #vim.fn.getqflist() + #vim.fn.getloclist(0) > 5 end)
  vim.cmd('cclose')
  vim.cmd('lclose')

  -- hover
  go('name: arm', 6)
  need('a build', function()
    local found = request('textDocument/hover')
    return found and string.find(found.contents.value, 'mass', 1, true)
  end)
  vim.lsp.buf.hover()
  need('hover', function()
    for _, window in ipairs(vim.api.nvim_list_wins()) do
      if vim.api.nvim_win_get_config(window).relative ~= '' then
        local lines = vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false)
        told.hover = table.concat(lines, '\n')
        vim.api.nvim_win_close(window, true)
        return true
      end
    end
    return false
  end)

  -- rename, behind signs of two UTF-16 units
  go('$(length)', 3)
  vim.lsp.buf.rename('reach')
  need('rename', function() return string.find(buffer(), '  reach: 0.5', 1, true) end)
  told.renamed = buffer()

  -- completion
  go('# here', 0)
  vim.api.nvim_set_current_line('    joint: {ty}')
  vim.api.nvim_win_set_cursor(0, { vim.api.nvim_win_get_cursor(0)[1], 14 })
  local offered = request('textDocument/completion')
  for _, item in ipairs(offered.items) do
    if item.label == 'type' then
      vim.lsp.util.apply_text_edits({ item.textEdit }, vim.api.nvim_get_current_buf(), is_new and 'utf-32' or 'utf-16')
    end
  end
  told.completed = vim.api.nvim_get_current_line()

  -- completion in other contexts
  told.offered = {}
  for written, wanted in pairs({
    ['joint: {type: re'] = 'revolute',
    ['joint: {type: fixed, parent: ba'] = 'base',
    ['joint: {type: fixed, xyz: 0 0 $(le'] = 'reach',
    ['Ar'] = 'Arm',
    ['include: le'] = 'leg.yaml',
    ['include: package://ro'] = 'rover_description',
  }) do
    local indent = string.find(written, 'joint', 1, true) and '    ' or '- '
    vim.api.nvim_set_current_line(indent .. written)
    vim.api.nvim_win_set_cursor(0, { vim.api.nvim_win_get_cursor(0)[1], #indent + #written })
    told.offered[written] = 'nothing'
    for _, item in ipairs(request('textDocument/completion').items) do
      if item.label == wanted then
        told.offered[written] = item.label
      end
    end
  end
  vim.api.nvim_set_current_line('    joint: {type: fixed, parent: base, xyz: 0 0 $(reech)}')

  -- quick fix
  need('fixable', function() return codes() == 'undefined-name' end)
  go('reech', 1)
  vim.ui.select = function(items, _, choose) choose(items[1], 1) end
  vim.lsp.buf.code_action()
  need('fix', function() return not string.find(buffer(), 'reech', 1, true) end)
  told.fixed = vim.api.nvim_get_current_line()

  -- signature
  vim.api.nvim_buf_set_lines(0, -1, -1, false, { '- Arm: left, ' })
  vim.api.nvim_win_set_cursor(0, { vim.api.nvim_buf_line_count(0), 12 })
  local signature = request('textDocument/signatureHelp')
  told.signature = signature and { signature.signatures[1].label, signature.activeParameter }
  vim.api.nvim_set_current_line('- Arm: left')

  -- what cannot be renamed, with the reason; highlights; the manual
  go('made = 3', 1)
  local position = vim.lsp.util.make_position_params(0, vim.lsp.get_client_by_id(client).offset_encoding)
  position.newName = 'other'
  told.refused = vim.lsp.buf_request_sync(0, 'textDocument/rename', position, 300000)[client].error.message
  go('$(reach)', 3)
  told.highlights = #request('textDocument/documentHighlight')
  go('joint: {type', 1)
  told.manual = request('textDocument/hover').contents.value

  -- links, folds
  local document = { textDocument = { uri = vim.uri_from_bufnr(0) } }
  told.folds = #(vim.lsp.buf_request_sync(0, 'textDocument/foldingRange', document, 300000)[client].result)
  told.links = #(vim.lsp.buf_request_sync(0, 'textDocument/documentLink', document, 300000)[client].result)
  if is_new then
    need('tokens', function()
      local tokens = vim.lsp.semantic_tokens.get_at_pos(0, 2, 3)
      return tokens and tokens[1] and tokens[1].type == 'variable'
    end)
    vim.lsp.inlay_hint.enable(true)
    need('hints', function() return #vim.lsp.inlay_hint.get({ bufnr = 0 }) > 0 end)
    told.hint = vim.lsp.inlay_hint.get({ bufnr = 0 })[1].inlay_hint.label
  end

  -- formatting
  vim.api.nvim_buf_set_lines(0, 0, 1, false, { 'robot:    rover' })
  if vim.lsp.buf.format then
    vim.lsp.buf.format({ timeout_ms = 300000 })
  else
    vim.lsp.buf.formatting_sync(nil, 300000)
  end
  told.formatted = vim.api.nvim_buf_get_lines(0, 0, 1, false)[1]

  -- a xacro file of the program
  vim.cmd('silent! write')
  vim.cmd('edit gripper.urdf.xacro')
  vim.lsp.buf_attach_client(0, client)
  go('${width}', 4)
  told['xacro hover'] = request('textDocument/hover').contents.value
  vim.lsp.buf.definition()
  need('xacro definition', function() return vim.api.nvim_win_get_cursor(0)[1] == 2 end)
  told['xacro definition'] = vim.api.nvim_get_current_line()
  go('${width}', 4)
  vim.api.nvim_set_current_line((vim.api.nvim_get_current_line():gsub('width', 'widht')))
  need('xacro diagnostic', function() return codes() ~= '' end)
  local found = vim.diagnostic.get(0)[1]
  told['xacro diagnostic'] = { found.lnum, found.code }
  vim.lsp.buf.code_action()
  need('xacro fix', function() return not string.find(buffer(), 'widht', 1, true) end)
  told['xacro fixed'] = vim.api.nvim_get_current_line()
  told.encoding = vim.lsp.get_client_by_id(client).offset_encoding
end

local ok, fault = pcall(run)
if not ok then
  told.fault = tostring(fault)
end
finish()
