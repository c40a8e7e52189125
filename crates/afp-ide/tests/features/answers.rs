//! The answers of each feature as lines.

use std::fmt::Write;

use afp_ide::completion::Piece;
use afp_ide::edit::{TextEdit, apply};
use afp_ide::symbols::Symbol;
use afp_ide::{actions, completion, definition, folding, hints, hover, lenses, references};
use afp_ide::{selection, signature, symbols, tokens};
use afp_syntax::source::Span;

use crate::support::Case;

/// The most completions shown for a place.
const SHOWN: usize = 14;

/// One answer for each mark, below its place.
fn each(case: &Case, answer: impl Fn(u32) -> String) -> String {
    assert!(!case.marks.is_empty(), "no mark in\n{}", case.written);
    let one = |mark: &u32| {
        let place = case.place(Span { file: case.file, start: *mark, end: *mark });
        let answer = answer(*mark);
        let answer = if answer.is_empty() { "nothing\n".to_owned() } else { answer };
        let lines: String = answer.lines().map(|line| format!("  {line}\n")).collect();
        format!("{place}\n{lines}")
    };
    case.marks.iter().map(one).collect()
}

fn lines(all: impl IntoIterator<Item = String>) -> String {
    all.into_iter().map(|line| line + "\n").collect()
}

pub fn completion(case: &Case) -> String {
    let view = case.view();
    each(case, |mark| {
        let all = completion::completions(&view, mark);
        let shown = all.iter().take(SHOWN).map(|one| {
            let kind = format!("{:?}", one.kind).to_lowercase();
            let mut line = format!("{} ({kind}): {}", one.label, written(&one.insert));
            if !one.with.is_empty() {
                line += &format!(
                    "  + {}",
                    one.with.iter().map(|edit| edit.text.trim()).collect::<String>()
                );
            }
            line
        });
        let rest = all.len().saturating_sub(SHOWN);
        let rest = (rest > 0).then(|| format!("and {rest} more"));
        lines(shown.chain(rest))
    })
}

fn written(pieces: &[Piece]) -> String {
    let piece = |piece: &Piece| match piece {
        Piece::Text(text) => text.clone(),
        Piece::Hole(text) => format!("<{text}>"),
    };
    pieces.iter().map(piece).collect::<String>().replace('\n', "\\n")
}

pub fn definition(case: &Case) -> String {
    let view = case.view();
    each(case, |mark| {
        let mut text = String::new();
        for (label, found) in [
            ("declared", definition::definition(&view, mark)),
            ("made from", definition::type_definition(&view, mark)),
        ] {
            let Some(found) = found else { continue };
            let origin = case.range(found.origin);
            let targets: Vec<_> =
                found.targets.iter().map(|target| case.place(target.name)).collect();
            let _ = writeln!(text, "{origin} {label} {}", targets.join(", "));
        }
        text
    })
}

pub fn references(case: &Case) -> String {
    let view = case.view();
    each(case, |mark| {
        let all = references::references(&view, mark);
        let all: Vec<_> = all.iter().map(|span| case.place(*span)).collect();
        let own = references::highlights(&view, mark).len();
        if all.is_empty() { String::new() } else { format!("{} ({own} here)\n", all.join(" ")) }
    })
}

pub fn hover(case: &Case) -> String {
    let view = case.view();
    each(case, |mark| {
        let found = hover::hover(&view, mark);
        found
            .map(|hover| format!("{}\n{}\n", case.range(hover.span), hover.markdown()))
            .unwrap_or_default()
    })
}

pub fn signature(case: &Case) -> String {
    let view = case.view();
    each(case, |mark| {
        let Some(found) = signature::signature(&view, mark) else { return String::new() };
        let mut text = format!("{}\n", found.label);
        if let Some(port) = found.active.map(|active| &found.ports[active]) {
            let _ = writeln!(text, "at {}: {}", &found.label[port.label.clone()], port.doc);
        }
        text
    })
}

/// The actions for the selection between two marks; a single mark is an empty selection.
pub fn actions(case: &Case) -> String {
    let view = case.view();
    let (Some(start), Some(end)) = (case.marks.first(), case.marks.last()) else {
        panic!("no mark in\n{}", case.written);
    };
    let place = Span { file: case.file, start: *start, end: *end };
    let all = actions::actions(&view, place).into_iter().map(|action| {
        let mends = action.mends.and_then(|place| case.compiled.diags.get(place as u32));
        let mends = mends.map(|it| format!(" for {}", it.code.as_str())).unwrap_or_default();
        let kind = format!("{:?}", action.kind).to_lowercase();
        format!("{kind}{mends}: {}\n{}", action.title, after(case, &action.edits))
    });
    let text: String = all.collect();
    if text.is_empty() { "nothing\n".to_owned() } else { text }
}

fn after(case: &Case, edits: &[TextEdit]) -> String {
    let text = case.view().text();
    let own: Vec<_> = edits.iter().filter(|edit| edit.span.file == case.file).cloned().collect();
    assert_eq!(own.len(), edits.len(), "edits elsewhere");
    let after = apply(text, &own);
    let (before, after): (Vec<_>, Vec<_>) =
        (text.lines().collect(), after.lines().map(str::to_owned).collect());
    let same = before.iter().zip(&after).take_while(|(a, b)| **a == b.as_str()).count();
    let rest = before[same..].iter().rev().zip(after[same..].iter().rev());
    let same_end = rest.take_while(|(a, b)| **a == b.as_str()).count();
    after[same..after.len() - same_end].iter().map(|line| format!("    |{line}\n")).collect()
}

pub fn symbols(case: &Case) -> String {
    fn shown(case: &Case, symbols: &[Symbol], depth: usize, text: &mut String) {
        for one in symbols {
            let _ = writeln!(
                text,
                "{:depth$}{} ({:?}) {} {}: {}",
                "",
                one.name,
                one.kind,
                case.range(one.span),
                case.place(one.name_span),
                one.detail
            );
            shown(case, &one.children, depth + 2, text);
        }
    }
    let mut text = String::new();
    shown(case, &symbols::symbols(&case.view()), 0, &mut text);
    text
}

pub fn folding(case: &Case) -> String {
    let folds = folding::folds(&case.view());
    lines(folds.iter().map(|fold| format!("{:?} {}", fold.kind, case.range(fold.span))))
}

pub fn selection(case: &Case) -> String {
    let view = case.view();
    each(case, |mark| {
        let all = selection::selections(&view, mark);
        lines(all.iter().map(|span| case.range(*span)))
    })
}

pub fn colours(case: &Case) -> String {
    let colours = tokens::colours(&case.view());
    lines(colours.iter().map(|colour| {
        let text = case.compiled.sources.text(colour.span);
        let declares = if colour.declares { " declared" } else { "" };
        let constant = if colour.constant { " constant" } else { "" };
        format!("{} {text}: {}{declares}{constant}", case.place(colour.span), colour.kind.name())
    }))
}

pub fn hints(case: &Case) -> String {
    let hints = hints::hints(&case.view());
    lines(hints.iter().map(|hint| format!("{} {}: {}", case.place(hint.at), hint.label, hint.why)))
}

pub fn lenses(case: &Case) -> String {
    let all = lenses::lenses(&case.view());
    lines(
        all.iter()
            .map(|lens| format!("{} {:?} '{}'", case.place(lens.span), lens.action, lens.name)),
    )
}
