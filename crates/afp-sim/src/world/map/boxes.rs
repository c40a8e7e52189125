//! Occupied cells gathered into boxes.

use super::picture::Grey;

/// Which cells are occupied; row 0 is the uppermost.
pub(super) struct Cells {
    pub(super) width: usize,
    pub(super) height: usize,
    occupied: Vec<bool>,
    /// For each corner of cells, how many occupied ones lie above and to the left.
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
    pub(super) fn new(grey: &Grey, is_occupied: impl Fn(u8) -> bool) -> Self {
        let Grey { width, height, ref values } = *grey;
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

    /// Whether no cell within `reach` is occupied, and none of them lies beyond the map.
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

    /// Whether nothing is occupied.
    pub(super) fn is_empty(&self) -> bool {
        self.sums.last() == Some(&0)
    }

    /// Which cells can be reached from beyond the map, row by row.
    pub(super) fn outside(&self) -> Vec<bool> {
        let (width, height) = (self.width, self.height);
        let mut outside = vec![false; self.occupied.len()];
        let on_border = |at: usize| {
            let (row, column) = (at / width, at % width);
            row == 0 || column == 0 || row + 1 == height || column + 1 == width
        };
        let free = |at: &usize| self.occupied.get(*at) == Some(&false);
        let mut next: Vec<usize> =
            (0..self.occupied.len()).filter(|at| on_border(*at)).filter(free).collect();
        while let Some(at) = next.pop() {
            let Some(known) = outside.get_mut(at).filter(|known| !**known) else { continue };
            *known = true;
            let column = at % width;
            let left = (column > 0).then(|| at - 1);
            let right = (column + 1 < width).then_some(at + 1);
            let beside = [left, right, at.checked_sub(width), Some(at + width)];
            next.extend(beside.into_iter().flatten().filter(free));
        }
        outside
    }

    /// The occupied cells as boxes: each as wide as can be, then as high.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(rows: &[&str]) -> Cells {
        let values = rows.iter().flat_map(|row| row.bytes()).collect();
        Cells::new(&Grey { width: rows[0].len(), height: rows.len(), values }, |v| v == b'#')
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
}
