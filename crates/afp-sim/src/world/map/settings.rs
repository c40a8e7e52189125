//! A map's `.yaml` file and its rules for the cells of the picture, both as in nav2's `map_server`.

use std::ops::Range;

use super::picture::Pixel;
use crate::world::WorldError;
use saphyr::{LoadableYamlNode, Yaml};

/// Place and size of the cells, and the rules for occupied cells.
#[derive(Debug, PartialEq)]
pub(super) struct Settings {
    pub(super) image: String,
    /// The side of a cell, in metres.
    pub(super) resolution: f64,
    /// The lower left corner of the picture, in metres.
    origin: [f64; 2],
    /// The picture's rotation, in radians.
    pub(super) yaw: f64,
    mode: Mode,
    /// White is occupied.
    negate: bool,
    /// Darker cells are occupied: 0 white, 1 black.
    threshold: f64,
    /// Lighter cells are free.
    free: f64,
    /// Unknown cells are walls.
    unknown_is_wall: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cell {
    Occupied,
    Free,
    /// Between the two thresholds in mode `scale`: a share, and not a wall.
    Partly,
    Unknown,
}

/// The interpretation of greys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    /// By darkness, with the opacity as a fourth colour; between the thresholds a cell is unknown.
    Trinary,
    /// By darkness; a cell that is not opaque is unknown.
    Scale,
    /// A value up to 100 is the occupancy in percent; a larger value is unknown.
    Raw,
}

impl Settings {
    pub(super) fn read(yaml: &str) -> Result<Settings, WorldError> {
        let documents = Yaml::load_from_str(yaml).map_err(|error| {
            WorldError::new(Some(empty(byte(yaml, error.marker().index()))), error.info())
        })?;
        let keys = Keys { text: yaml, map: documents.first() };
        let image = keys.get("image").and_then(Yaml::as_str).filter(|image| !image.is_empty());
        let image = image.ok_or_else(|| keys.error("image", "must name a picture"))?.to_owned();
        let modes = [("trinary", Mode::Trinary), ("scale", Mode::Scale), ("raw", Mode::Raw)];
        let mode = keys.one_of("mode", &modes)?.unwrap_or(Mode::Trinary);
        let unknown_is_wall =
            keys.one_of("unknown", &[("free", false), ("walls", true)])?.unwrap_or(false);
        let resolution = keys.number("resolution")?;
        if !(0.001..=10.0).contains(&resolution) {
            return Err(keys.error("resolution", "is not within 0.001 and 10 metres"));
        }
        let [x, y, yaw] = keys.origin()?;
        // Reduced once, because each use would round a large angle differently.
        let yaw = yaw % core::f64::consts::TAU;
        let negate = keys.get("negate").and_then(truth);
        let negate = negate.ok_or_else(|| keys.error("negate", "must be 0 or 1"))?;
        let (threshold, free) = (keys.share("occupied_thresh")?, keys.share("free_thresh")?);
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

    /// The state of a cell with this pixel, as in nav2's `map_io.cpp`.
    pub(super) fn cell(&self, Pixel { colors, alpha }: Pixel) -> Cell {
        let counted = alpha.filter(|_| self.mode == Mode::Trinary);
        let sum = colors.into_iter().chain(counted).map(f64::from).sum::<f64>();
        let shade = sum / if counted.is_some() { 4.0 } else { 3.0 } / f64::from(u16::MAX);
        let occupied = match self.mode {
            Mode::Scale if alpha.is_some_and(|alpha| alpha < u16::MAX) => return Cell::Unknown,
            Mode::Raw => match libm::round(shade * 255.0) {
                percent if percent > 100.0 => return Cell::Unknown,
                percent => percent / 100.0,
            },
            Mode::Trinary | Mode::Scale if self.negate => shade,
            Mode::Trinary | Mode::Scale => 1.0 - shade,
        };
        if occupied > self.threshold {
            Cell::Occupied
        } else if occupied < self.free {
            Cell::Free
        } else if self.mode == Mode::Scale {
            Cell::Partly
        } else {
            Cell::Unknown
        }
    }

    pub(super) fn is_wall(&self, cell: Cell) -> bool {
        match cell {
            Cell::Occupied => true,
            Cell::Free | Cell::Partly => false,
            Cell::Unknown => self.unknown_is_wall,
        }
    }

    /// A place of the picture, in cells from its lower left corner, converted to metres.
    pub(super) fn place(&self, across: f64, up: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.yaw);
        let [x, y] = [across, up].map(|cells| cells * self.resolution);
        [self.origin[0] + x * cos - y * sin, self.origin[1] + x * sin + y * cos]
    }
}

