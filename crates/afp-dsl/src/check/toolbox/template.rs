//! One template: its parts, their places and their numbers.

use crate::check::names::{DeclaredNames, unknown};
use crate::check::toolbox::cases;
use crate::check::toolbox::ports::{self, Site, misfit};
use crate::check::{size, timing};
use crate::index::Word;
use crate::rows::{MAX_EVENTS, MAX_ROWS, MAX_STATES};
use crate::toolbox::{Outcome, ReadsTable, StatesOf, Template, TemplateKind};
use crate::types::Type;
use crate::types::text::a_type;
use afp_syntax::ast::{self, Name, Part};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words, words};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::unquote;

/// Reads a template; `None` without a name.
pub(super) fn read(
    node: &ast::Template,
    site: &Site<'_>,
    diags: &mut Diagnostics,
) -> Option<Template> {
    let mut template = without_parts(node, node.name()?);
    let parts = node.parts();
    let mut seen = Seen::default();
    resumable(node, &mut template, diags);
    outcomes(&parts, &mut template, diags);
    let mut names = DeclaredNames::default();
    for part in &parts {
        match part {
            Part::Icon(quoted, span) => {
                seen.once("icon", *span, diags);
                template.icon = quoted.as_ref().map(|quoted| unquote(quoted, diags));
            }
            Part::Uses(Some(device), span) => {
                names_device(device, &template, site, diags);
                if template.kind == TemplateKind::Computation {
                    misfit("uses", "a computation commands nothing", *span, diags);
                }
                template.uses.push(device.text.clone());
            }
            Part::Needs(Some(device), _) => {
                names_device(device, &template, site, diags);
                template.needs.push(device.text.clone());
            }
            Part::Uses(None, _) | Part::Needs(None, _) => {}
            Part::In(port) => {
                let table = port.ty().and_then(|ty| ports::table_word(&ty));
                let port = ports::input(port, template.kind, site, &mut names, diags);
                if let (Some(word), Some(port)) = (table, &port) {
                    seen.once("in table", word.span, diags);
                    template.reads_table = Some(ReadsTable { port: port.clone(), table: None });
                }
                template.inputs.extend(port);
            }
            Part::Out(port) => {
                let port = ports::output(port, &template.outcomes, site, &mut names, diags);
                template.outputs.extend(port);
            }
            Part::Timing(time) => set_time(time, &mut template, &mut seen, diags),
            Part::Outcome(_) | Part::Exclusive(_) | Part::StatesOf(..) => {}
        }
    }
    for part in &parts {
        if let Part::StatesOf(port, span, doc) = part {
            seen.once("states of", *span, diags);
            if let Some(port) = states_of(port.as_ref(), *span, &template, site, diags) {
                let states = StatesOf { port, doc: doc.clone(), span: *span, home: None };
                template.states_of = Some(states);
            }
        }
    }
    cases::read(&parts, &mut template, site, diags);
    reads_table(&template, diags);
    too_large(&template, diags);
    deadline(&parts, &template, diags);
    without_outcomes(node, &template, diags);
    Some(template)
}

/// Reads `resumable`, which actors and supervisors can be.
fn resumable(node: &ast::Template, template: &mut Template, diags: &mut Diagnostics) {
    let Some(span) = node.resumable() else { return };
    template.resumable = template.kind != TemplateKind::Computation;
    if !template.resumable {
        misfit("resumable", "a computation runs at once", span, diags);
    }
}

fn without_parts(node: &ast::Template, name: Name) -> Template {
    Template {
        kind: node.kind(),
        name: name.text,
        doc: node.doc(),
        every: timing::DEFAULT_EVERY,
        span: name.span,
        ..Template::default()
    }
}

/// The parts that may occur once, with the span of the first.
#[derive(Default)]
struct Seen {
    first: Vec<(String, Span)>,
}

impl Seen {
    fn once(&mut self, word: &str, span: Span, diags: &mut Diagnostics) {
        if let Some((_, first)) = self.first.iter().find(|(known, _)| known == word) {
            diags.push(
                Diagnostic::new(Code::E0511, span, message!("'{}' is given twice", word))
                    .note(*first, "first given here")
                    .help("remove one of them"),
            );
        } else {
            self.first.push((word.to_owned(), span));
        }
    }
}

