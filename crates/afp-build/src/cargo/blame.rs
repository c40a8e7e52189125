//! The source of a Rust compiler error: a line of the plan, of a toolbox, or neither.

use std::fs;
use std::path::{Path, PathBuf};

use afp_codegen::{CrateFile, declaration};
use afp_excerpt::{Mark, Report, Severity, place};
use afp_project::shown;
use afp_run::say;
use afp_syntax::source::{Source, Sources, Span};
use serde_json::{Value, json};

use super::message::{Message, Place};
use afp_toolboxes::project::OwnToolbox;

/// The possible sources of errors.
pub struct Blame<'a> {
    /// The crate of a plan.
    pub generated: Option<Generated<'a>>,
    /// The toolboxes whose crates are built.
    pub toolboxes: &'a [OwnToolbox],
}

/// The crate of a plan.
pub struct Generated<'a> {
    pub folder: &'a Path,
    pub files: &'a [CrateFile],
    /// The plan's sources.
    pub sources: &'a Sources,
}

/// A place to fix an error, with a description.
struct Found<'a> {
    source: &'a Source,
    span: Span,
    message: String,
}

impl Blame<'_> {
    /// Whether a message is relevant: only the project's own crates have warnings.
    pub(super) fn concerns(&self, message: &Message) -> bool {
        let is_own = |own: &OwnToolbox| is_in(message, own.krate.folder.as_deref());
        message.is_error || self.toolboxes.iter().any(is_own)
    }

    /// Prints a message on standard error: first its source, then the compiler's words.
    pub(super) fn tell(&self, message: &Message) {
        if message.is_error {
            let places = self.places(message);
            places.iter().for_each(|found| say(found.shown()));
            // The compiler's file name is relative to the package.
            if let Some((path, place)) = rust(message) {
                let (line, column) = place.at;
                match places.is_empty() {
                    true => say(format_args!("in {path}:{line}:{column}:")),
                    false => say(format_args!("  = in {path}:{line}:{column}")),
                }
            }
        }
        say(&message.rendered);
    }

    /// A message in the form of a plan's diagnostic, for tools. Its place is the first source;
    /// other sources and the place in Rust are notes. Without a source, its place is that in Rust.
    /// There is no code, because Rust's codes are not AFP's.
    pub(super) fn json(&self, message: &Message) -> Value {
        let places = if message.is_error { self.places(message) } else { Vec::new() };
        let in_rust = rust(message)
            .map(|(path, found)| (place(&path, found.bytes.clone(), found.at), &found.label));
        let severity = if message.is_error { Severity::Error } else { Severity::Warning };
        let title = places.first().map_or(&message.title, |found| &found.message);
        let mut marks: Vec<_> = places.iter().map(Found::mark).collect();
        marks
            .iter_mut()
            .zip(&places)
            .skip(1)
            .for_each(|(mark, found)| mark.label.clone_from(&found.message));
        let mut object = Report { severity, code: "", message: title, help: "", marks }.json();
        match (in_rust, object["notes"].as_array_mut()) {
            (Some((place, _)), _) if places.is_empty() => object["place"] = place,
            (Some((place, label)), Some(notes)) => {
                notes.push(json!({ "place": place, "text": label }));
            }
            _ => {}
        }
        object
    }

    /// The places in plan and toolboxes for a message.
    fn places(&self, message: &Message) -> Vec<Found<'_>> {
        let plan = self.generated.as_ref().and_then(|crate_| crate_.place(message));
        let toolbox = || self.toolboxes.iter().find_map(|own| declared(own, message));
        match plan {
            Some((place, true)) => vec![place],
            // A named toolbox is more exact than the whole plan.
            Some((place, false)) => toolbox().into_iter().chain([place]).collect(),
            None => toolbox().into_iter().collect(),
        }
    }
}

impl Generated<'_> {
    /// The place in the plan, and whether it is smaller than the whole plan.
    fn place(&self, message: &Message) -> Option<(Found<'_>, bool)> {
        if !is_in(message, Some(self.folder)) {
            return None;
        }
        let at = message.place.as_ref()?;
        let file = self.files.iter().find(|file| Path::new(&file.path) == at.file);
        let (span, exact) = file.or(self.files.first())?.place(at.at.0);
        let message = format!("the generated Rust does not compile: {}", message.title);
        Some((Found { source: self.sources.get(span.file)?, span, message }, exact))
    }
}

fn declared<'a>(own: &'a OwnToolbox, message: &Message) -> Option<Found<'a>> {
    let said = words(&message.said);
    let inside = is_in(message, own.krate.folder.as_deref());
    // Other crates may use a template's words by chance.
    if !inside && !said.contains(&&*own.krate.rust_name()) {
        return None;
    }
    let head = if inside { head(message).unwrap_or_default() } else { String::new() };
    let line = message.place.as_ref().filter(|_| inside).map_or("", |place| &place.line);
    let span = declaration(&own.declared, &said, &words(line), &words(&head))?;
    let (name, title) = (&own.name, &message.title);
    let message = match inside {
        false if title.starts_with("the trait bound ") => {
            format!("the robot lacks a trait that the toolbox '{name}' needs here: {title}")
        }
        _ => format!("the Rust of the toolbox '{name}' does not compile: {title}"),
    };
    Some(Found { source: &own.source, span, message })
}

/// The head of the `impl` around the place of a message; `None` outside of one.
fn head(message: &Message) -> Option<String> {
    let text = fs::read_to_string(message.path()?).ok()?;
    let lines: Vec<_> = text.lines().take(message.place.as_ref()?.at.0).collect();
    let first = lines.iter().rposition(|line| line.starts_with("impl"))?;
    // The end of another item is in between.
    if lines[first + 1..].iter().any(|line| line.starts_with('}')) {
        return None;
    }
    let head = lines[first..].iter().take_while(|line| !line.starts_with("    fn "));
    Some(head.copied().collect::<Vec<_>>().join("\n"))
}

/// The place of a message in the Rust code, with a readable path.
fn rust(message: &Message) -> Option<(String, &Place)> {
    let path = shown(&real(&message.path()?)).display().to_string();
    Some((path, message.place.as_ref()?))
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
    fn mark(&self) -> Mark<'_> {
        let Found { source: Source { name, text }, span, .. } = self;
        let span = Some(span.start as usize..span.end as usize);
        Mark { path: name, text, lines: None, span, label: String::new() }
    }

    fn shown(&self) -> String {
        let (severity, marks) = (Severity::Error, vec![self.mark()]);
        Report { severity, code: "", message: &self.message, help: "", marks }.render(true)
    }
}
