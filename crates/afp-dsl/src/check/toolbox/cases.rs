//! States of declared computations and facts of supervisors: conditions and assignments over the input ports.

use std::collections::BTreeMap;

use crate::check::formula::Scope;
use crate::check::head::EntryDraft;
use crate::check::names::{Indices, unknown};
use crate::check::toolbox::condition::{condition, reads_no_text};
use crate::check::toolbox::facts;
use crate::check::toolbox::ports::{Site, misfit};
use crate::graph::{EntryKind, Formula};
use crate::toolbox::{Case, OutPort, Template, TemplateKind};
use crate::types::Type;
use crate::types::text::a_type;
use afp_syntax::ast::{self, Bind, Name, Part};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// The number of formula nodes per microsecond on the slowest supported target.
const PARTS_PER_MICROSECOND: u64 = 16;

/// Reads the bodies of the states, or the facts of the events, if there are any.
pub(super) fn read(
    parts: &[Part],
    template: &mut Template,
    site: &Site<'_>,
    diags: &mut Diagnostics,
) {
    let states = parts.iter().filter_map(|part| match part {
        Part::Outcome(node) => Some((node, node.name()?)),
        _ => None,
    });
    let states: Vec<_> = states.collect();
    let is_fact = |part: &Part| matches!(part, Part::Exclusive(_));
    if !states.iter().any(|(node, _)| node.is_declared()) && !parts.iter().any(is_fact) {
        return;
    }
    match template.kind {
        TemplateKind::Computation => {
            conditions_fit(&states, diags);
            ports_fit(parts, template, diags);
        }
        kind => misplaced(&states, kind, diags),
    }
    let entries = template.inputs.iter();
    let entries = entries
        .map(|port| EntryDraft::readable(&port.name, port.span, EntryKind::In, &port.ty))
        .collect::<Vec<_>>();
    let names = template.inputs.iter().map(|port| Some(port.name.as_str()));
    let scope = Scope {
        types: site.types,
        tables: &[],
        entries: &entries,
        indices: &Indices::of(names),
        readable: &|_| true,
        unreadable: "",
        text: site.source,
        record: site.record,
    };
    let bodies = Bodies { scope, outputs: &template.outputs };
    let cases: Vec<_> = states.iter().map(|(node, _)| bodies.case(node, diags)).collect();
    if template.kind != TemplateKind::Computation {
        template.facts = facts::read(parts, &states, cases, (&bodies.scope, template), diags);
        return;
    }
    written(&cases, template, diags);
    let size: usize = cases.iter().flat_map(Case::formulas).map(|it| it.nodes().count()).sum();
    let size = u64::try_from(size).unwrap_or(u64::MAX).max(1);
    template.budget = Some(size.div_ceil(PARTS_PER_MICROSECOND).saturating_mul(1000));
    template.cases = Some(cases.into());
}

/// Reports conditions and bodies that only the states of a computation have. An event may have a condition.
fn misplaced(states: &[(&ast::Outcome, Name)], kind: TemplateKind, diags: &mut Diagnostics) {
    let (is_wrong, message, help): (fn(&ast::Outcome) -> bool, _, _) = match kind {
        TemplateKind::Supervisor => {
            (|event| event.body().is_some(), "an event has no body", "remove the braces")
        }
        _ => (
            ast::Outcome::is_declared,
            "only the states of a computation have conditions and bodies",
            "remove them; Rust or Python implements this template",
        ),
    };
    for (_, name) in states.iter().filter(|(node, _)| is_wrong(node)) {
        diags.push(Diagnostic::new(Code::E0519, name.span, message).help(help));
    }
}

/// Every state has a body, and every state but the last has a condition.
fn conditions_fit(states: &[(&ast::Outcome, Name)], diags: &mut Diagnostics) {
    let last = states.len() - 1;
    for (place, (node, name)) in states.iter().enumerate() {
        // A state that could not be read may have had both.
        if diags.syntax_errors_within(node.span()).next().is_some() {
            continue;
        }
        let error = |span, message| Diagnostic::new(Code::E0519, span, message);
        if node.body().is_none() {
            let message = message!("'{}' has no body, but another state has one", name.text);
            let compared = node.when().and_then(|(_, compared)| compared.last()?.operands().pop());
            let end = compared.map_or(name.span, |operand| operand.span()).after();
            let error = error(name.span, message).help("add '{}', which assigns nothing");
            diags.push(error.fix(end, " {}"));
        }
        match node.when() {
            Some((when, _)) if place == last => {
                let message = message!("the last state '{}' has a condition", name.text);
                let help = "remove the condition, or add a last state without one";
                diags.push(error(when, message).help(help));
            }
            None if place < last => {
                let message = message!("the states after '{}' are never reached", name.text);
                let help = "add a condition, such as 'when a < b', or move the state to the end";
                diags.push(error(name.span, message).help(help));
            }
            _ => {}
        }
    }
}

