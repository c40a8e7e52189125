//! Draws the camera's picture, column by column.
//!
//! The camera is level, so a column of pixels shows one vertical plane. Every solid that crosses
//! the plane shows a piece of one side and, if it is lower than the camera, of its top. Far solids
//! are drawn first and near solids over them.

use super::{COLUMNS, FORWARD, HEIGHT, ROWS, lens};
use crate::noise::{Noise, Source};
use crate::scene::{Crossing, Scene, Solid};
use crate::vehicle::Place;
use crate::world::Rgb;

/// The colour above everything if there is no ceiling.
const SKY: Rgb = [205, 216, 228];
/// Nearer objects are not visible, in metres.
pub(super) const NEAR: f64 = 0.02;
/// The direction of the light, seen from above, and the darkening of sides away from it.
const SUN: [f64; 2] = [0.6, 0.8];
const SHADE: f64 = 0.25;
/// The maximum noise of a pixel.
const GRAIN: u32 = 3;

/// The picture seen from a robot at this place, with its own grain.
pub(super) fn render(scene: &Scene, robot: Place, seed: u64) -> Vec<u8> {
    let mut picture = Picture { rgb: vec![0; COLUMNS * ROWS * 3], grain: Source::Camera.of(seed) };
    let focus = lens().focus();
    let eye = robot.beyond(FORWARD, 0.0);
    let mut met: Vec<(&Solid, Crossing)> = Vec::new();
    for x in 0..COLUMNS {
        let left = (COLUMNS as f64 / 2.0 - x as f64 - 0.5) / focus;
        // The direction is one metre long ahead, so that lengths along it are depths.
        let direction = robot.turned([1.0, left]);
        met.clear();
        met.extend(scene.cross(eye, direction).filter(|(_, crossing)| crossing.enter > NEAR));
        met.sort_by(|(_, a), (_, b)| b.enter.total_cmp(&a.enter));
        let mut column = Column { picture: &mut picture, x, focus };
        column.background(scene, eye, direction);
        for (solid, crossing) in &met {
            column.solid(solid, crossing, eye, direction);
        }
    }
    picture.grain();
    picture.rgb
}

struct Picture {
    rgb: Vec<u8>,
    grain: Noise,
}

impl Picture {
    fn put(&mut self, x: usize, y: usize, color: Rgb) {
        let first = (y * COLUMNS + x) * 3;
        // An array: a copy of three bytes between slices is a call, and took a quarter of the time.
        let pixel = self.rgb.get_mut(first..).and_then(<[u8]>::first_chunk_mut);
        if let Some(pixel) = pixel {
            *pixel = color;
        }
    }

    fn grain(&mut self) {
        for value in &mut self.rgb {
            let off = self.grain.below(2 * GRAIN + 1) as i32 - GRAIN as i32;
            *value = (i32::from(*value) + off).clamp(0, 255) as u8;
        }
    }
}

struct Column<'a> {
    picture: &'a mut Picture,
    x: usize,
    focus: f64,
}

impl Column<'_> {
    /// The upward slope of a row.
    fn slope(&self, y: usize) -> f64 {
        (ROWS as f64 / 2.0 - y as f64 - 0.5) / self.focus
    }

    /// The rows with slopes between two limits.
    fn rows(&self, low: f64, high: f64) -> std::ops::Range<usize> {
        let row = |slope: f64| {
            let y = libm::ceil(ROWS as f64 / 2.0 - 0.5 - slope * self.focus);
            y.clamp(0.0, ROWS as f64) as usize
        };
        row(high)..row(low)
    }

    fn background(&mut self, scene: &Scene, eye: [f64; 2], direction: [f64; 2]) {
        for y in 0..ROWS {
            let slope = self.slope(y);
            let color = match slope < 0.0 {
                true => scene.floor(along(eye, direction, -HEIGHT / slope)),
                false => SKY,
            };
            self.picture.put(self.x, y, color);
        }
    }

    fn solid(&mut self, solid: &Solid, met: &Crossing, eye: [f64; 2], direction: [f64; 2]) {
        let top = solid.height - HEIGHT;
        let light = (met.normal[0] * SUN[0] + met.normal[1] * SUN[1] + 1.0) / 2.0;
        let light = 1.0 - SHADE + SHADE * light;
        for y in self.rows(-HEIGHT / met.enter, top / met.enter) {
            let up = HEIGHT + self.slope(y) * met.enter;
            self.picture.put(self.x, y, lit(solid.look.at(met.along, up), light));
        }
        if top < 0.0 {
            for y in self.rows(top / met.enter, top / met.leave) {
                let [a, b] = along(eye, direction, top / self.slope(y));
                self.picture.put(self.x, y, solid.look.at(a, b));
            }
        }
    }
}

fn along(from: [f64; 2], direction: [f64; 2], far: f64) -> [f64; 2] {
    [0, 1].map(|i| from[i] + direction[i] * far)
}

fn lit(color: Rgb, light: f64) -> Rgb {
    color.map(|part| (f64::from(part) * light) as u8)
}
