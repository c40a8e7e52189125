//! Targets of states and events: each is connected once, to an existing element or a keyword.

mod unknown_outcome;
mod written_edge;

use std::cell::{LazyCell, RefCell};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

use crate::check::formula::too_long;
use crate::check::names::{Indices, is_word, offer};
use crate::check::resume;
use crate::check::signature::{Signature, SignatureKind};
use crate::check::synonyms::{self, Leads};
use crate::graph::{EdgeSpans, ElementId, ReasonId, Target};
use crate::index::{Recorder, Word};
use crate::toolbox::TemplateKind;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Sought, Words, list, words};
use afp_syntax::habits::{RETURN, RETURNS, ours};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::unquote;
use afp_types::MAX_TEXT;

use unknown_outcome::unknown_outcome;
pub(crate) use written_edge::{WrittenEdge, name};

/// The two edges that need no declaration.
pub(crate) const ERROR: &str = "Error";
const TERMINATE: &str = "terminate";
/// The target of a failed component without an `Error` edge.
const FAIL: &str = "fail";
/// The edge of a supervisor that was polled too late.
pub(crate) const DEADLINE_MISSED: &str = "DeadlineMissed";

/// The edges of one component.
pub(crate) struct Connected {
    /// One target for each state or event of the signature.
    pub outcomes: Vec<Option<Target>>,
    /// The target of `Error` or `DeadlineMissed`.
    pub extra: Option<Target>,
    pub spans: EdgeSpans,
}

/// A component whose edges are checked.
pub(crate) struct Origin<'a> {
    pub signature: &'a Signature,
    pub name: Option<&'a Name>,
    /// The span for errors about missing edges.
    pub span: Span,
    /// Whether the text has syntax errors here.
    pub broken: bool,
    pub supervisor: bool,
}

impl Origin<'_> {
    /// Its built-in edge, in addition to states or events.
    fn extra(&self) -> &'static str {
        if self.supervisor { DEADLINE_MISSED } else { ERROR }
    }

    /// Whether it has such a state or event.
    pub fn has(&self, name: &Name) -> bool {
        name.text == self.extra() || self.signature.outcomes.iter().any(|it| **it == *name.text)
    }

    fn computes(&self) -> bool {
        self.signature.kind == SignatureKind::Template(TemplateKind::Computation)
    }
}

/// The reason of a `fail` without a string.
const NO_REASON: &str = "the plan failed";

/// The targets of edges: the elements of a plan by name, and the reasons after `fail`.
pub(crate) struct Elements<'a> {
    names: Vec<Option<Name>>,
    indices: Indices,
    reasons: RefCell<Reasons>,
    record: &'a Recorder,
}

/// The reasons after `fail`, each once, with its index.
#[derive(Default)]
struct Reasons {
    list: Vec<String>,
    indices: HashMap<String, usize>,
}

impl Reasons {
    fn index_of(&mut self, reason: String) -> usize {
        let next = self.list.len();
        match self.indices.entry(reason) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                self.list.push(new.key().clone());
                *new.insert(next)
            }
        }
    }
}

