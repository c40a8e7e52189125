//! Where an error of the Rust compiler comes from: a line of the plan, of a toolbox, or neither.

use std::fs;
use std::path::{Path, PathBuf};

use afp_codegen::{CrateFile, declaration};
use afp_project::shown;
use afp_run::{RunError, say};
use afp_syntax::source::{Source, Sources, Span};

use super::message::Message;
use crate::toolboxes::OwnToolbox;

/// What errors can be traced back to.
pub struct Blame<'a> {
    /// The crate that was made from a plan.
    pub generated: Option<Generated<'a>>,
    /// The toolboxes whose crates are built.
    pub toolboxes: &'a [OwnToolbox],
}

/// A crate that was made from a plan.
pub struct Generated<'a> {
    /// Its folder.
    pub folder: &'a Path,
    /// Its files.
    pub files: &'a [CrateFile],
    /// The texts that it was made from.
    pub sources: &'a Sources,
}

/// A place to mend something, and the words for it.
struct Found<'a> {
    source: &'a Source,
    span: Span,
    message: String,
}

impl Blame<'_> {
    /// Tells standard error of a message: first where it comes from, then in the compiler's words.
    ///
    /// Warnings are told of the project's own crates alone.
    pub(super) fn tell(&self, message: &Message) {
        let own = self.toolboxes.iter().any(|own| is_in(message, own.krate.folder.as_deref()));
        if message.is_error {
            for found in self.places(message) {
                say(found.shown().styled());
            }
            let path = shown(&real(&message.path()));
            let (line, column) = message.place;
            say(format_args!("  = in {}:{line}:{column}", path.display()));
        }
        if message.is_error || own {
            say(&message.rendered);
        }
    }

    /// The places in plan and toolboxes that a message is about.
    fn places(&self, message: &Message) -> Vec<Found<'_>> {
        let plan = self.generated.as_ref().and_then(|crate_| crate_.place(message));
        let toolbox = || self.toolboxes.iter().find_map(|own| declared(own, message));
        match plan {
            Some((place, true)) => vec![place],
            // The whole plan says little; a toolbox that is named says more.
            Some((place, false)) => toolbox().into_iter().chain([place]).collect(),
            None => toolbox().into_iter().collect(),
        }
    }
}

impl Generated<'_> {
    /// The place in the plan, and whether it is more than the whole plan.
    fn place(&self, message: &Message) -> Option<(Found<'_>, bool)> {
        if !is_in(message, Some(self.folder)) {
            return None;
        }
        let file = self.files.iter().find(|file| Path::new(&file.path) == message.file);
        let (span, exact) = file.or(self.files.first())?.place(message.place.0);
        let message = format!("the Rust made from this does not compile: {}", message.title);
        Some((Found { source: self.sources.get(span.file)?, span, message }, exact))
    }
}

/// The declaration of a toolbox that a message is about.
fn declared<'a>(own: &'a OwnToolbox, message: &Message) -> Option<Found<'a>> {
    let said = words(&message.said);
    let inside = is_in(message, own.krate.folder.as_deref());
    // Other crates may have words of their own that a template has too.
    if !inside && !said.contains(&&*own.krate.rust_name()) {
        return None;
    }
    let (mut line, head) = (Vec::new(), head(message, inside));
    if inside {
        line = words(&message.line);
    }
    let span = declaration(&own.declared, &said, &line, &words(&head))?;
    let name = &own.name;
    let message = format!("the Rust of the toolbox '{name}' does not compile: {}", message.title);
    Some(Found { source: &own.source, span, message })
}

/// The head of the `impl` around the place of a message.
fn head(message: &Message, inside: bool) -> String {
    let text = fs::read_to_string(message.path()).ok().filter(|_| inside).unwrap_or_default();
    let lines: Vec<_> = text.lines().take(message.place.0).collect();
    let Some(first) = lines.iter().rposition(|line| line.starts_with("impl")) else {
        return String::new();
    };
    // A line that ends another item stands between: the place is in none.
    if lines[first + 1..].iter().any(|line| line.starts_with('}')) {
        return String::new();
    }
    let head = lines[first..].iter().take_while(|line| !line.starts_with("    fn "));
    head.copied().collect::<Vec<_>>().join("\n")
}

/// The names in a text.
fn words(text: &str) -> Vec<&str> {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    text.split(|letter| !is_part(letter)).filter(|word| !word.is_empty()).collect()
}

fn is_in(message: &Message, folder: Option<&Path>) -> bool {
    folder.is_some_and(|folder| real(&message.package) == real(folder))
}

fn real(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}

impl Found<'_> {
    fn shown(&self) -> RunError {
        let Found { source, span, message } = self;
        RunError::Content {
            path: source.name.clone().into(),
            span: Some(span.start as usize..span.end as usize),
            text: source.text.clone(),
            message: message.clone(),
        }
    }
}
