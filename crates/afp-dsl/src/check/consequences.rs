//! Removes errors that are consequences of other errors.
//!
//! Names in unreadable text seem to be missing elsewhere. An unknown name is one error, however
//! often it is used. If something is declared and never used, the unknown name is probably its
//! misspelling.

use std::collections::hash_map::Entry;

use super::places::{ByLine, Lines, Ranges, Within};
use super::{PlanHead, Program, meant, mistaken};
use crate::gather::PlanFile;
use afp_syntax::ast::{Element, Item, Name};
use afp_syntax::diagnostics::{
    Code, Diagnostic, Diagnostics, Message, Severity, Sought, Subject, places, words::nearest,
};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::units::Unit;
use rustc_hash::{FxHashMap, FxHashSet};

/// Errors that may be consequences in a plan with unreadable text.
const MISSING: &[Code] = &[
    Code::E0201,
    Code::E0202,
    Code::E0209,
    Code::E0210,
    Code::E0211,
    Code::E0215,
    Code::E0216,
    Code::E0225,
    Code::E0232,
    Code::E0233,
    Code::E0239,
    Code::E0241,
    Code::E0248,
    Code::E0253,
    Code::E0602,
    Code::E0603,
    Code::E0608,
];

/// Errors of unknown names.
const UNKNOWN: &[Code] =
    &[Code::E0201, Code::E0209, Code::E0216, Code::E0238, Code::E0248, Code::E0602];

/// Errors of a whole scenario, which may be those of an unreadable line in it.
const WHOLE: &[Code] = &[Code::E0601, Code::E0605, Code::E0609];

/// The maximum number of uses of a name that an error shows.
const MOST_PLACES: usize = 8;

/// The maximum number of unknown names that are searched elsewhere, because each search visits all
/// elements.
const MOST_EXPLAINED: usize = 100;

/// Removes and joins consequences of reported errors.
pub(super) fn hold_back(program: &Program<'_>, files: &[PlanFile], diags: &mut Diagnostics) {
    let is_unread =
        |each: &&Diagnostic| each.code < Code::E0201 && each.severity == Severity::Error;
    let unread: Vec<Span> = diags.iter().filter(is_unread).map(|each| each.span).collect();
    if !unread.is_empty() {
        let is_nameless = |each: &&Diagnostic| each.subject == Subject::MissingName;
        let nameless = diags.iter().filter(is_nameless).map(|each| each.span).collect();
        hold_back_unread(files, &Unread { places: unread, nameless }, diags);
    }
    if diags.iter().any(|each| each.code == Code::E0603) {
        hold_back_edges(program, diags);
    }
    mistaken::hold_back(program, diags);
    if diags.iter().any(|each| each.code == Code::E0212) {
        hold_back_targets(program, diags);
    }
    if diags.iter().any(|each| UNKNOWN.contains(&each.code)) {
        join(program, diags);
    }
    let plans: Vec<Span> = program.plans.iter().map(|head| head.node.span()).collect();
    let mut explained = 0;
    diags.change(|each| {
        let may_be_else = matches!(each.code, Code::E0210 | Code::E0239);
        if (may_be_else || matches!(each.subject, Subject::Event | Subject::Value))
            && explained < MOST_EXPLAINED
        {
            explained += 1;
            let plan = plans.iter().position(|plan| plan.contains(each.span));
            *each = meant::explain(program, plan, each.clone());
        }
    });
}

/// Removes errors about unknown targets in plans with two elements of one name: the second is
/// probably the missing one.
fn hold_back_targets(program: &Program<'_>, diags: &mut Diagnostics) {
    let twice = diags.iter().filter(|each| each.code == Code::E0212).map(|each| each.span);
    let twice: FxHashSet<Span> = twice.collect();
    let has_two = |head: &&PlanHead| {
        let elements = head.node.elements();
        elements.iter().filter_map(|it| it.name()).any(|name| twice.contains(&name.span))
    };
    let plans = program.plans.iter().filter(has_two).map(|head| head.node.span());
    let plans = Ranges::new(plans.collect());
    diags.retain(|each| each.code != Code::E0216 || !plans.any(each.span));
}

/// The unreadable places.
struct Unread {
    places: Vec<Span>,
    /// The places of missing names.
    nameless: Vec<Span>,
}