/// Resolves `uses` and `needs`: a device of the toolbox, or a resource that other toolboxes also
/// use. Reports a device that the template names again.
fn names_device(resource: &Name, template: &Template, site: &Site<'_>, diags: &mut Diagnostics) {
    if template.uses.contains(&resource.text) || template.needs.contains(&resource.text) {
        let message = message!("'{}' is given twice", resource.text);
        let diagnostic = Diagnostic::new(Code::E0511, resource.span, message);
        diags.push(diagnostic.help("remove one of them"));
    }
    let known = site.devices.iter().find(|device| device.name == resource.text);
    if let Some(device) = known {
        return site.record.definition(resource.span, device.span);
    }
    let names = || site.devices.iter().map(|device| device.name.as_str());
    if words::nearest(&resource.text, names()).is_none() {
        return site.record.word(resource.span, Word::Resource);
    }
    site.record.unknown(resource.span);
    let message = message!("the toolbox has no device '{}'", resource.text);
    diags.push(unknown(Code::E0516, resource.span, message, &resource.text, names(), ""));
}

fn outcomes(parts: &[Part], template: &mut Template, diags: &mut Diagnostics) {
    let (right, wrong) = match template.kind {
        TemplateKind::Supervisor => ("event", "state"),
        TemplateKind::Actor | TemplateKind::Computation => ("state", "event"),
    };
    let mut names = DeclaredNames::default();
    for part in parts {
        let Part::Outcome(node) = part else { continue };
        if let Some(keyword) = node.keyword().filter(|keyword| keyword.text == wrong) {
            let message = match template.kind {
                TemplateKind::Supervisor => "a supervisor has events, not states",
                TemplateKind::Actor => "an actor has states, not events",
                TemplateKind::Computation => "a computation has states, not events",
            };
            diags.push(Diagnostic::new(Code::E0510, keyword.span, message).write(right));
        }
        let Some(name) = node.name() else { continue };
        names.declare(&name, diags);
        if matches!(name.text.as_str(), "Error" | "DeadlineMissed") {
            diags.push(reserved(&name, template.kind));
        }
        let (doc, once) = (node.doc(), node.once());
        template.outcomes.push(Outcome { name: name.text, doc, once, span: name.span });
    }
}

/// The message about a built-in name of edges that is declared.
fn reserved(name: &Name, kind: TemplateKind) -> Diagnostic {
    let own = match kind {
        TemplateKind::Supervisor => "DeadlineMissed",
        TemplateKind::Actor | TemplateKind::Computation => "Error",
    };
    let (message, help) = match name.text == own {
        true => (
            "needs no declaration",
            "remove it, or choose another name; plans can connect it anyway",
        ),
        false if own == "Error" => ("is for supervisors", "choose another name"),
        false => ("is how elements fail", "choose another name"),
    };
    Diagnostic::new(Code::E0214, name.span, message!("'{}' {}", name.text, Words(message)))
        .help(help)
}

/// States that are the values of the enum bound to a port.
fn states_of(
    port: Option<&Name>,
    span: Span,
    template: &Template,
    site: &Site<'_>,
    diags: &mut Diagnostics,
) -> Option<u16> {
    if template.kind != TemplateKind::Computation {
        misfit("states of", "only a computation has one state for each value", span, diags);
    }
    if let Some(first) = template.outcomes.first() {
        diags.push(
            Diagnostic::new(Code::E0510, first.span, "the states are the values of a port")
                .note(span, "said here")
                .help("remove either 'states of' or the other states"),
        );
    }
    if let Some(output) = template.outputs.first() {
        let message = "a computation whose states are the values of a port has no outputs";
        diags.push(Diagnostic::new(Code::E0510, output.span, message).help("remove the output"));
    }
    let port = port?;
    let Some(index) = template.inputs.iter().position(|input| input.name == port.text) else {
        site.record.unknown(port.span);
        let known = template.inputs.iter().map(|input| input.name.as_str());
        let message = message!("the template has no input '{}'", port.text);
        let none = "declare an input of type 'discrete'";
        diags.push(unknown(Code::E0202, port.span, message, &port.text, known, none));
        return None;
    };
    let input = &template.inputs[index];
    site.record.definition(port.span, input.span);
    if input.ty != Type::Discrete {
        let message = message!("'{}' is {}", input.name, Words(a_type(&input.ty)));
        diags.push(
            Diagnostic::new(Code::E0510, port.span, message)
                .note(input.span, "declared here")
                .help("give the port the type 'discrete', to which plans can bind any enum"),
        );
    }
    u16::try_from(index).ok()
}

