use std::path::Path;
use std::sync::Arc;

use super::{Arrow, Boxes, EdgeScene, Scene, paint};
use crate::layout_file::{Layout, Position};
use crate::sample::{WALL_FOLLOWING, afp_files, compiled, generated, is_toolbox};
use crate::{Options, dot, json, picture, svg};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::{Compiled, compile};
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;
use afp_syntax::source::Source;

mod edges;

fn whatever(text: &str) -> Compiled {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    compile(&Source::new("sample.afp", text), &toolboxes, &Texts::default())
}

fn scene(text: &str, before: Option<&Scene>) -> Scene {
    Scene::new(&whatever(text).outline, &Options::default(), before)
}

/// The texts of the shipped plans.
fn shipped() -> Vec<String> {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let files = ["plans", "examples"].map(|folder| afp_files(&format!("{root}/{folder}")));
    let text = |file: &Path| std::fs::read_to_string(file).unwrap();
    let texts = files.concat().into_iter().map(|file| text(&file));
    let plans = texts.filter(|text| text.contains("plan ") && !is_toolbox(text));
    let plans: Vec<_> = plans.filter(|text| !text.contains("\nscenario ")).collect();
    assert!(plans.len() >= 3, "plans have moved");
    plans
}

#[test]
fn every_part_has_its_identity() {
    let scene = scene(WALL_FOLLOWING, None);
    let [plan] = scene.plans.as_slice() else { panic!("{}", scene.plans.len()) };
    let paths: Vec<_> = plan.elements.iter().map(|element| element.item.to_string()).collect();
    assert_eq!(paths[..2], ["WallFollowing.start", "WallFollowing.searchFirstWall"]);
    let touch = Item::local("WallFollowing", "searchFirstWall", "touch");
    let pieces: Vec<_> = plan.elements[1].pieces.iter().collect();
    assert!(pieces.iter().any(|piece| piece.item == touch), "the tab of a supervisor");
    let edge = plan.edges.iter().find(|edge| edge.item == touch).unwrap();
    assert_eq!(
        (edge.to.to_string().as_str(), edge.kind),
        ("WallFollowing.backupCollision", "event")
    );
    for element in &plan.elements {
        for piece in &element.pieces {
            assert!(piece.rect.x >= element.outer.x - 0.1, "{piece:?}");
            assert!(piece.rect.right() <= element.outer.right() + 0.1, "{piece:?}");
        }
        assert!(element.svg.starts_with("<g class=\"element\"") && element.svg.ends_with("</g>\n"));
        assert!(!element.svg.contains("style="), "{}", element.svg);
    }
}

#[test]
fn every_prefix_of_a_file_is_drawn() {
    // Every prefix would take minutes without optimisation; the first one differs from plan to
    // plan.
    let step = if std::env::var_os("AFP_BY_NIGHT").is_some() { 1 } else { 61 };
    for text in shipped() {
        let ends: Vec<_> = text.char_indices().map(|(end, _)| end).collect();
        for end in ends.iter().skip(text.len() % step).step_by(step) {
            let compiled = whatever(&text[..*end]);
            let options = Options { warnings: true, ..Options::default() };
            let scene = Scene::new(&compiled.outline, &options, None);
            let drawn: usize = scene.plans.iter().map(|plan| plan.elements.len() - 1).sum();
            let main = compiled.outline.main.map(|id| compiled.outline.plan(id).elements.len());
            assert!(drawn >= main.unwrap_or(0), "an element is missing in\n{}", &text[..*end]);
            assert!(picture(&scene, options.theme).ends_with("</svg>\n"));
        }
        let outline = whatever(&text[..text.len() / 2]).outline;
        assert!(!dot(&outline, &Options::default()).is_empty());
        assert!(!json(&outline, &Options::default()).is_empty());
    }
}

