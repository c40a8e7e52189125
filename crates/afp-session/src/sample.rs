//! Signals of a robot as samples: values of the language, and types for logs and pictures only.
//!
//! Frames follow the usual convention: x forward, y left, z up, angles counter-clockwise, metres
//! and radians.

use afp_core::devices::SignalType;
use afp_core::{Duration, Instant, Text};

use crate::datum::Datum;

/// The interval of camera pictures in a log.
pub const FILM: Duration = Duration::from_millis(500);

/// Frames of any robot in logs and pictures.
pub mod frames {
    /// The frame of the world.
    pub const WORLD: &str = "world";
    /// The true pose of the robot.
    pub const BODY: &str = "base_link";
    /// The pose of the robot by its odometry.
    pub const BY_ODOMETRY: &str = "base_link_by_odometry";
    /// The pose of the robot by its localisation on a map.
    pub const BY_LOCALISATION: &str = "base_link_by_localisation";
}

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

impl Pose2 {
    /// Converts a pose relative to this pose (a motion from here, a sensor on the robot) to the
    /// frame of this pose.
    pub fn beyond(self, moved: Pose2) -> Pose2 {
        let (sin, cos) = libm::sincos(self.heading);
        Pose2 {
            x: self.x + moved.x * cos - moved.y * sin,
            y: self.y + moved.x * sin + moved.y * cos,
            heading: self.heading + moved.heading,
        }
    }

    /// Converts a pose in the frame of this pose to a pose relative to this pose, the inverse of
    /// [`Pose2::beyond`].
    pub fn to(self, pose: Pose2) -> Pose2 {
        let (sin, cos) = libm::sincos(self.heading);
        let (x, y) = (pose.x - self.x, pose.y - self.y);
        let heading = pose.heading - self.heading;
        Pose2 { x: x * cos + y * sin, y: y * cos - x * sin, heading }
    }

    /// The pose at an instant, interpolated between one before and one after it; beyond both, the
    /// nearer one.
    pub fn between(before: (Instant, Pose2), after: (Instant, Pose2), at: Instant) -> Pose2 {
        let ((from, before), (to, after)) = (before, after);
        let whole = to.since(from).as_secs_f64();
        let share = if whole > 0.0 { (at.since(from).as_secs_f64() / whole).min(1.0) } else { 1.0 };
        // The shorter turn.
        let turn = libm::remainder(after.heading - before.heading, std::f64::consts::TAU);
        let part = |from: f64, to: f64| from + (to - from) * share;
        Pose2 {
            x: part(before.x, after.x),
            y: part(before.y, after.y),
            heading: before.heading + turn * share,
        }
    }
}

/// The pose of a frame in another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The frame of `pose`.
    pub parent: &'static str,
    /// The frame at `pose`.
    pub child: &'static str,
    /// The pose of `child`.
    pub pose: Pose2,
    /// Its height in metres.
    pub height: f64,
}

/// A range reading of a sensor with a cone of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ranging {
    /// The time of the measurement, which may be before it is known.
    pub time: Instant,
    /// The frame of `pose`.
    pub frame: &'static str,
    /// The pose of the sensor.
    pub pose: Pose2,
    /// Half the cone's opening in radians.
    pub half_angle: f64,
    /// Metres; `None` without an echo.
    pub range: Option<f64>,
}

/// A picture of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Image<'a> {
    /// The time of the picture.
    pub time: Instant,
    /// The frame of the camera.
    pub frame: &'static str,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Red, green and blue of each pixel, row by row.
    pub rgb: &'a [u8],
}

/// A thing in the room.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Unique in the scene; a later shape with the same id replaces this one.
    pub id: String,
    /// The frame of the outline.
    pub frame: &'static str,
    /// Its outline in metres, counter-clockwise.
    pub outline: Vec<[f64; 2]>,
    /// From the floor, in metres.
    pub height: f64,
    /// Red, green, blue and opacity, each 0 to 1.
    pub color: [f64; 4],
}

