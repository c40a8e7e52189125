//! Names of one scope: each is unique, valid in Rust, and differs in more than case.

use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words, list, words};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::units::Unit;
use rustc_hash::FxHashMap;

/// Maximum number of names in a help.
const MOST_LISTED: usize = 12;

/// Names without a raw spelling in Rust, or with a fixed meaning.
const REFUSED: &[&str] = &["self", "Self", "super", "crate", "true", "false"];

#[derive(Default)]
pub(crate) struct DeclaredNames {
    declared: FxHashMap<String, Name>,
}

impl DeclaredNames {
    /// Declares a name and reports its errors. Returns whether the name is new.
    pub fn declare(&mut self, name: &Name, diags: &mut Diagnostics) -> bool {
        let key = key(&name.text);
        if REFUSED.contains(&name.text.as_str()) || !key.starts_with(|c: char| c.is_alphabetic()) {
            refuse(name, diags);
        }
        let Some(first) = self.declared.get(&key) else {
            self.declared.insert(key, name.clone());
            return true;
        };
        let clash = if first.text == name.text {
            Diagnostic::new(Code::E0212, name.span, message!("'{}' is declared twice", name.text))
                .help("remove one of them, or give it another name")
        } else {
            let message =
                message!("'{}' and '{}' differ only in case or '_'", name.text, first.text);
            Diagnostic::new(Code::E0213, name.span, message)
                .help("give one of them a name that differs in a letter")
        };
        diags.push(clash.note(first.span, "first declared here"));
        first.text != name.text
    }
}

/// Indices of names in a list; the first of duplicates counts.
#[derive(Default)]
pub(crate) struct Indices(FxHashMap<String, usize>);

impl Indices {
    /// The indices in a list, which may have gaps.
    pub fn of<'a>(names: impl IntoIterator<Item = Option<&'a str>>) -> Indices {
        let mut indices = FxHashMap::default();
        for (index, name) in names.into_iter().enumerate() {
            if let Some(name) = name {
                indices.entry(name.to_owned()).or_insert(index);
            }
        }
        Indices(indices)
    }

    pub fn find(&self, name: &str) -> Option<usize> {
        self.0.get(name).copied()
    }
}

/// Reports an element with a reserved name.
pub(crate) fn element(name: &Name, diags: &mut Diagnostics) {
    if is_word(&name.text) {
        refuse(name, diags);
    }
}

/// Whether a name is a keyword after `->`.
pub(crate) fn is_word(name: &str) -> bool {
    matches!(name, "terminate" | "fail" | "ignore" | "resume" | "suspend" | "return")
}

/// Warns of an entry that looks like a unit after a number.
pub(crate) fn entry(name: &Name, diags: &mut Diagnostics) {
    if Unit::parse(&name.text).is_some() {
        let message = message!("'{}' is also a unit", name.text);
        let help =
            message!("give the entry a longer name, so that '2 {}' cannot be misread", name.text);
        diags.push(Diagnostic::new(Code::E0240, name.span, message).help(help));
    }
}

/// Reports a name that several toolboxes and files declare. `found` has the qualifier of each,
/// empty for files, and its declaration.
pub(crate) fn ambiguous(
    what: &str,
    name: &str,
    span: Span,
    found: &[(Option<&str>, Span)],
) -> Diagnostic {
    let full = found.iter().filter_map(|(home, _)| home.map(|home| format!("{home}.{name}")));
    let full: Vec<_> = full.collect();
    let write = list(full.iter().map(String::as_str), "or");
    let files = found.iter().filter(|(home, _)| home.is_none());
    let (who, help) = match (full.len(), found.len() - full.len()) {
        (_, 0) => ("toolboxes", message!("write {}", write)),
        (0, _) => ("files", "give one of them another name".into()),
        _ => (
            "files and toolboxes",
            message!("write {}, or rename the declaration in the file", write),
        ),
    };
    let message = message!("several {} have {} '{}'", Words(who), Words(what), name);
    let error = Diagnostic::new(Code::E0237, span, message).help(help);
    files.fold(error, |error, (_, place)| error.note(*place, "declared here"))
}

fn refuse(name: &Name, diags: &mut Diagnostics) {
    let message = message!("'{}' cannot be a name here", name.text);
    diags.push(Diagnostic::new(Code::E0213, name.span, message).help("choose another name"));
}

/// The normalised form of a name.
pub(crate) fn key(name: &str) -> String {
    match name.is_ascii() {
        true => {
            let mut key = String::with_capacity(name.len());
            let letters = name.chars().filter(|each| *each != '_');
            key.extend(letters.map(|each| each.to_ascii_lowercase()));
            key
        }
        false => name.chars().filter(|each| *each != '_').collect::<String>().to_lowercase(),
    }
}

/// Reports an unknown name, with the likely name or the available ones.
pub(crate) fn unknown<'a>(
    code: Code,
    span: Span,
    message: impl Into<Message>,
    name: &str,
    known: impl IntoIterator<Item = &'a str, IntoIter: Clone>,
    none: impl Into<Message>,
) -> Diagnostic {
    offer(Diagnostic::new(code, span, message), name, known, none)
}

/// Adds the likely name, or the available ones, to a diagnostic.
pub(crate) fn offer<'a>(
    diagnostic: Diagnostic,
    name: &str,
    known: impl IntoIterator<Item = &'a str, IntoIter: Clone>,
    none: impl Into<Message>,
) -> Diagnostic {
    let known = known.into_iter();
    match once(words::all_nearest(name, known.clone()), usize::MAX).as_slice() {
        [] => {}
        [meant] => return diagnostic.write(*meant),
        // The intended name is ambiguous.
        several => {
            let some = several.iter().copied().take(MOST_LISTED);
            return diagnostic.help(message!("write {}", list(some, "or")));
        }
    }
    let mut some = once(known, MOST_LISTED + 1);
    match some.len() {
        0 => diagnostic.elsewhere(none),
        count if count > MOST_LISTED => {
            some.truncate(MOST_LISTED);
            diagnostic.help(message!("write one of {}, among others", list(some, "or")))
        }
        _ => diagnostic.help(message!("write {}", list(some, "or"))),
    }
}

/// The first distinct names, at most `most`.
fn once<'a>(names: impl IntoIterator<Item = &'a str>, most: usize) -> Vec<&'a str> {
    let mut some = Vec::new();
    for name in names {
        if some.len() < most && !some.contains(&name) {
            some.push(name);
        }
    }
    some
}