#[test]
fn errors_are_marked_at_their_places() {
    let text = "use carbot\nplan P {\n    start go\n    actor go: Forwrd(distance = 3 cm) {\n\
                Done -> nowhere\n    }\n    actor turn: Turn(angle = ) {\n    }\n}\n";
    let scene = scene(text, None);
    let wrong: Vec<_> = scene.plans[0]
        .elements
        .iter()
        .flat_map(|element| &element.pieces)
        .filter(|piece| piece.severity == Some(Severity::Error))
        .map(|piece| format!("{} {:?}", piece.item, piece.part))
        .collect();
    for expected in ["P.go Whole", "P.go Exit", "P.turn Whole"] {
        assert!(wrong.iter().any(|found| found.starts_with(expected)), "{expected}: {wrong:?}");
    }
    let picture = picture(&scene, crate::Theme::Light);
    for expected in ["icon wrong", ">nowhere</text>", ">Forwrd</text>", "box hole", "box open"] {
        assert!(picture.contains(expected), "no {expected} in {picture}");
    }
}

#[test]
fn a_file_without_a_plan_is_an_empty_drawing() {
    for text in ["", "use carbot\n", "}"] {
        let compiled = whatever(text);
        assert!(svg(&compiled.outline, &Options::default()).ends_with("</svg>\n"));
        assert!(Scene::new(&compiled.outline, &Options::default(), None).plans.is_empty());
    }
}

/// The text with an additional actor after an element: the element leads to it, and it leads to the
/// old target.
fn with_one_more(text: &str, scene: &Scene, index: usize) -> Option<String> {
    let edge = scene.plans[0].edges.iter().filter(|edge| edge.kind == "state").nth(index)?;
    let (from, to) = (edge.item.name(), edge.to.name());
    let start = text.find(&format!(" {from}:"))?;
    let arrow = start + text[start..].find(&format!("-> {to}"))?;
    let end = start + text[start..].find("\n    }").map(|at| at + 6)?;
    let fresh = format!(
        "\n    actor fresh: Turn(angle = 5 deg) {{\n        TurnSuccessful -> {to}\n    }}\n"
    );
    let mut changed = text.to_owned();
    changed.insert_str(end, &fresh);
    changed.replace_range(arrow..arrow + 3 + to.len(), "-> fresh");
    Some(changed)
}

/// The positions of all boxes after the first edit in a drawing.
fn written(text: &str) -> Layout {
    let (compiled, mut layout) = (whatever(text), Layout::default());
    boxes(&compiled, &layout).write(&mut layout);
    layout
}

fn boxes(compiled: &Compiled, layout: &Layout) -> Boxes {
    Boxes::new(&compiled.outline, compiled.plan_files.start as u16, layout, &[])
}

/// A scene with these positions.
fn placed(text: &str, positions: &Layout, before: Option<&Scene>) -> Scene {
    let compiled = whatever(text);
    let positions = vec![positions.clone(); compiled.sources.len()];
    let options = Options { positions: &positions, ..Options::default() };
    Scene::new(&compiled.outline, &options, before)
}

#[test]
fn a_new_actor_does_not_move_the_others() {
    let mut tried = 0;
    for text in shipped() {
        let (before, layout) = (scene(&text, None), written(&text));
        for place in 0..before.plans[0].edges.len() {
            let Some(changed) = with_one_more(&text, &before, place) else { continue };
            let after = placed(&changed, &layout, None);
            assert_eq!(moved(&before, &after), 0, "{changed}");
            assert_eq!(after.plans[0].elements.len(), before.plans[0].elements.len() + 1);
            tried += 1;
        }
    }
    assert!(tried >= 8, "{tried}");
}

/// The first edit and its undo once moved other boxes.
#[test]
fn writing_all_positions_does_not_change_the_drawing() {
    let plans = shipped().into_iter().chain([LOOP.to_owned(), generated(30, 5)]);
    for text in plans {
        let (automatic, written) = (scene(&text, None), placed(&text, &written(&text), None));
        let corners = |scene: &Scene| {
            let elements = scene.plans[0].elements.iter();
            elements.map(|one| (one.rect.x, one.rect.y)).collect::<Vec<_>>()
        };
        assert_eq!(corners(&automatic), corners(&written), "{text}");
        let pieces = |scene: &Scene| {
            let elements = scene.plans[0].elements.iter();
            elements.flat_map(|one| one.pieces.clone()).collect::<Vec<_>>()
        };
        assert_eq!(pieces(&automatic), pieces(&written), "{text}");
    }
}

