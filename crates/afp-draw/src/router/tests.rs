use super::gaps::Gaps;
use super::lines::Lines;
use super::{
    Axis, Bounds, CLEAR, Connector, Heading, PITCH, Point, Routes, bundles, route, route_within,
};

fn bounds((left, top): Point, (width, height): Point) -> Bounds {
    Bounds { left, top, right: left + width, bottom: top + height }
}

/// An edge from the middle of the lower border of a box to the upper border of another.
fn down(boxes: &[Bounds], from: usize, to: usize) -> Connector {
    let (one, two) = (boxes[from], boxes[to]);
    Connector {
        from,
        to,
        start: ((one.left + one.right) / 2.0, one.bottom),
        heading: Heading::Down,
        arrival: (two.left + 20.0, two.right - 20.0),
        tip: two.top,
        kind: "",
    }
}

/// Edges that leave a box side by side, every second one to the right.
fn connectors(boxes: &[Bounds], edges: &[(usize, usize)]) -> Vec<Connector> {
    let connector = |(index, (from, to)): (usize, &(usize, usize))| {
        let before = edges[..index].iter().filter(|other| other.0 == *from).count();
        let connector = down(boxes, *from, *to);
        if before % 2 == 1 {
            let start = (boxes[*from].right, boxes[*from].top + 20.0 * before as f64);
            return Connector { start, heading: Heading::Right, ..connector };
        }
        Connector {
            start: (connector.start.0 + 10.0 * before as f64, connector.start.1),
            ..connector
        }
    };
    edges.iter().enumerate().map(connector).collect()
}

fn routed(boxes: &[Bounds], edges: &[(usize, usize)]) -> Routes {
    route(boxes, &connectors(boxes, edges), &[])
}

/// Boxes in uneven rows, with random but reproducible edges.
fn sample(count: usize, seed: u64) -> (Vec<Bounds>, Vec<(usize, usize)>) {
    let mut state = seed;
    let mut next = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((state >> 33) % below) as usize
    };
    let boxes = (0..count).map(|index| {
        let (column, row) = (index % 5, index / 5);
        let (dx, dy) = (next(120) as f64, next(60) as f64);
        bounds(
            (column as f64 * 420.0 + dx, row as f64 * 320.0 + dy),
            (150.0 + next(100) as f64, 60.0 + next(80) as f64),
        )
    });
    let boxes = boxes.collect();
    let edges = (0..2 * count).map(|edge| (edge / 2, next(count as u64))).collect();
    (boxes, edges)
}

/// The straight parts of an edge: whether vertical, the coordinate across, the range.
fn parts(points: &[Point]) -> Vec<(bool, f64, f64, f64)> {
    let part = |pair: &[Point]| {
        let (a, b) = (pair[0], pair[1]);
        let upright = (a.0 - b.0).abs() < (a.1 - b.1).abs();
        let (at, one, two, slant) =
            if upright { (a.0, a.1, b.1, a.0 - b.0) } else { (a.1, a.0, b.0, a.1 - b.1) };
        assert!(slant.abs() < 1e-6, "{a:?} {b:?} is slanted");
        (upright, at, one.min(two), one.max(two))
    };
    points.windows(2).map(part).collect()
}

/// A box that an edge crosses.
fn met<'b>(corners: &[Point], boxes: &'b [Bounds]) -> Option<&'b Bounds> {
    let through = |each: &&Bounds| {
        parts(corners).into_iter().any(|(upright, at, from, to)| {
            let inside = |low: f64, high: f64| low + 0.5 < at && at < high - 0.5;
            let over = |low: f64, high: f64| from < high - 0.5 && low + 0.5 < to;
            match upright {
                true => inside(each.left, each.right) && over(each.top, each.bottom),
                false => inside(each.top, each.bottom) && over(each.left, each.right),
            }
        })
    };
    boxes.iter().find(through)
}

#[test]
fn a_box_below_is_reached_straight() {
    let boxes = [bounds((0.0, 0.0), (100.0, 50.0)), bounds((10.0, 120.0), (100.0, 50.0))];
    assert_eq!(routed(&boxes, &[(0, 1)]).corners, [vec![(50.0, 50.0), (50.0, 120.0)]]);
}

#[test]
fn an_edge_to_its_own_box_goes_around_it() {
    let boxes = [bounds((0.0, 0.0), (100.0, 50.0))];
    let found = routed(&boxes, &[(0, 0)]);
    let [corners] = found.corners.as_slice() else { panic!("{found:?}") };
    assert_eq!(corners.len(), 6);
    assert!(corners[2].0 <= -CLEAR || corners[2].0 >= 100.0 + CLEAR, "{corners:?}");
}

