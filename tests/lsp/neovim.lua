-- SPDX-License-Identifier: Apache-2.0
-- A session of Neovim with `rung lsp`: an error appears and goes, hover, definition, completion, rename, formatting, a code
-- action, and a file of TwinCAT. Run in a folder with the files of tests/golden/lsp/neovim.test and init.lua, the settings
-- of docs/editors/neovim.md:
--   nvim --headless -u init.lua -i NONE -n -c 'luafile neovim.lua' -c cquit
-- Prints what the editor shows; lines and columns from 1.
local milliseconds = 60000
local out = {}

local function say(...)
  local words = {}
  for _, word in ipairs({ ... }) do
    table.insert(words, tostring(word))
  end
  table.insert(out, table.concat(words, ' '))
end

local function wait(what, test)
  if not vim.wait(milliseconds, test, 20) then
    say('no ' .. what)
  end
end

local function ask(method, line, column)
  local params = {
    textDocument = vim.lsp.util.make_text_document_params(),
    position = { line = line - 1, character = column - 1 },
  }
  for _, answer in pairs(vim.lsp.buf_request_sync(0, method, params, milliseconds) or {}) do
    return answer.result
  end
end

local function cursor()
  local at = vim.api.nvim_win_get_cursor(0)
  return at[1] .. ':' .. at[2] + 1
end

vim.cmd('edit main.st')
say('filetype', vim.bo.filetype)

wait('diagnostic', function() return #vim.diagnostic.get(0) > 0 end)
for _, diagnostic in ipairs(vim.diagnostic.get(0)) do
  say('diagnostic', diagnostic.lnum + 1 .. ':' .. diagnostic.col + 1, diagnostic.code, diagnostic.message)
end

say('hover', (ask('textDocument/hover', 8, 7).contents.value:gsub('\n+', ' | ')))

vim.api.nvim_win_set_cursor(0, { 7, 12 })
vim.lsp.buf.definition()
wait('definition', function() return cursor() ~= '7:13' end)
say('definition', cursor())

vim.api.nvim_buf_set_text(0, 8, 5, 8, 6, { 'n + 1' })
wait('repair', function() return #vim.diagnostic.get(0) == 0 end)
say('diagnostics', #vim.diagnostic.get(0))

vim.api.nvim_buf_set_lines(0, 8, 9, true, { 'ramp.' })
local labels = {}
for _, item in ipairs(ask('textDocument/completion', 9, 6).items) do
  table.insert(labels, item.label)
end
say('completion', table.concat(labels, ' '))

vim.api.nvim_buf_set_lines(0, 8, 9, true, { 'n:=n+1;' })
if vim.lsp.buf.format then
  vim.lsp.buf.format({ timeout_ms = milliseconds })
else
  vim.lsp.buf.formatting_sync(nil, milliseconds)
end
say('formatted', vim.api.nvim_buf_get_lines(0, 8, 9, true)[1])

vim.cmd('silent write')
vim.cmd('edit other.st')  -- the rename edits it, too
vim.cmd('buffer main.st')
vim.api.nvim_win_set_cursor(0, { 2, 10 })
vim.lsp.buf.rename('increment')
wait('rename', function() return vim.fn.getline(8):find('increment') end)
say('renamed', vim.fn.getline(2), vim.fn.getbufline(vim.fn.bufnr('other.st'), 3)[1])

vim.api.nvim_buf_set_lines(0, 8, 9, true, { 'n := m2;' })
wait('other diagnostic', function() return #vim.diagnostic.get(0) > 0 end)
vim.api.nvim_win_set_cursor(0, { 9, 5 })
vim.ui.select = function(actions, options, choose)
  for i, action in ipairs(actions) do
    if options.format_item(action):find('^Declare') then return choose(action, i) end
  end
  choose(actions[1], 1)
end
vim.lsp.buf.code_action()
wait('fix', function() return #vim.diagnostic.get(0) == 0 end)
say('fixed', vim.fn.getline(7))

vim.cmd('set hidden')
vim.cmd('edit Motor.TcPOU')
wait('diagnostic in XML', function() return #vim.diagnostic.get(0) > 0 end)
for _, diagnostic in ipairs(vim.diagnostic.get(0)) do
  say(vim.bo.filetype, diagnostic.lnum + 1 .. ':' .. diagnostic.col + 1, diagnostic.code, diagnostic.message)
end

io.stdout:write(table.concat(out, '\n') .. '\n')
vim.cmd('qall!')
