//! What is no mistake of its own: it comes of another one, which is reported.
//!
//! Where text cannot be read, names that stand in it seem to be missing elsewhere. A name that is not there is one
//! mistake, however often it is used; and where nothing else is called for, it is that of a declaration with a slip in
//! it.

use std::ops::Range;

use super::{PlanHead, Program, meant};
use crate::gather::PlanFile;
use afp_syntax::ast::{Item, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Severity, words::nearest};
use afp_syntax::source::Span;
use rustc_hash::{FxHashMap, FxHashSet};

/// What may only seem to be missing in a plan of which something cannot be read.
const MISSING: &[Code] = &[
    Code::E0201,
    Code::E0202,
    Code::E0209,
    Code::E0210,
    Code::E0211,
    Code::E0215,
    Code::E0216,
    Code::E0225,
    Code::E0233,
    Code::E0241,
];

/// Names that are not there.
const UNKNOWN: &[Code] = &[Code::E0201, Code::E0209, Code::E0216, Code::E0238];

/// So many of the places at which a name is used are shown.
const MOST_PLACES: usize = 8;

/// Drops and joins what comes of mistakes that are reported.
pub(super) fn hold_back(program: &Program<'_>, files: &[PlanFile], diags: &mut Diagnostics) {
    let unread: Vec<Span> = diags
        .iter()
        .filter(|each| each.code < Code::E0201 && each.severity == Severity::Error)
        .map(|each| each.span)
        .collect();
    if !unread.is_empty() {
        hold_back_unread(files, &unread, diags);
    }
    if diags.iter().any(|each| UNKNOWN.contains(&each.code)) {
        join(program, diags);
    }
}

/// Drops what may come of text that cannot be read at these places.
fn hold_back_unread(files: &[PlanFile], unread: &[Span], diags: &mut Diagnostics) {
    let items: Vec<Span> =
        files.iter().flat_map(|file| file.tree.items()).filter_map(|it| span(&it)).collect();
    let text = |file: u16| {
        let file = files.iter().find(|it| it.index == file);
        file.map_or("", |it| &it.source.text)
    };
    let lines: Vec<_> =
        unread.iter().map(|place| (place.file, line(text(place.file), *place))).collect();
    let words: FxHashSet<&str> =
        lines.iter().flat_map(|(file, line)| self::words(&text(*file)[line.clone()])).collect();
    // A plan that ends too early has the rest of it behind itself.
    let outside = |place: &&Span| !items.iter().any(|item| item.contains(**place));
    let mut whole: FxHashSet<u16> = unread.iter().filter(outside).map(|place| place.file).collect();
    // What a line would have named that uses nothing that can be read is not known.
    let uses = files.iter().flat_map(|file| file.tree.items());
    let uses = uses.filter_map(|item| match item {
        Item::Use(item) => Some(item.span()),
        _ => None,
    });
    let broken = uses.filter(|item| unread.iter().any(|place| item.contains(*place)));
    whole.extend(broken.map(|item| item.file));
    // What is wrong besides, once the line can be read: one edit does not mend it.
    let mut besides: FxHashSet<(u16, usize)> = FxHashSet::default();
    diags.retain(|each| {
        // A unit is read, whatever stands around it.
        if each.code < Code::E0201 || each.code == Code::E0236 {
            return true;
        }
        let (file, at) = (each.span.file, each.span.start as usize);
        let beside = lines.iter().find(|(other, line)| *other == file && line.contains(&at));
        let may_come_of = || {
            let mut named = each.message.split('\'').skip(1).step_by(2);
            whole.contains(&file) || named.any(|name| words.contains(name))
        };
        let is_missing = MISSING.contains(&each.code);
        if let Some((_, line)) = beside.filter(|_| each.severity == Severity::Error) {
            besides.insert((file, line.start));
        }
        !(beside.is_some() || is_missing && may_come_of())
    });
    diags.change(|each| {
        let line = line(text(each.span.file), each.span);
        if each.code < Code::E0201 && besides.contains(&(each.span.file, line.start)) {
            each.fix = None;
        }
    });
}