/// Removes possible consequences of unreadable text at these places.
fn hold_back_unread(files: &[PlanFile], all: &Unread, diags: &mut Diagnostics) {
    let items: Vec<Span> =
        files.iter().flat_map(|file| file.tree.items()).filter_map(|it| span(&it)).collect();
    let (lines, unread) = (Lines::new(files), Within::new(&all.places));
    let by_line = ByLine::new(&lines, &all.places);
    let words = by_line.lines().flat_map(|(file, line)| self::words(lines.text(file, line)));
    let words: FxHashSet<&str> = words.collect();
    let nameless = Within::new(&all.nameless);
    let (enums, tables) = nameless_of_files(files, &nameless);
    let nameless = Ranges::new(plans_around(files, &nameless));
    let broken = Ranges::new(items.iter().copied().filter(|item| unread.any(*item)).collect());
    // If a plan ends too early, its rest follows it.
    let items = Ranges::new(items);
    let outside = all.places.iter().filter(|place| !items.any(**place));
    let mut whole: FxHashSet<u16> = outside.map(|place| place.file).collect();
    whole.extend(files_with_broken_uses(files, &unread));
    let heads = Ranges::new(nameless_heads(files));
    // Further errors that remain after the line is readable: one edit does not fix them.
    let mut besides: FxHashSet<(u16, usize)> = FxHashSet::default();
    diags.retain(|each| {
        // The grammar has already reported a missing name.
        if each.code == Code::E0602 && each.span == Span::default() {
            return false;
        }
        // A unit is read in any surroundings.
        if each.code < Code::E0201 || each.code == Code::E0236 {
            return true;
        }
        let file = each.span.file;
        let beside = by_line.beside(&lines, each.span);
        // If only a name is missing, the edges after it are read.
        let are_read = |(_, here): (usize, &[Span])| here.iter().all(|place| heads.any(*place));
        if each.code == Code::E0216 && beside.is_some_and(are_read) {
            return true;
        }
        let may_come_of = || {
            let named = match &each.subject {
                Subject::Path(path) => vec![path.as_str()],
                _ => each.names(),
            };
            let mut parts = named.into_iter().flat_map(|name| name.split('.'));
            let nameless_types = match each.code {
                Code::E0232 | Code::E0239 => Some(&enums),
                Code::E0253 => Some(&tables),
                _ => None,
            };
            if let Some(nameless) = nameless_types {
                return whole.contains(&file) || nameless.contains(&file);
            }
            let declared =
                matches!(each.code, Code::E0209 | Code::E0216) && nameless.any(each.span);
            whole.contains(&file) || declared || parts.any(|name| words.contains(name))
        };
        if WHOLE.contains(&each.code) && broken.any(each.span) {
            return false;
        }
        let is_missing = MISSING.contains(&each.code);
        if let Some((line, _)) = beside.filter(|_| each.severity == Severity::Error) {
            besides.insert((file, line));
        }
        !(beside.is_some() || is_missing && may_come_of())
    });
    diags.change(|each| {
        let line = || (each.span.file, lines.of(each.span).start);
        if each.code < Code::E0201 && besides.contains(&line()) {
            each.fix = None;
        }
    });
}

/// The plans with a declaration without a name, which may be the missing name.
fn plans_around(files: &[PlanFile], nameless: &Within) -> Vec<Span> {
    let plans = files.iter().flat_map(|file| file.tree.items()).filter_map(|item| match item {
        Item::Plan(plan) => Some(plan.span()),
        _ => None,
    });
    plans.filter(|plan| nameless.any(*plan)).collect()
}

/// The files with an enum or a table without a name.
fn nameless_of_files(files: &[PlanFile], nameless: &Within) -> (FxHashSet<u16>, FxHashSet<u16>) {
    let (mut enums, mut tables) = (FxHashSet::default(), FxHashSet::default());
    for item in files.iter().flat_map(|file| file.tree.items()) {
        let found = match item {
            Item::Enum(_) => &mut enums,
            Item::Table(_) => &mut tables,
            _ => continue,
        };
        found.extend(span(&item).filter(|item| nameless.any(*item)).map(|item| item.file));
    }
    (enums, tables)
}

