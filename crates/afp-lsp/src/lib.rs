//! The language server as a value: messages go in, messages come out.
//!
//! It does no I/O and knows no thread and no clock, so it runs wherever it is put: behind standard
//! input, behind a socket, in a browser. What no client has open it asks its [`Host`] for. A request is
//! answered by the call of [`Server::handle`] that brings it; what can wait, such as diagnostics after
//! a change, comes from [`Server::idle`], which its owner calls when no further message is waiting. So
//! a client that types faster than a large plan is compiled is not kept waiting by what it has typed over.
//!
//! It speaks the Language Server Protocol 3.18, and requests of its own named `afp/...` for drawings
//! and changes of meaning, which `docs/editors.md` lists.

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

/// Whether a text has a plan in it, whatever else is wrong with it.
pub fn holds_plan(text: &str) -> bool {
    let file =
        afp_syntax::parse(text, 0, &mut afp_syntax::diagnostics::Diagnostics::default()).file();
    file.items().iter().any(|item| matches!(item, afp_syntax::ast::Item::Plan(_)))
}
