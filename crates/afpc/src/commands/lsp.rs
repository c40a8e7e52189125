//! `afpc lsp`: the language server over standard input and output.

use std::fs;
use std::path::Path;

use afp_lsp::{Host, Server};
use afp_run::{EXIT_OK, RunError, write_whole};
use lsp_server::Connection;

use crate::plan_file::{NoPlan, read_used};

pub const EXAMPLES: &str = "\
Editors start it; docs/editors.md says how. It is made to be spoken to by a program: messages come in
on standard input and go out on standard output.";

/// Serves one client until it says goodbye or is gone.
///
/// # Errors
/// Standard input or output break off within a message.
pub fn run() -> Result<u8, NoPlan> {
    let (connection, threads) = Connection::stdio();
    let mut server = Server::new(Box::new(Disk));
    while let Ok(message) = connection.receiver.recv() {
        let mut answers = server.handle(message);
        if connection.receiver.is_empty() {
            answers.extend(server.idle());
        }
        for answer in answers {
            // Who does not read any more is gone, which the next message shows.
            let _ = connection.sender.send(answer);
        }
        if server.exit_code().is_some() {
            break;
        }
    }
    drop(connection);
    threads
        .join()
        .map_err(RunError::file("cannot talk to the editor over", "standard input".as_ref()))?;
    Ok(server.exit_code().unwrap_or(EXIT_OK))
}

/// The files of this machine.
#[derive(Debug)]
struct Disk;

/// Folders deeper than this are not searched for plans.
const DEPTH: usize = 12;

impl Host for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        read_used(path)
    }

    fn plan_files(&self, folder: &str) -> Vec<String> {
        let mut paths = Vec::new();
        search(Path::new(folder), DEPTH, &mut paths);
        paths.sort();
        paths
    }

    fn built_in(&self, name: &str, text: &str) -> Option<String> {
        let folder = afp_build::cache()?.join("toolboxes").join(env!("CARGO_PKG_VERSION"));
        let path = folder.join(name);
        if fs::read_to_string(&path).is_ok_and(|known| known == text) {
            return path.to_str().map(str::to_owned);
        }
        fs::create_dir_all(&folder).ok()?;
        write_whole("cannot write the toolbox", &path, text).ok()?;
        path.to_str().map(str::to_owned)
    }
}

/// The plan files and toolboxes below a folder; hidden folders and those that builds fill are left out.
fn search(folder: &Path, depth: usize, paths: &mut Vec<String>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let (name, path) = (entry.file_name(), entry.path());
        let name = name.to_string_lossy();
        // Links are not followed, so that no circle is walked.
        let Ok(kind) = entry.file_type() else { continue };
        if kind.is_dir()
            && depth > 0
            && !name.starts_with('.')
            && name != "target"
            && name != "node_modules"
        {
            search(&path, depth - 1, paths);
        } else if kind.is_file() && name.ends_with(".afp") {
            paths.extend(path.to_str().map(str::to_owned));
        }
    }
}
