//! Tests of whole drawings: parts do not overlap.

use super::sample::{
    EVERY_PART, WALL_FOLLOWING, afp_files, compiled, compiled_with, generated, is_toolbox,
};
use super::scene::{Drawn, Scene};
use super::sketch::{Arrow, Frame, Rect, Shape, Sketch, Tip};
use super::usage::Use;
use super::{Count, Options, PlanUsage, Theme, Usage, svg};
use crate::layout_file::Layout;
use afp_dsl::Compiled;
use afp_dsl::outline::{Outline, Part};
use afp_dsl::toolbox::Toolbox;
use afp_syntax::item::Item;
use afp_syntax::source::Source;

/// Lines within this distance look like one.
const APART: f64 = 5.0;

/// The maximum distance from its tip at which an edge may share a line with another edge to the
/// same box.
const NEAR_TIP: f64 = 120.0;

#[test]
fn nothing_overlaps_in_the_shipped_plans() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let files =
        [format!("{root}/plans"), format!("{root}/examples")].map(|folder| afp_files(&folder));
    let sources = files
        .concat()
        .into_iter()
        .map(|file| Source::new(file.to_str().unwrap(), std::fs::read_to_string(&file).unwrap()));
    let (toolboxes, plans): (Vec<_>, Vec<_>) = sources.partition(|file| is_toolbox(&file.text));
    let toolboxes: Vec<_> = toolboxes.into_iter().map(|file| file.text).collect();
    assert!(plans.len() >= 2, "plans have moved");
    for plan in plans {
        println!("{}", plan.name);
        check_all(&compiled_with(&plan, &toolboxes));
    }
}

#[test]
fn nothing_overlaps_with_sub_plans_and_every_kind_of_edge() {
    check_all(&compiled(EVERY_PART));
}

#[test]
fn nothing_overlaps_in_a_plan_of_sixty_elements() {
    check_all(&compiled(&generated(60, 1)));
}

#[test]
fn plans_with_random_edges_are_as_wide_as_a_screen() {
    for (count, seed) in [(60, 1), (60, 2), (120, 3), (200, 4)] {
        let scene =
            Scene::new(&compiled(&generated(count, seed)).outline, &Options::default(), None);
        let bounds = scene.plans[0].bounds;
        let ratio = bounds.width / bounds.height;
        assert!((0.5..=2.0).contains(&ratio), "{count} elements, seed {seed}: {ratio:.2}");
    }
}

#[test]
fn nothing_overlaps_in_plans_of_thirty_elements() {
    for seed in 1..=3 {
        check(&compiled(&generated(30, seed)), &Options::default());
    }
}

#[test]
fn nothing_overlaps_in_many_small_plans() {
    for seed in 1..=30 {
        check(&compiled(&generated(1 + seed % 9, seed)), &Options::default());
    }
}

/// Folded and unfolded, with and without data.
fn check_all(compiled: &Compiled) {
    for (sub_plans, data) in [(true, true), (true, false), (false, true), (false, false)] {
        println!("sub-plans: {sub_plans}, data: {data}");
        check(compiled, &Options { sub_plans, data, ..Options::default() });
    }
}

#[test]
fn placed_elements_stay_and_the_rest_goes_around_them() {
    let plan = compiled(WALL_FOLLOWING);
    let from_collision_to_wall = |text: &str| {
        let (positions, errors) = Layout::read(text);
        assert_eq!(errors, []);
        let positions = in_every_file(&plan, positions);
        let options = Options { positions: &positions, ..Options::default() };
        check(&plan, &options);
        let (sketch, _) = sketch(&plan.outline, &options);
        let place = |name| sketch.labels.iter().find(|label| label.text == name).unwrap();
        let (one, two) = (place("backupCollision"), place("followWall"));
        (two.x - one.x, two.y - one.y)
    };
    let one = "WallFollowing.backupCollision 1100 60\nWallFollowing.followWall 0 700\n";
    let two = "WallFollowing.backupCollision 1100 60\nWallFollowing.followWall -30 720\n";
    let (one, two) = (from_collision_to_wall(one), from_collision_to_wall(two));
    assert!((two.0 - one.0 + 30.0).abs() < 1e-6, "{one:?} {two:?}");
    assert!((two.1 - one.1 - 20.0).abs() < 1e-6, "{one:?} {two:?}");
}

