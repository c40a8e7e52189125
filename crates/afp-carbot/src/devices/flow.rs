//! Optical flow between two pictures of the camera.

use super::{Camera, Reading};
use afp_core::{Duration, Fault, Instant};

/// The places at which the flow is measured: equidistant columns and rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Column and row of the first place, in pixels.
    pub first: (usize, usize),
    /// Distance between places to the right and down, in pixels.
    pub step: usize,
    /// Places per row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
}

impl Grid {
    /// Upper bound of the number of places; templates reserve memory for it.
    pub const MOST: usize = 512;

    /// Places every `step` pixels, centred, with at least `margin` pixels to the picture's edges. A
    /// `step` of 0 counts as 1.
    pub const fn new(width: usize, height: usize, step: usize, margin: usize) -> Self {
        let step = if step == 0 { 1 } else { step };
        let (first_x, columns) = spread(width, step, margin);
        let (first_y, rows) = spread(height, step, margin);
        Grid { first: (first_x, first_y), step, columns, rows }
    }

    /// The number of places.
    pub const fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Whether there are no places.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Column and row of the `n`-th place, in pixels; places count row by row from the top left.
    pub const fn pixel(&self, n: usize) -> (usize, usize) {
        let columns = if self.columns == 0 { 1 } else { self.columns };
        (self.first.0 + n % columns * self.step, self.first.1 + n / columns * self.step)
    }
}

/// The first place and the number of places along one side of a picture.
const fn spread(size: usize, step: usize, margin: usize) -> (usize, usize) {
    match size.checked_sub(2 * margin + 1) {
        Some(room) => (margin + room % step / 2, room / step + 1),
        None => (margin, 0),
    }
}

/// Displacement of a place, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shift {
    /// To the right.
    pub right: f32,
    /// Down.
    pub down: f32,
}

/// The flow between two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow<'a> {
    /// The places, in the earlier picture.
    pub grid: Grid,
    /// The displacement of each place; `None` if unknown: too little texture, out of the picture,
    /// or hidden.
    pub shifts: &'a [Option<Shift>],
    /// Time between the pictures.
    pub span: Duration,
}

/// A camera that measures optical flow.
pub trait FlowCamera: Camera {
    /// The flow to the latest processed picture; the reading's time is that picture's time. The
    /// call also starts the computation for a newer picture, so call it at every poll.
    ///
    /// A camera that repeats the same picture gives [`Invalid::Frozen`], never a flow without
    /// motion.
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