/// A box that was moved once stayed there after an undo.
#[test]
fn a_scene_does_not_depend_on_the_one_before() {
    let large = generated(40, 3);
    for (text, less, item) in [
        (LOOP, LOOP.replace("Elapsed -> a, ", ""), Item::inner("P", "b")),
        (
            &large,
            large.replacen("-> element3", "-> element5", 1),
            Item::inner("Generated", "element7"),
        ),
    ] {
        let first = scene(text, None);
        let (all, mut moved) = (written(text), written(text));
        moved.set(item, Position { x: 900, y: 900 });
        let between = placed(text, &moved, Some(&first));
        for text in [text, &less] {
            for layout in [&all, &moved, &Layout::default()] {
                let fresh = placed(text, layout, None);
                for before in [&first, &between, &scene("", None)] {
                    assert_eq!(fragments(&placed(text, layout, Some(before))), fragments(&fresh));
                }
            }
        }
    }
}

/// The boxes that a change of a text lowered, by name with the distance.
fn lowered(before: &str, layout: &Layout, after: &str) -> Vec<(String, i32)> {
    let (old, new) = (whatever(before), whatever(after));
    let mut now = boxes(&new, layout);
    now.make_room(&boxes(&old, layout));
    let mut changed = layout.clone();
    now.write(&mut changed);
    let down = layout.iter().filter_map(|(item, was)| {
        let is = changed.get(item).unwrap();
        assert_eq!(was.x, is.x);
        (is != was).then(|| (item.name().to_owned(), is.y - was.y))
    });
    down.collect()
}

#[test]
fn a_growing_box_moves_down_only_covered_boxes() {
    let watched = "use carbot\nplan P {\n    start a\n    actor a: Forward { ForwardSuccessful -> b }\n    \
                   actor b: Forward { ForwardSuccessful -> c }\n    actor c: Forward { ForwardSuccessful -> \
                   terminate }\n    actor d: Forward {}\n}\n";
    let grown = watched
        .replace("actor a: Forward {", "actor a: Forward(distance = 3 cm, speed = 2 cm/s) {");
    let layout = Layout::read("P.start 0 0\nP.a 0 100\nP.b 0 230\nP.c 0 800\nP.d 900 130\n").0;
    let down = lowered(watched, &layout, &grown);
    assert!(matches!(&down[..], [(name, by)] if name == "b" && *by > 0), "{down:?}");
    // Boxes that a user has put on one another stay.
    let layout = Layout::read("P.start 0 0\nP.a 0 100\nP.b 0 130\nP.c 0 800\nP.d 900 130\n").0;
    assert_eq!(lowered(watched, &layout, &grown), []);
    assert_eq!(lowered(&grown, &layout, watched), []);
    // Covered boxes go down one after the other, as far as necessary.
    let layout = Layout::read("P.start 0 0\nP.a 0 100\nP.b 0 230\nP.c 0 340\nP.d 900 130\n").0;
    let down: Vec<_> =
        lowered(watched, &layout, &grown).into_iter().map(|(name, _)| name).collect();
    assert_eq!(down, ["b", "c"]);
}

/// The number of boxes that moved by more than 10 px.
fn moved(before: &Scene, after: &Scene) -> usize {
    let far = |known: &&super::ElementScene| {
        let now = after.plans[0].elements.iter().find(|element| element.item == known.item);
        now.is_none_or(|now| (now.rect.x - known.rect.x).hypot(now.rect.y - known.rect.y) > 10.0)
    };
    before.plans[0].elements.iter().filter(far).count()
}