#[test]
fn edges_are_routed_between_boxes_at_any_places() {
    for seed in 1..=6_u64 {
        let (count, plan) = (7 + seed, compiled(&generated(7 + seed, seed)));
        let line = |index: u64| {
            let place = (index + 3 * seed) % count;
            let (column, row) = (place % 4, place / 4);
            format!("Generated.element{index} {} {}\n", column * 900, row * 500)
        };
        // In every second seed, one element in three has an automatic place.
        let kept = (0..count).filter(|index| seed % 2 == 0 || index % 3 != 0);
        let (positions, _) = Layout::read(&kept.map(line).collect::<String>());
        let positions = in_every_file(&plan, positions);
        check(&plan, &Options { positions: &positions, ..Options::default() });
    }
}

#[test]
fn usage_is_shown_by_classes_and_numbers() {
    let compiled = compiled(EVERY_PART);
    let graph = compiled.graph.as_ref().unwrap();
    let count = |outcomes: usize, times: u64| Count {
        starts: times,
        outcomes: (0..outcomes as u64).map(|place| times.min(place * 12)).collect(),
        ..Count::default()
    };
    let plans = graph.plans.iter().map(|plan| PlanUsage {
        plan: plan.span,
        elements: (0..).zip(&plan.elements).map(|(n, each)| count(each.states.len(), n)).collect(),
        supervisors: plan.supervisors.iter().map(|each| count(each.events.len(), 7)).collect(),
        entries: (0..plan.entries.len() as u64).collect(),
    });
    let usage = Usage { plans: plans.collect() };
    let options = Options { usage: Some(&usage), ..Options::default() };
    check(&compiled, &options);
    let picture = svg(&compiled.outline, &options);
    for class in ["actor unused", "partly", "flow state unused", "error unused", "missed unused"] {
        assert!(picture.contains(class), "no {class}");
    }
    for text in ["· never", "×1", "used, but not all of its exits", "prefers-color-scheme:dark"] {
        assert!(picture.contains(text), "no {text}");
    }
    for plan in Drawn::new(&compiled.outline, &options, None).plans {
        let edges = plan.edges.iter().map(|edge| edge.class.usage != Some(Use::Never));
        assert!(edges.is_sorted(), "used parts are on top");
    }
    let plain = svg(&compiled.outline, &Options::default());
    assert!(!plain.contains("unused") && !plain.contains('×'), "a plain drawing counts nothing");
}

/// All parts of the drawing, and the size of the picture.
fn sketch<'a>(outline: &'a Outline, options: &'a Options<'a>) -> (Sketch<'a>, (f64, f64)) {
    let drawn = Drawn::new(outline, options, None);
    let mut all = Sketch::default();
    for plan in drawn.plans {
        all.add(plan.sketch(), (0.0, 0.0));
    }
    if let Some((legend, at)) = drawn.legend {
        all.add(legend, at);
    }
    (all, drawn.size)
}

fn in_every_file(compiled: &Compiled, positions: Layout) -> Vec<Layout> {
    vec![positions; compiled.sources.len()]
}

fn check(compiled: &Compiled, options: &Options) {
    let (sketch, size) = sketch(&compiled.outline, options);
    boxes_are_apart(&sketch, size);
    labels_are_apart(&sketch);
    arrows_keep_away_from_boxes(&sketch);
    arrows_do_not_run_on_each_other(&sketch);
}

/// Whether two rectangles share more than a border.
fn overlap(a: &Rect, b: &Rect) -> bool {
    a.x + 0.1 < b.right()
        && b.x + 0.1 < a.right()
        && a.y + 0.1 < b.bottom()
        && b.y + 0.1 < a.bottom()
}

