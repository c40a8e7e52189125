//! How far clients have followed what the room has made of their texts.
//!
//! A change that is not a client's own, as from another program, meets what the client has typed meanwhile. The client
//! puts the two together: it is told the room's text, which of its versions that has in it, and a number; it gives the
//! number back with the first text that has both. What comes from it before lacks the change, and is passed over: the
//! next one has it, too.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::notification;

/// How far one client has come, by the addresses of its texts.
#[derive(Debug, Default)]
pub(super) struct Following(BTreeMap<String, Text>);

#[derive(Debug, Default)]
struct Text {
    /// The client's last version that the room has.
    seen: i32,
    /// The number of the last change that the client was told.
    told: u32,
    /// The number of the last one that its text has in it.
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

    /// The client has a new version, perhaps with a change in it; whether it has all that it was told. One that is the
    /// room's own text has.
    pub fn has_all(&mut self, uri: &str, version: i32, taken: Option<u32>, is_same: bool) -> bool {
        let text = self.0.entry(uri.to_owned()).or_default();
        text.taken = if is_same { text.told } else { taken.unwrap_or(text.taken) };
        let has_all = text.taken >= text.told;
        if has_all {
            text.seen = version;
        }
        has_all
    }

    /// Whether the client was told a change that its text does not have yet.
    pub fn is_behind(&self, uri: &str) -> bool {
        self.0.get(uri).is_some_and(|text| text.taken < text.told)
    }

    /// What a client is told of a text that the room has.
    pub fn tell(&mut self, uri: &str, text: &str) -> lsp_server::Message {
        let one = self.0.entry(uri.to_owned()).or_default();
        one.told += 1;
        let (version, number) = (one.seen, one.told);
        let said: Value = json!({ "uri": uri, "text": text, "clean": true, "version": version, "number": number });
        notification("afp/changed", said)
    }
}
