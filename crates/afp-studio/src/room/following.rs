//! The progress of clients with the room's changes of their texts.
//!
//! A change from elsewhere, such as another program, meets the client's own typing. The client
//! merges the two. It receives the room's text, the last of its versions included there, and a
//! number. It returns the number with the first merged text. Earlier texts of the client lack the
//! change and are ignored, since the next one also contains their typing.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::notification;

/// The progress of one client, by the addresses of its texts.
#[derive(Debug, Default)]
pub(super) struct Following(BTreeMap<String, Text>);

#[derive(Debug, Default)]
struct Text {
    /// The client's last version in the room.
    seen: i32,
    /// The number of the last change sent to the client.
    told: u32,
    /// The number of the last change in its text.
    taken: u32,
}

impl Following {
    /// The client has opened a text.
    pub fn opened(&mut self, uri: &str, version: i32) {
        self.0.insert(uri.to_owned(), Text { seen: version, ..Text::default() });
    }

    /// The client has closed a text.
    pub fn closed(&mut self, uri: &str) {
        self.0.remove(uri);
    }

    /// Notes a new version of the client, and returns whether it has all changes. A text equal to
    /// the room's has them.
    pub fn has_all(&mut self, uri: &str, version: i32, taken: Option<u32>, is_same: bool) -> bool {
        let text = self.0.entry(uri.to_owned()).or_default();
        text.taken = if is_same { text.told } else { taken.unwrap_or(text.taken) };
        let has_all = text.taken >= text.told;
        if has_all {
            text.seen = version;
        }
        has_all
    }

    /// Whether a change sent to the client is missing in its text.
    pub fn is_behind(&self, uri: &str) -> bool {
        self.0.get(uri).is_some_and(|text| text.taken < text.told)
    }

    pub fn tell(&mut self, uri: &str, text: &str) -> lsp_server::Message {
        let one = self.0.entry(uri.to_owned()).or_default();
        one.told += 1;
        let (version, number) = (one.seen, one.told);
        let said: Value = json!({ "uri": uri, "text": text, "clean": true, "version": version, "number": number });
        notification("afp/changed", said)
    }
}
