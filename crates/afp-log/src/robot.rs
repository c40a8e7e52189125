//! Robots and worlds in a log: plain shapes, independent of any robot's types.
//!
//! Frames follow the usual convention: x forward, y left, z up, angles counter-clockwise, metres
//! and radians.

use afp_core::Instant;
pub use afp_session::{Pose2, Ranging, Shape, Transform};

/// A camera's picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// The time of the picture.
    pub time: Instant,
    /// The frame of the camera.
    pub frame: &'static str,
    /// Its width in pixels.
    pub width: u32,
    /// Its height in pixels.
    pub height: u32,
    /// Red, green and blue of each pixel, row by row.
    pub rgb: Box<[u8]>,
}

/// The level of a line of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Information.
    Info,
    /// A warning.
    Warning,
    /// An error.
    Error,
}
