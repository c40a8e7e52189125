//! The texts of a diagnostic, made when they are shown.

use std::cell::Cell;

use super::{Diagnostic, Message};
use crate::source::Span;

thread_local! {
    /// Whether each text is the code alone.
    static ONLY_CODES: Cell<bool> = Cell::new(std::env::var_os("AFP_ONLY_CODES").is_some());
}

/// Shows codes in place of all texts on this thread, so that a test fails if something decides by the wording.
///
/// The variable `AFP_ONLY_CODES` does the same for a whole program. Builds without debug assertions ignore both.
#[doc(hidden)]
pub fn show_only_codes(only: bool) {
    ONLY_CODES.set(only);
}

fn only_codes() -> bool {
    cfg!(debug_assertions) && ONLY_CODES.get()
}

impl Diagnostic {
    /// What is wrong.
    pub fn message_text(&self) -> String {
        self.message_without("")
    }

    /// What is wrong; that `sign` was found there is left out.
    pub fn message_without(&self, sign: &str) -> String {
        let mut text = self.shown(&self.message);
        let found = self.found.as_ref().filter(|found| !found.is_name(sign) && !only_codes());
        if let Some(found) = found {
            text += ", found ";
            found.write(&mut text);
        }
        text
    }

    /// What to do; empty if nothing is known.
    pub fn help_text(&self) -> String {
        self.shown(&self.help)
    }

    /// Other places that matter, and what is there.
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