/// Exits are on the borders of their boxes; all other parts are separate.
fn boxes_are_apart(sketch: &Sketch, (width, height): (f64, f64)) {
    let is_exit = |class| ["state", "event", "error", "missed"].contains(&class);
    for (place, one) in sketch.frames.iter().enumerate() {
        let inside = Rect { x: 0.0, y: 0.0, width, height };
        assert!(one.rect.x > 0.0 && one.rect.right() < inside.right(), "{one:?} leaves the page");
        assert!(one.rect.y > 0.0 && one.rect.bottom() < inside.bottom(), "{one:?} leaves the page");
        for two in &sketch.frames[..place] {
            let nested = two.class.name == "configuration" && one.class.name == "entry";
            let attached = is_exit(one.class.name) != is_exit(two.class.name);
            // The spine of supervisors is inside their element.
            let hangs = one.class.name == "spine" || two.class.name == "spine";
            let apart = nested || hangs || attached || !overlap(&one.rect, &two.rect);
            assert!(apart, "{one:?} covers {two:?}");
        }
    }
}

fn labels_are_apart(sketch: &Sketch) {
    for (place, one) in sketch.labels.iter().enumerate() {
        for two in &sketch.labels[..place] {
            assert!(!overlap(&one.rect(), &two.rect()), "{one:?} covers {two:?}");
        }
        // A label that touches a box is completely inside it.
        let rect = one.rect();
        let touching = sketch.frames.iter().filter(|frame| overlap(&frame.rect, &rect));
        let touching: Vec<_> = touching.collect();
        let held = touching.iter().any(|frame| {
            let frame = frame.rect;
            frame.x <= rect.x
                && rect.right() <= frame.right()
                && frame.y <= rect.y
                && rect.bottom() <= frame.bottom()
        });
        assert!(held || touching.is_empty(), "{one:?} sticks out of {touching:?}");
    }
}

/// The straight parts of an arrow as thin rectangles.
fn parts(arrow: &Arrow) -> Vec<Rect> {
    let part = |pair: &[(f64, f64)]| {
        let ((ax, ay), (bx, by)) = (pair[0], pair[1]);
        Rect { x: ax.min(bx), y: ay.min(by), width: (ax - bx).abs(), height: (ay - by).abs() }
    };
    arrow.points.windows(2).map(part).collect()
}

/// Thick arrows touch boxes only with their ends; horizontal starts are under their exit.
fn arrows_keep_away_from_boxes(sketch: &Sketch) {
    for arrow in sketch.arrows.iter().filter(|arrow| arrow.is_flow()) {
        for part in parts(arrow) {
            for frame in &sketch.frames {
                let rect = Rect {
                    x: frame.rect.x + 1.0,
                    y: frame.rect.y + 1.0,
                    width: frame.rect.width - 2.0,
                    height: frame.rect.height - 2.0,
                };
                let grown =
                    Rect { width: part.width.max(0.2), height: part.height.max(0.2), ..part };
                assert!(!overlap(&grown, &rect), "{arrow:?} runs through {frame:?}");
            }
            assert!(part.width < 0.5 || part.height < 0.5, "{arrow:?} is slanted");
        }
    }
}

fn arrows_do_not_run_on_each_other(sketch: &Sketch) {
    let thick: Vec<_> = sketch.arrows.iter().filter(|arrow| arrow.is_flow()).collect();
    for (place, one) in thick.iter().enumerate() {
        for two in &thick[..place] {
            for (a, b) in
                parts(one).iter().flat_map(|a| parts(two).into_iter().map(move |b| (*a, b)))
            {
                let shared = run_on_each_other(&a, &b);
                let near = same_tip(one, two) && (shared < NEAR_TIP || are_one(one, two));
                assert!(shared < APART || near, "{one:?} runs on {two:?}");
            }
        }
    }
}

/// Whether two edges lead to the same box, where they may merge.
fn same_tip(one: &Arrow, two: &Arrow) -> bool {
    let (Some(a), Some(b)) = (one.points.last(), two.points.last()) else { return false };
    (a.1 - b.1).abs() < 0.5 && (a.0 - b.0).abs() < APART
}

/// Whether two edges of one kind have merged and end in one tip.
fn are_one(one: &Arrow, two: &Arrow) -> bool {
    one.class.name == two.class.name && one.points.last() == two.points.last()
}

