//! What moves by itself in one flow.

use crate::devices::{Flow, Grid, Lens};
use crate::helpers::own_motion::Step;
use afp_core::{Fault, Reason};

/// This many places that move side by side are something.
const SOMETHING: usize = 4;
/// The robot's own motion is known to this share.
const DOUBT: f64 = 0.1;
/// What the flow may be wrong by at any place, pixels.
const BLUR: f64 = 0.25;
/// The grid has more places than there is room for.
pub(super) const TOO_MANY_PLACES: Fault = Fault::new(&Reason {
    code: "too-many-places",
    text: "the flow has more than 512 places: the camera's driver measures it at fewer",
});

/// A flow and what the robot did meanwhile.
pub(super) struct View<'a> {
    pub(super) lens: Lens,
    pub(super) step: Step,
    pub(super) flow: Flow<'a>,
    /// What is slower than this across the line of sight does not count, radians a second.
    pub(super) speed: f64,
}

/// Something that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Something {
    /// Radians to the left of the robot's heading.
    pub(super) bearing: f64,
    /// The share of the picture's places that it covers.
    pub(super) strength: f64,
}

impl View<'_> {
    /// The largest of the things that move, none if there is none.
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

    /// Where the `n`-th place is against the middle of the picture, pixels to the right and down.
    fn middle(&self, n: usize) -> [f64; 2] {
        let (x, y) = self.flow.grid.pixel(n);
        let off = |at: usize, size: usize| at as f64 + 0.5 - size as f64 / 2.0;
        [off(x, self.lens.columns), off(y, self.lens.rows)]
    }

    /// Whether the `n`-th place moves by itself.
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

    /// Takes the open places that hang together with `first`: how many, and the sum of their columns
    /// against the middle.
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