impl<'a> Elements<'a> {
    /// Takes the names of a plan's elements, by index.
    pub fn new(names: Vec<Option<Name>>, record: &'a Recorder) -> Elements<'a> {
        let texts = names.iter().map(|name| name.as_ref().map(|name| name.text.as_str()));
        let reasons = RefCell::default();
        Elements { indices: Indices::of(texts), names, reasons, record }
    }

    /// The reasons so far, each once.
    pub fn reasons(&self) -> Vec<String> {
        self.reasons.borrow().list.clone()
    }

    /// The index of the text after `fail`. Reports an invalid reason.
    fn reason(&self, text: Option<&Name>, diags: &mut Diagnostics) -> Option<ReasonId> {
        let reason = text.map_or(NO_REASON.to_owned(), |text| unquote(text, diags));
        if let Some(Name { span, .. }) = text.filter(|_| reason.is_empty()) {
            diags.push(
                Diagnostic::new(Code::E0230, *span, "the reason is empty")
                    .help("write the reason of the fault, or only 'fail'"),
            );
            return None;
        }
        if let Some(Name { span, .. }) = text.filter(|_| reason.len() > MAX_TEXT) {
            diags.push(too_long(*span));
            return None;
        }
        let index = self.reasons.borrow_mut().index_of(reason);
        // Too many reasons are reported with the plan's other tables.
        Some(ReasonId(u16::try_from(index).unwrap_or(u16::MAX)))
    }

    pub fn into_indices(self) -> Indices {
        self.indices
    }

    fn is_word(&self, to: &Name) -> bool {
        let word = match to.text.as_str() {
            "terminate" => Word::Terminate,
            "fail" => Word::Fail,
            "ignore" => Word::Ignore,
            "resume" => Word::Resume,
            "return" => Word::Return,
            _ => return false,
        };
        self.record.word(to.span, word);
        true
    }

    /// The names of the elements, in source order.
    pub fn names(&self) -> impl Iterator<Item = &str> + Clone {
        self.names.iter().flatten().map(|name| name.text.as_str())
    }
}

/// Checks the edges of one component; `elements` are the elements of the plan.
pub(crate) fn check(
    origin: &Origin<'_>,
    edges: &[WrittenEdge],
    elements: &Elements<'_>,
    diags: &mut Diagnostics,
) -> Connected {
    let (connected, seen, unknown) = connect(origin, edges, elements, diags);
    if !origin.broken {
        report_missing(origin, &seen, unknown, diags);
    }
    connected
}

/// Checks the edges of the source. Returns their outcomes, and the number of edges without one.
pub(super) fn connect<'e>(
    origin: &Origin<'_>,
    edges: &'e [WrittenEdge],
    elements: &Elements<'_>,
    diags: &mut Diagnostics,
) -> (Connected, Vec<&'e Name>, usize) {
    let signature = origin.signature;
    let count = signature.outcomes.len();
    let spans = EdgeSpans { outcomes: vec![None; count], extra: None };
    let mut connected = Connected { outcomes: vec![None; count], extra: None, spans };
    let mut seen: Vec<&Name> = Vec::new();
    let mut unknown = 0;
    let extra = origin.extra();
    // Computed once, because a text may have many unknown names.
    let missing = LazyCell::new(|| without_edge(signature, edges));
    for edge in edges {
        let name = &edge.name;
        if edge.is_nameless() {
            leads_to(edge, origin, elements);
            continue;
        }
        let index = signature.outcomes.iter().position(|outcome| **outcome == *name.text);
        outcome(origin, index, name, elements.record);
        if let Some(first) = seen.iter().find(|known| known.text == name.text) {
            diags.push(
                Diagnostic::new(
                    Code::E0226,
                    name.span,
                    message!("'{}' is connected twice", name.text),
                )
                .note(first.span, "first connected here")
                .help("remove one of the edges"),
            );
            leads_to(edge, origin, elements);
            continue;
        }
        let span = edge.span;
        let target = target(edge, origin, elements, diags);
        match index {
            Some(index) => {
                connected.outcomes[index] = target;
                connected.spans.outcomes[index] = Some(span);
            }
            None if name.text == extra => {
                connected.extra = target;
                connected.spans.extra = Some(span);
            }
            None => {
                let (error, meant) = unknown_outcome(origin, &missing, name);
                diags.push(error);
                unknown += meant;
                continue;
            }
        }
        seen.push(name);
    }
    (connected, seen, unknown)
}

/// The states or events without an edge.
fn without_edge<'s>(signature: &'s Signature, edges: &[WrittenEdge]) -> Vec<&'s str> {
    let own = signature.outcomes.iter().map(|outcome| &**outcome);
    own.filter(|own| edges.iter().all(|edge| edge.name.text != *own)).collect()
}

/// Records the names of edges of an unknown component; `words` are outcomes of every component.
pub(crate) fn names_only(
    edges: &[WrittenEdge],
    words: &[&str],
    elements: &Elements<'_>,
    diags: &mut Diagnostics,
) {
    for edge in edges {
        let name = &edge.name;
        match word(&name.text).filter(|_| words.contains(&name.text.as_str())) {
            Some(word) => elements.record.word(name.span, word),
            None if edge.is_nameless() => {}
            None => elements.record.unknown(name.span),
        }
        match &edge.target {
            Some(to) if edge.suspends.is_some() || !elements.is_word(to) => {
                find(to, Leads::Edge, elements, diags);
            }
            _ => {}
        }
    }
}

/// Resolves the target of an invalid edge.
fn leads_to(edge: &WrittenEdge, origin: &Origin<'_>, elements: &Elements<'_>) {
    target(edge, origin, elements, &mut Diagnostics::default());
}

/// Resolves the state or event of an edge.
fn outcome(origin: &Origin<'_>, index: Option<usize>, name: &Name, record: &Recorder) {
    let known = index.is_some() || name.text == origin.extra();
    match (index.and_then(|index| origin.signature.outcome_span(index)), word(&name.text)) {
        (Some(definition), _) => record.definition(name.span, definition),
        (None, Some(word)) if known => record.word(name.span, word),
        _ => record.unknown(name.span),
    }
}

/// The states and events that need no declaration.
pub(crate) fn word(name: &str) -> Option<Word> {
    Some(match name {
        "OK" => Word::Ok,
        "Interrupted" => Word::Interrupted,
        ERROR => Word::Error,
        DEADLINE_MISSED => Word::DeadlineMissed,
        _ => return None,
    })
}