/// Where an item stands that has its own mistakes.
fn span(item: &Item) -> Option<Span> {
    Some(match item {
        Item::Use(item) => item.span(),
        Item::Plan(item) => item.span(),
        Item::Scenario(item) => item.span(),
        Item::Enum(item) => item.span(),
        _ => return None,
    })
}

/// The line of a place, in bytes of its text.
fn line(text: &str, place: Span) -> Range<usize> {
    let at = (place.start as usize).min(text.len());
    let start = text.get(..at).and_then(|before| before.rfind('\n')).map_or(0, |end| end + 1);
    let end = text.get(at..).and_then(|rest| rest.find('\n')).map_or(text.len(), |end| at + end);
    // The end of the line belongs to it, where the text goes on.
    start..(end + 1).min(text.len())
}

/// The words of a text.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|letter: char| !letter.is_alphanumeric() && letter != '_')
        .filter(|it| !it.is_empty())
}

/// Joins what is said of one unknown name in one plan.
fn join(program: &Program<'_>, diags: &mut Diagnostics) {
    let plan_of =
        |span: Span| program.plans.iter().position(|head| head.node.span().contains(span));
    let mut first: FxHashMap<(Code, Option<usize>, String), usize> = FxHashMap::default();
    let mut joined: Vec<(Diagnostic, Vec<Span>)> = Vec::new();
    let mut all: Vec<_> = diags.iter().cloned().collect();
    all.sort_by_key(|each| each.span);
    for each in all {
        if !UNKNOWN.contains(&each.code) {
            continue;
        }
        let key = (each.code, plan_of(each.span), each.message.clone());
        match first.get(&key) {
            Some(place) => joined[*place].1.push(each.span),
            None => {
                first.insert(key, joined.len());
                joined.push((each, Vec::new()));
            }
        }
    }
    diags.retain(|each| !UNKNOWN.contains(&each.code));
    for (error, others) in joined {
        let head = plan_of(error.span).and_then(|place| program.plans.get(place));
        let slip = head.filter(|_| !others.is_empty()).and_then(|head| slip(program, head, &error));
        diags.push(match slip {
            Some((name, meant)) => at_declaration(&error, &others, &name, &meant),
            None => also_at(meant::explain(program, plan_of(error.span), error), &others),
        });
    }
}

/// The name that is declared, used nowhere, and differs from one that is used and not there by a slip; and that one.
fn slip(program: &Program<'_>, head: &PlanHead, error: &Diagnostic) -> Option<(Name, String)> {
    let text = program.files.get(head.file)?.text;
    let used = text.get(error.span.start as usize..error.span.end as usize)?;
    let declared: Vec<Name> = match error.code {
        Code::E0216 => head.node.elements().iter().filter_map(|element| element.name()).collect(),
        Code::E0209 => head.entries.iter().map(|entry| entry.name.clone()).collect(),
        _ => return None,
    };
    let meant = nearest(used, declared.iter().map(|name| &*name.text))?;
    let is_used = head.node.names().filter(|name| name == meant).count() > 1;
    let name = declared.iter().find(|name| name.text == meant).filter(|_| !is_used)?;
    Some((name.clone(), used.to_owned()))
}

/// Says it where the name is declared.
fn at_declaration(error: &Diagnostic, others: &[Span], name: &Name, meant: &str) -> Diagnostic {
    let message =
        format!("nothing uses '{}', and '{meant}', which is used, is not there", name.text);
    let said = Diagnostic::new(error.code, name.span, message)
        .help(format!("write '{meant}'"))
        .replace(meant);
    let places = std::iter::once(&error.span).chain(others).take(MOST_PLACES);
    places.fold(said, |said, place| said.note(*place, format!("'{meant}' is used here")))
}

/// Says it where the name is used first. One edit does not mend several places.
fn also_at(mut error: Diagnostic, others: &[Span]) -> Diagnostic {
    if !others.is_empty() {
        error.fix = None;
    }
    others.iter().take(MOST_PLACES).fold(error, |error, other| error.note(*other, "and here"))
}
