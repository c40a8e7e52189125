//! Records the meanings of names during the check.
//!
//! The span of its name identifies a definition. The check has it at hand, so recording is a push.
//! The index numbers definitions at the end.

use std::cell::{Cell, RefCell};

use afp_syntax::source::Span;

use super::Word;

/// The meaning of a name. Of two meanings of one name, the greater one counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
// The tag has the width of its content, so that copies are of whole words.
#[repr(u32)]
pub(crate) enum Found {
    /// In text that could not be parsed.
    Unread,
    Unknown,
    /// A keyword, or a name of the robot.
    Word(Word),
    /// Several definitions, by index in [`Records::several`].
    Several(u32),
    /// A file, by [`Span::file`].
    File(u16),
    /// The definition with this name.
    Definition(Span),
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Records {
    /// Names with their meanings, unsorted.
    pub names: Vec<(Span, Found)>,
    /// The possible definitions of ambiguous names.
    pub several: Vec<Vec<Span>>,
    /// Short bindings, each with the name of its port, unsorted.
    pub alone: Vec<(Span, Span)>,
}

/// Records meanings of names. It is passed as a shared reference, since resolving changes nothing
/// else.
#[derive(Debug, Default)]
pub(crate) struct Recorder(RefCell<Records>);

impl Recorder {
    /// A recorder with capacity for a text: one name per dozen bytes.
    pub fn for_text(bytes: usize) -> Recorder {
        let names = Vec::with_capacity(bytes / 12);
        Recorder(RefCell::new(Records { names, ..Records::default() }))
    }

    pub fn definition(&self, name: Span, definition: Span) {
        self.record(name, Found::Definition(definition));
    }

    /// Records a short binding: in addition to the entry, recorded separately, it means the port
    /// named at `port`.
    pub fn alone(&self, name: Span, port: Span) {
        self.0.borrow_mut().alone.push((name, port));
    }

    pub fn several(&self, name: Span, definitions: impl IntoIterator<Item = Span>) {
        let mut records = self.0.borrow_mut();
        let place = u32::try_from(records.several.len()).unwrap_or(u32::MAX);
        records.several.push(definitions.into_iter().collect());
        records.names.push((name, Found::Several(place)));
    }

    pub fn file(&self, name: Span, file: u16) {
        self.record(name, Found::File(file));
    }

    /// Records a keyword, or a name of the robot.
    pub fn word(&self, name: Span, word: Word) {
        self.record(name, Found::Word(word));
    }

    pub fn unknown(&self, name: Span) {
        self.record(name, Found::Unknown);
    }

    /// Whether a name in some places means a definition.
    pub fn is_named_within(&self, definition: Span, places: &[Span]) -> bool {
        let records = self.0.borrow();
        let mut names = records.names.iter().filter(|it| it.1 == Found::Definition(definition));
        names.any(|(name, _)| places.iter().any(|place| place.contains(*name)))
    }

    pub fn take(&self) -> Records {
        self.0.take()
    }

    fn record(&self, name: Span, found: Found) {
        self.0.borrow_mut().names.push((name, found));
    }
}

/// Sorted records.
#[derive(Clone, Debug, Default)]
pub(crate) struct Meanings {
    /// Each name once.
    pub names: Vec<(Span, Found)>,
    /// The possible definitions of ambiguous names.
    pub several: Vec<Vec<Span>>,
    /// Short bindings, each with the name of its port.
    pub alone: Vec<(Span, Span)>,
}

impl Meanings {
    pub fn new(records: Records) -> Meanings {
        let Records { mut names, several, alone } = records;
        sort(&mut names);
        // The greatest of several meanings counts.
        names.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 = kept.1.max(next.1);
            }
            same
        });
        Meanings { names, several, alone }
    }

    /// Adds the records of later files.
    pub fn extend(&mut self, other: Meanings) {
        let first = u32::try_from(self.several.len()).unwrap_or(u32::MAX);
        self.names.extend(other.names.into_iter().map(|(name, found)| match found {
            Found::Several(place) => (name, Found::Several(first.saturating_add(place))),
            found => (name, found),
        }));
        self.several.extend(other.several);
        self.alone.extend(other.alone);
    }

    pub fn get(&self, name: Span) -> Option<Found> {
        self.lookup().get(name)
    }

    /// Returns a cursor for many queries.
    pub fn lookup(&self) -> Lookup<'_> {
        Lookup { names: &self.names, last: Cell::new(0) }
    }
}

/// Sorts names by place. The check visits a text nearly in order, so most names are in place and
/// others close to it; otherwise it falls back to a general sort.
fn sort(names: &mut [(Span, Found)]) {
    let mut moves = 16 * names.len();
    for at in 1..names.len() {
        let own = key(names[at].0);
        if key(names[at - 1].0) <= own {
            continue;
        }
        let before = names[..at].iter().rposition(|(name, _)| key(*name) <= own);
        let to = before.map_or(0, |before| before + 1);
        match moves.checked_sub(at - to) {
            Some(rest) => moves = rest,
            None => return names.sort_by_key(|(name, _)| key(*name)),
        }
        names[to..=at].rotate_right(1);
    }
}

/// A cursor for queries that are nearly in order.
pub(crate) struct Lookup<'a> {
    names: &'a [(Span, Found)],
    /// Index of the last answer.
    last: Cell<usize>,
}

impl Lookup<'_> {
    pub fn get(&self, name: Span) -> Option<Found> {
        let own = key(name);
        let near = self.last.get();
        let near = near..self.names.len().min(near + 8);
        let found = match self.names[near.clone()].iter().position(|(known, _)| *known == name) {
            Some(found) => near.start + found,
            None => self.names.binary_search_by_key(&own, |(known, _)| key(*known)).ok()?,
        };
        self.last.set(found);
        let (known, meaning) = self.names[found];
        (known == name).then_some(meaning)
    }
}

/// File and first byte as one number for fast comparison; no two names begin at one place.
pub(super) fn key(name: Span) -> u64 {
    u64::from(name.file) << 32 | u64::from(name.start)
}
