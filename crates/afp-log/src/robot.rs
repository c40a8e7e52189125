//! What a log knows of robots and rooms: plain shapes, no robot's own types.
//!
//! Frames follow the usual convention: x forward, y left, z up, angles counter-clockwise, metres
//! and radians.

use afp_core::Instant;

/// The frame of a robot where its own odometry takes it to be.
pub const BELIEVED: &str = "base_link_by_odometry";

/// A place and a heading in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose2 {
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Radians.
    pub heading: f64,
}

/// Where one frame stands in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The frame that `pose` speaks in.
    pub parent: &'static str,
    /// The frame that it places.
    pub child: &'static str,
    /// The place of `child`.
    pub pose: Pose2,
    /// Its height in metres.
    pub height: f64,
}

/// One range reading of a sensor that sees a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ranging {
    /// When it was taken, which may be before it is known.
    pub time: Instant,
    /// The frame that `pose` speaks in.
    pub frame: &'static str,
    /// Where the sensor was and which way it looked.
    pub pose: Pose2,
    /// Half the cone's opening in radians.
    pub half_angle: f64,
    /// Metres; `None` when no echo came back.
    pub range: Option<f64>,
}

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

/// Something that stands in the room.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Unique name within the scene; a later shape of the same name replaces this one.
    pub id: String,
    /// The frame it stands in.
    pub frame: &'static str,
    /// Its outline in metres, counter-clockwise.
    pub outline: Vec<[f64; 2]>,
    /// From the floor, in metres.
    pub height: f64,
    /// Red, green, blue and opacity, each 0 to 1.
    pub color: [f64; 4],
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