struct Keys<'a, 'b> {
    text: &'a str,
    map: Option<&'a Yaml<'b>>,
}

impl<'a, 'b> Keys<'a, 'b> {
    fn get(&self, key: &str) -> Option<&'a Yaml<'b>> {
        self.map?.as_mapping_get(key)
    }

    fn number(&self, key: &str) -> Result<f64, WorldError> {
        self.get(key).and_then(number).ok_or_else(|| self.error(key, "must be a number"))
    }

    /// The meaning of a word; `None` if the key is absent.
    fn one_of<T: Copy>(&self, key: &str, known: &[(&str, T)]) -> Result<Option<T>, WorldError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let word = value.as_str();
        let is_meant = |name: &str| word.is_some_and(|word| word.eq_ignore_ascii_case(name));
        if let Some((_, meant)) = known.iter().find(|(name, _)| is_meant(name)) {
            return Ok(Some(*meant));
        }
        let names: Vec<_> = known.iter().map(|(name, _)| format!("'{name}'")).collect();
        let names = names.join(" or ");
        // A message can only repeat words, and not a number or a list.
        let what = match word {
            Some(word) => format!("'{word}' is unknown; it must be {names}"),
            None => format!("must be {names}"),
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
        let numbers = values.and_then(|all| all.iter().map(number).collect::<Option<Vec<f64>>>());
        let numbers = numbers.and_then(|all| <[f64; 3]>::try_from(all).ok());
        numbers.ok_or_else(|| self.error("origin", "must be three numbers: x, y and yaw"))
    }

    /// An error at the line of a key; at the start of the file if the key is missing.
    fn error(&self, key: &str, what: &str) -> WorldError {
        let mut start = 0;
        let mut lines = self.text.split_inclusive('\n').map(|line| {
            start += line.len();
            (start - line.len(), line)
        });
        let is_of_key = |line: &str| {
            let rest = line.trim_start().trim_start_matches(['"', '\'']).strip_prefix(key);
            rest.is_some_and(|rest| rest.trim_start_matches(['"', '\'', ' ']).starts_with(':'))
        };
        let start = lines.find(|(_, line)| is_of_key(line)).map_or(0, |(start, _)| start);
        let message = match self.get(key) {
            Some(_) => format!("{key}: {what}"),
            None => format!("{key}: {what}, and is missing"),
        };
        WorldError::new(Some(empty(start)), message)
    }
}

/// The byte index of a character, or the end of the text.
fn byte(text: &str, index: usize) -> usize {
    text.char_indices().nth(index).map_or(text.len(), |(byte, _)| byte)
}

fn empty(at: usize) -> Range<usize> {
    at..at
}

/// A number, with or without quotes.
fn number(value: &Yaml<'_>) -> Option<f64> {
    let whole = value.as_integer().map(|n| n as f64);
    let quoted = || value.as_str().and_then(|text| text.parse().ok());
    let number = value.as_floating_point().or(whole).or_else(quoted);
    number.filter(|number| number.is_finite())
}

