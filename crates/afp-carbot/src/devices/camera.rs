//! The forward camera.

use super::Reading;
use afp_core::quantity::{Angle, Length};

/// A picture, owned by the driver until the next picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Pixels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green and blue of each pixel, row by row from the top left: `3 * width * height` bytes.
    pub rgb: &'a [u8],
    /// Picture number from 1; a lost picture leaves a gap.
    pub number: u64,
}

impl Frame<'_> {
    /// Red, green and blue of the pixel in column `x` of row `y`; `None` outside the picture.
    pub fn pixel(&self, x: usize, y: usize) -> Option<[u8; 3]> {
        if x >= self.width {
            return None;
        }
        let first = y.checked_mul(self.width)?.checked_add(x)?.checked_mul(3)?;
        self.rgb.get(first..)?.first_chunk().copied()
    }
}

/// Mounting and field of view of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Distance of the camera in front of the turning centre.
    pub forward: Length,
    /// Height of the camera above the floor. It looks ahead, level.
    pub height: Length,
    /// Horizontal field of view, the whole angle; pixels are square.
    pub opening: Angle,
    /// Pixels per row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
}

impl Lens {
    /// The focal length in pixels.
    pub fn focus(&self) -> f64 {
        self.columns as f64 / 2.0 / libm::tan(self.opening.si() / 2.0)
    }
}

/// A camera that takes pictures at its own rate.
pub trait Camera {
    /// The latest picture; its time is the time of exposure.
    fn frame(&self) -> Reading<Frame<'_>>;

    /// Mounting and field of view.
    fn lens(&self) -> Lens;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_outside_of_the_picture_has_no_colour() {
        let frame = Frame { width: 2, height: 1, rgb: &[1, 2, 3, 4, 5, 6], number: 1 };
        assert_eq!(frame.pixel(1, 0), Some([4, 5, 6]));
        assert_eq!(frame.pixel(2, 0), None);
        assert_eq!(frame.pixel(0, 1), None);
        assert_eq!(frame.pixel(0, usize::MAX), None);
    }
}