/// A plan whose first element is watched, entered again and left for the end.
const LOOP: &str = "use std\n\nplan P {\n    start a\n\n    actor a: Wait(duration = 1 s) {\n        \
    Elapsed -> b\n\n        supervise bump: CheckTimeout(duration = 2 s) {\n            TimeUp -> back\n        \
    }\n    }\n    actor b: Wait(duration = 1 s) { Elapsed -> c }\n    actor c: Wait(duration = 1 s) { \
    Elapsed -> a, Error -> terminate }\n    actor back: Wait(duration = 1 s) { Elapsed -> b }\n}\n";

#[test]
fn a_new_box_is_at_the_nearest_free_place() {
    let before = scene(LOOP, None);
    // Before everything, in the place of the start tag, and between two rows.
    for (old, new, to) in [("start a", "start z", "a"), ("Elapsed -> c", "Elapsed -> z", "c")] {
        let text = LOOP.replace(old, new);
        let one = format!("\n    actor z: Wait(duration = 1 s) {{ Elapsed -> {to} }}\n}}\n");
        let after = placed(&text.replace("\n}\n", &one), &written(LOOP), None);
        let elements = &after.plans[0].elements;
        let rect = |name: &str| elements.iter().find(|one| one.item.name() == name).unwrap().rect;
        let lowest = elements.iter().map(|one| one.rect.bottom()).fold(0.0, f64::max);
        assert!(rect("z").bottom() < lowest, "{new}: {:?}", rect("z"));
        assert_eq!(moved(&before, &after), 0);
    }
}

#[test]
fn the_start_is_above_a_placed_first_element() {
    let simple = "use std\nplan P {\n    start a\n    actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n";
    let starts = |scene: &Scene| {
        let rect = |at: usize| scene.plans[0].elements[at].rect;
        (rect(1).x - rect(0).x, rect(1).y - rect(0).y)
    };
    for text in [simple, LOOP] {
        let automatic = starts(&scene(text, None));
        for (x, y) in [(24, 96), (0, 0), (24, 120), (300, 240), (-60, -36), (1200, 12)] {
            let compiled = whatever(text);
            let mut positions = Layout::default();
            positions.set(Item::inner("P", "a"), Position { x, y });
            let positions = vec![positions; compiled.sources.len()];
            let options = Options { positions: &positions, ..Options::default() };
            let (dx, dy) = starts(&Scene::new(&compiled.outline, &options, None));
            let same = (dx - automatic.0).abs() < 0.1 && (dy - automatic.1).abs() < 0.1;
            assert!(same, "{x} {y}: {dx} {dy}, not {automatic:?}");
        }
    }
}

#[test]
fn a_moved_box_takes_only_its_own_edges_along() {
    let text = generated(120, 5);
    let compiled = compiled(&text);
    let before = Scene::new(&compiled.outline, &Options::default(), None);
    let item = Item::inner("Generated", "element7");
    let place = before.plans[0].elements.iter().find(|element| element.item == item).unwrap().rect;
    let mut positions = written(&text);
    let (x, y) = (place.x as i32 + 36, place.y as i32 + 12);
    positions.set(item.clone(), Position { x, y });
    let after = placed(&text, &positions, Some(&before));
    let rect = after.plans[0].elements.iter().find(|element| element.item == item).unwrap().rect;
    assert_eq!((rect.x, rect.y), (f64::from(x), f64::from(y)));
    let same = |edge: &&EdgeScene| {
        let known = before.plans[0].edges.iter();
        known.into_iter().any(|old| old.points == edge.points && old.item == edge.item)
    };
    let edges = &after.plans[0].edges;
    let kept = edges.iter().filter(same).count();
    assert!(kept * 10 >= edges.len() * 8, "{kept} of {} routes stayed", edges.len());
    assert_eq!(moved(&before, &after), 1);
}

