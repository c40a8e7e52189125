//! What a map's `.yaml` file says.

use std::ops::Range;

use crate::world::WorldError;
use saphyr::{LoadableYamlNode, Yaml};

/// What is free where a map does not say from where on, as `map_server` has it.
const FREE: f64 = 0.196;

/// Where and how large the cells are, and which of them are occupied.
#[derive(Debug, PartialEq)]
pub(super) struct Settings {
    pub(super) image: String,
    /// The side of a cell, metres.
    pub(super) resolution: f64,
    /// The lower left corner of the picture, metres.
    origin: [f64; 2],
    /// How the picture is turned, radians.
    pub(super) yaw: f64,
    /// How greys are read.
    mode: Mode,
    /// White is occupied.
    negate: bool,
    /// More than this is occupied: 0 white, 1 black.
    threshold: f64,
    /// Less than this is known to be free.
    free: f64,
    /// What nobody knows is a wall.
    unknown_is_wall: bool,
}

/// What is known of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cell {
    Occupied,
    Free,
    Unknown,
}

/// How greys are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    /// By how dark they are; what is between the thresholds is unknown. So in mode `scale`, where it is a share that
    /// makes no wall.
    Dark,
    /// A value up to 100 says how occupied the cell is in percent, a larger one that nobody knows.
    Raw,
}

impl Settings {
    pub(super) fn read(yaml: &str) -> Result<Settings, WorldError> {
        let documents = Yaml::load_from_str(yaml).map_err(|error| {
            WorldError::new(Some(empty(byte(yaml, error.marker().index()))), error.info())
        })?;
        let keys = Keys { text: yaml, map: documents.first() };
        let image = keys.get("image").and_then(Yaml::as_str);
        let image = image.ok_or_else(|| keys.error("image", "is to name a picture"))?.to_owned();
        let modes = [("trinary", Mode::Dark), ("scale", Mode::Dark), ("raw", Mode::Raw)];
        let mode = keys.one_of("mode", &modes)?.unwrap_or(Mode::Dark);
        let unknown_is_wall =
            keys.one_of("unknown", &[("free", false), ("walls", true)])?.unwrap_or(false);
        let resolution = keys.number("resolution")?;
        if !(0.001..=10.0).contains(&resolution) {
            return Err(keys.error("resolution", "is not within 0.001 and 10 metres"));
        }
        let [x, y, yaw] = keys.origin()?;
        // Once for all who ask: of many turns each would find another rest.
        let yaw = yaw % core::f64::consts::TAU;
        let negate = match keys.get("negate") {
            None => false,
            Some(value) => value
                .as_bool()
                .or_else(|| value.as_integer().filter(|n| (0..=1).contains(n)).map(|n| n == 1))
                .ok_or_else(|| keys.error("negate", "is to be 0 or 1"))?,
        };
        let threshold = keys.share("occupied_thresh")?;
        let free = match keys.get("free_thresh") {
            Some(_) => keys.share("free_thresh")?,
            None => FREE.min(threshold),
        };
        if free > threshold {
            return Err(keys.error("free_thresh", "is more than 'occupied_thresh'"));
        }
        let origin = [x, y];
        Ok(Settings {
            image,
            resolution,
            origin,
            yaw,
            mode,
            negate,
            threshold,
            free,
            unknown_is_wall,
        })
    }

    /// What is known of a cell of this grey.
    pub(super) fn cell(&self, grey: u8) -> Cell {
        let occupied = match self.mode {
            Mode::Raw if grey > 100 => return Cell::Unknown,
            Mode::Raw => f64::from(grey) / 100.0,
            Mode::Dark => f64::from(if self.negate { grey } else { 255 - grey }) / 255.0,
        };
        if occupied > self.threshold {
            Cell::Occupied
        } else if occupied < self.free {
            Cell::Free
        } else {
            Cell::Unknown
        }
    }

    /// Whether a cell of this grey is a wall.
    pub(super) fn is_wall(&self, grey: u8) -> bool {
        match self.cell(grey) {
            Cell::Occupied => true,
            Cell::Free => false,
            Cell::Unknown => self.unknown_is_wall,
        }
    }

    /// A place of the picture, counted in cells from its lower left corner, in metres.
    pub(super) fn place(&self, across: f64, up: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.yaw);
        let [x, y] = [across, up].map(|cells| cells * self.resolution);
        [self.origin[0] + x * cos - y * sin, self.origin[1] + x * sin + y * cos]
    }
}

/// The keys of the file.
struct Keys<'a, 'b> {
    text: &'a str,
    map: Option<&'a Yaml<'b>>,
}

impl<'a, 'b> Keys<'a, 'b> {
    fn get(&self, key: &str) -> Option<&'a Yaml<'b>> {
        self.map?.as_mapping_get(key)
    }

    fn number(&self, key: &str) -> Result<f64, WorldError> {
        self.get(key).and_then(number).ok_or_else(|| self.error(key, "is to be a number"))
    }

    /// What a word stands for; none where the key is not there.
    fn one_of<T: Copy>(&self, key: &str, known: &[(&str, T)]) -> Result<Option<T>, WorldError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let word = value.as_str();
        if let Some((_, meant)) = known.iter().find(|(name, _)| Some(*name) == word) {
            return Ok(Some(*meant));
        }
        let names: Vec<_> = known.iter().map(|(name, _)| format!("'{name}'")).collect();
        let names = names.join(" or ");
        // A number, a list or nothing is no word that could be repeated.
        let what = match word {
            Some(word) => format!("'{word}' is not known; it is to be {names}"),
            None => format!("is to be {names}"),
        };
        Err(self.error(key, &what))
    }

    /// A number from 0 to 1.
    fn share(&self, key: &str) -> Result<f64, WorldError> {
        let share = self.number(key)?;
        match (0.0..=1.0).contains(&share) {
            true => Ok(share),
            false => Err(self.error(key, "is not within 0 and 1")),
        }
    }

    fn origin(&self) -> Result<[f64; 3], WorldError> {
        let values = self.get("origin").and_then(|origin| origin.as_vec());
        let numbers: Vec<f64> = values.into_iter().flatten().filter_map(number).collect();
        let wrong = |_| self.error("origin", "is to be three numbers: x, y and yaw");
        <[f64; 3]>::try_from(numbers).map_err(wrong)
    }

    /// An error at the line of a key.
    fn error(&self, key: &str, what: &str) -> WorldError {
        let mut start = 0;
        let mut lines = self.text.split_inclusive('\n').map(|line| {
            start += line.len();
            (start - line.len(), line)
        });
        let line = lines.find(|(_, line)| line.trim_start().starts_with(key));
        WorldError::new(line.map(|(start, _)| empty(start)), format!("{key}: {what}"))
    }
}

/// The byte at which a character begins, or the end of the text.
fn byte(text: &str, index: usize) -> usize {
    text.char_indices().nth(index).map_or(text.len(), |(byte, _)| byte)
}

fn empty(at: usize) -> Range<usize> {
    at..at
}

fn number(value: &Yaml<'_>) -> Option<f64> {
    let whole = value.as_integer().map(|n| n as f64);
    value.as_floating_point().or(whole).filter(|number| number.is_finite())
}
