//! Finds an object in a picture.

use crate::devices::{Frame, Lens};
use crate::objects::Appearance;
use afp_core::quantity::{Angle, Length};

/// Fewest pixels of an object; fewer are noise.
const FEWEST: usize = 24;
/// Fewest pixels of a column that belong to the object.
const COLUMN: usize = 2;
/// A gap of this many columns does not divide an object.
const GAP: usize = 2;

/// An object in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// Bearing to the left of the camera's axis.
    pub bearing: Angle,
    /// Distance of the foot from the camera along the floor; infinite if the foot is not below the
    /// horizon.
    pub distance: Length,
    /// Number of pixels of the object.
    pub pixels: usize,
}

/// Neighbouring columns that show the object.
#[derive(Clone, Copy, Debug, Default)]
struct Blob {
    pixels: usize,
    /// Sum of the columns of all pixels.
    columns: usize,
    /// Number of columns, and the sum of their lowest rows.
    wide: usize,
    feet: usize,
}

impl Appearance {
    /// The largest object of these colours in a picture.
    ///
    /// Reads every pixel once and allocates nothing.
    pub fn find(&self, frame: &Frame<'_>, lens: &Lens) -> Option<Sighting> {
        let (mut best, mut open, mut gap) = (Blob::default(), Blob::default(), 0);
        for x in 0..frame.width {
            let is_own = |y: &usize| frame.pixel(x, *y).is_some_and(|pixel| self.has(pixel));
            let rows = (0..frame.height).filter(is_own);
            let (pixels, foot) = rows.fold((0, 0), |(pixels, _), y| (pixels + 1, y));
            if pixels < COLUMN {
                gap += 1;
                open = if gap > GAP { Blob::default() } else { open };
                continue;
            }
            gap = 0;
            open.pixels += pixels;
            open.columns += pixels * x;
            open.wide += 1;
            open.feet += foot;
            best = if open.pixels > best.pixels { open } else { best };
        }
        (best.pixels >= FEWEST).then(|| best.sighting(frame, lens))
    }
}

impl Blob {
    fn sighting(&self, frame: &Frame<'_>, lens: &Lens) -> Sighting {
        let column = self.columns as f64 / self.pixels as f64;
        // The foot is the lower edge of the lowest row.
        let foot = self.feet as f64 / self.wide as f64 + 1.0;
        let right = column + 0.5 - frame.width as f64 / 2.0;
        let down = foot - frame.height as f64 / 2.0;
        let (focus, height) = (lens.focus(), lens.height.si());
        let distance = if down > 0.0 { height * focus / down } else { f64::INFINITY };
        Sighting {
            bearing: Angle::from_si(libm::atan2(-right, focus)),
            distance: Length::from_si(distance),
            pixels: self.pixels,
        }
    }
}