/// A whole number other than 0 is true, and so are YAML's words for it.
fn truth(value: &Yaml<'_>) -> Option<bool> {
    let word = |text: &str| match text.to_ascii_lowercase().as_str() {
        "true" | "yes" | "on" | "y" => Some(true),
        "false" | "no" | "off" | "n" => Some(false),
        text => text.parse().ok().map(|number: i64| number != 0),
    };
    let number = value.as_integer().map(|number| number != 0);
    value.as_bool().or(number).or_else(|| value.as_str().and_then(word))
}

#[cfg(test)]
mod tests {
    use super::Cell::{Free, Occupied, Partly, Unknown};
    use super::*;

    /// The cells of nav2's `map_io.cpp`: `OCC_GRID_OCCUPIED`, `OCC_GRID_FREE`, shares and
    /// `OCC_GRID_UNKNOWN`. Mode and 'negate'; 8-bit greys with their opacity, and the expected
    /// cells.
    type Case = (&'static str, u8, &'static [(u8, Option<u16>, Cell)]);

    const CLEAR: Option<u16> = Some(0);
    const OPAQUE: Option<u16> = Some(255);

    const CASES: [Case; 9] = [
        (
            "trinary",
            0,
            &[
                (255, None, Free),
                (206, None, Free),
                (205, None, Unknown),
                (90, None, Unknown),
                (89, None, Occupied),
                (0, None, Occupied),
            ],
        ),
        (
            "trinary",
            1,
            &[
                (255, None, Occupied),
                (166, None, Occupied),
                (165, None, Unknown),
                (49, None, Free),
                (0, None, Free),
            ],
        ),
        // The opacity counts as a fourth colour.
        (
            "trinary",
            0,
            &[
                (80, OPAQUE, Unknown),
                (34, OPAQUE, Unknown),
                (33, OPAQUE, Occupied),
                (0, OPAQUE, Occupied),
                (189, OPAQUE, Free),
                (188, OPAQUE, Unknown),
                (255, CLEAR, Unknown),
                (119, CLEAR, Unknown),
                (118, CLEAR, Occupied),
                (255, Some(128), Free),
            ],
        ),
        ("trinary", 1, &[(255, OPAQUE, Occupied), (0, OPAQUE, Unknown), (0, CLEAR, Free)]),
        (
            "scale",
            0,
            &[
                (255, None, Free),
                (206, None, Free),
                (205, None, Partly),
                (90, None, Partly),
                (89, None, Occupied),
                (0, OPAQUE, Occupied),
                (205, OPAQUE, Partly),
                (0, CLEAR, Unknown),
                (0, Some(254), Unknown),
                (255, CLEAR, Unknown),
            ],
        ),
        ("scale", 1, &[(255, OPAQUE, Occupied), (0, OPAQUE, Free), (255, Some(1), Unknown)]),
        // A percentage, independent of 'negate' and opacity.
        (
            "raw",
            0,
            &[
                (0, None, Free),
                (19, None, Free),
                (20, None, Unknown),
                (65, None, Unknown),
                (66, None, Occupied),
                (100, None, Occupied),
                (101, None, Unknown),
                (255, None, Unknown),
            ],
        ),
        ("raw", 1, &[(0, None, Free), (100, None, Occupied), (255, None, Unknown)]),
        ("raw", 0, &[(0, CLEAR, Free), (100, CLEAR, Occupied), (100, OPAQUE, Occupied)]),
    ];

    #[test]
    fn cells_equal_the_cells_of_nav2() {
        for (mode, negate, cells) in CASES {
            for mode in [mode.to_owned(), mode.to_uppercase()] {
                let yaml = format!(
                    "image: a.png\nmode: {mode}\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: {negate}\n\
                     occupied_thresh: 0.65\nfree_thresh: 0.196\n"
                );
                let settings = Settings::read(&yaml).unwrap();
                for (grey, alpha, cell) in cells {
                    let alpha = alpha.map(|alpha: u16| alpha * 257);
                    let pixel = Pixel { colors: [u16::from(*grey) * 257; 3], alpha };
                    assert_eq!(settings.cell(pixel), *cell, "{mode} {negate} {grey} {alpha:?}");
                }
            }
        }
    }
}
