//! Moving objects in one flow.

use crate::devices::{Flow, Grid, Lens};
use crate::helpers::own_motion::Step;
use afp_core::{Fault, Reason};

/// Fewest adjacent moving places that make an object.
const SOMETHING: usize = 4;
/// Relative uncertainty of the robot's own motion.
const DOUBT: f64 = 0.1;
/// Uncertainty of the flow at any place, pixels.
const BLUR: f64 = 0.25;
/// The grid has more than [`Grid::MOST`] places.
pub(super) const TOO_MANY_PLACES: Fault = Fault::new(&Reason {
    code: "too-many-places",
    text: "the flow has more than 512 places: the camera's driver measures it at fewer",
});

/// A flow and the robot's motion meanwhile.
pub(super) struct View<'a> {
    pub(super) lens: Lens,
    pub(super) step: Step,
    pub(super) flow: Flow<'a>,
    /// Slower motion across the line of sight is ignored, radians a second.
    pub(super) speed: f64,
}

/// A moving object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Something {
    /// Radians to the left of the robot's heading.
    pub(super) bearing: f64,
    /// Share of the picture's places that it covers.
    pub(super) strength: f64,
}

impl View<'_> {
    /// The largest moving object.
    ///
    /// # Errors
    /// [`TOO_MANY_PLACES`] if the grid has more than [`Grid::MOST`].
    pub(super) fn largest(&self) -> Result<Option<Something>, Fault> {
        let places = self.flow.grid.len();
        if places > Grid::MOST {
            return Err(TOO_MANY_PLACES);
        }
        let mut open = [false; Grid::MOST];
        for (place, open) in open.iter_mut().enumerate().take(places) {
            *open = self.moves(place);
        }
        let (mut most, mut largest) = (SOMETHING - 1, None);
        for place in 0..places {
            if open[place] {
                let (size, columns) = self.gather(place, &mut open);
                if size > most {
                    (most, largest) = (size, Some(columns / size as f64));
                }
            }
        }
        Ok(largest.map(|column| Something {
            bearing: libm::atan2(-column, self.lens.focus()),
            strength: most as f64 / places as f64,
        }))
    }

    /// Position of the `n`-th place from the picture's centre, pixels to the right and down.
    fn middle(&self, n: usize) -> [f64; 2] {
        let (x, y) = self.flow.grid.pixel(n);
        let off = |at: usize, size: usize| at as f64 + 0.5 - size as f64 / 2.0;
        [off(x, self.lens.columns), off(y, self.lens.rows)]
    }

    /// Whether the `n`-th place moves independently of the robot.
    fn moves(&self, n: usize) -> bool {
        let Some(Some(shift)) = self.flow.shifts.get(n) else { return false };
        let place = self.middle(n);
        let found = [place[0] + f64::from(shift.right), place[1] + f64::from(shift.down)];
        let focus = self.lens.focus();
        let least = self.speed * self.flow.span.as_secs_f64() * focus;
        self.step
            .unexplained(&self.lens, focus, place, found)
            .is_some_and(|it| it.pixels > BLUR + least + DOUBT * it.explained)
    }

    /// Removes the open places connected with `first`. Returns their number and the sum of their
    /// columns from the centre.
    fn gather(&self, first: usize, open: &mut [bool; Grid::MOST]) -> (usize, f64) {
        let columns = self.flow.grid.columns.max(1);
        let (mut todo, mut left) = ([0_u16; Grid::MOST], 1);
        todo[0] = first as u16;
        open[first] = false;
        let (mut size, mut sum) = (0, 0.0);
        while left > 0 {
            left -= 1;
            let place = usize::from(todo[left]);
            (size, sum) = (size + 1, sum + self.middle(place)[0]);
            let (row, column) = (place / columns, place % columns);
            for row in row.saturating_sub(1)..=row + 1 {
                for column in column.saturating_sub(1)..=(column + 1).min(columns - 1) {
                    let next = row * columns + column;
                    if open.get(next).copied().unwrap_or(false) {
                        open[next] = false;
                        todo[left] = next as u16;
                        left += 1;
                    }
                }
            }
        }
        (size, sum)
    }
}
