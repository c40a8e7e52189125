-- What Neovim finds in a plan with the parser and the queries as docs/editors.md installs them; one line for each.
local parser = vim.treesitter.get_parser(0, "afp")
local root = parser:parse()[1]:root()
local query = (vim.treesitter.query.get or vim.treesitter.get_query)("afp", "highlights")
local text = vim.treesitter.get_node_text or vim.treesitter.query.get_node_text
local found = { "errors " .. tostring(root:has_error()) }
local seen = {}
for id, node in query:iter_captures(root, 0, 0, -1) do
  seen[query.captures[id] .. " " .. text(node, 0)] = true
end
for _, expected in ipairs({ "keyword supervise", "type Forward", "function followWall", "number 30", "property walldist" }) do
  table.insert(found, expected .. " " .. tostring(seen[expected] or false))
end
io.stdout:write(table.concat(found, "\n") .. "\n")
vim.cmd("qa!")
