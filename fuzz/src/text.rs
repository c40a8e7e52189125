//! Properties of the readers: no panics, no losses, and a place for each error.

use std::borrow::Cow;

use afp_draw::layout_file::Layout;
use afp_draw::{Options, svg};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_dsl::scenario::{Scenario, Window};
use afp_format::format;
use afp_sim::{Simulation, World};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::item::Item;
use afp_syntax::source::Source;
use afp_syntax::{Node, kind::Kind, parse};

/// The bytes as read from a file.
pub(crate) fn text(data: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(data)
}

/// The tree contains the text byte for byte.
///
/// # Panics
/// The property does not hold.
pub fn parser(data: &[u8]) {
    let text = text(data);
    let mut diags = Diagnostics::default();
    assert_eq!(parse(&text, 0, &mut diags).text(), text);
}

/// A compilation (of several files if lines `// file: PATH` divide the text) ends with a graph or
/// with errors, and all its diagnostics can be shown.
///
/// # Panics
/// The property does not hold.
pub fn checker(data: &[u8]) {
    let (first, files) = Texts::in_one(&text(data));
    let compiled = compile(&Source::new("fuzzed.afp", first), &toolboxes(), &files);
    assert_eq!(compiled.graph.is_none(), compiled.diags.has_errors());
    assert_eq!(compiled.render(false).is_empty(), compiled.diags.is_empty());
}

/// The formatted text has the same meaning and comments, and formatting it again does not change
/// it.
///
/// # Panics
/// The property does not hold.
pub fn formatter(data: &[u8]) {
    let text = text(data);
    let Ok(formatted) = format(&text) else { return };
    assert_eq!(solid(&text), solid(&formatted), "the text changed:\n{formatted}");
    assert_eq!(format(&formatted).as_deref().ok(), Some(formatted.as_str()), "not canonical");
}

/// The tokens without white space and commas, which the formatter may change.
fn solid(text: &str) -> Vec<String> {
    let root: Node = parse(text, 0, &mut Diagnostics::default()).root();
    let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    let kept = tokens.filter(|token| !matches!(token.kind(), Kind::Whitespace | Kind::Comma));
    kept.map(|token| token.text().trim_end().to_owned()).collect()
}

/// A written layout can be read back, and a plan can be drawn with its elements at the positions.
///
/// # Panics
/// The property does not hold.
pub fn layout(data: &[u8]) {
    let (layout, told) = Layout::read(&text(data));
    let written = layout.write();
    let (again, errors) = Layout::read(&written);
    assert_eq!(again, layout, "{written}");
    // Errors are kept and reported each time.
    assert_eq!(errors.len(), told.len(), "{errors:?} in {written}");
    drawn(&layout);
}

/// Draws a plan with one element for each position of a layout.
fn drawn(layout: &Layout) {
    const PLAN: &str = include_str!("../../plans/wall_following.afp");
    let compiled = compile(&Source::new("drawn.afp", PLAN), &toolboxes(), &Texts::default());
    let Some(graph) = &compiled.graph else { panic!("{}", compiled.render(false)) };
    let plan = graph.main();
    let names = plan.elements.iter().map(|element| element.name.as_str()).chain(["start"]);
    let mut placed = Layout::default();
    for (name, (_, position)) in names.zip(layout.iter()) {
        placed.set(Item::inner(&plan.name, name), position);
    }
    let positions = vec![placed; compiled.sources.len()];
    let picture = svg(&compiled.outline, &Options { positions: &positions, ..Options::default() });
    assert!(picture.ends_with("</svg>\n") && !picture.contains("NaN"), "{picture}");
}

/// A world is read, or rejected with a place within the text.
///
/// # Panics
/// The property does not hold.
pub fn world(data: &[u8]) {
    let text = text(data);
    if let Err(error) = World::parse(&text) {
        assert!(!error.to_string().is_empty());
    }
}

