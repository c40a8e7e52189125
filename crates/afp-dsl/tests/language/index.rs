//! Texts, many of them invalid, each with the meanings of its names; and properties of any text.
//!
//! `AFP_BLESS=1` rewrites the meanings; read the diff like code.

use crate::support;

use std::fmt::Write;

use afp_dsl::Compiled;
use afp_dsl::index::{Definition, DefinitionKind, Meaning, Word};
use afp_syntax::diagnostics::{Diagnostics, Severity};
use afp_syntax::source::Span;
use afp_syntax::{kind::Kind, parse};

const MARK: &str = "\n// Index:\n";

#[test]
fn every_case_has_its_index() {
    let toolboxes = support::toolboxes();
    let mut wrong = Vec::new();
    for path in support::files("tests/index") {
        let case = support::read(&path);
        let text = case.split(MARK).next().unwrap();
        let compiled = support::compile(text, &toolboxes);
        let dump: String = dump(&compiled).lines().map(|line| format!("//  {line}\n")).collect();
        wrong.extend(support::compare(&path, &case, &format!("{text}{MARK}{dump}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Line and column of a place; the name of a toolbox.
fn place(compiled: &Compiled, span: Span) -> String {
    let files = compiled.plan_files.clone();
    let source = compiled.sources.get(span.file).unwrap();
    let (line, column) = source.line_column(span.start);
    match usize::from(span.file) {
        file if file == files.start => format!("{line}:{column}"),
        file if files.contains(&file) => format!("{}:{line}:{column}", source.name),
        _ => source.name.clone(),
    }
}

/// A definition with its parent.
fn shown(compiled: &Compiled, definition: &Definition) -> String {
    let mut path = compiled.sources.text(definition.name).to_owned();
    let mut owner = definition.owner;
    while let Some(id) = owner {
        let outer = compiled.index.definition(id);
        path = format!("{}.{path}", compiled.sources.text(outer.name));
        owner = outer.owner;
    }
    let kind = match definition.kind {
        DefinitionKind::Entry(kind) => format!("{kind:?} entry"),
        DefinitionKind::Component(kind) => format!("{kind:?}"),
        DefinitionKind::Template(kind) => format!("{kind:?} template"),
        kind => format!("{kind:?}"),
    };
    format!("{} {path}", kind.to_lowercase())
}

fn dump(compiled: &Compiled) -> String {
    let index = &compiled.index;
    let mut text = String::new();
    for file in compiled.plan_files.clone() {
        for name in index.names_in(file as u16) {
            let said = match name.meaning {
                Meaning::Declares(id) => {
                    let definition = index.definition(id);
                    let made = definition.made_from.map(|made| index.definition(made));
                    let made = made.map(|made| format!(" from {}", shown(compiled, made)));
                    let uses: Vec<_> =
                        index.references(id).map(|used| place(compiled, used)).collect();
                    let uses = if uses.is_empty() {
                        String::new()
                    } else {
                        format!("; {}", uses.join(" "))
                    };
                    format!("= {}{}{uses}", shown(compiled, definition), made.unwrap_or_default())
                }
                Meaning::Refers(id) => {
                    let definition = index.definition(id);
                    format!(
                        "{} ({})",
                        shown(compiled, definition),
                        place(compiled, definition.name)
                    )
                }
                Meaning::Both { entry, port } => {
                    let both = [entry, port].map(|id| index.definition(id));
                    let both = both.map(|it| {
                        format!("{} ({})", shown(compiled, it), place(compiled, it.name))
                    });
                    both.join(" for ")
                }
                Meaning::Ambiguous(candidates) => {
                    let all = index.candidates(candidates).iter();
                    let all = all.map(|id| shown(compiled, index.definition(*id)));
                    format!("one of {}", all.collect::<Vec<_>>().join(", "))
                }
                Meaning::File(file) => format!("file {}", compiled.sources.get(file).unwrap().name),
                meaning => format!("{meaning:?}").to_lowercase(),
            };
            let written = compiled.sources.text(name.span);
            let _ = writeln!(text, "{} {written}: {said}", place(compiled, name.span));
        }
    }
    text
}

/// Checks that every name of a text is in its index once, and that definitions and references
/// match.
pub fn examine(text: &str, compiled: &Compiled) {
    let index = &compiled.index;
    let file = compiled.plan_files.start as u16;
    let sound = !compiled.diags.iter().any(|each| each.severity == Severity::Error);
    let root = parse(text, file, &mut Diagnostics::default()).root();
    for token in root.descendants_with_tokens().filter_map(|each| each.into_token()) {
        if token.kind() != Kind::Name {
            continue;
        }
        let range = token.text_range();
        let span = Span { file, start: range.start().into(), end: range.end().into() };
        let name = index.name(span);
        let name =
            name.unwrap_or_else(|| panic!("'{}' at {span:?} is missing of\n{text}", token.text()));
        assert_eq!(index.at(file, span.start), Some(name), "{text}");
        let skipped = token.parent_ancestors().any(|node| node.kind() == Kind::Error);
        if name.meaning == Meaning::Unread {
            assert!(skipped, "'{}' at {span:?} is not read of\n{text}", token.text());
        }
        assert!(!sound || name.meaning != Meaning::Unknown, "'{}' of\n{text}", token.text());
    }
    for pair in index.names_in(file).windows(2) {
        assert!(pair[0].span.end <= pair[1].span.start, "{pair:?} of\n{text}");
    }
    for (id, definition) in index.definitions() {
        let own = index.name(definition.name).unwrap();
        assert_eq!(own.meaning, Meaning::Declares(id));
        assert!(definition.span.contains(definition.name), "{definition:?} of\n{text}");
        for used in index.references(id) {
            match index.name(used).unwrap().meaning {
                Meaning::Both { entry, port } => assert!([entry, port].contains(&id), "{text}"),
                meaning => assert_eq!(meaning, Meaning::Refers(id)),
            }
        }
        if let Some(owner) = definition.owner {
            assert!(index.members(owner).any(|(member, _)| member == id), "{definition:?}");
        }
    }
}

#[test]
fn every_name_of_every_case_is_in_the_index() {
    let toolboxes = support::toolboxes();
    for folder in [
        "tests/errors",
        "tests/graph",
        "tests/outline",
        "tests/index",
        "tests/toolboxes",
        "../../plans",
        "../../plans/tests",
        "../../tests/run",
    ] {
        for path in support::files(folder) {
            let text = support::read(&path);
            let (first, files) = afp_dsl::files::Texts::in_one(&text);
            let source = afp_syntax::source::Source::new(support::CASE, first.as_str());
            examine(&first, &afp_dsl::compile(&source, &toolboxes, &files));
        }
    }
}

const PATROL: &str = "\
use carbot as c

enum Side { left right }

plan Patrol {
    in side: Side = Side.left
    var gap: length
    start go
    /// Ahead.
    actor go: c.Forward(distance = gap, driven => gap) {
        supervise touch: c.CheckTouchSensor { TouchSensorPressed -> turn }
        ForwardSuccessful -> turn
    }
    actor turn: c.Turn { TurnSuccessful -> go, Error -> terminate }
}
";

/// The place of the `nth` occurrence of a word, from 1.
fn find(compiled: &Compiled, word: &str, nth: usize) -> (u16, u32) {
    let file = compiled.plan_files.start as u16;
    let text = &compiled.sources.get(file).unwrap().text;
    (file, text.match_indices(word).nth(nth - 1).unwrap().0 as u32)
}

/// Examples of the index's uses.
#[test]
fn the_index_answers_an_editor() {
    let compiled = support::compile(PATROL, &support::toolboxes());
    let index = &compiled.index;
    let said = |word: &str, nth: usize| {
        let (file, offset) = find(&compiled, word, nth);
        index.at(file, offset).unwrap().meaning
    };
    // Go to definition: from a target to its element, from a port to the toolbox.
    let turn = said("turn", 1).definition().unwrap();
    let definition = index.definition(turn);
    assert_eq!(place(&compiled, definition.name), "14:11");
    assert_eq!(compiled.sources.text(definition.span).lines().count(), 1);
    let port = index.definition(said("distance", 1).definition().unwrap());
    assert_eq!(
        (port.kind, place(&compiled, port.name)),
        (DefinitionKind::Input, "carbot.afp".into())
    );
    // References of an element.
    let uses: Vec<_> = index.references(turn).map(|span| place(&compiled, span)).collect();
    assert_eq!(uses, ["11:69", "12:30"]);
    // Hover: help, and its template.
    let go = index.definition(said("go", 1).definition().unwrap());
    assert_eq!(go.doc, "Ahead.");
    let template = index.definition(go.made_from.unwrap());
    assert_eq!(compiled.sources.text(template.name), "Forward");
    assert!(template.doc.starts_with("Drive"), "{}", template.doc);
    // The alias of a toolbox is declared after 'as'.
    let alias = index.definition(said("c.Forward", 1).definition().unwrap());
    assert_eq!((alias.kind, place(&compiled, alias.name)), (DefinitionKind::Alias, "1:15".into()));
    // Keywords have no definition.
    assert_eq!(said("Error", 1), Meaning::Word(Word::Error));
    assert_eq!(said("length", 1), Meaning::Word(Word::Type));
    // Symbols: the members of a plan, in order.
    let plan = said("Patrol", 1).definition().unwrap();
    let members: Vec<_> =
        index.members(plan).map(|(_, each)| compiled.sources.text(each.name)).collect();
    assert_eq!(members, ["side", "gap", "go", "turn"]);
    // Completion: inside of the plan also its members.
    let names = |offset: u32| {
        let all = index.visible(compiled.plan_files.start as u16, offset, |_| true).into_iter();
        let all = all.map(|id| compiled.sources.text(index.definition(id).name));
        all.collect::<Vec<_>>()
    };
    let (_, inside) = find(&compiled, "ForwardSuccessful", 1);
    assert!(
        ["Side", "Patrol", "side", "gap", "go", "turn", "Turn"]
            .iter()
            .all(|n| names(inside).contains(n))
    );
    assert!(!names(0).contains(&"gap") && names(0).contains(&"Patrol"));
    assert!(!names(inside).contains(&"Count"), "the toolbox 'std' is not used");
    let plans = |kind| kind == DefinitionKind::Plan;
    let plans = index.visible(compiled.plan_files.start as u16, inside, plans).into_iter();
    let plans: Vec<_> = plans.map(|id| compiled.sources.text(index.definition(id).name)).collect();
    assert_eq!(plans, ["Patrol"]);
    // There is nothing between names.
    let (file, offset) = find(&compiled, "{ left", 1);
    assert_eq!(index.at(file, offset), None);
}
