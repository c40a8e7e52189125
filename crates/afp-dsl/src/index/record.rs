//! What the check says of names while it resolves them.
//!
//! A definition is known by the span of its own name, which the check has at hand wherever it
//! resolves something, so recording costs a push. The index gives them numbers at the end.

use std::cell::{Cell, RefCell};

use afp_syntax::source::Span;

use super::Word;

/// What a written name means, as the check has found it. The order says which of two findings about
/// one name counts: the last one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
// A tag as wide as what it carries: copies are of whole words.
#[repr(u32)]
pub(crate) enum Found {
    /// It stands in text that could not be read.
    Unread,
    /// Nothing that is known.
    Unknown,
    /// A word of the language, or of the robot.
    Word(Word),
    /// Several definitions, by their place among [`Records::several`].
    Several(u32),
    /// A file, by [`Span::file`].
    File(u16),
    /// The definition whose name stands there.
    Definition(Span),
}

/// Everything that was recorded.
#[derive(Clone, Debug, Default)]
pub(crate) struct Records {
    /// Names as written, each with its meaning, in no order.
    pub names: Vec<(Span, Found)>,
    /// The definitions that ambiguous names may mean.
    pub several: Vec<Vec<Span>>,
    /// Names that are bindings by themselves, each with the name of its port, in no order.
    pub alone: Vec<(Span, Span)>,
}

/// Takes down what names mean. It is handed around as a shared reference, since what resolves names
/// changes nothing else.
#[derive(Debug, Default)]
pub(crate) struct Recorder(RefCell<Records>);

impl Recorder {
    /// A recorder for a text of so many bytes, which has a name in a dozen of them.
    pub fn for_text(bytes: usize) -> Recorder {
        let names = Vec::with_capacity(bytes / 12);
        Recorder(RefCell::new(Records { names, ..Records::default() }))
    }

    /// A name means the definition whose own name stands at `definition`.
    pub fn definition(&self, name: Span, definition: Span) {
        self.record(name, Found::Definition(definition));
    }

    /// A name is a binding by itself: beside the entry, which is recorded as any other, it means the port whose own
    /// name stands at `port`.
    pub fn alone(&self, name: Span, port: Span) {
        self.0.borrow_mut().alone.push((name, port));
    }

    /// A name may mean any of several definitions.
    pub fn several(&self, name: Span, definitions: impl IntoIterator<Item = Span>) {
        let mut records = self.0.borrow_mut();
        let place = u32::try_from(records.several.len()).unwrap_or(u32::MAX);
        records.several.push(definitions.into_iter().collect());
        records.names.push((name, Found::Several(place)));
    }

    /// A name means a file.
    pub fn file(&self, name: Span, file: u16) {
        self.record(name, Found::File(file));
    }

    /// A name is a word of the language, or of the robot.
    pub fn word(&self, name: Span, word: Word) {
        self.record(name, Found::Word(word));
    }

    /// A name means nothing that is known.
    pub fn unknown(&self, name: Span) {
        self.record(name, Found::Unknown);
    }

    /// Whether a name in some of these places means a definition.
    pub fn is_named_within(&self, definition: Span, places: &[Span]) -> bool {
        let records = self.0.borrow();
        let mut names = records.names.iter().filter(|it| it.1 == Found::Definition(definition));
        names.any(|(name, _)| places.iter().any(|place| place.contains(*name)))
    }

    /// Takes everything so far.
    pub fn take(&self) -> Records {
        self.0.take()
    }

    fn record(&self, name: Span, found: Found) {
        self.0.borrow_mut().names.push((name, found));
    }
}

/// What was recorded, in the order of the names.
#[derive(Clone, Debug, Default)]
pub(crate) struct Meanings {
    /// Each name once.
    pub names: Vec<(Span, Found)>,
    /// The definitions that ambiguous names may mean.
    pub several: Vec<Vec<Span>>,
    /// Names that are bindings by themselves, each with the name of its port.
    pub alone: Vec<(Span, Span)>,
}

impl Meanings {
    /// Puts records in order.
    pub fn new(records: Records) -> Meanings {
        let Records { mut names, several, alone } = records;
        sort(&mut names);
        // Of several findings the greatest one counts.
        names.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 = kept.1.max(next.1);
            }
            same
        });
        Meanings { names, several, alone }
    }

    /// Adds what is said of files that come behind those so far.
    pub fn extend(&mut self, other: Meanings) {
        let first = u32::try_from(self.several.len()).unwrap_or(u32::MAX);
        self.names.extend(other.names.into_iter().map(|(name, found)| match found {
            Found::Several(place) => (name, Found::Several(first.saturating_add(place))),
            found => (name, found),
        }));
        self.several.extend(other.several);
        self.alone.extend(other.alone);
    }

    /// What the name at a place means.
    pub fn get(&self, name: Span) -> Option<Found> {
        self.lookup().get(name)
    }

    /// Answers many questions about the names.
    pub fn lookup(&self) -> Lookup<'_> {
        Lookup { names: &self.names, last: Cell::new(0) }
    }
}

/// Sorts names by their places. The check goes through a text nearly in order, so most names are where
/// they belong and the others a few places off; where they are not, they are sorted as any list is.
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

/// Answers questions about names that are asked nearly in the order of their places.
pub(crate) struct Lookup<'a> {
    names: &'a [(Span, Found)],
    /// Where the last answer was.
    last: Cell<usize>,
}

impl Lookup<'_> {
    /// What the name at a place means.
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

/// File and first byte in one number, by which names are quickly compared; no two begin at one place.
pub(super) fn key(name: Span) -> u64 {
    u64::from(name.file) << 32 | u64::from(name.start)
}