/// A template that reads a table has no implementation, so its declaration is fixed.
fn reads_table(template: &Template, diags: &mut Diagnostics) {
    let Some(reads) = &template.reads_table else { return };
    let others = template.inputs.iter().filter(|port| port.name != reads.port.name);
    let others: Vec<_> = others.map(|port| &port.ty).collect();
    let fits = template.kind == TemplateKind::Computation
        && others == [&Type::Int]
        && template.outputs.is_empty()
        && template.outcomes.len() == 2
        && template.cases.is_none();
    if !fits {
        let message = message!("'{}' cannot read a table", template.name);
        let help = "declare a computation with one 'int' input, two states and no output";
        diags.push(Diagnostic::new(Code::E0510, reads.port.span, message).help(help));
    }
}

fn set_time(time: &ast::Timing, template: &mut Template, seen: &mut Seen, diags: &mut Diagnostics) {
    let Some(keyword) = time.keyword() else { return };
    let word = keyword.text.as_str();
    seen.once(word, keyword.span, diags);
    let why = match (template.kind, word) {
        (TemplateKind::Computation, "every" | "deadline" | "stop") => {
            Some("a computation runs at once")
        }
        (TemplateKind::Supervisor, "stop") => Some("a supervisor moves nothing"),
        (TemplateKind::Actor, "deadline") => Some("the polls of an actor have no deadline"),
        _ => None,
    };
    if let Some(why) = why {
        misfit(word, why, keyword.span, diags);
    }
    let Some(value) = timing::nanoseconds(time, diags) else { return };
    match word {
        "every" => template.every = value,
        "deadline" => template.deadline = Some(value),
        "budget" => template.budget = Some(value),
        _ => template.stop = Some(value),
    }
}

fn too_large(template: &Template, diags: &mut Diagnostics) {
    let help = "split it into two templates";
    let outcomes = template.outcomes.iter().map(|outcome| outcome.span);
    match template.kind {
        TemplateKind::Supervisor => {
            size::at_most(MAX_EVENTS, ("a supervisor", "events"), outcomes, help, diags);
        }
        TemplateKind::Actor | TemplateKind::Computation => {
            size::at_most(MAX_STATES, ("a template", "states"), outcomes, help, diags);
        }
    }
    let inputs = template.inputs.iter().map(|port| port.span);
    size::at_most(MAX_ROWS, ("a template", "inputs"), inputs, help, diags);
    let outputs = template.outputs.iter().map(|port| port.span);
    size::at_most(MAX_ROWS, ("a template", "outputs"), outputs, help, diags);
}

fn deadline(parts: &[Part], template: &Template, diags: &mut Diagnostics) {
    let Some(deadline) = template.deadline else { return };
    // An invalid period has already been reported.
    let written = |word: &str| {
        parts.iter().find_map(|part| match part {
            Part::Timing(time) if time.keyword().is_some_and(|known| known.text == word) => {
                Some(time)
            }
            _ => None,
        })
    };
    if written("every").is_some_and(|time| diags.error_within(time.span())) {
        return;
    }
    if let Some(time) = written("deadline") {
        timing::deadline_fits(deadline, template.every, time.span(), diags);
    }
}

fn without_outcomes(node: &ast::Template, template: &Template, diags: &mut Diagnostics) {
    let any = !template.outcomes.is_empty() || template.states_of.is_some();
    if any || diags.syntax_errors_within(node.span()).next().is_some() {
        return;
    }
    let (what, help) = match template.kind {
        TemplateKind::Actor => return lasting(template, diags),
        TemplateKind::Supervisor => ("event", "add 'event' and a name"),
        TemplateKind::Computation => ("state", "add 'state' and a name"),
    };
    let message = message!("'{}' has no {}", template.name, Words(&what));
    diags.push(Diagnostic::new(Code::E0512, template.span, message).help(help));
}

/// An actor without a state ends only by an event, so it never writes its outputs.
fn lasting(template: &Template, diags: &mut Diagnostics) {
    for port in &template.outputs {
        let message = message!("'{}' has no state, so nothing ever writes it", template.name);
        diags.push(
            Diagnostic::new(Code::E0514, port.span, message)
                .help("remove it, or add 'state' and a name"),
        );
    }
}
