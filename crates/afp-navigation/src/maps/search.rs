//! The search for a path through a grid.

use crate::maps::grid::Grid;
use crate::maps::room::Room;
use afp_carbot::Path;
use afp_core::Fault;
use pathfinding::prelude::astar;

/// The minimum clearance near the robot's start, in metres.
const TIGHT: f32 = 0.05;
/// The factor of the length of a path through a cell in which the robot just fits, and through a
/// tight cell.
const NARROW: f32 = 4.0;
const SQUEEZE: f32 = 12.0;
/// The length from a cell to its neighbour, and to its diagonal neighbour, in a unit with whole
/// numbers.
pub(crate) const BESIDE: u32 = 100;
const ACROSS: u32 = 141;
/// The maximum length of a straight piece in cells, and the clearance that it may have less than
/// the cells that it replaces, in metres.
const PIECE: usize = 80;
const LESS: f32 = 0.03;

/// The path from one place to another, or to within `near` of it; `None` if there is no path. It
/// uses A* (Hart, Nilsson and Raphael, 1968) on the eight neighbours of each cell and keeps to the
/// middle of narrow places; then its corners are tightened.
///
/// # Errors
/// It has too many corners.
pub(crate) fn path(
    grid: &Grid,
    from: [f64; 2],
    to: [f64; 2],
    near: f64,
) -> Result<Option<Path>, Fault> {
    let Some((start, goal)) = grid.index(from).zip(goal(grid, to, near)) else { return Ok(None) };
    let end = grid.place(goal);
    let cost = |index: usize| weight(grid, index, from);
    let rest = |index: &usize| {
        let [x, y] = grid.place(*index);
        let [x, y] = [(x - end[0]).abs() / grid.cell, (y - end[1]).abs() / grid.cell];
        let (across, beside) = (x.min(y), (x - y).abs());
        (f64::from(ACROSS) * across + f64::from(BESIDE) * beside) as u32
    };
    let next = |index: &usize| neighbours(grid, *index, cost);
    let found = astar(&start, next, rest, |index| *index == goal);
    let Some((cells, _)) = found else { return Ok(None) };
    let last = if grid.index(to) == Some(goal) { to } else { end };
    Path::new(pulled_tight(grid, &cells, from, last)).map(Some)
}

