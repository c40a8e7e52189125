//! A map in cells, with each cell's distance from obstacles.

use crate::maps::map::Map;
use crate::maps::room::Room;
use nalgebra::Vector2;

/// The side of a cell, in metres; larger if a map has too many cells.
const CELL: f64 = 0.05;
/// The maximum number of cells.
const MOST: f64 = 500_000.0;

/// An occupancy grid for a robot. For each cell, it has the distance to the nearest obstacle, up to
/// the maximum that matters to the robot.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// The space that the robot needs.
    pub(crate) room: Room,
    low: Vector2<f64>,
    pub(crate) cell: f64,
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    clearance: Vec<f32>,
}

impl Grid {
    /// The grid of a whole map.
    pub(crate) fn new(map: &Map, room: Room) -> Self {
        let [low, high] = map.bounds().map(Vector2::from);
        let size = high - low;
        let cell = CELL.max(libm::sqrt(size.x * size.y / MOST));
        let [columns, rows] = [size.x, size.y].map(|side| libm::ceil(side / cell) as usize);
        let clearance = vec![room.most; columns * rows];
        let mut grid = Grid { room, low, cell, columns, rows, clearance };
        for outline in map.outlines() {
            grid.stamp(outline);
        }
        grid
    }

    /// The distance between the middle of a cell and the nearest obstacle.
    pub(crate) fn clearance(&self, index: usize) -> f32 {
        self.clearance.get(index).copied().unwrap_or(0.0)
    }

    /// The cell of a place; `None` beyond the map.
    pub(crate) fn index(&self, [x, y]: [f64; 2]) -> Option<usize> {
        let [across, up] = [(x - self.low.x) / self.cell, (y - self.low.y) / self.cell];
        let inside = across >= 0.0 && up >= 0.0;
        let (column, row) = (across as usize, up as usize);
        (inside && column < self.columns && row < self.rows).then(|| row * self.columns + column)
    }

    pub(crate) fn place(&self, index: usize) -> [f64; 2] {
        let (column, row) = (index % self.columns, index / self.columns);
        let at = |low: f64, n: usize| low + (n as f64 + 0.5) * self.cell;
        [at(self.low.x, column), at(self.low.y, row)]
    }

    /// The cells with their middles within this distance of a place or box of places, in metres.
    pub(crate) fn around(
        &self,
        low: [f64; 2],
        high: [f64; 2],
        far: f64,
    ) -> impl Iterator<Item = usize> + use<> {
        let range = |low: f64, high: f64, from: f64, count: usize| {
            let cell = |at: f64| ((at - from) / self.cell).clamp(0.0, count as f64) as usize;
            cell(low - far)..(cell(high + far) + 1).min(count)
        };
        let across = range(low[0], high[0], self.low.x, self.columns);
        let up = range(low[1], high[1], self.low.y, self.rows);
        let columns = self.columns;
        up.flat_map(move |row| across.clone().map(move |column| row * columns + column))
    }

    /// Adds a small obstacle at a place, as if it were farther away by `off`, in metres.
    pub(crate) fn add(&mut self, place: [f64; 2], farther: f64) {
        for index in self.around(place, place, f64::from(self.room.most)) {
            let [x, y] = self.place(index);
            self.limit(index, libm::hypot(x - place[0], y - place[1]) + farther);
        }
    }

    /// Copies the clearances of another grid of the same map.
    pub(crate) fn clone_clearance(&mut self, other: &Grid) {
        self.clearance.clone_from(&other.clearance);
    }

    fn stamp(&mut self, outline: &[Vector2<f64>]) {
        let low = outline.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = outline.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        for index in self.around(low.into(), high.into(), f64::from(self.room.most)) {
            let off = distance(outline, self.place(index).into());
            self.limit(index, off);
        }
    }

    fn limit(&mut self, index: usize, clearance: f64) {
        if let Some(known) = self.clearance.get_mut(index) {
            *known = known.min(clearance as f32);
        }
    }
}

/// The distance between a place and a convex outline; 0 inside of it.
fn distance(outline: &[Vector2<f64>], place: Vector2<f64>) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let sides = || outline.iter().zip(next.clone());
    if sides().all(|(from, to)| (to - from).perp(&(place - from)) >= 0.0) {
        return 0.0;
    }
    let off = |(from, to): (&Vector2<f64>, &Vector2<f64>)| {
        let along = to - from;
        let length = along.norm_squared().max(1e-12);
        let share = ((place - from).dot(&along) / length).clamp(0.0, 1.0);
        (place - from - along * share).norm()
    };
    sides().map(off).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::room::tests::carbot;

    const MOST: f32 = 0.6;

    fn grid() -> Grid {
        let map = Map::new([
            vec![[0.0, 0.0], [2.0, 0.0], [2.0, 0.1], [0.0, 0.1]],
            vec![[0.0, 1.9], [2.0, 1.9], [2.0, 2.0], [0.0, 2.0]],
        ]);
        Grid::new(&map, Room::of(&carbot()))
    }

    #[test]
    fn a_cell_has_its_clearance() {
        let grid = grid();
        let clearance = |x, y| grid.clearance(grid.index([x, y]).unwrap());
        assert_eq!((grid.columns, grid.rows), (40, 40));
        assert_eq!((clearance(1.0, 0.05), clearance(1.0, 1.0)), (0.0, MOST));
        assert!((clearance(1.0, 0.324) - 0.225).abs() < 0.001);
        assert_eq!((grid.index([-0.1, 0.0]), grid.index([0.0, 2.1])), (None, None));
    }

    #[test]
    fn an_added_obstacle_takes_space() {
        let mut grid = grid();
        grid.add([1.0, 1.0], 0.0);
        let clearance = |x, y| grid.clearance(grid.index([x, y]).unwrap());
        assert!(clearance(1.0, 1.0) < 0.04 && (clearance(1.324, 1.0) - 0.325).abs() < 0.03);
        assert_eq!(clearance(0.2, 1.0), MOST);
    }
}