/// Reports ports and parts that a declared computation cannot have.
fn ports_fit(parts: &[Part], template: &Template, diags: &mut Diagnostics) {
    let inputs = template.inputs.iter().map(|port| (&port.ty, port.span));
    let ports = inputs.chain(template.outputs.iter().map(|port| (&port.ty, port.span)));
    for (ty, span) in ports.filter(|(ty, _)| matches!(ty, Type::Object(_))) {
        let message = message!("formulas cannot read {}", Words(a_type(ty)));
        let error = Diagnostic::new(Code::E0519, span, message);
        diags.push(error.help("write the type 'any': formulas can only copy an object"));
    }
    for part in parts {
        match part {
            Part::Out(port) => {
                for name in port.on().into_iter().flatten().take(1) {
                    let message = "an output of a computation with bodies has no 'on'";
                    let error = Diagnostic::new(Code::E0519, name.span, message);
                    diags.push(error.help("remove 'on' and the names after it"));
                }
            }
            Part::Timing(time) => {
                if let Some(word) = time.keyword().filter(|word| word.text == "budget") {
                    let why = "the time of a declared computation follows from its formulas";
                    misfit("budget", why, word.span, diags);
                }
            }
            _ => {}
        }
    }
}

/// Notes which states write each output, and reports an output that none of them writes.
fn written(cases: &[Case], template: &mut Template, diags: &mut Diagnostics) {
    for (place, port) in (0..).zip(&mut template.outputs) {
        let writes = |case: &Case| case.writes.iter().any(|(output, _)| *output == place);
        let states = (0..).zip(cases).filter(|(_, case)| writes(case));
        port.on = states.map(|(state, _)| state).collect();
        if port.on.is_empty() && !diags.has_errors() {
            let message = message!("no state assigns '{}'", port.name);
            let error = Diagnostic::new(Code::E0514, port.span, message);
            diags.push(error.help("assign it in a state, or remove it"));
        }
    }
}

/// The names that bodies can use.
struct Bodies<'a> {
    scope: Scope<'a>,
    outputs: &'a [OutPort],
}

impl Bodies<'_> {
    fn case(&self, node: &ast::Outcome, diags: &mut Diagnostics) -> Case {
        let compared = node.when().map(|(_, compared)| compared).unwrap_or_default();
        let when = compared.iter().filter_map(|one| condition(&self.scope, one, diags)).collect();
        let mut assigned: BTreeMap<u16, (Span, Option<Formula>)> = BTreeMap::new();
        for bind in node.body().unwrap_or_default() {
            let Some((output, port, formula)) = self.assignment(bind, diags) else { continue };
            if let Some((first, _)) = assigned.get(&output) {
                let message = message!("'{}' is assigned twice", port.text);
                let error = Diagnostic::new(Code::E0511, port.span, message);
                diags.push(error.note(*first, "first assigned here").help("remove one of them"));
            }
            assigned.entry(output).or_insert((port.span, formula));
        }
        let writes = assigned.into_iter().filter_map(|(output, (_, it))| Some((output, it?)));
        Case { when, writes: writes.collect() }
    }

    /// An assigned output by position, its name, and its value unless that has an error.
    fn assignment(
        &self,
        bind: Bind,
        diags: &mut Diagnostics,
    ) -> Option<(u16, Name, Option<Formula>)> {
        let (port, formula) = match bind {
            Bind::In { port, formula, .. } => (port, formula),
            Bind::Out { port, sign, entry, formula } => {
                entry.iter().for_each(|name| _ = self.scope.entry(name));
                formula.iter().for_each(|formula| self.scope.names_only(formula));
                let message = "an output takes the value of a formula";
                diags.push(Diagnostic::new(Code::E0519, sign, message).write("="));
                (port, None)
            }
        };
        let Some(place) = self.outputs.iter().position(|output| output.name == port.text) else {
            self.scope.record.unknown(port.span);
            formula.iter().for_each(|formula| self.scope.names_only(formula));
            let known = self.outputs.iter().map(|output| output.name.as_str());
            let message = message!("the template has no output '{}'", port.text);
            let none = "declare it with 'out'";
            diags.push(unknown(Code::E0202, port.span, message, &port.text, known, none));
            return None;
        };
        let output = &self.outputs[place];
        self.scope.record.definition(port.span, output.span);
        let value = formula.and_then(|it| Some(self.scope.check(&it, Some(&output.ty), diags)?.0));
        let value = value.filter(|value| reads_no_text(value, diags));
        Some((u16::try_from(place).ok()?, port, value))
    }
}
