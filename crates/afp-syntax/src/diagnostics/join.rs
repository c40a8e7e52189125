//! Reports a repeated cause once, with the number of its places.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use afp_excerpt::hidden::trick;

use super::render::thousands;
use super::{Code, Diagnostic, Diagnostics, Edit, Message, Words};
use crate::message;
use crate::source::Span;

/// The limit for the text of an edit that covers several places, in bytes.
const LONGEST_EDIT: usize = 64 << 10;

pub fn places(sentence: &Message, count: usize) -> Message {
    message!("{}, at {} places", sentence.clone(), Words(thousands(count)))
}

impl Diagnostics {
    /// Joins the diagnostics of a file about the same characters or names. `text` is the text of
    /// the file.
    pub(crate) fn join(&mut self, file: u16, text: &str) {
        let mut first: HashMap<(Code, &str), usize> = HashMap::new();
        let mut others: HashMap<usize, Vec<Option<Edit>>> = HashMap::new();
        let mut kept: Vec<Diagnostic> = Vec::with_capacity(self.list.len());
        let cause = |code: Code, span: Span| {
            let is_of_lexer = matches!(code, Code::E0101 | Code::E0113) && span.file == file;
            let cause = text.get(span.start as usize..span.end as usize).unwrap_or_default();
            // Each place that hides something is a danger of its own.
            let hides = !is_of_lexer || cause.chars().all(|each| trick(each).is_some());
            (!hides).then_some(cause)
        };
        for each in std::mem::take(&mut self.list) {
            let Some(cause) = cause(each.code, each.span) else {
                kept.push(each);
                continue;
            };
            match first.entry((each.code, cause)) {
                Entry::Occupied(known) => others.entry(*known.get()).or_default().push(each.fix),
                Entry::Vacant(new) => {
                    new.insert(kept.len());
                    kept.push(each);
                }
            }
        }
        self.counted.retain(|(span, code)| {
            let known = cause(*code, *span).and_then(|cause| first.get(&(*code, cause)));
            known.inspect(|known| others.entry(**known).or_default().push(None)).is_none()
        });
        for (at, fixes) in others {
            let Some(said) = kept.get_mut(at) else { continue };
            said.message = places(&said.message, fixes.len() + 1);
            let all = std::iter::once(said.fix.take()).chain(fixes).collect::<Option<Vec<_>>>();
            said.fix = all.and_then(|all| in_one(&all, text));
        }
        self.list = kept;
        self.note_all();
    }
}

/// Joins edits into one; they must be sorted by place.
fn in_one(edits: &[Edit], text: &str) -> Option<Edit> {
    let (first, last) = (edits.first()?.span, edits.last()?.span);
    let (mut better, mut at) = (String::new(), first.start as usize);
    let is_short = last.end.checked_sub(first.start)? as usize <= LONGEST_EDIT;
    for Edit { span, text: new } in edits.iter().filter(|_| is_short) {
        better += text.get(at..span.start as usize)?;
        better += new;
        at = span.end as usize;
    }
    is_short.then_some(Edit { span: Span { end: last.end, ..first }, text: better })
}
