//! `afpc lsp` over standard input and output: by hand, and by Neovim with its own client.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

use crate::common::Place;

const BROKEN: &str = "use carbot\n\nplan P {\n    start go\n    actor go: Forward(distance = 30) { \
                      ForwardSuccessful -> terminate }\n}\n";

/// The server with its pipes.
struct Spoken {
    child: Child,
    out: BufReader<ChildStdout>,
}

impl Spoken {
    fn new(place: &Place) -> Spoken {
        let mut command = place.command();
        command.arg("lsp").stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        Spoken { child, out }
    }

    fn say(&mut self, message: &str) {
        let stdin = self.child.stdin.as_mut().unwrap();
        write!(stdin, "Content-Length: {}\r\n\r\n{message}", message.len()).unwrap();
        stdin.flush().unwrap();
    }

    fn hear(&mut self) -> String {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.out.read_line(&mut line).unwrap();
            match line.trim_end().split_once(": ") {
                Some(("Content-Length", number)) => length = number.parse().unwrap(),
                Some(_) => {}
                None => break,
            }
        }
        let mut body = vec![0; length];
        self.out.read_exact(&mut body).unwrap();
        String::from_utf8(body).unwrap()
    }
}

#[test]
fn a_client_initializes_opens_a_plan_and_exits() {
    let place = Place::new();
    let mut server = Spoken::new(&place);
    server.say(r#"{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}"#);
    let hello = server.hear();
    assert!(hello.contains("hoverProvider") && hello.contains("afp/drawing"), "{hello}");
    server.say(r#"{"jsonrpc":"2.0","method":"initialized","params":{}}"#);
    let uri = format!("file://{}", place.path("p.afp").display());
    let text = BROKEN.replace('\n', "\\n");
    server.say(&format!(
        r#"{{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{{"textDocument":{{"uri":"{uri}","languageId":"afp","version":1,"text":"{text}"}}}}}}"#
    ));
    let wrong = server.hear();
    assert!(wrong.contains("publishDiagnostics") && wrong.contains("E0203"), "{wrong}");
    // A definition in a built-in toolbox leads to an existing file.
    server.say(&format!(
        r#"{{"jsonrpc":"2.0","id":2,"method":"textDocument/definition","params":{{"textDocument":{{"uri":"{uri}"}},"position":{{"line":4,"character":16}}}}}}"#
    ));
    let found = server.hear();
    let path = found.split("file://").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
    assert!(std::fs::read_to_string(path).unwrap().contains("actor Forward"), "{found}");
    server.say(r#"{"jsonrpc":"2.0","id":3,"method":"shutdown"}"#);
    assert!(server.hear().contains(r#""result":null"#));
    server.say(r#"{"jsonrpc":"2.0","method":"exit"}"#);
    assert_eq!(server.child.wait().unwrap().code(), Some(0));
}

#[test]
fn the_server_ends_when_its_client_is_gone() {
    let place = Place::new();
    let mut server = Spoken::new(&place);
    drop(server.child.stdin.take());
    assert_eq!(server.child.wait().unwrap().code(), Some(0));
}

/// A folder whose toolbox has a crate: a build would leave a file.
fn untrusted() -> Place {
    let place = Place::new();
    place.write("afp.toml", "[toolboxes]\ngripper = { path = \"gripper/gripper.afp\" }\n");
    let toolbox = "/// Grips.\ntoolbox gripper\n\n/// Grips.\nactor Grip { state Gripped }\n";
    place.write("gripper/gripper.afp", toolbox);
    let manifest =
        "[package]\nname = \"gripper\"\nversion = \"0.1.0\"\nedition = \"2024\"\n[workspace]\n";
    place.write("gripper/Cargo.toml", manifest);
    place.write("gripper/src/lib.rs", "");
    let marks = "fn main() { std::fs::write(\"../marker\", \"\").unwrap(); }\n";
    place.write("gripper/build.rs", marks);
    place.write(
        "p.afp",
        "use gripper\n\nplan P {\n    start grip\n    actor grip: Grip { Gripped -> terminate }\n}\n",
    );
    place
}

#[test]
fn opening_checking_drawing_and_hovering_run_no_code_of_a_folder() {
    let place = untrusted();
    place.afpc("check p.afp").succeeds();
    place.afpc("graph p.afp").succeeds();
    let mut server = Spoken::new(&place);
    server.say(r#"{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}"#);
    server.hear();
    server.say(r#"{"jsonrpc":"2.0","method":"initialized","params":{}}"#);
    let uri = format!("file://{}", place.path("p.afp").display());
    let text = place.read("p.afp").replace('\n', "\\n");
    server.say(&format!(
        r#"{{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{{"textDocument":{{"uri":"{uri}","languageId":"afp","version":1,"text":"{text}"}}}}}}"#
    ));
    let said = server.hear();
    assert!(said.contains(r#""diagnostics":[]"#), "{said}");
    for (id, method, more) in [
        (2, "textDocument/hover", r#","position":{"line":4,"character":18}"#),
        (3, "afp/drawing", ""),
        (4, "textDocument/completion", r#","position":{"line":4,"character":18}"#),
    ] {
        server.say(&format!(
            r#"{{"jsonrpc":"2.0","id":{id},"method":"{method}","params":{{"textDocument":{{"uri":"{uri}"}}{more}}}}}"#
        ));
        let said = server.hear();
        assert!(said.contains("Grip"), "{method}: {said}");
    }
    assert!(!place.exists("marker"));
    // A build would leave the file.
    let mut build = Command::new(env!("CARGO"));
    let done = build.args(["check", "--offline", "--quiet"]).current_dir(place.path("gripper"));
    assert!(done.status().unwrap().success());
    assert!(place.exists("marker"));
}

/// The script for Neovim and its own client. It writes one word for each result and always exits:
/// after an error, Neovim would wait for a key.
const SCRIPT: &str = r#"
local out = {}
local function all()
local function note(name, fine) table.insert(out, name .. "=" .. tostring(fine)) end
vim.cmd("edit plan.afp")
local buffer = vim.api.nvim_get_current_buf()
local function clients() return (vim.lsp.get_clients or vim.lsp.get_active_clients)() end
note("attached", vim.wait(20000, function() return #clients() == 1 end))
local function has(count) return function() return #vim.diagnostic.get(buffer) == count end end
note("diagnostic", vim.wait(20000, has(1)))
local client = clients()[1]
local function ask(method, line, character, more)
  local params = { textDocument = vim.lsp.util.make_text_document_params(buffer), position = { line = line, character = character } }
  local said = client.request_sync(method, vim.tbl_extend("force", params, more or {}), 20000, buffer)
  return said and said.result
end
local hover = ask("textDocument/hover", 4, 16)
note("hover", hover ~= nil and hover.contents.value:find("Drive straight ahead") ~= nil)
local here = { line = 4, character = 34 }
local actions = ask("textDocument/codeAction", 4, 34, { range = { start = here, ["end"] = here }, context = { diagnostics = {} } })
vim.lsp.util.apply_workspace_edit(actions[1].edit, client.offset_encoding)
note("fixed", vim.api.nvim_buf_get_lines(buffer, 4, 5, false)[1]:find("distance = 30 cm", 1, true) ~= nil)
note("silent", vim.wait(20000, has(0)))
local renamed = ask("textDocument/rename", 4, 11, { newName = "drive" })
vim.lsp.util.apply_workspace_edit(renamed, client.offset_encoding)
note("renamed", vim.api.nvim_buf_get_lines(buffer, 3, 4, false)[1] == "    start drive")
local drawing = ask("afp/drawing", 0, 0)
note("drawn", drawing ~= nil and drawing.plan == "P" and #drawing.elements == 2)
local items = ask("textDocument/completion", 4, 17)
note("completed", items ~= nil and #items.items > 5)
end
local fine, why = xpcall(all, debug.traceback)
if not fine then table.insert(out, why) end
vim.fn.writefile(vim.split(table.concat(out, "\n"), "\n"), "found.txt")
vim.cmd("quitall!")
"#;

/// The configuration of Neovim on the page about editors, first or second block.
fn lua(nth: usize) -> String {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let blocks = afp_book::blocks(&docs).unwrap().into_iter();
    let of_editors = |block: &afp_book::Block| block.page == "editors" && block.kind == "lua";
    blocks.filter(of_editors).nth(nth).unwrap().text
}

#[test]
fn neovim_fixes_and_renames_with_its_own_client() {
    let Ok(version) = Command::new("nvim").arg("--version").output() else {
        eprintln!("skipped: 'nvim' is not installed; run 'apt-get install neovim'");
        return;
    };
    let version = String::from_utf8_lossy(&version.stdout);
    let version = version.lines().next().unwrap_or_default();
    let place = Place::new();
    place.write("plan.afp", BROKEN);
    place.write("afp.toml", "");
    let (new, old) = (lua(0), lua(1));
    let init = format!("if vim.fn.has('nvim-0.11') == 1 then\n{new}else\n{old}end\n");
    place.write("init.lua", &init);
    place.write("ask.lua", SCRIPT);
    let mut command = Command::new("nvim");
    command.args(["--headless", "--clean", "-n", "-u", "init.lua", "-c", "luafile ask.lua"]);
    let afpc = Path::new(env!("CARGO_BIN_EXE_afpc")).parent().unwrap().to_owned();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(afpc).chain(std::env::split_paths(&others)));
    command.current_dir(place.path("")).env("PATH", path.unwrap());
    command.env("XDG_CACHE_HOME", place.path("cache")).env("XDG_STATE_HOME", place.path("state"));
    command.stdin(Stdio::null());
    let said = command.output().unwrap();
    let said = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(place.exists("found.txt"), "{version}: {said}");
    let found = place.read("found.txt");
    let names =
        ["attached", "diagnostic", "hover", "fixed", "silent", "renamed", "drawn", "completed"];
    let expected: String = names.iter().map(|name| format!("{name}=true\n")).collect();
    assert_eq!(found, expected, "{version}: {said}");
}
