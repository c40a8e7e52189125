//! Reads a log, whole or cut short.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use afp_core::Instant;
use afp_session::{Datum, EventKind, Outlines, RunEvent, frames};
use mcap::records::Record;
use prost::Message;

use crate::error::LogError;
use crate::event::{decode, decode_value, instant};
use crate::names::LogNames;
use crate::proto::afp::{Configuration, Entry, PlanEvent, PlanTable, Sample};
use crate::proto::foxglove::{
    CompressedImage, FrameTransform, FrameTransforms, LaserScan, Pose, PoseInFrame, Quaternion,
    SceneEntity, SceneUpdate, Vector3,
};
use crate::recover::{Missing, RECOVERED, missing};
use crate::robot::Pose2;
use crate::scan::{load, scan};

/// Contents of a log.
#[derive(Clone, Debug, Default)]
pub struct LogData {
    /// The metadata record `afp.run`.
    pub facts: BTreeMap<String, String>,
    /// The attachments that are text, by name.
    pub attachments: BTreeMap<String, String>,
    /// The results of a finished run: its metadata record `afp.end`.
    pub end: BTreeMap<String, String>,
    /// The plan's components; the names of its entries are in the events.
    pub names: LogNames,
    /// The events, in order.
    pub events: Vec<RunEvent>,
    /// The configuration at the start, after each commit, and after a loss.
    pub configurations: Vec<Configured>,
    /// The samples of devices, by `DEVICE/SIGNAL`, at each change; unset when a device becomes
    /// silent.
    pub samples: BTreeMap<String, Vec<(Instant, Datum)>>,
    /// The robot's poses.
    pub poses: Vec<(Instant, Pose2)>,
    /// The last positions of objects in the room.
    pub things: Outlines,
    /// The estimates of the robot's odometry.
    pub believed: Vec<(Instant, Pose2)>,
    /// The readings of range sensors.
    pub rangings: Vec<Heard>,
    /// The camera's pictures: time, and the picture as a PNG file.
    pub images: Vec<(Instant, Vec<u8>)>,
    /// The channels by topic.
    pub topics: BTreeMap<String, TopicInfo>,
    /// The size of the file in bytes.
    pub bytes: u64,
    /// The first and the last message.
    pub span: Option<(Instant, Instant)>,
    /// The reason why the log ends early, or its missing part.
    pub cut_short: Option<String>,
    /// The periods with missing messages in a recovered log, in order.
    pub missing: Vec<Missing>,
}

/// The values of all entries after a commit.
#[derive(Clone, Debug, PartialEq)]
pub struct Configured {
    /// The time.
    pub at: Instant,
    /// The author, or `outside`; empty at the start and after a loss.
    pub author: String,
    /// The paths of the entries and their values.
    pub entries: Vec<(String, Datum)>,
}

/// A reading of a range sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Heard {
    /// The sensor's device name.
    pub device: Arc<str>,
    /// The time of the reading.
    pub at: Instant,
    /// The sensor's pose relative to the robot.
    pub pose: Pose2,
    /// Half the opening of the cone, radians.
    pub half_angle: f64,
    /// The range in metres; `None` without an echo.
    pub range: Option<f64>,
}

/// The description of a channel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TopicInfo {
    /// The name of its schema.
    pub schema: String,
    /// The number of its messages.
    pub messages: u64,
}

/// Reads the log of a run. A truncated log returns its intact part.
///
/// # Errors
/// The file cannot be opened, is not an MCAP file, is not the log of a run, or has an unsupported
/// compression.
pub fn read(path: &Path) -> Result<LogData, LogError> {
    let (mut log, says_run) = read_all(path)?;
    // The description of the run comes first.
    let begun = log.cut_short.is_none() || !log.topics.is_empty();
    match says_run || !begun {
        true => {
            log.note_missing();
            Ok(log)
        }
        false => Err(LogError::NoRun { path: path.to_owned() }),
    }
}

/// Like [`read`], for any MCAP file.
///
/// # Errors
/// Those of [`read`], except that the file may have any contents.
pub fn read_any(path: &Path) -> Result<LogData, LogError> {
    let (mut log, _) = read_all(path)?;
    log.note_missing();
    Ok(log)
}

pub(crate) fn read_all(path: &Path) -> Result<(LogData, bool), LogError> {
    let bytes = load(path)?;
    let mut reader = Reader::default();
    let scanned = scan(&bytes, |record| {
        reader.take(record);
        Ok(())
    });
    let mut log = reader.log;
    log.bytes = bytes.len() as u64;
    log.missing.sort();
    if let Err(error) = scanned {
        let cut = match (reader.footer, error) {
            (_, error @ LogError::Compressed(_)) => return Err(error),
            (false, LogError::Mcap(mcap::McapError::UnexpectedEof)) => {
                "it has no footer: the run ended before the log was closed".to_owned()
            }
            (_, error) => error.to_string(),
        };
        log.cut_short.get_or_insert(cut);
    }
    Ok((log, reader.says_run))
}

impl LogData {
    /// Number of records lost during writing.
    pub fn lost(&self) -> u64 {
        let lost = |event: &RunEvent| match event.kind {
            EventKind::Lost(count) => count,
            _ => 0,
        };
        self.events.iter().map(lost).sum()
    }

    /// Notes the messages that were lost before the recovery.
    fn note_missing(&mut self) {
        let stretches: Vec<_> = self.missing.iter().map(Missing::to_string).collect();
        if !stretches.is_empty() {
            let stretches = stretches.join(" and ");
            let said = format!("it was recovered, and lacks the messages {stretches}");
            self.cut_short.get_or_insert(said);
        }
    }
}

