//! Flow after Lucas and Kanade, in pure Rust.
//!
//! Windows are matched from small pictures to large ones, there and back (Bouguet, "Pyramidal
//! implementation of the Lucas Kanade feature tracker", 2000; Kalal et al., "Forward-backward error",
//! 2010).

use super::{BAD_PICTURES, DULL, LEVELS, OpticalFlow, Picture, RETURN, STEPS, WINDOW};
use afp_carbot::devices::{Grid, Shift};
use afp_core::Fault;
use image::GrayImage;
use optical_flow_lk::{
    TrackKernel, TrackOptions, TrackParams, TrackStatus, TrackerCapacity, TrackerContext,
};

/// The result is bit-identical on every target.
const OPTIONS: TrackOptions = TrackOptions::new().with_kernel(TrackKernel::FixedPoint);

const PARAMETERS: TrackParams =
    TrackParams { window_size: WINDOW, max_iterations: STEPS, min_eigen_threshold: DULL };

/// Pyramidal Lucas-Kanade with its buffers.
pub struct LucasKanade {
    tracker: TrackerContext,
    pictures: [GrayImage; 2],
    places: Vec<(f32, f32)>,
}

impl LucasKanade {
    /// Creates buffers for pictures of this size; other sizes allocate.
    pub fn new(width: usize, height: usize) -> Self {
        let points = super::grid(width, height).len();
        let (width, height) = (width as u32, height as u32);
        let room = TrackerCapacity { width, height, levels: LEVELS, window_size: WINDOW, points };
        LucasKanade {
            tracker: TrackerContext::with_capacity(room),
            pictures: [(); 2].map(|()| GrayImage::new(width, height)),
            places: Vec::with_capacity(points),
        }
    }
}

impl Clone for LucasKanade {
    /// Creates new buffers: no state is kept between flows.
    fn clone(&self) -> Self {
        let (width, height) = self.pictures[0].dimensions();
        LucasKanade::new(width as usize, height as usize)
    }
}

impl OpticalFlow for LucasKanade {
    fn flow(
        &mut self,
        before: &Picture,
        after: &Picture,
        grid: &Grid,
        shifts: &mut [Option<Shift>],
    ) -> Result<(), Fault> {
        let [earlier, later] = &mut self.pictures;
        take(earlier, before)?;
        take(later, after)?;
        if earlier.dimensions() != later.dimensions() || shifts.len() != grid.len() {
            return Err(BAD_PICTURES);
        }
        self.tracker.prepare(earlier, later, LEVELS);
        self.places.clear();
        let place = |n| {
            let (x, y) = grid.pixel(n);
            (x as f32, y as f32)
        };
        self.places.extend((0..grid.len()).map(place));
        let tracked = self.tracker.track_fb_with(&self.places, None, PARAMETERS, RETURN, OPTIONS);
        for ((shift, result), (x, y)) in shifts.iter_mut().zip(tracked).zip(&self.places) {
            *shift = (result.status == TrackStatus::Tracked)
                .then_some(Shift { right: result.pos.0 - x, down: result.pos.1 - y });
        }
        Ok(())
    }
}

/// Copies a picture into the library's type.
fn take(image: &mut GrayImage, picture: &Picture) -> Result<(), Fault> {
    let (width, height) = (picture.width() as u32, picture.height() as u32);
    if image.dimensions() == (width, height) {
        image.copy_from_slice(picture.grey());
    } else {
        let grey = picture.grey().to_vec();
        *image = GrayImage::from_raw(width, height, grey).ok_or(BAD_PICTURES)?;
    }
    Ok(())
}
