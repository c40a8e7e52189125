//! The expected reading of the range sensor, at any place and in any direction.
//!
//! It is computed on first use for each cell of a grid and each direction, and kept: a filter needs
//! thousands of places a second, most of them close to each other. Within a cell the distance is
//! extrapolated linearly, so that the grid can be coarse.

mod cone;

use crate::maps::map::Map;
use afp_carbot::devices::Beam;
use cone::{Cone, Heard};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::{AtomicU16, Ordering};

/// The side of a cell, in metres; larger if a map has too many cells.
const CELL: f64 = 0.1;
/// The maximum number of cells: 72 directions of two bytes each make 72 megabytes.
const MOST: f64 = 500_000.0;
/// The number of directions, counted from the x axis.
pub(crate) const DIRECTIONS: usize = 72;
const STEP: f64 = TAU / DIRECTIONS as f64;

/// Not yet computed.
const UNKNOWN: u16 = u16::MAX;
const SILENCE: u16 = u16::MAX - 1;
const SOLID: u16 = u16::MAX - 2;
/// Distances are stored in these parts of a metre, if they fit next to the rays.
const PARTS: f64 = 1000.0;

/// The expected reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// An echo from this distance, in metres.
    Echo(f64),
    /// Silence: all obstacles are far away or mirror the sound away.
    Silence,
    /// An impossible place: inside of an obstacle, or beyond the map.
    Solid,
}

/// The range sensor's expected readings on a map. Copies share the results.
#[derive(Clone, Debug)]
pub struct EchoField {
    map: Arc<Map>,
    cells: Arc<[AtomicU16]>,
    /// Cosine and sine of each direction.
    directions: Arc<[Vector2<f64>]>,
    /// The map's lower left corner.
    low: Vector2<f64>,
    cell: f64,
    columns: usize,
    rows: usize,
    cone: Cone,
    coding: Coding,
}

/// The encoding of an echo: its ray in the high bits, its distance in the low bits, in parts of a
/// metre.
#[derive(Clone, Copy, Debug)]
struct Coding {
    shift: u32,
    parts: f64,
}

impl Coding {
    /// The encoding of echoes within a cone. The special values for no echo have all ray bits set.
    /// No encoded echo does, because the number of rays fits into these bits and the last ray is
    /// less.
    fn new(cone: Cone) -> Self {
        let rays = 2 * cone.side + 1;
        let bits = usize::BITS - rays.leading_zeros();
        let most = f64::from(u16::MAX >> bits);
        Coding { shift: u16::BITS - bits, parts: PARTS.min(most / cone.range) }
    }

    fn encode(self, heard: Heard) -> u16 {
        libm::round(heard.range * self.parts) as u16 | (heard.ray << self.shift)
    }

    fn decode(self, entry: u16) -> Heard {
        let ray = entry >> self.shift;
        Heard { range: f64::from(entry ^ (ray << self.shift)) / self.parts, ray }
    }
}

impl EchoField {
    /// The field of a sensor on a map. Allocates all memory, and takes hardly any time.
    pub fn new(map: Map, beam: &Beam) -> Self {
        let [low, high] = map.bounds().map(Vector2::from);
        let size = high - low;
        let cell = CELL.max(libm::sqrt(size.x * size.y / MOST));
        let [columns, rows] = [size.x, size.y].map(|side| libm::ceil(side / cell) as usize);
        let unknown = || AtomicU16::new(UNKNOWN);
        let cells = (0..columns * rows * DIRECTIONS).map(|_| unknown()).collect();
        let direction = |n: usize| {
            let (sin, cos) = libm::sincos(n as f64 * STEP);
            Vector2::new(cos, sin)
        };
        let directions = (0..DIRECTIONS).map(direction).collect();
        let cone = Cone::new(beam, libm::hypot(columns as f64, rows as f64) * cell);
        EchoField {
            map: Arc::new(map),
            cells,
            directions,
            low,
            cell,
            columns,
            rows,
            cone,
            coding: Coding::new(cone),
        }
    }

    /// Whether two fields share their results.
    pub fn shares_with(&self, other: &EchoField) -> bool {
        Arc::ptr_eq(&self.cells, &other.cells)
    }

    /// The map of the field.
    pub fn map(&self) -> &Map {
        &self.map
    }

    /// The expected reading of a sensor at a place (in metres) and in a direction (in radians
    /// against the x axis).
    pub fn expected(&self, [x, y]: [f64; 2], direction: f64) -> Expected {
        let [across, up] = [(x - self.low.x) / self.cell, (y - self.low.y) / self.cell];
        let inside = across >= 0.0 && up >= 0.0;
        let (column, row) = (across as usize, up as usize);
        if !inside || column >= self.columns || row >= self.rows {
            return Expected::Solid;
        }
        // Truncation after an offset rounds, faster than rounding itself.
        let nearest = (direction / STEP + f64::copysign(0.5, direction)) as i64;
        let towards = nearest.rem_euclid(DIRECTIONS as i64) as usize;
        let room = (row * self.columns + column) * DIRECTIONS;
        let entry = match self.read(room + towards) {
            UNKNOWN => {
                self.compute(room, self.middle(column, row));
                self.read(room + towards)
            }
            known => known,
        };
        match entry {
            SOLID | UNKNOWN => Expected::Solid,
            SILENCE => Expected::Silence,
            echo => {
                let Heard { range, ray } = self.coding.decode(echo);
                let ray = usize::from(ray) + DIRECTIONS - self.cone.side;
                let along = self.directions.get((towards + ray) % DIRECTIONS);
                let off = Vector2::new(x, y) - self.middle(column, row);
                let nearer = along.map_or(0.0, |along| along.dot(&off));
                Expected::Echo(range - nearer)
            }
        }
    }