/// The values of all entries in a message of `/plan/configuration`; `None` for other bytes.
pub fn configuration(bytes: &[u8]) -> Option<Configured> {
    Configuration::decode(bytes).ok().map(configured)
}

#[derive(Default)]
struct Reader {
    log: LogData,
    schemas: BTreeMap<u16, String>,
    channels: BTreeMap<u16, (String, String)>,
    /// Whether the log describes its run.
    says_run: bool,
    footer: bool,
}

impl Reader {
    fn take(&mut self, record: Record<'_>) {
        match record {
            Record::Schema { header, .. } => {
                self.schemas.insert(header.id, header.name);
            }
            Record::Channel(channel) => {
                let schema = self.schemas.get(&channel.schema_id).cloned().unwrap_or_default();
                let topic = self.log.topics.entry(channel.topic.clone()).or_default();
                topic.schema.clone_from(&schema);
                self.channels.insert(channel.id, (channel.topic, schema));
            }
            Record::Message { header, data } => {
                let Some((topic, schema)) = self.channels.get(&header.channel_id).cloned() else {
                    return;
                };
                if let Some(info) = self.log.topics.get_mut(&topic) {
                    info.messages += 1;
                }
                let at = Instant::from_nanos(header.log_time);
                let (first, last) = self.log.span.unwrap_or((at, at));
                self.log.span = Some((first.min(at), last.max(at)));
                if let Err(error) = self.message(&topic, &schema, at, &data) {
                    let said = format!("a message on {topic} does not decode: {error}");
                    self.log.cut_short.get_or_insert(said);
                }
            }
            Record::Metadata(metadata) if metadata.name == "afp.run" => {
                self.says_run = true;
                self.log.facts = metadata.metadata;
            }
            Record::Metadata(metadata) if metadata.name == "afp.end" => {
                self.log.end = metadata.metadata;
            }
            Record::Metadata(metadata) if metadata.name == RECOVERED => {
                self.log.missing.extend(missing(&metadata.metadata));
            }
            Record::Attachment { header, data, .. } => {
                if let Ok(text) = String::from_utf8(data.into_owned()) {
                    self.log.attachments.insert(header.name, text);
                }
            }
            Record::Footer(_) => self.footer = true,
            _ => {}
        }
    }

    fn message(
        &mut self,
        topic: &str,
        schema: &str,
        at: Instant,
        data: &[u8],
    ) -> Result<(), prost::DecodeError> {
        match (topic, schema) {
            ("/plan/events", _) => self.log.events.push(decode(PlanEvent::decode(data)?)),
            ("/plan/configuration", _) => {
                self.log.configurations.push(configured(Configuration::decode(data)?));
            }
            ("/plan/table", _) => {
                self.log.names = LogNames(PlanTable::decode(data)?);
            }
            ("/robot/pose", _) => {
                let message = PoseInFrame::decode(data)?;
                self.log.poses.extend(pose(message.pose.as_ref()).map(|pose| (at, pose)));
            }
            ("/scene", _) => {
                let entities = SceneUpdate::decode(data)?.entities.into_iter();
                self.log.things.extend(entities.filter_map(rim));
            }
            ("/tf", _) => {
                let message = FrameTransforms::decode(data)?;
                let believed = |each: &&FrameTransform| each.child_frame_id == frames::BY_ODOMETRY;
                let believed = message.transforms.iter().find(believed).and_then(placed);
                self.log.believed.extend(believed.map(|pose| (at, pose)));
            }
            (_, "foxglove.LaserScan") => {
                let LaserScan { timestamp, pose: at, end_angle, ranges, .. } =
                    LaserScan::decode(data)?;
                self.log.rangings.extend(pose(at.as_ref()).map(|pose| Heard {
                    device: topic.strip_prefix("/robot/").unwrap_or(topic).into(),
                    at: instant(&timestamp),
                    pose,
                    half_angle: end_angle,
                    range: ranges.first().copied(),
                }));
            }
            (_, "foxglove.CompressedImage") => {
                let CompressedImage { timestamp, data, .. } = CompressedImage::decode(data)?;
                self.log.images.push((instant(&timestamp), data));
            }
            (_, "afp.Sample") => {
                let Sample { value, .. } = Sample::decode(data)?;
                let name = topic.strip_prefix("/robot/").unwrap_or(topic).to_owned();
                let value = value.map_or(Datum::Unset, decode_value);
                self.log.samples.entry(name).or_default().push((at, value));
            }
            _ => {}
        }
        Ok(())
    }
}

fn configured(message: Configuration) -> Configured {
    let entry = |entry: Entry| (entry.name, entry.value.map_or(Datum::Unset, decode_value));
    Configured {
        at: instant(&message.time),
        author: message.author,
        entries: message.entries.into_iter().map(entry).collect(),
    }
}

fn pose(pose: Option<&Pose>) -> Option<Pose2> {
    let pose = pose?;
    plane(pose.position.as_ref()?, pose.orientation.as_ref()?)
}

/// The name of an entity of the scene, and its outline.
fn rim(entity: SceneEntity) -> Option<(String, Vec<[f64; 2]>)> {
    let rim = entity.lines.into_iter().next()?;
    Some((entity.id, rim.points.iter().map(|point| [point.x, point.y]).collect()))
}

fn placed(transform: &FrameTransform) -> Option<Pose2> {
    plane(transform.translation.as_ref()?, transform.rotation.as_ref()?)
}

fn plane(at: &Vector3, turned: &Quaternion) -> Option<Pose2> {
    let heading = 2.0 * libm::atan2(turned.z, turned.w);
    let whole = [at.x, at.y, heading].iter().all(|number| number.is_finite());
    whole.then_some(Pose2 { x: at.x, y: at.y, heading })
}
