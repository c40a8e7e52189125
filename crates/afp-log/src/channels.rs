//! The channels of a log: their topics and schemas, and the messages of the robot's channels.
//!
//! A new channel needs a variant of [`Said`], a method of [`crate::Recorder`], its call in
//! [`crate::SessionLog`], and, if something reads it, an arm in `read.rs`.

use afp_core::Instant;
use afp_session::Datum;
use prost::Message;

use crate::proto::afp::Sample;
use crate::proto::{AFP_SET, FOXGLOVE_SET};
use crate::robot::{Image, Level, Pose2, Ranging, Shape, Transform};
use crate::{event, foxglove};

/// Frames in one message of [`Recorder::transforms`](crate::Recorder::transforms).
pub const FRAMES: usize = 4;

/// A channel by the names of its device and its signal; by its topic if it has no device.
pub(crate) type Key = (&'static str, &'static str);

/// A channel, its schema, and the descriptors that explain the schema.
pub(crate) type Channel = (Key, &'static str, &'static [u8]);

pub(crate) const EVENTS: Channel = (("", "/plan/events"), "afp.PlanEvent", AFP_SET);
pub(crate) const CONFIGURATION: Channel =
    (("", "/plan/configuration"), "afp.Configuration", AFP_SET);
pub(crate) const TABLE: Channel = (("", "/plan/table"), "afp.PlanTable", AFP_SET);
const TRANSFORMS: Channel = (("", "/tf"), "foxglove.FrameTransforms", FOXGLOVE_SET);
const POSE: Channel = (("", "/robot/pose"), "foxglove.PoseInFrame", FOXGLOVE_SET);
const SCENE: Channel = (("", "/scene"), "foxglove.SceneUpdate", FOXGLOVE_SET);
const TEXT: Channel = (("", "/log"), "foxglove.Log", FOXGLOVE_SET);

pub(crate) const ALWAYS: [Channel; 7] =
    [EVENTS, CONFIGURATION, TABLE, TRANSFORMS, POSE, SCENE, TEXT];

pub(crate) fn topic(key: Key) -> String {
    match key {
        ("", topic) => topic.to_owned(),
        (device, "") => format!("/robot/{device}"),
        ("robot", name) => format!("/robot/{name}"),
        (device, name) => format!("/robot/{device}/{name}"),
    }
}

/// A device's signal with its own channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Signal {
    /// The device.
    pub device: &'static str,
    /// The signal.
    pub name: &'static str,
    /// Its SI unit; empty without a unit.
    pub unit: &'static str,
}

/// A message on a channel of the robot or its world.
pub(crate) enum Said {
    Transforms([Option<Transform>; FRAMES]),
    Pose { frame: &'static str, pose: Pose2 },
    Ranging { device: &'static str, ranging: Ranging, height: f64 },
    Image { device: &'static str, image: Image },
    Sample { signal: Signal, value: Datum },
    Scene(Box<[Shape]>),
    Text { level: Level, name: &'static str, text: Box<str> },
}

impl Said {
    pub(crate) fn channel(&self) -> Channel {
        match *self {
            Said::Transforms(_) => TRANSFORMS,
            Said::Pose { .. } => POSE,
            Said::Ranging { device, .. } => ((device, ""), "foxglove.LaserScan", FOXGLOVE_SET),
            Said::Image { device, .. } => ((device, ""), "foxglove.CompressedImage", FOXGLOVE_SET),
            Said::Sample { signal, .. } => ((signal.device, signal.name), "afp.Sample", AFP_SET),
            Said::Scene(_) => SCENE,
            Said::Text { .. } => TEXT,
        }
    }

    /// Replaces the content of a buffer by the message.
    pub(crate) fn encode(self, at: Instant, buffer: &mut Vec<u8>) {
        match self {
            Said::Transforms(transforms) => fill(buffer, &foxglove::transforms(at, &transforms)),
            Said::Pose { frame, pose } => fill(buffer, &foxglove::pose(at, frame, pose)),
            Said::Ranging { ranging, height, .. } => {
                fill(buffer, &foxglove::ranging(&ranging, height));
            }
            Said::Image { image, .. } => fill(buffer, &foxglove::image(&image)),
            Said::Sample { signal, value } => {
                let (time, unit) = (Some(event::timestamp(at)), signal.unit.to_owned());
                let value = Some(event::encode_value(value));
                fill(buffer, &Sample { time, value, unit });
            }
            Said::Scene(shapes) => fill(buffer, &foxglove::scene(at, &shapes)),
            Said::Text { level, name, text } => {
                fill(buffer, &foxglove::text(at, level, name, &text));
            }
        }
    }
}

/// Replaces the content of a buffer by a message.
pub(crate) fn fill(buffer: &mut Vec<u8>, message: &impl Message) {
    buffer.clear();
    buffer.resize(message.encoded_len(), 0);
    // Into a slice, because a vector would grow byte by byte. The slice has the right length.
    let _ = message.encode(&mut buffer.as_mut_slice());
}