/// Files with an unreadable `use`: its names are unknown.
fn files_with_broken_uses(files: &[PlanFile], unread: &Within) -> Vec<u16> {
    let uses = files.iter().flat_map(|file| file.tree.items()).filter_map(|item| match item {
        Item::Use(item) => Some(item.span()),
        _ => None,
    });
    let broken = uses.filter(|item| unread.any(*item));
    broken.map(|item| item.file).collect()
}

/// The spans of items with errors of their own.
fn span(item: &Item) -> Option<Span> {
    Some(match item {
        Item::Use(item) => item.span(),
        Item::Plan(item) => item.span(),
        Item::Scenario(item) => item.span(),
        Item::Enum(item) => item.span(),
        Item::Table(item) => item.span(),
        _ => return None,
    })
}

/// The heads, up to the template, of elements and supervisors without a name.
fn nameless_heads(files: &[PlanFile]) -> Vec<Span> {
    let plans = files.iter().flat_map(|file| file.tree.items()).filter_map(|item| match item {
        Item::Plan(plan) => Some(plan),
        _ => None,
    });
    let mut heads = Vec::new();
    for plan in plans {
        let elements = plan.elements();
        let local = elements.iter().flat_map(|element| element.guards());
        let guards = plan.guards().into_iter().chain(local);
        let guards = guards.map(|guard| (guard.name().is_none(), guard.span(), guard.template()));
        let elements = elements.iter();
        let elements = elements.map(|it| (it.name().is_none(), it.span(), it.template()));
        for (nameless, all, template) in elements.chain(guards) {
            if let Some(template) = template.filter(|_| nameless) {
                heads.push(Span { end: template.span().start, ..all });
            }
        }
    }
    heads
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|letter: char| !letter.is_alphanumeric() && letter != '_')
        .filter(|it| !it.is_empty())
}

/// Joins the errors about one unknown name of one plan, in the plan and in its scenarios.
fn join(program: &Program<'_>, diags: &mut Diagnostics) {
    let plans: Vec<Span> = program.plans.iter().map(|head| head.node.span()).collect();
    let around = |span: Span| plans.iter().position(|plan| plan.contains(span));
    let mut first: FxHashMap<_, usize> = FxHashMap::default();
    let mut joined: Vec<(Diagnostic, Vec<Span>)> = Vec::new();
    let mut last: FxHashMap<usize, FxHashMap<&str, usize>> = FxHashMap::default();
    let mut all: Vec<_> = diags.iter().filter(|it| UNKNOWN.contains(&it.code)).cloned().collect();
    // Errors of a plan come before those of its scenarios.
    all.sort_by_cached_key(|each| (around(each.span).is_none(), each.span));
    for each in all {
        match first.entry(Once::new(program, &each, around(each.span))) {
            Entry::Occupied(known) => {
                let (said, others) = &mut joined[*known.get()];
                if said.span != each.span && others.last() != Some(&each.span) {
                    others.push(each.span);
                }
            }
            Entry::Vacant(new) => {
                new.insert(joined.len());
                joined.push((each, Vec::new()));
            }
        }
    }
    diags.retain(|each| !UNKNOWN.contains(&each.code));
    for (said, (error, others)) in joined.into_iter().enumerate() {
        let plan = around(error.span);
        let head = plan.and_then(|index| program.plans.get(index));
        let slip = head.and_then(|head| {
            let last = last.entry(head.file).or_insert_with(|| last_places(program, head.file));
            let end = head.node.span().end as usize;
            // Scenarios may use names of the plan, and are not read while the plan has errors.
            let is_behind = |name: &str| last.get(name).is_some_and(|index| *index >= end);
            let text = program.files.get(head.file)?.text;
            let used = text.get(error.span.start as usize..error.span.end as usize)?;
            // The search for a misspelling visits all elements.
            if others.is_empty() && !is_behind(used) {
                return None;
            }
            let name = slip(head, error.code, used).filter(|name| !is_behind(&name.text))?;
            Some((name, used))
        });
        diags.push(match slip {
            Some((name, meant)) => at_declaration(&error, &others, &name, meant),
            None if said < MOST_EXPLAINED => also_at(meant::explain(program, plan, error), &others),
            None => also_at(error, &others),
        });
    }
}

/// The identity of an error that is reported only once.
#[derive(PartialEq, Eq, Hash)]
enum Once {
    /// An unknown name: its kind and its plan.
    Name(Sought, Option<usize>, String),
    /// A toolbox or file that is not used: the place and the text of the line to add.
    Use(Span, String),
    /// Another error, at its place.
    Place(Code, Span, Message),
}