/// The cell at the end of the path: the goal's cell if the robot fits there, or else the nearest.
fn goal(grid: &Grid, to: [f64; 2], near: f64) -> Option<usize> {
    let fits = |index: &usize| grid.clearance(*index) >= grid.room.fits;
    if let Some(exact) = grid.index(to).filter(fits) {
        return Some(exact);
    }
    let off = |index: &usize| {
        let [x, y] = grid.place(*index);
        libm::hypot(x - to[0], y - to[1])
    };
    let close = grid.around(to, to, near).filter(fits).filter(|index| off(index) <= near);
    close.min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// The factor of a path's length through a cell; `None` if the robot does not fit.
pub(crate) fn weight(grid: &Grid, index: usize, from: [f64; 2]) -> Option<f32> {
    let clearance = grid.clearance(index);
    let Room { fits, leaving, most, .. } = grid.room;
    if clearance >= fits {
        return Some(1.0 + (NARROW - 1.0) * (most - clearance).max(0.0) / (most - fits));
    }
    let [x, y] = grid.place(index);
    let leaves = libm::hypot(x - from[0], y - from[1]) <= leaving && clearance >= TIGHT;
    leaves.then_some(SQUEEZE)
}

pub(crate) fn neighbours(
    grid: &Grid,
    index: usize,
    cost: impl Fn(usize) -> Option<f32>,
) -> impl Iterator<Item = (usize, u32)> {
    let (columns, rows) = (grid.columns as isize, grid.rows as isize);
    let (column, row) = (index as isize % columns, index as isize / columns);
    let steps = (-1..=1).flat_map(|up| (-1..=1).map(move |across| (across, up)));
    steps.filter_map(move |(across, up)| {
        let (column, row) = (column + across, row + up);
        let inside = (0..columns).contains(&column) && (0..rows).contains(&row);
        let length = match (across, up) {
            (0, 0) => return None,
            (0, _) | (_, 0) => BESIDE,
            _ => ACROSS,
        };
        let next = inside.then_some((row * columns + column) as usize)?;
        Some((next, (length as f32 * cost(next)?) as u32))
    })
}

/// The necessary corners of a path.
fn pulled_tight(grid: &Grid, cells: &[usize], from: [f64; 2], to: [f64; 2]) -> Vec<[f64; 2]> {
    let mut places: Vec<_> = cells.iter().map(|index| grid.place(*index)).collect();
    if let Some(first) = places.first_mut() {
        *first = from;
    }
    match places.last_mut() {
        Some(last) if cells.len() > 1 => *last = to,
        _ => places.push(to),
    }
    let clearances: Vec<_> = places.iter().map(|place| clearance_at(grid, *place)).collect();
    let mut corners = vec![from];
    let mut at = 0;
    while at + 1 < places.len() {
        let far = (at + PIECE).min(places.len() - 1);
        let straight = |to: &usize| {
            let least = clearances[at..=*to].iter().copied().fold(grid.room.comfort, f32::min);
            is_clear(grid, places[at], places[*to], least - LESS)
        };
        at = (at + 2..=far).rev().find(straight).unwrap_or(at + 1);
        corners.push(places[at]);
    }
    corners
}

/// Whether the robot fits along a straight piece.
pub(crate) fn is_free(grid: &Grid, from: [f64; 2], to: [f64; 2]) -> bool {
    is_clear(grid, from, to, grid.room.fits - LESS)
}

/// Whether a straight piece has this clearance.
fn is_clear(grid: &Grid, from: [f64; 2], to: [f64; 2], clearance: f32) -> bool {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let steps = libm::ceil(libm::hypot(x, y) / grid.cell * 2.0).max(1.0);
    (0..=steps as u32).all(|n| {
        let share = f64::from(n) / steps;
        clearance_at(grid, [from[0] + x * share, from[1] + y * share]) >= clearance
    })
}

fn clearance_at(grid: &Grid, place: [f64; 2]) -> f32 {
    grid.index(place).map_or(0.0, |index| grid.clearance(index))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::map::Map;
    use crate::maps::room::tests::{body, carbot};
    use afp_carbot::devices::Body;

    fn wall(x: [f64; 2], y: [f64; 2]) -> Vec<[f64; 2]> {
        vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
    }

    /// Two rooms of three metres by four, with a door of `width` in the middle of the wall between
    /// them.
    fn rooms_of(body: &Body, width: f64) -> Grid {
        let half = width / 2.0;
        let map = Map::new([
            wall([0.0, 6.0], [0.0, 0.1]),
            wall([0.0, 6.0], [3.9, 4.0]),
            wall([0.0, 0.1], [0.0, 4.0]),
            wall([5.9, 6.0], [0.0, 4.0]),
            wall([2.95, 3.05], [0.0, 2.0 - half]),
            wall([2.95, 3.05], [2.0 + half, 4.0]),
        ]);
        Grid::new(&map, Room::of(body))
    }

    fn rooms(width: f64) -> Grid {
        rooms_of(&carbot(), width)
    }

    fn places(grid: &Grid, from: [f64; 2], to: [f64; 2]) -> Option<Vec<[f64; 2]>> {
        path(grid, from, to, 0.1).unwrap().map(|path| path.places().collect())
    }

    /// The length of a path, and its minimum clearance.
    fn measure(grid: &Grid, places: &[[f64; 2]]) -> (f64, f32) {
        let pieces = places.windows(2);
        let length =
            |ends: &[[f64; 2]]| libm::hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
        let along = |ends: &[[f64; 2]], n: i32| {
            let share = f64::from(n) / 20.0;
            [0, 1].map(|axis| ends[0][axis] + share * (ends[1][axis] - ends[0][axis]))
        };
        let clearances = pieces
            .clone()
            .flat_map(|ends| (0..=20).map(move |n| clearance_at(grid, along(ends, n))));
        (pieces.map(length).sum(), clearances.fold(grid.room.most, f32::min))
    }

    #[test]
    fn a_free_path_is_straight() {
        let path = places(&rooms(1.0), [1.0, 2.0], [5.0, 2.0]).unwrap();
        assert!(path.len() <= 3, "{path:?}");
        let ends =
            [[1.0, 2.0], [5.0, 2.0]].map(|place: [f64; 2]| place.map(|at| f64::from(at as f32)));
        assert_eq!((path[0], *path.last().unwrap()), (ends[0], ends[1]));
    }

    #[test]
    fn a_path_leads_through_the_door_with_space_for_the_robot() {
        let grid = rooms(1.0);
        let path = places(&grid, [1.0, 0.7], [5.0, 0.7]).unwrap();
        let (length, clearance) = measure(&grid, &path);
        assert!(
            (4.5..6.0).contains(&length) && clearance >= grid.room.fits - LESS,
            "{length} {clearance} {path:?}"
        );
        assert!(path.len() < 12, "{path:?}");
    }

    #[test]
    fn a_path_avoids_a_door_that_is_too_narrow() {
        assert_eq!(places(&rooms(0.5), [1.0, 2.0], [5.0, 2.0]), None);
        assert!(places(&rooms(0.75), [1.0, 2.0], [5.0, 2.0]).is_some());
    }

    #[test]
    fn a_path_avoids_a_door_that_is_too_narrow_for_the_body() {
        // Sides of the body, and the widest of these doors that it does not fit through: it can
        // turn in place everywhere.
        let doors = [0.3, 0.5, 0.75, 1.1, 1.5, 1.8];
        for (length, width, closed) in
            [(0.2, 0.15, 0.3), (0.4, 0.35, 0.5), (0.7, 0.6, 0.75), (1.2, 0.9, 1.5)]
        {
            let leads = |door| {
                places(&rooms_of(&body(length, width), door), [1.5, 2.0], [4.5, 2.0]).is_some()
            };
            let shut = doors.into_iter().rfind(|door| !leads(*door));
            assert_eq!(shut, Some(closed), "{length} by {width}");
        }
    }

    #[test]
    fn a_path_goes_around_found_obstacles() {
        let mut grid = rooms(2.5);
        for n in 0..10 {
            grid.add([3.0, 1.6 + 0.05 * f64::from(n)], 0.0);
        }
        let path = places(&grid, [1.0, 2.0], [5.0, 2.0]).unwrap();
        assert!(path.iter().any(|[_, y]| (y - 2.0).abs() > 0.25), "{path:?}");
        assert!(measure(&grid, &path).1 >= grid.room.fits - LESS, "{path:?}");
    }

    #[test]
    fn a_goal_in_a_wall_needs_a_tolerance() {
        let grid = rooms(1.0);
        assert_eq!(places(&grid, [1.0, 2.0], [0.2, 2.0]), None);
        let near = path(&grid, [1.0, 2.0], [0.2, 2.0], 0.3).unwrap().unwrap();
        let end = near.places().next_back().unwrap();
        assert!(end[0] > 0.3 && end[0] < 0.5, "{end:?}");
        assert_eq!(places(&grid, [1.0, 2.0], [9.0, 2.0]), None);
        assert_eq!(places(&grid, [-1.0, 2.0], [1.0, 2.0]), None);
    }

    #[test]
    fn a_robot_close_to_a_wall_finds_a_path_away_from_it() {
        assert!(places(&rooms(1.0), [0.3, 2.0], [5.0, 2.0]).is_some());
    }

    #[test]
    fn a_path_to_the_robots_own_place_is_empty() {
        assert_eq!(places(&rooms(1.0), [1.0, 2.0], [1.01, 2.01]).unwrap().len(), 2);
    }
}
