-- neovim, without a screen, opens a domain with a mistake in it and uses the language server as a person would.
-- nvim --headless -u NONE -i NONE -c 'luafile tests/clients/neovim.lua'; CAVEAT names the program, FOLDER a copy of the folder.

local function check(condition, message)
  if not condition then
    io.stderr:write("neovim: " .. message .. "\n")
    vim.cmd("cquit 1")
  end
end

local folder = os.getenv("FOLDER")
vim.cmd("edit " .. folder .. "/domain.pddl")
local client = vim.lsp.start_client({
  cmd = { os.getenv("CAVEAT"), "lsp" },
  root_dir = folder,
  workspace_folders = { { uri = vim.uri_from_fname(folder), name = "pddl" } },
})
check(client, "the server does not start")
check(vim.lsp.buf_attach_client(0, client), "the server does not take the buffer")

local function diagnostics()
  return vim.diagnostic.get(0)
end
local function find(text)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    local column = line:find(text, 1, true)
    if column then
      return number, column - 1
    end
  end
end
local function place(text, offset)
  local line, column = find(text)
  check(line, text .. " is not in the buffer")
  vim.api.nvim_win_set_cursor(0, { line, column + (offset or 0) })
  return vim.lsp.util.make_position_params()
end
local function ask(method, params)
  local answers = vim.lsp.buf_request_sync(0, method, params, 5000)
  check(answers and answers[client], method .. " has no answer")
  check(not answers[client].err, method .. " fails: " .. vim.inspect(answers[client].err))
  return answers[client].result
end

-- Diagnostics and a quick fix.
local line = find(":effect (clean ?c))")
vim.api.nvim_buf_set_lines(0, line - 1, line, false, { "    :efect (clean ?c))" })
check(vim.wait(5000, function() return #diagnostics() == 1 end), "one diagnostic is wanted")
check(diagnostics()[1].code == "E0005", "E0005 is wanted, not " .. vim.inspect(diagnostics()))
check(diagnostics()[1].lnum == line - 1, "the diagnostic is on another line")
local params = place(":efect")
params.range = { start = params.position, ["end"] = params.position }
params.context = { diagnostics = vim.lsp.diagnostic.get_line_diagnostics(0, line - 1) }
local actions = ask("textDocument/codeAction", params)
check(#actions > 0, "there is no quick fix")
vim.lsp.util.apply_workspace_edit(actions[1].edit, "utf-16")
check(find(":effect (clean ?c))"), "the quick fix does not mend the field")
check(vim.wait(5000, function() return #diagnostics() == 0 end), "the diagnostic does not go away")

-- Hover and definition.
local hover = ask("textDocument/hover", place("(at ?c sink)", 1))
check(hover.contents.value:find("where a cup stands", 1, true), "the hover has no comment")
local definition = ask("textDocument/definition", place("(at ?c sink)", 1))
definition = definition[1] or definition
local declared = find("(at ?c - cup ?p - place)")
check((definition.range or definition.targetSelectionRange).start.line == declared - 1, "the definition is elsewhere")

-- Rename, which also changes a file that is not open.
params = place("(clean ?c - cup)", 1)
params.newName = "washed"
vim.lsp.util.apply_workspace_edit(ask("textDocument/rename", params), "utf-16")
check(find("(washed ?c - cup)") and not find("(clean"), "the predicate is not renamed")
vim.cmd("wall")
local problem = table.concat(vim.fn.readfile(folder .. "/p01.pddl"), "\n")
check(problem:find("(washed red)", 1, true), "the problem is not renamed along")

-- Formatting.
line = find("(:types cup place)")
vim.api.nvim_buf_set_lines(0, line - 1, line, false, { "         (:types    cup place)" })
vim.lsp.buf.formatting_sync(nil, 5000)
check(vim.api.nvim_buf_get_lines(0, line - 1, line, false)[1] == "  (:types cup place)", "the line is not formatted")

vim.lsp.stop_client(client)
print("neovim: diagnostics, quick fix, hover, definition, rename and formatting work")
vim.cmd("qall!")