impl Once {
    fn new(program: &Program<'_>, error: &Diagnostic, around: Option<usize>) -> Once {
        if let Some(fix) = error.fix.as_ref().filter(|fix| fix.text.starts_with("use ")) {
            return Once::Use(fix.span, fix.text.clone());
        }
        let Subject::Unknown { what, name, plan } = &error.subject else {
            return Once::Place(error.code, error.span, error.message().clone());
        };
        let of = plan.as_ref().unwrap_or(name);
        let is_it = |head: &PlanHead| head.name.as_ref().is_some_and(|name| name.text == *of);
        let plan = around.or_else(|| program.plans.iter().position(is_it));
        Once::Name(*what, plan, name.clone())
    }
}

/// Removes errors of scenarios about elements with wrong edges.
fn hold_back_edges(program: &Program<'_>, diags: &mut Diagnostics) {
    const EDGES: &[Code] = &[Code::E0210, Code::E0211, Code::E0216, Code::E0226];
    let wrong = diags.iter().filter(|each| EDGES.contains(&each.code)).map(|each| each.span);
    let wrong: Vec<Span> = wrong.take(MOST_PLACES).collect();
    if wrong.is_empty() {
        return;
    }
    let elements: Vec<_> = program.plans.iter().flat_map(|head| head.node.elements()).collect();
    let (wrong, right): (Vec<_>, Vec<_>) =
        elements.iter().partition(|element| wrong.iter().any(|it| element.span().contains(*it)));
    let names = |all: Vec<&Element>| -> FxHashSet<String> {
        all.into_iter().filter_map(|element| Some(element.name()?.text)).collect()
    };
    // Elements of several plans may have the same name.
    let (mut names, right) = (names(wrong), names(right));
    names.retain(|name| !right.contains(name));
    diags.retain(|each| {
        let comes_of = |name: &&str| name.split('.').any(|part| names.contains(part));
        each.code != Code::E0603 || !each.names().iter().any(comes_of)
    });
}

/// The last place of each word of a file.
fn last_places<'a>(program: &Program<'a>, file: usize) -> FxHashMap<&'a str, usize> {
    let text = program.files.get(file).map_or("", |file| file.text);
    let place = |word: &str| word.as_ptr().addr() - text.as_ptr().addr();
    words(text).map(|word| (word, place(word))).collect()
}

/// The only declared and unused name that is a misspelling of a used and unknown name.
fn slip(head: &PlanHead, code: Code, used: &str) -> Option<Name> {
    // All single letters are similar, and a unit is more likely a unit.
    if used.chars().count() < 2 || Unit::parse(used).is_some() {
        return None;
    }
    let declared: Vec<Name> = match code {
        Code::E0216 => head.node.elements().iter().filter_map(|element| element.name()).collect(),
        Code::E0209 => head.entries.iter().map(|entry| entry.name.clone()).collect(),
        _ => return None,
    };
    let meant = nearest(used, declared.iter().map(|name| &*name.text))?;
    let is_used = head.node.names().filter(|name| name == meant).count() > 1;
    declared.iter().find(|name| name.text == meant).filter(|_| !is_used).cloned()
}

/// Reports the misspelling at the declaration.
fn at_declaration(error: &Diagnostic, others: &[Span], name: &Name, meant: &str) -> Diagnostic {
    let message =
        message!("nothing uses '{}', and '{}' is used but not declared", name.text, meant);
    let said = Diagnostic::new(error.code, name.span, message).write(meant);
    let places = std::iter::once(&error.span).chain(others).take(MOST_PLACES);
    places.fold(said, |said, place| said.note(*place, message!("'{}' is used here", meant)))
}

/// Reports it at the first use. One edit does not fix several places, unless it adds a `use`.
fn also_at(mut error: Diagnostic, others: &[Span]) -> Diagnostic {
    if !others.is_empty() {
        error.fix = error.fix.filter(|fix| fix.text.starts_with("use "));
    }
    if others.len() > MOST_PLACES {
        error.change_message(|said| places(said, others.len() + 1));
    }
    others.iter().take(MOST_PLACES).fold(error, |error, other| error.note(*other, "and here"))
}
