//! Optical flow: the motion of a camera's pictures, computed as a job.
//!
//! ```text
//!   Frame ──grey──▶ the last two pictures ──copied──▶ FlowJob ──OpticalFlow──▶ shifts on a grid
//!             in FlowSensor::look, at a poll          on a worker
//! ```
//!
//! [`OpticalFlow`] is the interface of methods. [`LucasKanade`] is available on every platform, in
//! fixed point and therefore bit-identical everywhere. `OpenCv` needs the feature `opencv`.

mod job;
mod lucas_kanade;
#[cfg(feature = "opencv")]
mod opencv;
mod picture;
mod sensor;

pub use job::FlowJob;
pub use lucas_kanade::LucasKanade;
#[cfg(feature = "opencv")]
pub use opencv::OpenCv;
pub use picture::Picture;
pub use sensor::FlowSensor;

use afp_carbot::devices::{Grid, Shift};
use afp_core::{Fault, Reason};

/// A way to compute the flow from one picture to the next.
///
/// ```
/// use afp_carbot::devices::{Grid, Shift};
/// use afp_core::Fault;
/// use afp_navigation::flow::{BAD_PICTURES, OpticalFlow, Picture};
///
/// /// A way for tests: nothing ever moves.
/// struct Still;
///
/// impl OpticalFlow for Still {
///     fn flow(
///         &mut self,
///         before: &Picture,
///         after: &Picture,
///         _: &Grid,
///         shifts: &mut [Option<Shift>],
///     ) -> Result<(), Fault> {
///         if before.grey().len() != after.grey().len() {
///             return Err(BAD_PICTURES);
///         }
///         shifts.fill(Some(Shift { right: 0.0, down: 0.0 }));
///         Ok(())
///     }
/// }
/// ```
pub trait OpticalFlow: Send + 'static {
    /// Writes the shift from `before` to `after` at each place of the grid, or `None` if it is
    /// unknown. Pictures have the same size, and `shifts` has an element for each place.
    ///
    /// # Errors
    /// [`BAD_PICTURES`], or the method's own fault.
    fn flow(
        &mut self,
        before: &Picture,
        after: &Picture,
        grid: &Grid,
        shifts: &mut [Option<Shift>],
    ) -> Result<(), Fault>;
}

impl OpticalFlow for Box<dyn OpticalFlow> {
    fn flow(
        &mut self,
        before: &Picture,
        after: &Picture,
        grid: &Grid,
        shifts: &mut [Option<Shift>],
    ) -> Result<(), Fault> {
        (**self).flow(before, after, grid, shifts)
    }
}

/// Two pictures do not fit each other or the grid.
pub const BAD_PICTURES: Fault = Fault::new(&Reason {
    code: "bad-pictures",
    text: "two pictures of the camera differ in size, or are smaller than the grid of the flow",
});

/// The side of a Lucas-Kanade window, in pixels.
const WINDOW: usize = 15;
/// The number of picture sizes, each half of the previous one, so that fast motion is found.
const LEVELS: usize = 3;
/// The minimum variation of a usable window: the smaller eigenvalue of its gradients, in grey
/// levels a pixel squared. The camera's grain stays below it.
const DULL: f32 = 4.0;
/// The maximum distance between a place and the end of its path there and back, in pixels.
const RETURN: f32 = 0.5;
/// The maximum number of steps towards the best match on each size of the picture.
const STEPS: usize = 20;

/// The minimum distance between places, in pixels.
const STRIDE: usize = 8;

/// The grid for the flow of a picture of this size: every 8 pixels, or in a larger picture as dense
/// as [`Grid::MOST`] allows.
pub const fn grid(width: usize, height: usize) -> Grid {
    let mut stride = STRIDE;
    loop {
        let grid = Grid::new(width, height, stride, WINDOW / 2 + 2);
        if grid.len() <= Grid::MOST {
            return grid;
        }
        stride += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_covers_every_picture_within_the_limit_of_places() {
        for (width, height) in [(160, 120), (320, 240), (640, 480), (1920, 1080), (4000, 30)] {
            let grid = grid(width, height);
            assert!(grid.len() > 200 && grid.len() <= Grid::MOST, "{width} {height}: {grid:?}");
            let (x, y) = grid.pixel(grid.len() - 1);
            assert!(x + grid.first.0 + 1 >= width - 1, "{width} {height}: {grid:?}");
            assert!(y + grid.first.1 + 1 >= height - 1, "{width} {height}: {grid:?}");
        }
        assert_eq!(grid(160, 120).step, STRIDE);
    }
}
