//! The search for the next place to look around.

use crate::maps::grid::Grid;
use crate::maps::room::Room;
use crate::maps::search::{BESIDE, neighbours, weight};
use pathfinding::prelude::dijkstra_reach;

/// The side of the floor's squares, in metres, and their maximum number; a map with more of them
/// has larger squares.
const SQUARE: f64 = 0.3;
const MOST: f64 = 400.0;
/// Floor nearer to a wall than this is ignored, in metres.
const FLOOR: f32 = 0.1;
/// The relative value of floor that was already seen, again for each further time.
const AGAIN: f64 = 0.2;
/// The distance over which the value of a place falls by e, in metres.
const FAR: f64 = 10.0;

/// The next place to look around for a robot at `from` that has looked around there and at the
/// places `seen`, `sight` metres far. It is the place with the most newly visible floor, reduced by
/// the length of the path (González-Baños and Latombe, *Navigation strategies for exploring indoor
/// environments*, 2002). The robot has comfortable space to turn there, if possible. `None` if it
/// can reach no place.
pub(crate) fn best(grid: &Grid, from: [f64; 2], seen: &[[f64; 2]], sight: f64) -> Option<[f64; 2]> {
    let views = views(grid, from)?;
    let spots = spots(grid, from, seen, sight);
    let value = |(view, way): &([f64; 2], f64)| {
        let inside = spots.iter().filter(|(spot, _)| is_in_sight(grid, *view, *spot, sight));
        inside.map(|(_, worth)| worth).sum::<f64>() * libm::exp(-way / FAR)
    };
    let valued = views.iter().map(|view| (view.0, value(view)));
    valued.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(view, _)| view)
}

/// Reachable places, and the weighted lengths of their paths, in metres; `None` if the robot is
/// beyond the map.
fn views(grid: &Grid, from: [f64; 2]) -> Option<Vec<([f64; 2], f64)>> {
    let start = grid.index(from)?;
    let cost = |cell: usize| weight(grid, cell, from);
    let reached = dijkstra_reach(&start, |cell| neighbours(grid, *cell, cost));
    let others = reached.filter(|it| it.node != start).map(|it| (it.node, it.total_cost));
    let mut views = roomiest(grid, others);
    let is_roomy = |least: f32| move |it: &(usize, u32)| grid.clearance(it.0) >= least;
    let Room { fits, comfort, .. } = grid.room;
    let least = if views.iter().any(is_roomy(comfort)) { comfort } else { fits };
    views.retain(is_roomy(least));
    let metres = |cost: u32| f64::from(cost) / f64::from(BESIDE) * grid.cell;
    Some(views.into_iter().map(|(cell, cost)| (grid.place(cell), metres(cost))).collect())
}

/// Places on the floor, and their values.
fn spots(grid: &Grid, from: [f64; 2], seen: &[[f64; 2]], sight: f64) -> Vec<([f64; 2], f64)> {
    let floor = (0..grid.columns * grid.rows).filter(|cell| grid.clearance(*cell) > FLOOR);
    let spots = roomiest(grid, floor.map(|cell| (cell, 0)));
    let spot = |(cell, _): (usize, u32)| {
        let place = grid.place(cell);
        let eyes = seen.iter().chain([&from]);
        let times = eyes.filter(|eye| is_in_sight(grid, **eye, place, sight)).count();
        (place, (0..times).fold(1.0, |worth, _| worth * AGAIN))
    };
    spots.into_iter().map(spot).collect()
}

/// For each square, the cell with the most clearance; among equals the first.
fn roomiest(grid: &Grid, cells: impl Iterator<Item = (usize, u32)>) -> Vec<(usize, u32)> {
    let all = (grid.columns * grid.rows) as f64;
    let side = libm::ceil(libm::sqrt(all / MOST)).max(libm::round(SQUARE / grid.cell)) as usize;
    let across = grid.columns.div_ceil(side);
    let mut squares = vec![None; across * grid.rows.div_ceil(side)];
    for (cell, cost) in cells {
        let square = cell / grid.columns / side * across + cell % grid.columns / side;
        let clearance = grid.clearance(cell);
        if let Some(best) = squares.get_mut(square)
            && best.is_none_or(|(best, _)| clearance > grid.clearance(best))
        {
            *best = Some((cell, cost));
        }
    }
    squares.into_iter().flatten().collect()
}

