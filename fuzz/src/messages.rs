//! Messages to the language server: each request is answered once, and no message makes the server
//! fail.

use afp_lsp::{Message, NoFiles, Server};

use crate::text::text;

/// Each line that is a message is sent; other lines are ignored.
///
/// # Panics
/// A request has no response or several.
pub fn messages(data: &[u8]) {
    let mut server = Server::new(Box::new(NoFiles));
    for line in text(data).lines() {
        let Ok(message) = serde_json::from_str::<Message>(line) else { continue };
        let asked = usize::from(matches!(message, Message::Request(_)));
        let said = server.handle(message);
        let answers = said.iter().filter(|said| matches!(said, Message::Response(_))).count();
        assert_eq!(answers, asked, "{line}");
        server.idle();
    }
}