    fn read(&self, index: usize) -> u16 {
        self.cells.get(index).map_or(SOLID, |cell| cell.load(Ordering::Relaxed))
    }

    fn middle(&self, column: usize, row: usize) -> Vector2<f64> {
        self.low + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * self.cell
    }

    /// Computes a cell for all directions. Concurrent calls compute the same values.
    fn compute(&self, room: usize, middle: Vector2<f64>) {
        let Some(entries) = self.cells.get(room..room + DIRECTIONS) else { return };
        let solid = self.map.is_solid(middle.into());
        let heard = self.cone.echoes(self.map.faces(), &self.directions, middle);
        for (entry, heard) in entries.iter().zip(heard) {
            let value = match heard {
                _ if solid => SOLID,
                None => SILENCE,
                Some(heard) => self.coding.encode(heard),
            };
            entry.store(value, Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_core::quantity::{Angle, Length};

    /// A sensor with this opening in degrees, and this range in metres.
    fn beam_of(opening: f64, max: f64) -> Beam {
        let [forward, min, max] = [0.1, 0.03, max].map(Length::from_si);
        Beam { forward, opening: Angle::from_deg(opening), min, max }
    }

    fn beam() -> Beam {
        beam_of(30.0, 4.0)
    }

    fn wall(x: [f64; 2], y: [f64; 2]) -> Vec<[f64; 2]> {
        vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
    }

    #[test]
    fn a_wall_is_heard_from_its_nearest_place() {
        let map = Map::new([wall([2.0, 2.1], [-2.0, 2.0]), wall([-2.1, -2.0], [-2.0, 2.0])]);
        let field = EchoField::new(map, &beam());
        for x in [0.0, 0.03, 0.42, 1.37] {
            for degrees in [-12.0_f64, 0.0, 9.0] {
                let Expected::Echo(range) = field.expected([x, 0.1], degrees.to_radians()) else {
                    panic!("silence at {x}, {degrees}");
                };
                assert!((range - (2.0 - x)).abs() < 0.01, "{x} {degrees}: {range}");
            }
        }
        assert_eq!(field.expected([0.0, 0.0], TAU / 4.0), Expected::Silence);
        assert_eq!(field.expected([2.05, 0.0], 0.0), Expected::Solid);
        assert_eq!(field.expected([2.5, 0.0], 0.0), Expected::Solid);
        assert_eq!(field.expected([f64::NAN, 0.0], 0.0), Expected::Solid);
    }

    #[test]
    fn each_sensor_hears_its_own_cone_up_to_its_range() {
        // A post in one ray, a wall behind it, and an obstacle aside, so that the map begins at the
        // left.
        let post = wall([8.0, 8.1], [-0.4, 0.4]);
        let far = wall([12.0, 12.1], [-4.0, 4.0]);
        let map = Map::new([post, far, wall([-0.1, 0.0], [-4.0, -3.9])]);
        // Opening and range of a sensor; how far aside it still hears the post.
        for (opening, max, aside) in [
            (30.0, 4.0, None),
            (30.0, 9.0, Some(15)),
            (30.0, 30.0, Some(15)),
            (10.0, 30.0, Some(5)),
            (60.0, 30.0, Some(30)),
            (0.0, 30.0, Some(0)),
            (340.0, f64::INFINITY, Some(35)),
        ] {
            let field = EchoField::new(map.clone(), &beam_of(opening, max));
            let hears = |degrees: &i32| {
                let direction = f64::from(*degrees).to_radians();
                match field.expected([0.5, 0.0], direction) {
                    Expected::Echo(range) => (range - 7.5).abs() < 0.05,
                    _ => false,
                }
            };
            let heard = (0..40).step_by(5).rfind(hears);
            assert_eq!(heard, aside, "{opening} deg, {max} m");
        }
    }

    #[test]
    fn an_encoded_echo_is_decoded_unchanged() {
        for side in 0..DIRECTIONS / 2 {
            for range in [0.5, 4.0, 100.0] {
                let cone = Cone::new(&beam_of(10.0 * side as f64, range), 1000.0);
                assert_eq!((cone.side, cone.range), (side, range));
                let coding = Coding::new(cone);
                for ray in 0..=2 * side as u16 {
                    for range in [0.0, range / 3.0, range] {
                        let entry = coding.encode(Heard { range, ray });
                        let told = coding.decode(entry);
                        assert!(
                            ![UNKNOWN, SILENCE, SOLID].contains(&entry),
                            "{side} {ray} {range}"
                        );
                        assert!(
                            (told.range - range).abs() <= 0.5 / coding.parts && told.ray == ray
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_slanted_wall_sends_its_sound_away() {
        let map = Map::new([wall([-4.0, 4.0], [1.0, 1.1]), wall([-4.0, 4.0], [-1.1, -1.0])]);
        let field = EchoField::new(map, &beam());
        let heard = |degrees: f64| field.expected([0.0, 0.0], degrees.to_radians());
        assert!(matches!(heard(80.0), Expected::Echo(range) if (range - 1.0).abs() < 0.01));
        assert!(matches!(heard(-60.0), Expected::Echo(range) if range < 1.1));
        assert_eq!(heard(20.0), Expected::Silence);
    }
}