#[test]
fn edges_between_boxes_touch_neither_boxes_nor_each_other() {
    for seed in 1..=12 {
        let (boxes, edges) = sample(25, seed);
        let found = routed(&boxes, &edges);
        let bundles = bundles(edges.iter().map(|(from, to)| (*from, *to, "")));
        for (edge, corners) in found.corners.iter().enumerate() {
            assert_eq!(met(corners, &boxes), None, "{corners:?}");
            // Edges of one bundle share a line after they meet.
            let apart = |other: &usize| bundles[edge].is_none() || bundles[edge] != bundles[*other];
            for other in (0..edge).filter(apart) {
                let others = &found.corners[other];
                let near = if edges[edge].1 == edges[other].1 { 120.0 } else { 5.0 };
                for a in parts(corners) {
                    for b in parts(others) {
                        let common = a.3.min(b.3) - a.2.max(b.2);
                        let on_top = a.0 == b.0 && (a.1 - b.1).abs() < 5.0 && common > near;
                        assert!(!on_top, "{seed}: {corners:?} runs on {others:?}");
                    }
                }
            }
        }
    }
}

/// Forty parallel lines were once indistinguishable, and each took a search across all others.
#[test]
fn many_edges_to_one_box_merge_where_they_meet() {
    let column = |index: usize| bounds((index as f64 * 0.04, index as f64 * 100.0), (120.0, 60.0));
    let boxes: Vec<_> = (0..41).map(column).collect();
    let edges: Vec<_> = (0..40).map(|from| (from, 40)).collect();
    let found = routed(&boxes, &edges);
    let mut tips: Vec<_> = found.corners.iter().filter_map(|corners| corners.last()).collect();
    tips.sort_by(|a, b| a.0.total_cmp(&b.0));
    tips.dedup();
    assert!(tips.len() <= 2, "{tips:?}");
    let mut uprights = Vec::new();
    for (edge, corners) in found.corners.iter().enumerate() {
        assert_eq!(corners[0], connectors(&boxes, &edges)[edge].start);
        for pair in corners.windows(2) {
            let (dx, dy) = ((pair[0].0 - pair[1].0).abs(), (pair[0].1 - pair[1].1).abs());
            assert!(dx < 0.05 || dy < 0.05, "{corners:?} is not right-angled");
            if dy > 150.0 {
                uprights.push(pair[0].0);
            }
        }
    }
    uprights.sort_by(f64::total_cmp);
    uprights.dedup_by(|a, b| (*a - *b).abs() < 0.5);
    assert!(uprights.len() <= 3, "one trunk, not {uprights:?}");
}

#[test]
fn nested_edges_do_not_cross() {
    let top = |x: f64| bounds((x, 0.0), (100.0, 40.0));
    let below = |x: f64| bounds((x, 200.0), (100.0, 40.0));
    let boxes = [top(0.0), top(200.0), top(400.0), below(600.0), below(800.0), below(1000.0)];
    let found = routed(&boxes, &[(0, 3), (1, 4), (2, 5)]);
    let levels: Vec<_> = found.corners.iter().map(|corners| corners[1].1).collect();
    assert!(levels.windows(2).all(|pair| pair[0] - pair[1] > PITCH - 1e-6), "{levels:?}");
}

#[test]
fn kept_routes_stay_and_others_go_around_them() {
    let (boxes, edges) = sample(20, 3);
    let connectors = connectors(&boxes, &edges);
    let all = route(&boxes, &connectors, &[]);
    let kept: Vec<_> = all.corners.iter().cloned().map(Some).collect();
    assert_eq!(route(&boxes, &connectors, &kept).corners, all.corners);
    let mut some = kept;
    for edge in (0..some.len()).step_by(7) {
        some[edge] = None;
    }
    let again = route(&boxes, &connectors, &some);
    for (edge, corners) in again.corners.iter().enumerate() {
        match &some[edge] {
            Some(kept) => assert_eq!(corners, kept),
            None => assert!(corners.len() >= 2),
        }
    }
}

/// Each of them once counted separately up to its tip, and nothing crossed the merged edges.
#[test]
fn a_kept_bundle_is_crossed_as_one_edge() {
    let column = |index: usize| bounds((0.0, index as f64 * 100.0), (120.0, 60.0));
    let mut boxes: Vec<_> = (0..81).map(column).collect();
    boxes.extend([bounds((-400.0, 7600.0), (120.0, 60.0)), bounds((500.0, 7750.0), (120.0, 60.0))]);
    let mut edges: Vec<_> = (0..80).map(|from| (from, 80)).collect();
    edges.push((81, 82));
    let connectors = connectors(&boxes, &edges);
    let all = route(&boxes, &connectors, &[]);
    let mut kept: Vec<_> = all.corners.iter().cloned().map(Some).collect();
    kept[80] = None;
    let length = |corners: &[Point]| parts(corners).iter().map(|part| part.3 - part.2).sum::<f64>();
    let (first, again) =
        (length(&all.corners[80]), length(&route(&boxes, &connectors, &kept).corners[80]));
    assert!(again < first + 100.0, "{again} px around what was {first} px");
}

