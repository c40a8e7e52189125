//! `afpc lsp`: the language server over standard input and output.

use afp_lsp::Server;
use afp_run::{EXIT_OK, RunError};
use lsp_server::Connection;

use super::disk::Disk;
use crate::no_plan::NoPlan;

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