/// Whether no obstacle is between two near places. The clearance of a place is also the free length
/// of the line from it.
fn is_in_sight(grid: &Grid, eye: [f64; 2], place: [f64; 2], sight: f64) -> bool {
    let away = [place[0] - eye[0], place[1] - eye[1]];
    let length = libm::hypot(away[0], away[1]);
    if length > sight {
        return false;
    }
    let mut at = 0.0;
    while at < length {
        let share = at / length;
        let here = grid.index([eye[0] + away[0] * share, eye[1] + away[1] * share]);
        let free = here.map_or(0.0, |cell| f64::from(grid.clearance(cell)));
        if free < grid.cell / 2.0 {
            return false;
        }
        at += free.max(grid.cell);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::map::Map;
    use crate::maps::room::tests::carbot;

    fn wall(x: [f64; 2], y: [f64; 2]) -> Vec<[f64; 2]> {
        vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
    }

    /// Three rooms in a row, each three metres by four, with doors of `doors` metres: one at the
    /// upper end, one at the lower.
    fn rooms(doors: [f64; 2]) -> Grid {
        let [first, second] = [[0.1, 3.9 - doors[0]], [0.1 + doors[1], 3.9]];
        let map = Map::new([
            wall([0.0, 9.0], [0.0, 0.1]),
            wall([0.0, 9.0], [3.9, 4.0]),
            wall([0.0, 0.1], [0.0, 4.0]),
            wall([8.9, 9.0], [0.0, 4.0]),
            wall([2.95, 3.05], first),
            wall([5.95, 6.05], second),
        ]);
        Grid::new(&map, Room::of(&carbot()))
    }

    /// The viewpoints in order, from the first on.
    fn looks(grid: &Grid, first: [f64; 2], count: usize) -> Vec<[f64; 2]> {
        let mut looks = vec![first];
        while looks.len() < count {
            let (at, seen) = looks.split_last().expect("there is a first");
            looks.push(best(grid, *at, seen, 4.0).expect("there are others"));
        }
        looks
    }

    /// The share of the floor that is visible from none of some places.
    fn unseen(grid: &Grid, looks: &[[f64; 2]]) -> f64 {
        let spots = spots(grid, looks[0], &looks[1..], 4.0);
        let unseen = spots.iter().filter(|(_, worth)| *worth == 1.0).count();
        unseen as f64 / spots.len() as f64
    }

    #[test]
    fn three_views_show_three_rooms() {
        let grid = rooms([1.0, 1.0]);
        for first in [[1.5, 1.5], [4.5, 1.5], [7.5, 3.0]] {
            let looks = looks(&grid, first, 4);
            let shares: Vec<_> = (1..=4).map(|n| unseen(&grid, &looks[..n])).collect();
            assert!(
                shares[0] > 0.4 && shares[2] < 0.15 && shares[3] < 0.03,
                "{shares:?} {looks:?}"
            );
        }
    }

    #[test]
    fn views_do_not_run_out_and_each_room_has_its_turn() {
        let grid = rooms([1.0, 1.0]);
        let looks = looks(&grid, [1.5, 1.5], 30);
        for turn in looks.chunks(10) {
            assert!(unseen(&grid, turn) < 0.03, "{turn:?}");
        }
        for place in looks {
            assert!(grid.index(place).map(|cell| grid.clearance(cell)) >= Some(grid.room.comfort));
        }
    }

    #[test]
    fn an_unreachable_place_is_not_a_view() {
        let seen = [[1.2, 2.0], [1.8, 2.0], [1.5, 3.0]];
        let room = |door| {
            let [x, _] = best(&rooms([door, 0.4]), [1.5, 1.5], &seen, 4.0).unwrap();
            (x / 3.0) as usize
        };
        assert_eq!((room(1.0), room(0.4)), (1, 0));
    }

    #[test]
    fn a_corridor_without_comfort_has_views_and_a_hole_has_none() {
        let corridor = |width: f64| {
            let map =
                Map::new([wall([0.0, 6.0], [0.0, 0.1]), wall([0.0, 6.0], [width, width + 0.1])]);
            let grid = Grid::new(&map, Room::of(&carbot()));
            best(&grid, [0.5, (width + 0.1) / 2.0], &[], 2.0)
        };
        assert!(corridor(0.75).is_some_and(|[x, _]| x > 1.0), "{:?}", corridor(0.75));
        assert_eq!(corridor(0.05), None);
    }

    #[test]
    fn beyond_the_map_and_on_an_empty_map_there_is_no_view() {
        assert_eq!(best(&rooms([1.0, 1.0]), [-1.0, 1.0], &[], 4.0), None);
        let empty = Grid::new(&Map::new([]), Room::of(&carbot()));
        assert_eq!(best(&empty, [0.0, 0.0], &[], 4.0), None);
    }

    #[test]
    fn floor_beyond_the_sight_is_not_seen() {
        let grid = rooms([1.0, 1.0]);
        assert!(is_in_sight(&grid, [1.0, 1.0], [2.5, 1.0], 1.6));
        assert!(!is_in_sight(&grid, [1.0, 1.0], [2.5, 1.0], 1.4));
        assert!(!is_in_sight(&grid, [2.5, 1.0], [3.5, 1.0], 4.0));
        assert!(is_in_sight(&grid, [2.5, 3.4], [3.5, 3.4], 4.0));
        assert!(is_in_sight(&grid, [1.0, 1.0], [1.0, 1.0], 4.0));
    }
}
