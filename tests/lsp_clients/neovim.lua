-- SPDX-License-Identifier: MIT
-- Neovim as a client of `lsc lsp`: open, edit, diagnose, fix, rename, complete, format.
-- Usage: nvim --headless -u NONE -i NONE -n -c 'luafile neovim.lua'
--   LSC: the program; FOLDER: an empty folder for the grammars

local lsc, folder = os.getenv('LSC'), os.getenv('FOLDER')

local function fail(text)
  io.stderr:write('neovim: ' .. text .. '\n')
  vim.cmd('cquit 1')
end

local function check(truth, text)
  if not truth then
    fail(debug.traceback(text, 2))
  end
end

-- Waits until `is_done` is true.
local function await(text, is_done)
  check(vim.wait(10000, is_done, 5), text .. ' did not happen')
end

local function write_file(name, lines)
  vim.fn.writefile(lines, folder .. '/' .. name)
end

local function lines_of(buffer)
  return vim.api.nvim_buf_get_lines(buffer, 0, -1, false)
end

local function run()
  vim.o.hidden = true
  write_file('part.lsys', { '#leaf : L : * : F(size);' })
  write_file('tree.lsys', {
    '#n = 2;',
    '#define size 2;',
    '#include "part.lsys";',
    '#w : A(1) L;',
    '#grow : A(x) : x < size : F(x) A(x + 1);',
    '#stop : A(x) : x > size : F(zz);',
  })
  vim.cmd('edit ' .. folder .. '/tree.lsys')
  vim.bo.filetype = 'lsys'
  local tree = vim.api.nvim_get_current_buf()
  local id = vim.lsp.start_client({ name = 'lsc', cmd = { lsc, 'lsp' }, root_dir = folder })
  check(id, 'no client')
  vim.lsp.buf_attach_client(tree, id)

  -- Diagnose.
  local function codes(buffer)
    local all = {}
    for _, diagnostic in ipairs(vim.diagnostic.get(buffer)) do
      table.insert(all, diagnostic.code or diagnostic.user_data.lsp.code)
    end
    table.sort(all)
    return table.concat(all, ' ')
  end
  await('an error', function() return codes(tree):find('unknown%-name') end)
  local error = vim.tbl_filter(function(each)
    return each.severity == vim.diagnostic.severity.ERROR
  end, vim.diagnostic.get(tree))[1]
  check(error.lnum == 5 and error.col == 28, vim.inspect(error))

  -- Edit: only the changed text is sent.
  vim.api.nvim_buf_set_text(tree, 5, 28, 5, 30, { '3' })
  await('its end', function() return codes(tree) == 'condition-gap' end)

  -- Fix.
  vim.api.nvim_win_set_cursor(0, { 6, 18 })
  local client = vim.lsp.get_client_by_id(id)
  local function request(method, more)
    local params = vim.tbl_extend('force', vim.lsp.util.make_position_params(0), more or {})
    local answer, problem = client.request_sync(method, params, 10000, tree)
    check(answer and not answer.err, method .. ': ' .. vim.inspect(answer or problem))
    return answer.result
  end
  local range = vim.lsp.util.make_range_params()
  range.context = { diagnostics = vim.lsp.diagnostic.get_line_diagnostics(tree) }
  local actions = request('textDocument/codeAction', range)
  check(#actions > 0, 'no fixes')
  vim.lsp.util.apply_workspace_edit(actions[1].edit, client.offset_encoding)
  await('no message', function() return codes(tree) == '' end)

  -- Rename in both files.
  vim.cmd('badd ' .. folder .. '/part.lsys')
  vim.api.nvim_win_set_cursor(0, { 2, 9 })
  vim.lsp.buf.rename('reach')
  await('a new name', function() return lines_of(tree)[2] == '#define reach 2;' end)
  local part = vim.fn.bufnr(folder .. '/part.lsys')
  await('a new name in the other file', function()
    return vim.api.nvim_buf_is_loaded(part) and lines_of(part)[1] == '#leaf : L : * : F(reach);'
  end)
  vim.cmd('silent wall')
  check(codes(tree) == '', codes(tree))

  -- Complete.
  vim.api.nvim_buf_set_lines(tree, -1, -1, false, { '#more : L : * : ' })
  vim.api.nvim_win_set_cursor(0, { 7, 16 })
  local words = {}
  for _, item in ipairs(request('textDocument/completion')) do
    words[item.label] = true
  end
  check(words.A and words.L and words.F and words['+'], vim.inspect(words))
  vim.bo.omnifunc = 'v:lua.vim.lsp.omnifunc'
  vim.api.nvim_buf_set_lines(tree, -2, -1, false, {})

  -- Hover, definition, symbols.
  vim.api.nvim_win_set_cursor(0, { 2, 9 })
  check(vim.inspect(request('textDocument/hover')):find('value: 2'), 'no value')
  check(request('textDocument/definition')[1].range.start.line == 1, 'no definition')
  check(#request('textDocument/documentSymbol') >= 5, 'no symbols')

  -- Format.
  vim.api.nvim_buf_set_lines(tree, 0, 1, false, { '#n   =2;' })
  vim.lsp.buf.formatting_sync(nil, 10000)
  check(lines_of(tree)[1] == '#n = 2;', lines_of(tree)[1])
  await('no message at the end', function() return codes(tree) == '' end)

  -- End: the server has ended by itself.
  client.stop()
  await('the end', function() return client.is_stopped() end)
  print('neovim: all passed\n')
  vim.cmd('qall!')
end

local is_good, problem = pcall(run)
if not is_good then
  fail(tostring(problem))
end