fn target(
    edge: &WrittenEdge,
    origin: &Origin<'_>,
    elements: &Elements<'_>,
    diags: &mut Diagnostics,
) -> Option<Target> {
    let to = edge.target.as_ref()?;
    let leads = if origin.supervisor { Leads::Event } else { Leads::Edge };
    if let Some(word) = edge.suspends {
        elements.record.word(word, Word::Suspend);
        let handler = find(to, Leads::Start, elements, diags).map(Target::Suspend);
        let is_active = origin.supervisor || origin.computes();
        if !is_active {
            diags.push(resume::nothing_active(word.to(to.span), "suspended"));
        }
        return handler.filter(|_| is_active);
    }
    elements.is_word(to);
    match to.text.as_str() {
        "terminate" => return Some(Target::Terminate),
        "fail" => {
            hides_reason(edge, diags);
            return elements.reason(edge.reason.as_ref(), diags).map(Target::Fail);
        }
        "ignore" if origin.supervisor => return Some(Target::Ignore),
        "resume" if origin.supervisor || origin.computes() => return Some(Target::Resume),
        "resume" => {
            diags.push(resume::nothing_active(to.span, "resumed"));
            return None;
        }
        "return" => return Some(Target::Return),
        "ignore" => {
            diags.push(
                Diagnostic::new(Code::E0221, to.span, "only events can be ignored")
                    .help("name an element of the plan, or write 'terminate'"),
            );
            return None;
        }
        _ => {}
    }
    find(to, leads, elements, diags).map(Target::Element)
}

/// Reports that the reason of a fault is lost.
fn hides_reason(edge: &WrittenEdge, diags: &mut Diagnostics) {
    if edge.name.text == ERROR && edge.reason.is_none() {
        diags.push(
            Diagnostic::new(Code::E0314, edge.span, "the fault's own reason is lost here")
                .help("leave 'Error' unconnected: the plan then fails for that reason"),
        );
    }
}

/// The element of that name; reports an unknown one. An edge may lead to a keyword instead.
pub(crate) fn find(
    to: &Name,
    leads: Leads,
    elements: &Elements<'_>,
    diags: &mut Diagnostics,
) -> Option<ElementId> {
    let Some(index) = elements.indices.find(&to.text) else {
        elements.record.unknown(to.span);
        let words = [TERMINATE, FAIL].into_iter();
        let words =
            words.filter(|word| leads != Leads::Start && elements.indices.find(word).is_none());
        let names = elements.names().chain(words);
        let message = message!("the plan has no element '{}'", to.text);
        let error = Diagnostic::new(Code::E0216, to.span, message);
        let error = error.unknown(Sought::Element, &to.text);
        // No element can have the name of a keyword.
        let none = match is_word(&to.text) {
            true => "add an element, and name it",
            false => "add an element of that name",
        };
        if !diags.explains() {
            diags.push(error.elsewhere(none));
            return None;
        }
        let meant = synonyms::target(&to.text, leads);
        diags.push(match meant.filter(|_| words::nearest(&to.text, elements.names()).is_none()) {
            Some(word) => error.write(word),
            None if leads != Leads::Start && ours(RETURNS, &to.text).is_some() => {
                error.help(RETURN)
            }
            None => offer(error, &to.text, names, none),
        });
        return None;
    };
    if let Some(name) = &elements.names[index] {
        elements.record.definition(to.span, name.span);
    }
    u16::try_from(index).ok().map(ElementId)
}

/// Reports unconnected outcomes; each unknown name stands for one of them.
fn report_missing(origin: &Origin<'_>, seen: &[&Name], unknown: usize, diags: &mut Diagnostics) {
    let signature = origin.signature;
    let is_plan = matches!(signature.kind, SignatureKind::Plan(_));
    let missing = signature.outcomes.iter().map(|outcome| &**outcome).filter(|outcome| {
        let allowed = is_plan && *outcome == "Interrupted";
        !allowed && !seen.iter().any(|name| name.text == *outcome)
    });
    let missing: Vec<&str> = missing.collect();
    let name = origin.name.map_or("", |name| name.text.as_str());
    if missing.len() > unknown {
        let verb = if missing.len() == 1 { "is" } else { "are" };
        let message = message!(
            "{} of '{}' {} not connected",
            list(missing.iter().copied(), "and"),
            name,
            Words(verb)
        );
        let to = if origin.supervisor { "ignore" } else { "terminate" };
        let edges: Vec<_> = missing.iter().map(|state| format!("{state} -> {to}")).collect();
        let it = if missing.len() == 1 { "it to an element" } else { "them to elements" };
        let help = message!("add '{}', or lead {}", edges.join(", "), Words(it));
        diags.push(Diagnostic::new(Code::E0211, origin.span, message).help(help));
    }
    // An unknown name may mean this outcome.
    let named = unknown > 0 || seen.iter().any(|name| name.text == "Interrupted");
    let interrupted = is_plan && !named;
    if let Some(edge) = signature.interrupting.filter(|_| interrupted) {
        diags.push(
            Diagnostic::new(
                Code::E0233,
                origin.span,
                message!("'{}' of '{}' is not connected", "Interrupted", name),
            )
            .note(edge, "this event ends the plan as interrupted")
            .help("add 'Interrupted -> terminate', or lead it to an element"),
        );
    }
}