/// All reachable nodes were once searched first.
#[test]
fn an_edge_to_a_covered_box_takes_no_search() {
    let (mut boxes, _) = sample(25, 5);
    let (left, top) = (boxes[12].left - 50.0, boxes[12].top - 50.0);
    boxes.push(bounds((left, top), (400.0, 60.0)));
    let found = routed(&boxes, &[(0, 12)]);
    assert_eq!((found.effort, found.corners[0].last().map(|tip| tip.1)), (0, Some(boxes[12].top)));
}

#[test]
fn kept_edges_fill_gaps_like_laid_edges() {
    for seed in 1..=6 {
        let (boxes, edges) = sample(25, seed);
        let routes = vec![routed(&boxes, &edges).corners; 12].concat();
        for axis in [Axis::Upright, Axis::Level] {
            let (mut kept, mut laid) =
                (Gaps::new(&boxes, axis, &routes), Gaps::new(&boxes, axis, &[]));
            let parts = routes.iter().flat_map(|points| points.windows(2));
            for pair in parts.filter(|pair| Axis::of(pair[0], pair[1]) == axis) {
                let (at, span) = axis.part(pair[0], pair[1]);
                laid.take(at, span, 1);
            }
            let excess =
                |gaps: &mut Gaps| (0..gaps.len()).map(|gap| gaps.excess(gap)).collect::<Vec<_>>();
            let (kept, laid) = (excess(&mut kept), excess(&mut laid));
            assert_eq!(kept, laid);
            assert!(laid.iter().any(|excess| *excess > 0), "none is full");
        }
    }
}

/// Positions of a layout file may be anything; memory once grew with their differences.
#[test]
fn boxes_far_from_each_other_need_no_more_memory() {
    for far in [100_000.0, 2_000_000_000.0] {
        let boxes = [
            bounds((0.0, 0.0), (100.0, 50.0)),
            bounds((far, far), (100.0, 50.0)),
            bounds((-far, far), (100.0, 50.0)),
        ];
        let found = routed(&boxes, &[(0, 1), (1, 2), (2, 0), (0, 2)]);
        assert!(found.corners.iter().all(|corners| corners.len() >= 4), "{found:?}");
    }
}

#[test]
fn boxes_on_top_of_each_other_still_have_edges() {
    let boxes = [bounds((0.0, 0.0), (100.0, 50.0)); 3];
    let found = routed(&boxes, &[(0, 1), (1, 2), (2, 2)]);
    for corners in &found.corners {
        assert_eq!(corners.first(), Some(&(50.0, 50.0)));
        assert_eq!(corners.last().map(|tip| tip.1), Some(0.0));
        parts(corners);
    }
}

/// A thousand exits next to a thousand boxes once took gigabytes.
#[test]
fn edges_with_too_many_lines_are_routed_in_parts() {
    for seed in 1..=4 {
        let (boxes, edges) = sample(25, seed);
        let connectors = connectors(&boxes, &edges);
        let inflated: Vec<_> = boxes.iter().map(Bounds::inflated).collect();
        let nodes = |searched: &[usize], most: u32| {
            let lines = Lines::new(&inflated, &connectors, searched, std::iter::empty(), most);
            lines.map(|lines| u32::try_from(lines.positions.len()).unwrap())
        };
        let all: Vec<_> = (0..connectors.len()).collect();
        let whole = nodes(&all, u32::MAX).unwrap();
        let half = nodes(&all[..all.len() / 2], u32::MAX).unwrap();
        assert_eq!(nodes(&all, (whole + half) / 2), None);
        let found = route_within((whole + half) / 2, &boxes, &connectors, &[]);
        for (corners, connector) in found.corners.iter().zip(&connectors) {
            assert_eq!(corners[0], connector.start);
            assert_eq!(corners[corners.len() - 1].1, connector.tip);
            assert_eq!(met(corners, &boxes), None, "{seed}: {corners:?}");
        }
        // The boxes have more lines than that.
        let found = route_within(100, &boxes, &connectors, &[]);
        for (corners, connector) in found.corners.iter().zip(&connectors) {
            assert_eq!(
                (corners[0], corners[corners.len() - 1].1),
                (connector.start, connector.tip)
            );
        }
    }
}
