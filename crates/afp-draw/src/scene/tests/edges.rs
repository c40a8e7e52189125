//! Edges are visible from their exit to their tip: none is behind a box, and none goes in through
//! an exit.

use super::{boxes, placed, scene, shipped, whatever};
use crate::layout_file::Layout;
use crate::sample::generated;
use crate::{PlanScene, Point, Rect};

/// The plan in which an edge once moved together with the edge that it continues, into a box.
const MOVED: u64 = 29;

/// The random plans of a normal run; nightly runs have more of them.
fn plans() -> impl Iterator<Item = String> {
    let count = if std::env::var_os("AFP_BY_NIGHT").is_some() { 500 } else { 12 };
    (1..=count).chain([MOVED]).map(|seed| generated(10 + seed * 7 % 51, seed))
}

fn check(plan: &PlanScene, text: &str) {
    for edge in &plan.edges {
        let name =
            format!("{} {:?} -> {} {:?} in\n{text}", edge.item, edge.part, edge.to, edge.points);
        let to = plan.elements.iter().find(|one| one.item == edge.to).unwrap().rect;
        let [.., before, tip] = edge.points[..] else { panic!("{name}") };
        assert!(before.1 < tip.1 && (tip.1 - to.y).abs() < 0.1, "not from above: {name}");
        assert!(to.x <= tip.0 && tip.0 <= to.right(), "beside its target: {name}");
        let length: f64 = edge.points.windows(2).map(length).sum();
        assert!(length > 12.0, "cannot be seen: {name}");
        let own = |item, part| item == &edge.item && part == &edge.part;
        let pieces = plan.elements.iter().flat_map(|one| &one.pieces);
        let pieces = pieces.filter(|piece| !own(&piece.item, &piece.part)).map(|piece| piece.rect);
        for rect in pieces.chain(plan.elements.iter().map(|one| one.rect)) {
            for pair in edge.points.windows(2) {
                assert!(!crosses(pair, &rect), "crosses {rect:?}: {name}");
            }
        }
    }
}

fn length(pair: &[Point]) -> f64 {
    (pair[0].0 - pair[1].0).abs() + (pair[0].1 - pair[1].1).abs()
}

/// Whether a straight part runs through a box; an end may be on its border.
fn crosses(pair: &[Point], rect: &Rect) -> bool {
    let ((a, b), (c, d)) = (pair[0], pair[1]);
    a.min(c) < rect.right() - 1.0
        && rect.x + 1.0 < a.max(c)
        && b.min(d) < rect.bottom() - 1.0
        && rect.y + 1.0 < b.max(d)
}

#[test]
fn edges_are_visible_in_the_shipped_plans_and_in_random_plans() {
    for text in shipped().into_iter().chain(plans()) {
        scene(&text, None).plans.iter().for_each(|plan| check(plan, &text));
    }
}

/// It once ran behind its own box.
#[test]
fn a_loop_goes_around_its_box() {
    let text = "use carbot\nplan P {\n    start a\n    actor a: Forward {\n        supervise touch: CheckTouchSensor \
                { TouchSensorPressed -> a }\n        ForwardSuccessful -> a\n    }\n}\n";
    let mut layout = Layout::default();
    for _ in 0..2 {
        let scene = placed(text, &layout, None);
        check(&scene.plans[0], text);
        boxes(&whatever(text), &layout).write(&mut layout);
    }
}
