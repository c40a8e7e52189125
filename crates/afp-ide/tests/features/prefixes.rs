//! Every prefix of a text: each query has an answer with spans inside the text.

use std::path::Path;
use std::{env, fs};

use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::{Compiled, compile};
use afp_ide::{View, actions, completion, definition, folding, hints, hover, lenses, references};
use afp_ide::{selection, signature, symbols, tokens};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::parse;
use afp_syntax::source::{Source, Span};

/// Makes all queries about a place; every span must be inside its file.
fn ask(compiled: &Compiled, toolboxes: &Toolboxes, file: u16, at: u32) {
    let view = View::new(compiled, toolboxes, file);
    let inside = |span: Span| {
        let text = &compiled.sources.get(span.file).unwrap().text;
        assert!(text.get(span.start as usize..span.end as usize).is_some(), "{span:?} of\n{text}");
    };
    for one in completion::completions(&view, at) {
        inside(one.replaces);
        assert!(one.replaces.end == at && !one.insert.is_empty(), "{one:?}");
        one.with.iter().for_each(|edit| inside(edit.span));
    }
    if let Some(hover) = hover::hover(&view, at) {
        inside(hover.span);
        assert!(!hover.markdown().is_empty());
    }
    for found in [definition::definition(&view, at), definition::type_definition(&view, at)] {
        found.iter().flat_map(|found| &found.targets).for_each(|target| inside(target.name));
    }
    references::references(&view, at).into_iter().for_each(inside);
    let around = selection::selections(&view, at);
    assert!(around.windows(2).all(|pair| pair[1].contains(pair[0])), "{around:?}");
    around.into_iter().for_each(inside);
    if let Some(signature) = signature::signature(&view, at) {
        assert!(signature.active.is_none_or(|active| active < signature.ports.len()));
    }
    for action in actions::actions(&view, Span { file, start: at, end: at }) {
        assert!(!action.title.is_empty() && !action.edits.is_empty(), "{action:?}");
        action.edits.iter().for_each(|edit| inside(edit.span));
    }
}

fn ask_all(compiled: &Compiled, toolboxes: &Toolboxes, file: u16) {
    let view = View::new(compiled, toolboxes, file);
    let text = view.text();
    symbols::symbols(&view);
    lenses::lenses(&view);
    hints::hints(&view);
    let folds = folding::folds(&view);
    assert!(
        folds
            .iter()
            .all(|fold| text[fold.span.start as usize..fold.span.end as usize].contains('\n'))
    );
    let colours = tokens::colours(&view);
    assert!(colours.windows(2).all(|pair| pair[0].span.end <= pair[1].span.start), "{colours:?}");
}

/// The borders and middles of a text's words.
fn borders(text: &str) -> Vec<usize> {
    let root = parse(text, 0, &mut Diagnostics::default()).root();
    let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    let ranges = tokens.map(|token| std::ops::Range::<usize>::from(token.text_range()));
    ranges
        .flat_map(|range| [text.floor_char_boundary((range.start + range.end) / 2), range.end])
        .collect()
}

/// The test samples one prefix per step; `AFP_BY_NIGHT` tests all.
const STEP: usize = 23;

#[test]
fn every_question_is_answered_on_every_prefix_of_every_plan() {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let step = if env::var_os("AFP_BY_NIGHT").is_some() { 1 } else { STEP };
    let mut asked = 0;
    for folder in ["plans", "plans/parts", "plans/tests", "examples/embed/plans"] {
        for entry in fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|ending| ending != "afp") {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let mut files = Texts::default();
            let other = fs::read_to_string(root.join("plans/wall_following.afp")).unwrap();
            files.add("../wall_following.afp", other);
            let ends = borders(&text);
            let ends = ends.iter().rev().skip(asked % step).step_by(step);
            for &end in ends {
                let source = Source::new("tests/case.afp", &text[..end]);
                let compiled = compile(&source, &toolboxes, &files);
                let file = compiled.plan_files.start as u16;
                ask(&compiled, &toolboxes, file, end as u32);
                ask_all(&compiled, &toolboxes, file);
                asked += 1;
            }
        }
    }
    assert!(asked > 10_000 / step, "{asked}");
}

#[test]
fn every_question_is_answered_at_every_place_of_a_plan_and_of_a_toolbox() {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let text = include_str!("../../../../plans/wall_following.afp");
    let compiled = compile(&Source::new("case.afp", text), &toolboxes, &Texts::default());
    let files = [0, compiled.plan_files.start as u16];
    for file in files {
        let text = &compiled.sources.get(file).unwrap().text;
        for at in borders(text) {
            ask(&compiled, &toolboxes, file, at as u32);
        }
        ask_all(&compiled, &toolboxes, file);
    }
}