/// The length on which two parallel lines are too near to each other.
fn run_on_each_other(a: &Rect, b: &Rect) -> f64 {
    let vertical = |part: &Rect| part.width < 0.5 && part.height >= 0.5;
    let horizontal = |part: &Rect| part.height < 0.5 && part.width >= 0.5;
    let common = |a: (f64, f64), b: (f64, f64)| (a.0 + a.1).min(b.0 + b.1) - a.0.max(b.0);
    if vertical(a) && vertical(b) && (a.x - b.x).abs() < APART {
        common((a.y, a.height), (b.y, b.height))
    } else if horizontal(a) && horizontal(b) && (a.y - b.y).abs() < APART {
        common((a.x, a.width), (b.x, b.width))
    } else {
        0.0
    }
}

#[test]
fn every_kind_of_part_has_its_symbol() {
    let compiled = compiled(EVERY_PART);
    let options = Options::default();
    let (sketch, _) = sketch(&compiled.outline, &options);
    for class in [
        "start",
        "actor",
        "computation",
        "subplan",
        "supervisor",
        "configuration",
        "entry",
        "formula",
        "state",
        "event",
        "error",
        "missed",
        "terminate",
        "ignore",
    ] {
        assert!(sketch.frames.iter().any(|frame| frame.class.name == class), "no {class}");
    }
    let shape =
        |class: &str| sketch.frames.iter().find(|frame| frame.class.name == class).unwrap().shape;
    assert!(matches!(shape("actor"), Shape::Round(_)));
    assert!(matches!(shape("computation"), Shape::Cut(_)));
    assert!(matches!(shape("subplan"), Shape::Double(_)));
    for text in ["Square", "Avoid", "-side / 4", "2 * side + 5 cm", "OK", "DeadlineMissed"] {
        assert!(sketch.labels.iter().any(|label| label.text == text), "no label '{text}'");
    }
}

/// It once had a tag like `terminate`.
#[test]
fn a_resuming_event_is_a_hollow_arrow_back_to_its_own_box() {
    let compiled = compiled(RESUMING);
    check_all(&compiled);
    let options = Options::default();
    let (sketch, _) = sketch(&compiled.outline, &options);
    let back: Vec<_> = sketch.arrows.iter().filter(|arrow| arrow.tip == Tip::Hollow).collect();
    assert_eq!(back.len(), 5);
    for arrow in back {
        let (start, tip) = (arrow.points[0], *arrow.points.last().unwrap());
        let is_exit = |frame: &&Frame| frame.class.name == arrow.class.name;
        let near = |frame: &&Frame, (x, y): (f64, f64), by: f64| {
            let Rect { x: left, y: top, .. } = frame.rect;
            let (right, bottom) = (frame.rect.right(), frame.rect.bottom());
            left - by < x && x < right + by && top - by < y && y < bottom + by
        };
        let exit = sketch.frames.iter().filter(is_exit).find(|frame| near(frame, start, 0.1));
        let exit = exit.unwrap_or_else(|| panic!("{arrow:?} leaves no exit"));
        let own = sketch.frames.iter().find(|frame| {
            ["supervisor", "computation", "reactions"].contains(&frame.class.name)
                && near(frame, tip, 0.1)
                && overlap(&frame.rect, &exit.rect)
        });
        assert!(own.is_some(), "{arrow:?} does not lead back");
    }
    assert!(sketch.frames.iter().all(|frame| frame.class.name != "resume"));
    let words = sketch.labels.iter().filter(|label| label.class.name == "resume");
    assert_eq!(words.filter(|label| label.text == "Resume").count(), 5);
    let picture = svg(&compiled.outline, &options);
    assert_eq!(picture.matches("class=\"flow hollow ").count(), 5);
}

const RESUMING: &str = "use std\nuse carbot\nplan P {\nvar n: int = 0\nin far: length = 1 m\nstart go\n\
    supervise touch: CheckTouchSensor { TouchSensorPressed -> resume }\n\
    actor go: Forward(distance = far) {\n\
    supervise near: CheckValue(value = far, limit = 1 m) { Above -> resume Below -> again DeadlineMissed -> resume }\n\
    supervise flag: CheckEscapeButton { EscapeButtonPressed -> resume }\n\
    ForwardSuccessful -> go }\n\
    computation again: Count(value = n, limit = 3, next => n) { Again -> resume Done -> terminate }\n}\n";

