//! Combines occupied cells into boxes.

use super::picture::Grid;
use std::ops::Range;

/// The occupied cells; row 0 is at the top.
pub(super) struct Cells {
    pub(super) width: usize,
    pub(super) height: usize,
    occupied: Vec<bool>,
    /// For each corner of cells, the number of occupied cells above and to the left.
    sums: Vec<u32>,
}

/// Columns from `left` to before `right`, rows from `top` to before `bottom`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rectangle {
    pub(super) left: usize,
    pub(super) right: usize,
    pub(super) top: usize,
    pub(super) bottom: usize,
}

impl Cells {
    pub(super) fn new<T: Copy>(grid: &Grid<T>, is_occupied: impl Fn(T) -> bool) -> Self {
        let Grid { width, height, ref values } = *grid;
        let occupied: Vec<bool> = values.iter().map(|value| is_occupied(*value)).collect();
        let mut sums = vec![0; (width + 1) * (height + 1)];
        for row in 0..height {
            let mut in_row = 0;
            for column in 0..width {
                in_row += u32::from(occupied[row * width + column]);
                let above = sums[row * (width + 1) + column + 1];
                sums[(row + 1) * (width + 1) + column + 1] = above + in_row;
            }
        }
        Cells { width, height, occupied, sums }
    }

    /// Whether all cells within `reach` are free and on the map.
    pub(super) fn free_around(&self, row: usize, column: usize, reach: usize) -> bool {
        let (Some(top), Some(left)) = (row.checked_sub(reach), column.checked_sub(reach)) else {
            return false;
        };
        let (bottom, right) = (row + reach + 1, column + reach + 1);
        let sum = |row: usize, column: usize| self.sums[row * (self.width + 1) + column];
        bottom <= self.height
            && right <= self.width
            && sum(bottom, right) + sum(top, left) == sum(top, right) + sum(bottom, left)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.sums.last() == Some(&0)
    }

    /// The cells that can be reached from beyond the map, row by row.
    pub(super) fn outside(&self) -> Vec<bool> {
        self.flood().reached
    }

    fn flood(&self) -> Flood<'_> {
        let (width, cells) = (self.width, self.occupied.len());
        let mut flood = Flood { cells: self, reached: vec![false; cells], waiting: Vec::new() };
        for row in 0..self.height {
            let (first, next) = (row * width, (row + 1) * width);
            if row == 0 || row + 1 == self.height {
                flood.reach(first..next);
            } else {
                flood.reach(first..first + 1);
                flood.reach(next - 1..next);
            }
        }
        while let Some(run) = flood.waiting.pop() {
            if run.start >= width {
                flood.reach(run.start - width..run.end - width);
            }
            if run.end + width <= cells {
                flood.reach(run.start + width..run.end + width);
            }
        }
        flood
    }

    fn is_free(&self, at: usize) -> bool {
        self.occupied.get(at) == Some(&false)
    }

    /// The run of free cells in a row around a free cell.
    fn free_run(&self, at: usize) -> Range<usize> {
        let first = at / self.width * self.width;
        let start = (first..at).rev().take_while(|at| self.is_free(*at)).last().unwrap_or(at);
        let end = (at + 1..first + self.width).find(|at| !self.is_free(*at));
        start..end.unwrap_or(first + self.width)
    }

    /// The occupied cells as boxes: each as wide as possible, then as high as possible.
    pub(super) fn boxes(&self) -> Vec<Rectangle> {
        let mut left_over = self.occupied.clone();
        let mut boxes = Vec::new();
        for top in 0..self.height {
            let mut left = 0;
            while left < self.width {
                let row = &left_over[top * self.width..][left..self.width];
                let run = row.iter().take_while(|occupied| **occupied).count();
                if run > 0 {
                    boxes.push(self.take(&mut left_over, top, left, left + run));
                }
                left += run + 1;
            }
        }
        boxes
    }

    /// Takes a run of cells and all equal runs below it.
    fn take(&self, from: &mut [bool], top: usize, left: usize, right: usize) -> Rectangle {
        let mut bottom = top;
        while bottom < self.height {
            let run = &mut from[bottom * self.width..][left..right];
            if !run.iter().all(|occupied| *occupied) {
                break;
            }
            run.fill(false);
            bottom += 1;
        }
        Rectangle { left, right, top, bottom }
    }
}