/// The value of a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SampleRef<'a> {
    /// A truth value.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number in the unit of its row.
    Float(f64),
    /// A text.
    Text(&'a str),
    /// The pose of a frame.
    Pose(Transform),
    /// A reading of a range sensor.
    Range(Ranging),
    /// A picture.
    Image(Image<'a>),
    /// The outline of a moving thing.
    Outline(&'a Shape),
}

macro_rules! from_values {
    ($($value:ty => $kind:ident,)*) => {$(
        impl<'a> From<$value> for SampleRef<'a> {
            fn from(value: $value) -> Self {
                SampleRef::$kind(value)
            }
        }
    )*};
}

from_values! {
    bool => Bool,
    i64 => Int,
    f64 => Float,
    &'a str => Text,
}

impl SampleRef<'_> {
    /// The value in the language; `None` for types that only logs and pictures use.
    pub fn value(&self) -> Option<Datum> {
        match *self {
            SampleRef::Bool(truth) => Some(truth.into()),
            SampleRef::Int(number) => Some(number.into()),
            SampleRef::Float(number) => Some(number.into()),
            SampleRef::Text(text) => Some(Datum::Text(text.to_owned())),
            SampleRef::Pose(_)
            | SampleRef::Range(_)
            | SampleRef::Image(_)
            | SampleRef::Outline(_) => None,
        }
    }

    /// Whether it has a type.
    pub fn is(&self, ty: SignalType) -> bool {
        std::mem::discriminant(&self.ty()) == std::mem::discriminant(&ty)
    }

    /// Its type; without the unit of a number, which the row of the signal names.
    pub(crate) fn ty(&self) -> SignalType {
        match self {
            SampleRef::Bool(_) => SignalType::Bool,
            SampleRef::Int(_) => SignalType::Int,
            SampleRef::Float(_) => SignalType::Float(""),
            SampleRef::Text(_) => SignalType::Text,
            SampleRef::Pose(_) => SignalType::Pose,
            SampleRef::Range(_) => SignalType::Range,
            SampleRef::Image(_) => SignalType::Image,
            SampleRef::Outline(_) => SignalType::Outline,
        }
    }
}

/// An owned sample. Pictures, outlines and texts longer than an entry can hold are on the heap.
pub struct OwnedSample(Owned);

enum Owned {
    Bool(bool),
    Int(i64),
    Float(f64),
    Text(Text),
    LongText(Box<str>),
    Pose(Transform),
    Range(Ranging),
    /// The picture without its pixels, and its pixels.
    Image(Box<(Image<'static>, Vec<u8>)>),
    Outline(Box<Shape>),
}

impl OwnedSample {
    /// Copies a sample.
    pub fn new(value: SampleRef<'_>) -> Self {
        OwnedSample(match value {
            SampleRef::Bool(truth) => Owned::Bool(truth),
            SampleRef::Int(number) => Owned::Int(number),
            SampleRef::Float(number) => Owned::Float(number),
            SampleRef::Text(text) => match Text::try_from(text) {
                Ok(text) => Owned::Text(text),
                Err(_) => Owned::LongText(text.into()),
            },
            SampleRef::Pose(frame) => Owned::Pose(frame),
            SampleRef::Range(ranging) => Owned::Range(ranging),
            SampleRef::Image(image) => {
                Owned::Image(Box::new((Image { rgb: &[], ..image }, image.rgb.to_vec())))
            }
            SampleRef::Outline(shape) => Owned::Outline(Box::new(shape.clone())),
        })
    }

    /// The sample with borrowed values.
    pub fn get(&self) -> SampleRef<'_> {
        match &self.0 {
            Owned::Bool(truth) => SampleRef::Bool(*truth),
            Owned::Int(number) => SampleRef::Int(*number),
            Owned::Float(number) => SampleRef::Float(*number),
            Owned::Text(text) => SampleRef::Text(text),
            Owned::LongText(text) => SampleRef::Text(text),
            Owned::Pose(frame) => SampleRef::Pose(*frame),
            Owned::Range(ranging) => SampleRef::Range(*ranging),
            Owned::Image(image) => SampleRef::Image(Image { rgb: &image.1, ..image.0 }),
            Owned::Outline(shape) => SampleRef::Outline(shape),
        }
    }
}