#[test]
fn placed_elements_keep_their_places_through_edits() {
    let text = WALL_FOLLOWING;
    let mut positions = Layout::default();
    let item = Item::inner("WallFollowing", "followWall");
    positions.set(item.clone(), Position { x: 700, y: 900 });
    let (mut state, mut changed) = (7_u64, text.to_owned());
    let mut before: Option<Scene> = None;
    let rounds = if std::env::var_os("AFP_BY_NIGHT").is_some() { 1000 } else { 250 };
    for round in 0..rounds {
        let mut next = |below: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % below
        };
        // One character less or more, and sometimes the whole text again.
        if round % 12 == 0 {
            changed = text.to_owned();
        }
        let at = next(changed.len() - 1);
        if next(2) == 0 {
            changed.remove(at);
        } else {
            changed.insert(at, ['x', '{', '}', ' ', '"', '/', '>'][next(7)]);
        }
        let compiled = whatever(&changed);
        let positions = vec![positions.clone(); compiled.sources.len()];
        let options = Options { positions: &positions, ..Options::default() };
        let scene = Scene::new(&compiled.outline, &options, before.as_ref());
        let mut elements = scene.plans.iter().flat_map(|plan| &plan.elements);
        if let Some(found) = elements.find(|element| element.item == item) {
            assert_eq!((found.rect.x, found.rect.y), (700.0, 900.0), "{changed}");
        }
        before = Some(scene);
    }
}

/// The contents of a scene, painted without a previous scene.
fn painted_anew(scene: &Scene) -> Vec<String> {
    let plans = || scene.plans.iter();
    let elements = plans().flat_map(|plan| &plan.elements);
    let elements =
        elements.map(|one| paint::element(&one.item, &one.content, (one.outer.x, one.outer.y)));
    let edges = plans().flat_map(|plan| &plan.edges).map(|one| {
        let arrow = Arrow { joined: one.joined, ..Arrow::flow(one.points.clone(), one.class) };
        paint::edge(&one.item, &one.part, &arrow)
    });
    elements.chain(edges).collect()
}

fn fragments(scene: &Scene) -> Vec<&str> {
    let plans = || scene.plans.iter();
    let elements = plans().flat_map(|plan| &plan.elements).map(|one| &*one.svg);
    elements.chain(plans().flat_map(|plan| &plan.edges).map(|one| &*one.svg)).collect()
}

#[test]
fn reused_fragments_equal_painted_fragments() {
    let mut before: Option<Scene> = None;
    for end in
        (0..WALL_FOLLOWING.len()).step_by(97).filter(|end| WALL_FOLLOWING.is_char_boundary(*end))
    {
        let compiled = whatever(&WALL_FOLLOWING[..end]);
        let options = Options { warnings: true, ..Options::default() };
        let scene = Scene::new(&compiled.outline, &options, before.as_ref());
        assert_eq!(fragments(&scene), painted_anew(&scene), "{}", &WALL_FOLLOWING[..end]);
        before = Some(scene);
    }
}

#[test]
fn only_changed_fragments_are_painted() {
    let text = generated(30, 5);
    let before = scene(&text, None);
    let after = scene(&text.replacen("30 cm", "31 cm", 1), Some(&before));
    let pairs = || before.plans[0].elements.iter().zip(&after.plans[0].elements);
    let painted = pairs().filter(|(one, other)| !Arc::ptr_eq(&one.content, &other.content));
    let differ = pairs().filter(|(one, other)| one.svg != other.svg);
    assert_eq!((painted.count(), differ.count()), (1, 1));
}

#[test]
fn a_changed_icon_is_painted() {
    let compiled = whatever(WALL_FOLLOWING);
    let with = |radius: u32, before| {
        let icon = format!("<svg viewBox=\"0 0 24 24\"><circle r=\"{radius}\"/></svg>");
        let icons = |_: &_, _: &str| Some(icon.clone());
        let options = Options { icons: Some(&icons), ..Options::default() };
        Scene::new(&compiled.outline, &options, before)
    };
    let before = with(1, None);
    let same = with(1, Some(&before));
    assert_eq!(fragments(&same), fragments(&before));
    let after = with(2, Some(&before));
    assert_ne!(after.symbols, before.symbols);
    for one in &after.plans[0].elements {
        let used = after.symbols.iter().filter(|symbol| one.svg.contains(&symbol.id));
        assert_eq!(one.svg.matches("<use ").count() > 0, used.count() > 0, "{}", one.svg);
    }
}
