//! How the picture moves: the flow from one picture of the camera to the next.

use super::{Camera, Reading};
use afp_core::{Duration, Fault, Instant};

/// The places of a picture at which the flow is measured: columns and rows at equal distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// The pixel of the first place: its column and row.
    pub first: (usize, usize),
    /// Pixels from one place to the next, to the right and down.
    pub step: usize,
    /// Places a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
}

impl Grid {
    /// A grid has at most so many places: templates have room for them.
    pub const MOST: usize = 512;

    /// Places every `step` pixels, centred, none of them nearer than `margin` to the edge of a picture
    /// of this size. A `step` of 0 counts as 1.
    pub const fn new(width: usize, height: usize, step: usize, margin: usize) -> Self {
        let step = if step == 0 { 1 } else { step };
        let (first_x, columns) = spread(width, step, margin);
        let (first_y, rows) = spread(height, step, margin);
        Grid { first: (first_x, first_y), step, columns, rows }
    }

    /// How many places there are.
    pub const fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The pixel of the `n`-th place, row by row from the top left: its column and row.
    pub const fn pixel(&self, n: usize) -> (usize, usize) {
        let columns = if self.columns == 0 { 1 } else { self.columns };
        (self.first.0 + n % columns * self.step, self.first.1 + n / columns * self.step)
    }
}

/// The first place and how many there are, along one side of a picture.
const fn spread(size: usize, step: usize, margin: usize) -> (usize, usize) {
    match size.checked_sub(2 * margin + 1) {
        Some(room) => (margin + room % step / 2, room / step + 1),
        None => (margin, 0),
    }
}

/// How far what was at a place has moved, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shift {
    /// To the right.
    pub right: f32,
    /// Down.
    pub down: f32,
}

/// The flow from one picture to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow<'a> {
    /// Where it is measured, in the earlier picture.
    pub grid: Grid,
    /// What has happened to each place; none where that cannot be told: too little to be seen there, gone
    /// out of the picture, or hidden.
    pub shifts: &'a [Option<Shift>],
    /// The time from the earlier picture to the later one.
    pub span: Duration,
}

/// A camera that measures how its pictures move.
pub trait FlowCamera: Camera {
    /// The flow to the latest picture of which it is known; its time is that of the picture. Asking
    /// begins the computation for a newer picture, so who wants the flow asks at every poll.
    ///
    /// A camera that says the same picture over and over gives [`Invalid::Frozen`], never a flow
    /// without motion.
    ///
    /// # Errors
    /// The computation failed.
    ///
    /// [`Invalid::Frozen`]: super::Invalid::Frozen
    fn flow(&mut self, now: Instant) -> Result<Reading<Flow<'_>>, Fault>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_centred_and_keeps_its_margin() {
        let grid = Grid::new(160, 120, 8, 10);
        assert_eq!((grid.columns, grid.rows, grid.first), (18, 13, (11, 11)));
        assert_eq!(grid.pixel(0), (11, 11));
        assert_eq!(grid.pixel(grid.len() - 1), (147, 107));
    }

    #[test]
    fn a_picture_smaller_than_its_margins_has_no_places() {
        assert!(Grid::new(20, 120, 8, 10).is_empty());
        assert_eq!(Grid::new(21, 21, 8, 10).len(), 1);
        assert_eq!(Grid::new(3, 1, 0, 0).len(), 3);
    }
}
