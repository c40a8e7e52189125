//! Robots and worlds in a log: plain shapes, no robot's own types.
//!
//! Frames follow the usual convention: x forward, y left, z up, angles counter-clockwise, metres
//! and radians.

use afp_core::Instant;
pub use afp_session::{Pose2, Ranging, Shape, Transform};

/// A picture of a camera.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// When it was taken.
    pub time: Instant,
    /// The frame of the camera.
    pub frame: &'static str,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Red, green and blue of each pixel, row by row.
    pub rgb: Box<[u8]>,
}

/// How serious a line of text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// For the record.
    Info,
    /// Something is not as it should be.
    Warning,
    /// Something failed.
    Error,
}