#[test]
fn a_folded_box_hides_its_details_and_keeps_its_targets() {
    for text in [EVERY_PART, WALL_FOLLOWING, RESUMING] {
        let compiled = compiled(text);
        let plan = compiled.outline.plan(compiled.outline.main.unwrap());
        let start = Item::inner(plan.item.name(), "start");
        let all: Vec<_> = plan.elements.iter().map(|it| it.item.clone()).chain([start]).collect();
        let options = Options { sub_plans: false, ..Options::default() };
        let folded = Options { folded: &all, ..options };
        check(&compiled, &folded);
        let [open, shut] = [&options, &folded].map(|it| Scene::new(&compiled.outline, it, None));
        let edges = |scene: &Scene| {
            let mut all: Vec<_> = (scene.plans[0].edges.iter())
                .map(|edge| (edge.item.clone(), format!("{:?}", edge.part), edge.to.clone()))
                .collect();
            all.sort();
            all
        };
        assert_eq!(edges(&open), edges(&shut));
        // Each supervisor has the place of its tab, so that the marks of a run find it.
        let pieces = |scene: &Scene| -> Vec<_> {
            let pieces = scene.plans[0].elements.iter().flat_map(|each| each.pieces.clone());
            let mut all: Vec<_> =
                pieces.filter(|it| it.part == Part::Whole).map(|it| it.item).collect();
            all.retain(|item| plan.entries.iter().all(|entry| entry.item != *item));
            all.sort();
            all
        };
        assert_eq!(pieces(&open), pieces(&shut));
        let area = |scene: &Scene| {
            let outer = scene.plans[0].elements.iter().map(|each| each.outer);
            outer.map(|it| it.width * it.height).sum::<f64>()
        };
        assert!(area(&shut) < 0.8 * area(&open), "{} of {}", area(&shut), area(&open));
        assert!(!svg(&compiled.outline, &folded).contains(r#"class="port""#));
    }
}

#[test]
fn sub_plans_are_optional() {
    let outline = compiled(EVERY_PART).outline;
    let with = svg(&outline, &Options::default());
    let without = svg(&outline, &Options { sub_plans: false, ..Options::default() });
    assert!(with.contains(">away</text>") && !without.contains(">away</text>"));
}

#[test]
fn a_picture_is_reproducible_and_loads_nothing() {
    let icons = |_: &Toolbox, name: &str| afp_toolboxes::icon(name).map(str::to_owned);
    let options = Options { icons: Some(&icons), ..Options::default() };
    let picture = |text| svg(&compiled(text).outline, &options);
    let text = picture(WALL_FOLLOWING);
    assert_eq!(text, picture(WALL_FOLLOWING));
    assert_eq!(text.matches("http").count(), 1, "only the name space");
    assert!(!text.contains("url(") && !text.contains("style="));
    let (uses, ids) = (text.matches("href=\"#afp-"), text.matches(" id=\"afp-"));
    assert!(uses.count() > ids.count(), "icons are there once");
    assert!(text.contains(r#"<path d="M12 21V4"/>"#), "the icon of 'Forward'");
}

#[test]
fn themes_differ_in_colours_only() {
    let outline = compiled(WALL_FOLLOWING).outline;
    let of = |theme| svg(&outline, &Options { theme, ..Options::default() });
    let (auto, light, dark) = (of(Theme::Auto), of(Theme::Light), of(Theme::Dark));
    assert!(auto.contains("prefers-color-scheme:dark"));
    assert!(!light.contains("prefers-color-scheme") && !dark.contains("prefers-color-scheme"));
    let body = |text: &str| text.split("</style>").nth(1).map(str::to_owned);
    assert_eq!(body(&light), body(&dark));
    assert_ne!(light, dark);
}

#[test]
fn texts_of_plans_cannot_break_the_picture() {
    let text = "use std\nplan P {\nstart log\n\
                computation log: Log(value = \"</text><script>&\") { Done -> terminate }\n}\n";
    let picture = svg(&compiled(text).outline, &Options::default());
    assert!(!picture.contains("<script"));
    assert!(picture.contains("&lt;script&gt;&amp;"));
}
