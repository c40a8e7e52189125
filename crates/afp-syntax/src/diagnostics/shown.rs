//! The messages of a diagnostic, created only for display.

use std::cell::Cell;

use super::{Diagnostic, Message};
use crate::source::Span;

thread_local! {
    /// Whether each text consists of the code only.
    static ONLY_CODES: Cell<bool> = Cell::new(std::env::var_os("AFP_ONLY_CODES").is_some());
}

/// Shows codes instead of messages on this thread, so that a test fails if code depends on the
/// wording.
///
/// The variable `AFP_ONLY_CODES` does the same for a whole program. Builds without debug assertions
/// ignore both.
#[doc(hidden)]
pub fn show_only_codes(only: bool) {
    ONLY_CODES.set(only);
}

fn only_codes() -> bool {
    cfg!(debug_assertions) && ONLY_CODES.get()
}

impl Diagnostic {
    pub fn message_text(&self) -> String {
        self.message_without("")
    }

    /// The message without the part that `sign` was found.
    pub fn message_without(&self, sign: &str) -> String {
        let mut text = self.shown(&self.message);
        let found = self.found.as_ref().filter(|found| !found.is_name(sign) && !only_codes());
        if let Some(found) = found {
            text += ", found ";
            found.write(&mut text);
        }
        text
    }

    /// The help; empty if there is none.
    pub fn help_text(&self) -> String {
        self.shown(&self.help)
    }

    /// Related places with their notes.
    pub fn note_texts(&self) -> impl Iterator<Item = (Span, String)> {
        self.notes.iter().map(|note| (note.span, self.shown(&note.text)))
    }

    fn shown(&self, message: &Message) -> String {
        let mut text = String::new();
        match only_codes() && !message.is_empty() {
            true => text += self.code.as_str(),
            false => message.write(&mut text),
        }
        text
    }
}