/// Reached cells, run by run: each run waits once, so that an open map takes no more memory than a
/// narrow one.
struct Flood<'a> {
    cells: &'a Cells,
    reached: Vec<bool>,
    /// Runs with unchecked neighbours.
    waiting: Vec<Range<usize>>,
}

impl Flood<'_> {
    /// Reaches the runs with free cells in this range of one row.
    fn reach(&mut self, among: Range<usize>) {
        let mut at = among.start;
        while at < among.end {
            if self.reached.get(at) != Some(&false) || !self.cells.is_free(at) {
                at += 1;
                continue;
            }
            let run = self.cells.free_run(at);
            at = run.end;
            if let Some(reached) = self.reached.get_mut(run.clone()) {
                reached.fill(true);
            }
            self.waiting.push(run);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(rows: &[&str]) -> Cells {
        let values = rows.iter().flat_map(|row| row.bytes()).collect();
        Cells::new(&Grid { width: rows[0].len(), height: rows.len(), values }, |v| v == b'#')
    }

    #[test]
    fn boxes_cover_every_occupied_cell_once() {
        let cells = cells(&["#####..", "#...#.#", "#...#.#", "#####.."]);
        let boxes = cells.boxes();
        let mut covered = vec![0; 28];
        for Rectangle { left, right, top, bottom } in &boxes {
            for row in *top..*bottom {
                covered[row * 7 + left..row * 7 + right].iter_mut().for_each(|n| *n += 1);
            }
        }
        let expected: Vec<i32> = cells.occupied.iter().map(|o| i32::from(*o)).collect();
        assert_eq!(covered, expected);
        assert_eq!(boxes.len(), 5, "{boxes:?}");
    }

    #[test]
    fn surroundings_are_free_when_no_cell_is_occupied_or_beyond() {
        let cells = cells(&[".....", ".....", "....#", "....."]);
        assert!(cells.free_around(1, 1, 1));
        assert!(cells.free_around(2, 2, 1));
        assert!(!cells.free_around(2, 3, 1));
        assert!(!cells.free_around(0, 1, 1));
        assert!(!cells.free_around(3, 1, 1));
        assert!(cells.free_around(3, 4, 0) && !cells.free_around(2, 4, 0));
    }

    /// A picture with a share of occupied cells, in tenths.
    fn sprinkled(tenths: u64, seed: u64) -> Cells {
        let mut state = seed;
        let mut occupied = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) % 10 < tenths
        };
        let values = (0..23 * 17).map(|_| if occupied() { b'#' } else { b'.' }).collect();
        Cells::new(&Grid { width: 23, height: 17, values }, |v| v == b'#')
    }

    #[test]
    fn outside_cells_are_connected_to_the_border() {
        for seed in 0..100 {
            let cells = sprinkled(2 + seed % 4, seed);
            let (width, height) = (cells.width, cells.height);
            let mut outside = vec![false; width * height];
            loop {
                let before = outside.clone();
                for at in 0..width * height {
                    let (row, column) = (at / width, at % width);
                    let border =
                        row == 0 || column == 0 || row + 1 == height || column + 1 == width;
                    let beside = || {
                        before[at - 1] || before[at + 1] || before[at - width] || before[at + width]
                    };
                    outside[at] = cells.is_free(at) && (border || beside());
                }
                if outside == before {
                    break;
                }
            }
            assert_eq!(cells.outside(), outside, "seed {seed}");
        }
    }

    #[test]
    fn an_open_map_keeps_few_runs_waiting() {
        let values = vec![b'.'; 1000 * 1000];
        let cells = Cells::new(&Grid { width: 1000, height: 1000, values }, |v| v == b'#');
        let flood = cells.flood();
        assert!(flood.reached.iter().all(|reached| *reached));
        assert!(flood.waiting.capacity() <= 2048, "{}", flood.waiting.capacity());
    }
}
