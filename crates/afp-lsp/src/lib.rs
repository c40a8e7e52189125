//! The language server as a value: messages in, messages out.
//!
//! It has no I/O, no thread and no clock, so it runs over standard input, over a socket or in a
//! browser. Its [`Host`] provides the files that no client has open. [`Server::handle`] answers
//! requests immediately. Deferrable messages, such as diagnostics after a change, come from
//! [`Server::idle`]. Call it when no client message is waiting. A client that types faster than a
//! large plan compiles then skips the outdated compilations.
//!
//! It implements the Language Server Protocol 3.18, and AFP's own requests `afp/...` for drawings
//! and changes of meaning. `docs/editors.md` lists them.

mod answer;
mod conversation;
mod convert;
mod custom;
mod diagnostics;
mod dispatch;
mod documents;
mod file_edits;
mod host;
mod server;
mod standard;
mod uri;
mod workspace;

pub use answer::read_message;
pub use custom::Drawings;
pub use host::{Host, NoFiles};
pub use lsp_server::Message;
pub use server::Server;
pub use uri::{path_of, uri_of};

/// Whether a text contains a plan, even with errors.
pub fn holds_plan(text: &str) -> bool {
    let file =
        afp_syntax::parse(text, 0, &mut afp_syntax::diagnostics::Diagnostics::default()).file();
    file.items().iter().any(|item| matches!(item, afp_syntax::ast::Item::Plan(_)))
}
