//! Plans, many of them invalid, each with its outline; and properties of any text.
//!
//! `AFP_BLESS=1` rewrites the outlines; read the diff like code.

use crate::support;

use std::collections::BTreeSet;
use std::fmt::Write;

use afp_dsl::Compiled;
use afp_dsl::outline::{
    Binding, Column, Component, Destination, Findings, Identity, MadeFrom, Outline, Part, Plan,
    Target,
};
use afp_syntax::{Node, kind::Kind};

const MARK: &str = "\n// Outline:\n";

#[test]
fn every_case_has_its_outline() {
    let toolboxes = support::toolboxes();
    let mut wrong = Vec::new();
    for path in support::files("tests/outline") {
        let case = support::read(&path);
        let text = case.split(MARK).next().unwrap();
        let compiled = support::compile(text, &toolboxes);
        let dump: String = dump(&compiled).lines().map(|line| format!("//  {line}\n")).collect();
        wrong.extend(support::compare(&path, &case, &format!("{text}{MARK}{dump}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// All shipped files, cut after each token. By day one prefix per step is tested; `AFP_BY_NIGHT`
/// tests all.
const STEP: usize = 13;

#[test]
fn every_prefix_of_every_shipped_plan_keeps_its_valid_parts() {
    let toolboxes = support::toolboxes();
    let step = if std::env::var_os("AFP_BY_NIGHT").is_some() { 1 } else { STEP };
    let mut cuts = 0;
    for folder in ["../../plans", "../../plans/tests", "../../examples/embed/plans"] {
        for path in support::files(folder) {
            let text = support::read(&path);
            let folder = path.parent().unwrap().to_path_buf();
            let used = |name: &str| {
                std::fs::read_to_string(folder.join(name)).map_err(|error| error.to_string())
            };
            let root = afp_syntax::parse(&text, 0, &mut Default::default()).root();
            let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
            let solid = tokens.filter(|token| !token.kind().is_trivia());
            for token in solid.skip(cuts % step).step_by(step) {
                let prefix = &text[..usize::from(token.text_range().end())];
                let source = afp_syntax::source::Source::new(support::CASE, prefix);
                let compiled = afp_dsl::compile(&source, &toolboxes, &used);
                examine(prefix, &compiled);
                cuts += 1;
            }
        }
    }
    assert!(cuts > 5_000 / step, "only {cuts} prefixes");
}

/// An outline as text, with diagnostics after `!`.
fn dump(compiled: &Compiled) -> String {
    let outline = &compiled.outline;
    let mut text = String::new();
    let said = |findings: &Findings| {
        let codes = findings.list().iter().map(|at| compiled.diags.get(*at).unwrap().code.as_str());
        codes.map(|code| format!(" !{code}")).collect::<String>()
    };
    for file in &outline.files {
        let _ = writeln!(text, "file {}{}", file.path, said(&file.findings));
        for line in &file.uses {
            let name = line.toolbox.as_ref().or(line.path.as_ref()).map_or("", |name| &name.text);
            let alias = line.alias.iter().map(|alias| format!(" as {}", alias.text));
            let found = line.file.map_or("", |_| " (found)");
            let _ = writeln!(text, "  use {name}{}{found}", alias.collect::<String>());
        }
        for each in &file.enums {
            let values: Vec<_> = each.variants.iter().map(|value| value.text.as_str()).collect();
            let said = said(&each.findings);
            let _ = writeln!(text, "  enum {}: {}{said}", each.item, values.join(" "));
        }
        for each in &file.tables {
            let said = said(&each.findings);
            let column = |column: &Column| match &column.ty {
                Some(ty) => format!("{}: {ty}", column.name.text),
                None => format!("{}: ?", column.name.text),
            };
            let columns: Vec<_> = each.columns.iter().map(column).collect();
            let _ = writeln!(text, "  table {}({}){said}", each.item, columns.join(", "));
        }
        for scenario in &file.scenarios {
            let name = scenario.name.as_ref().map_or("", |name| &name.text);
            let plan = scenario.plan.map_or("?", |plan| outline.plan(plan).item.name());
            let _ = writeln!(text, "  scenario {name} for {plan}{}", said(&scenario.findings));
        }
        for plan in &file.plans {
            self::plan(&mut text, outline, outline.plan(*plan), &said);
        }
    }
    let main = outline.main.map_or("none", |plan| outline.plan(plan).item.name());
    text + &format!("main: {main}\n")
}

fn plan(text: &mut String, outline: &Outline, plan: &Plan, said: &dyn Fn(&Findings) -> String) {
    let mut line = |depth: usize, content: String| {
        let _ = writeln!(text, "{:width$}{content}", "", width = 2 * depth);
    };
    let interruptible = if plan.interruptible { " (interruptible)" } else { "" };
    let forever = if plan.forever { " (forever)" } else { "" };
    line(1, format!("plan {}{forever}{interruptible}{}", plan.item, said(&plan.findings)));
    for entry in &plan.entries {
        let ty = entry.ty.as_ref().map_or("?".to_owned(), ToString::to_string);
        let written = entry.written_type.as_ref().map_or("", |ty| &ty.text);
        let init = entry.init.iter().map(|init| format!(" = {}", init.text)).collect::<String>();
        let range = entry
            .range
            .iter()
            .map(|[least, most]| format!(" from {} to {}", least.text, most.text));
        let (range, said) = (range.collect::<String>(), said(&entry.findings));
        let live = if entry.live { " live" } else { "" };
        let kind = format!("{:?}{live}", entry.kind);
        line(2, format!("{kind} {}: {ty} ({written}){init}{range}{said}", entry.item));
    }
    for start in &plan.starts {
        let target = start.target.as_ref().map_or("?".to_owned(), |to| target(plan, to));
        line(2, format!("start {target}{}", said(&start.findings)));
    }
    for component in plan.components() {
        self::component(text, outline, plan, component, said);
    }
}

fn component(
    text: &mut String,
    outline: &Outline,
    plan: &Plan,
    component: &Component,
    said: &dyn Fn(&Findings) -> String,
) {
    let mut line = |depth: usize, content: String| {
        let _ = writeln!(text, "{:width$}{content}", "", width = 2 * depth);
    };
    let depth = 2 + usize::from(matches!(component.item, afp_syntax::item::Item::Local { .. }));
    let Component { item, kind, findings, .. } = component;
    let made = made_from(outline, component);
    line(depth, format!("{} {item}: {made}{}", kind.keyword(), said(findings)));
    for doc in [&component.doc, &component.note].into_iter().filter(|text| !text.is_empty()) {
        line(depth + 1, format!("says {doc:?}"));
    }
    if let Some(times) = component.times {
        let times = [times.timing.period, times.timing.deadline].map(|time| time.as_nanos());
        line(depth + 1, format!("every {} deadline {} ns", times[0], times[1]));
    }
    for input in &component.inputs {
        let ty = input.ty.as_ref().map_or("?".to_owned(), ToString::to_string);
        let value = match (&input.binding, &input.default) {
            (Some(binding), _) => bound(plan, binding),
            (None, Some(default)) => format!("({default:?})"),
            (None, None) if input.required => "HOLE".to_owned(),
            (None, None) => "(given)".to_owned(),
        };
        let known = if input.declared.is_some() { "" } else { "unknown " };
        let said = said(&input.findings);
        line(depth + 1, format!("{known}in {}: {ty} = {value}{said}", key(&input.name, input.nth)));
    }
    for output in &component.outputs {
        let ty = output.ty.as_ref().map_or("?".to_owned(), ToString::to_string);
        let value = output.binding.as_ref().map_or("-".to_owned(), |b| bound(plan, b));
        let known = if output.declared.is_some() { "" } else { "unknown " };
        let said = said(&output.findings);
        line(
            depth + 1,
            format!("{known}out {}: {ty} => {value}{said}", key(&output.name, output.nth)),
        );
    }
    for exit in &component.exits {
        let to = exit.edge.as_ref().map(|edge| edge.target.as_ref());
        let to = match to {
            Some(Some(to)) => target(plan, to),
            Some(None) => "?".to_owned(),
            None if exit.required => "HOLE".to_owned(),
            None => "-".to_owned(),
        };
        let known = if exit.known { "" } else { "unknown " };
        let said = said(&exit.findings);
        let name = key(&exit.name, exit.nth);
        line(depth + 1, format!("{known}{:?} {name} -> {to}{said}", exit.kind));
    }
}

fn key(name: &str, nth: u16) -> String {
    if nth == 1 { name.to_owned() } else { format!("{name}#{nth}") }
}

fn made_from(outline: &Outline, component: &Component) -> String {
    let Some(template) = &component.template else { return "nothing".to_owned() };
    let made = match &template.made_from {
        Some(MadeFrom::Template { toolbox, index }) => {
            format!("{}.{}", toolbox.name, toolbox.templates[*index].name)
        }
        Some(MadeFrom::Plan(plan)) => format!("plan {}", outline.plan(*plan).item),
        None => "unknown".to_owned(),
    };
    format!("{} ({made})", template.text)
}

fn bound(plan: &Plan, binding: &Binding) -> String {
    let Some(value) = &binding.value else { return "?".to_owned() };
    let entry = value.entry.map(|id| format!(" ({})", plan.entries[id.index()].item));
    format!("{}{}", value.text, entry.unwrap_or_default())
}

fn target(plan: &Plan, target: &Target) -> String {
    match target.to {
        Destination::Element(Some(id)) => plan.elements[id.index()].item.to_string(),
        Destination::Element(None) => format!("{} (unknown)", target.text),
        _ => target.text.clone(),
    }
}

/// The items and parts of all plan files, with their places.
fn identities(outline: &Outline) -> Vec<Identity> {
    let mut all = Vec::new();
    let mut add = |file, item: &afp_syntax::item::Item, part| {
        all.push(Identity { file, item: item.clone(), part });
    };
    for file in &outline.files {
        file.enums.iter().for_each(|each| add(file.file, &each.item, Part::Whole));
        file.tables.iter().for_each(|each| add(file.file, &each.item, Part::Whole));
    }
    for plan in &outline.plans {
        let file = plan.file();
        add(file, &plan.item, Part::Whole);
        (1..).zip(&plan.starts).for_each(|(nth, _)| add(file, &plan.item, Part::Start(nth)));
        plan.entries.iter().for_each(|entry| add(file, &entry.item, Part::Whole));
        for component in plan.components() {
            let item = &component.item;
            add(file, item, Part::Whole);
            for input in component.inputs.iter().filter(|input| input.binding.is_some()) {
                add(file, item, Part::Input { name: input.name.to_string(), nth: input.nth });
            }
            for output in component.outputs.iter().filter(|output| output.binding.is_some()) {
                add(file, item, Part::Output { name: output.name.to_string(), nth: output.nth });
            }
            for exit in component.exits.iter().filter(|exit| exit.edge.is_some()) {
                add(file, item, Part::Exit { name: exit.name.to_string(), nth: exit.nth });
            }
        }
    }
    all
}

/// Number of nodes of a kind in the plans of a file.
fn count(root: &Node, kind: Kind) -> usize {
    nodes(root, kind).count()
}

fn nodes(root: &Node, kind: Kind) -> impl Iterator<Item = Node> {
    let of_file = root.children().filter(|node| node.kind() == Kind::Plan);
    // A misplaced inner item is also known.
    let all = of_file.flat_map(|plan| {
        let errors = plan.children().filter(|node| node.kind() == Kind::Error);
        let inside = errors.flat_map(|error| error.children());
        let inside: Vec<_> = inside.filter(|node| node.kind() == Kind::Plan).collect();
        std::iter::once(plan).chain(inside)
    });
    all.flat_map(move |plan| {
        let found = plan.descendants().filter(|node| node.kind() == kind && !in_error(node, &plan));
        found.collect::<Vec<_>>()
    })
}

fn in_error(node: &Node, plan: &Node) -> bool {
    let inside = node.ancestors().take_while(|each| each != plan);
    inside.into_iter().any(|each| each.kind() == Kind::Error)
}

/// Checks that an outline has everything that was parsed, that its identities differ, and that they
/// match their places.
pub fn examine(text: &str, compiled: &Compiled) {
    let outline = &compiled.outline;
    let Some(first) = outline.files.first() else { return };
    let root = afp_syntax::parse(text, 0, &mut Default::default()).root();
    let plans: Vec<_> = first.plans.iter().map(|plan| outline.plan(*plan)).collect();
    let elements: usize = plans.iter().map(|plan| plan.elements.len()).sum();
    assert_eq!(elements, count(&root, Kind::Element), "elements of\n{text}");
    let guards: usize = plans.iter().map(|plan| plan.all_supervisors().count()).sum();
    assert_eq!(guards, count(&root, Kind::Guard), "supervisors of\n{text}");
    let entries: usize = plans.iter().map(|plan| plan.entries.len()).sum();
    assert_eq!(entries, count(&root, Kind::Entry), "entries of\n{text}");
    let components = || plans.iter().flat_map(|plan| plan.components());
    let edges = components().flat_map(|each| &each.exits).filter(|exit| exit.edge.is_some());
    let names =
        |edge: &Node| edge.children_with_tokens().filter(|each| each.kind() == Kind::Name).count();
    let named: usize = nodes(&root, Kind::Edge).map(|edge| names(&edge)).sum();
    let has_nameless = nodes(&root, Kind::Edge).any(|edge| names(&edge) == 0);
    let edges = edges.count();
    // An edge without a name is for every required state.
    assert!(edges == named || (edges > named && has_nameless), "{edges} edges of\n{text}");
    let all = identities(outline);
    let distinct: BTreeSet<_> = all.iter().collect();
    assert_eq!(distinct.len(), all.len(), "identities of\n{text}");
    for identity in &all {
        let span = outline.span_of(identity).unwrap();
        let at = outline.identity_at(span.file, span.start);
        let found = outline.span_of(&at.unwrap()).unwrap();
        assert!(span.contains(found) || span.start == found.end, "{identity:?} of\n{text}");
    }
    let given = outline.files.iter().map(|file| file.findings.list().len()).sum::<usize>()
        + all_findings(outline).map(|findings| findings.list().len()).sum::<usize>();
    let files: BTreeSet<_> = outline.files.iter().map(|file| file.file).collect();
    let said = compiled.diags.iter().filter(|each| files.contains(&each.span.file)).count();
    assert_eq!(given, said, "diagnostics of\n{text}");
}

fn all_findings(outline: &Outline) -> impl Iterator<Item = &Findings> {
    let files = outline.files.iter().flat_map(|file| {
        let enums = file.enums.iter().map(|each| &each.findings);
        let tables = file.tables.iter().map(|each| &each.findings);
        enums.chain(tables).chain(file.scenarios.iter().map(|each| &each.findings))
    });
    let plans = outline.plans.iter().flat_map(|plan| {
        let own = std::iter::once(&plan.findings);
        let entries = plan.entries.iter().map(|each| &each.findings);
        let starts = plan.starts.iter().map(|each| &each.findings);
        let components = plan.components().flat_map(|each| {
            let inputs = each.inputs.iter().map(|input| &input.findings);
            let outputs = each.outputs.iter().map(|output| &output.findings);
            let exits = each.exits.iter().map(|exit| &exit.findings);
            std::iter::once(&each.findings).chain(inputs).chain(outputs).chain(exits)
        });
        own.chain(entries).chain(starts).chain(components)
    });
    files.chain(plans)
}