/// A map of `map_server` (its `.yaml` text, a NUL and its picture) becomes the text of a world that
/// can be simulated, or is rejected with a place within the text.
///
/// # Panics
/// The property does not hold.
pub fn map(data: &[u8]) {
    let end = data.iter().position(|byte| *byte == 0).unwrap_or(data.len());
    let (yaml, picture) = (text(&data[..end]), data.get(end + 1..).unwrap_or_default());
    let named = World::map_picture(&yaml);
    match World::map_text("fuzzed", &yaml, picture) {
        Ok(written) => {
            assert!(named.is_ok(), "a map without a picture's name");
            let world = World::parse(&written).unwrap_or_else(|why| panic!("{why}\n{written}"));
            if let Err(why) = Simulation::new(&world, 0) {
                panic!("{why}\n{written}");
            }
        }
        Err(error) => {
            assert!(!error.message.is_empty());
            let span = error.span.unwrap_or(0..0);
            assert!(yaml.get(span).is_some(), "{}", error.message);
        }
    }
}

/// Scenarios of the shipped plans are checked: they belong to their plan and their times are in
/// order, or there are errors.
///
/// # Panics
/// The property does not hold.
pub fn scenario(data: &[u8]) {
    let text = text(data);
    let source = Source::new("plans/tests/fuzzed.afp", text.as_ref());
    let compiled = compile(&source, &toolboxes(), &plan_file);
    assert_eq!(compiled.graph.is_none(), compiled.diags.has_errors());
    assert_eq!(compiled.render(false).is_empty(), compiled.diags.is_empty());
    for scenario in &compiled.scenarios {
        belongs(scenario, &text);
    }
}

/// The text of a plan that scenarios may be for.
fn plan_file(path: &str) -> Result<String, String> {
    const PLANS: &[(&str, &str)] = &[
        ("plans/avoid_obstacle.afp", include_str!("../../plans/avoid_obstacle.afp")),
        ("plans/find_infrared.afp", include_str!("../../plans/find_infrared.afp")),
        ("plans/find_object.afp", include_str!("../../plans/find_object.afp")),
        ("plans/navigate_room.afp", include_str!("../../plans/navigate_room.afp")),
        ("plans/parts/boundary.afp", include_str!("../../plans/parts/boundary.afp")),
        ("plans/parts/explore.afp", include_str!("../../plans/parts/explore.afp")),
        ("plans/parts/go_to.afp", include_str!("../../plans/parts/go_to.afp")),
        ("plans/patrol.afp", include_str!("../../plans/patrol.afp")),
        ("plans/patterns.afp", include_str!("../../plans/patterns.afp")),
        ("plans/wall_following.afp", include_str!("../../plans/wall_following.afp")),
    ];
    let plan = PLANS.iter().find(|(name, _)| *name == path);
    plan.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "there is no such file".to_owned())
}

/// The properties of a scenario without errors.
fn belongs(scenario: &Scenario, text: &str) {
    let inside = |start: u32, end: u32| text.get(start as usize..end as usize).is_some();
    assert!(inside(scenario.span.start, scenario.span.end), "{}", scenario.name);
    assert!(scenario.stimuli.is_sorted_by_key(|stimulus| stimulus.at), "{:?}", scenario.stimuli);
    for stimulus in &scenario.stimuli {
        assert!(stimulus.at <= scenario.until, "{stimulus:?}");
        assert!(inside(stimulus.span.start, stimulus.span.end), "{stimulus:?}");
    }
    for expectation in &scenario.expectations {
        let Window { from, to } = expectation.window;
        // An expectation that counts from a moment may have no end.
        let last = expectation.from.map_or(scenario.until, |_| u64::MAX);
        assert!(from <= to && to <= last, "{expectation:?}");
        assert!(inside(expectation.span.start, expectation.span.end), "{expectation:?}");
    }
    let entries = scenario.graph.main().entries.len();
    for (entry, _) in &scenario.set {
        assert!(usize::from(*entry) < entries, "{:?}", scenario.set);
    }
}

/// An `afp.toml` is read; each error has a reason and a place.
///
/// # Panics
/// The property does not hold.
pub fn settings(data: &[u8]) {
    let text = text(data);
    for mistake in afp_project::read(&text).1 {
        let place = mistake.span.clone().and_then(|span| text.get(span));
        assert!(place.is_some(), "{mistake:?}");
        assert!(!mistake.message.is_empty());
    }
}

fn toolboxes() -> Toolboxes {
    afp_toolboxes::sources().collect()
}
