//! The reachable places of a room: a plan fails only if it misses a reachable goal.

use std::ops::RangeInclusive;

use afp_sim::world::{Mobility, Obstacle};
use afp_sim::{HALF_LENGTH, HALF_WIDTH, World};

/// The distance between two places, in metres.
const CELL: f64 = 0.1;
/// A place is wide enough if the robot can turn around there with this clearance, in metres.
const SPARE: f64 = 0.05;
/// The distance within which the robot may leave a narrow start, in metres.
const LEAVING: f64 = 0.3;

/// The places of a room that a wide enough path connects to the robot's start, with obstacles at
/// their initial places. Walking obstacles are ignored, since they give way.
#[derive(Clone, Debug)]
pub struct Reach {
    low: [f64; 2],
    columns: usize,
    rows: usize,
    reached: Vec<bool>,
}

impl Reach {
    /// Finds the reachable places of a room.
    pub fn of(world: &World) -> Reach {
        let (low, high) = bounds(world);
        let [columns, rows] = [0, 1].map(|i| ((high[i] - low[i]) / CELL).ceil() as usize);
        let mut reach = Reach { low, columns, rows, reached: vec![false; columns * rows] };
        let still = without_walkers(world);
        let wide = HALF_LENGTH.hypot(HALF_WIDTH) + SPARE;
        let mut seen = reach.reached.clone();
        let mut next: Vec<usize> = reach.around([world.start.x, world.start.y], LEAVING).collect();
        while let Some(cell) = next.pop() {
            let at = reach.middle(cell);
            if !std::mem::replace(&mut seen[cell], true) && room(&still, at) >= wide {
                reach.reached[cell] = true;
                next.extend(reach.around(at, CELL * 1.1));
            }
        }
        reach
    }

    /// The reachable area, in square metres.
    pub fn area(&self) -> f64 {
        self.reached.iter().filter(|reached| **reached).count() as f64 * CELL * CELL
    }

    pub fn has(&self, place: [f64; 2]) -> bool {
        self.near(place, CELL / 2.0).next().is_some()
    }

    /// The places within a distance of another one in metres, along either axis.
    pub fn near(&self, place: [f64; 2], far: f64) -> impl Iterator<Item = [f64; 2]> {
        self.around(place, far).filter(|cell| self.reached[*cell]).map(|cell| self.middle(cell))
    }

    /// The cells within a distance of a place in metres, along either axis.
    fn around(&self, place: [f64; 2], far: f64) -> impl Iterator<Item = usize> + use<> {
        let range = |i: usize, count: usize| -> RangeInclusive<usize> {
            let cell = |at: f64| ((at - self.low[i]) / CELL).max(0.0) as usize;
            cell(place[i] - far)..=cell(place[i] + far).min(count.saturating_sub(1))
        };
        let (across, up, columns) = (range(0, self.columns), range(1, self.rows), self.columns);
        up.flat_map(move |row| across.clone().map(move |column| row * columns + column))
    }

    fn middle(&self, cell: usize) -> [f64; 2] {
        let at = |i: usize, n: usize| self.low[i] + (n as f64 + 0.5) * CELL;
        [at(0, cell % self.columns), at(1, cell / self.columns)]
    }
}

/// The lower left and the upper right corner of a room's obstacles.
pub(crate) fn bounds(world: &World) -> ([f64; 2], [f64; 2]) {
    let corners = world.obstacles.iter().flat_map(|obstacle| obstacle.outline.corners());
    let outside = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    corners.fold(outside, |(low, high), at| {
        ([0, 1].map(|i| low[i].min(at[i])), [0, 1].map(|i| high[i].max(at[i])))
    })
}

/// The distance from a place to the nearest obstacle in metres; zero inside one.
pub(crate) fn room(world: &World, place: [f64; 2]) -> f64 {
    let room = |it: &Obstacle| distance(&it.outline.corners(), place);
    world.obstacles.iter().map(room).fold(f64::INFINITY, f64::min)
}

/// Whether the line between two places, each with a height in metres, is free of obstacles.
pub(crate) fn is_in_sight(
    world: &World,
    (from, low): ([f64; 2], f64),
    (to, high): ([f64; 2], f64),
) -> bool {
    /// The number of tested places on the line.
    const PLACES: u32 = 50;
    (0..=PLACES).all(|n| {
        let share = f64::from(n) / f64::from(PLACES);
        let place = [0, 1].map(|i| from[i] + (to[i] - from[i]) * share);
        let height = low + (high - low) * share;
        let mut higher = world.obstacles.iter().filter(|it| it.height > height);
        higher.all(|it| distance(&it.outline.corners(), place) > 0.0)
    })
}

/// The distance from a place to a convex outline with counter-clockwise corners; zero inside it.
fn distance(corners: &[[f64; 2]], place: [f64; 2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let mut inside = true;
    let off = |([ax, ay], [bx, by]): (&[f64; 2], &[f64; 2])| {
        let ([x, y], [px, py]) = ([bx - ax, by - ay], [place[0] - ax, place[1] - ay]);
        inside &= x * py - y * px >= 0.0;
        let share = ((x * px + y * py) / (x * x + y * y).max(1e-12)).clamp(0.0, 1.0);
        (px - x * share).hypot(py - y * share)
    };
    let off = corners.iter().zip(next).map(off).fold(f64::INFINITY, f64::min);
    if inside { 0.0 } else { off }
}

fn without_walkers(world: &World) -> World {
    let mut still = world.clone();
    still.obstacles.retain(|obstacle| !matches!(obstacle.mobility, Mobility::Scripted(_)));
    still
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_leads_through_a_door_and_not_through_a_gap() {
        let halves = |door: f64| {
            World::parse(&format!(
                "version = 1\nname = \"halves\"\n[robot]\npose_m_deg = [1.0, 1.0, 0.0]\n\
                 [[wall]]\nclosed = true\npoints_m = [[0, 0], [4, 0], [4, 2], [0, 2]]\n\
                 [[wall]]\npoints_m = [[2, 0], [2, {}]]\n",
                2.0 - door
            ))
        };
        for (door, leads) in [(0.9, true), (0.5, false)] {
            let reach = Reach::of(&halves(door).expect("a world"));
            assert!(reach.has([1.2, 1.2]) && !reach.has([0.1, 0.1]) && !reach.has([9.0, 1.0]));
            assert_eq!(reach.has([3.0, 1.0]), leads, "{door}");
        }
    }
}
