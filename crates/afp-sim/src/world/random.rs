//! Random furnished rooms: each seed has its own room, which never changes.
//!
//! A room is the text of a world file, so that a log or a user can keep it.

use super::World;
use crate::chassis::{HALF_LENGTH, HALF_WIDTH};
use crate::noise::{Noise, Source};
use std::fmt::Write;

/// The space for the robot between two objects, and between an object in the open and a wall, in
/// metres.
const PASSAGE: f64 = 0.6;
/// The number of tries to place an object.
const TRIES: u32 = 30;

/// A kind of furniture: name, minimum and maximum size along the wall and away from it, height,
/// whether it is at a wall, colour, texture and echo.
type Kind = (&'static str, [f64; 2], [f64; 2], f64, bool, &'static str, &'static str, f64);

const KINDS: [Kind; 9] = [
    ("cupboard", [0.8, 0.4], [1.6, 0.6], 2.0, true, "#8a5a33", "stripes", 1.0),
    ("sofa", [1.4, 0.7], [2.0, 0.9], 0.8, true, "#4d6a8f", "plain", 0.5),
    ("shelf", [0.6, 0.25], [1.4, 0.35], 1.8, true, "#b08d57", "checks", 1.0),
    ("desk", [1.0, 0.6], [1.4, 0.8], 0.75, true, "#a87c4f", "plain", 1.0),
    ("table", [0.7, 0.6], [1.4, 0.9], 0.75, false, "#c09a6b", "plain", 1.0),
    ("armchair", [0.6, 0.6], [0.8, 0.8], 0.9, false, "#7b3f3f", "plain", 0.5),
    ("pillar", [0.25, 0.25], [0.4, 0.4], 2.5, false, "#c8c8c0", "bricks", 1.0),
    ("step", [0.25, 0.25], [0.5, 0.5], 0.08, false, "#9a9a52", "checks", 1.0),
    ("carton", [0.2, 0.2], [0.35, 0.35], 0.3, false, "#b98f57", "stripes", 0.8),
];

impl World {
    /// A random furnished room: 4 to 8 m by 3.5 to 6 m, some with a doorway. It has furniture, low
    /// objects, movable objects, a walker, coloured patches and a source of infrared light. The
    /// same seed gives the same room.
    pub fn random(seed: u64) -> World {
        made(seed).1
    }

    /// The text of the file of [`World::random`].
    pub fn random_text(seed: u64) -> String {
        made(seed).0
    }
}

/// The first room in the seed's stream with a place for the robot.
fn made(seed: u64) -> (String, World) {
    let mut noise = Source::Rooms.of(seed);
    loop {
        let text = Room::new(&mut noise).furnish(seed);
        if let Some(text) = text
            && let Ok(world) = World::parse(&text)
        {
            return (text, world);
        }
    }
}

struct Room<'a> {
    noise: &'a mut Noise,
    size: [f64; 2],
    /// The position of a dividing wall with a doorway, if there is one.
    divided: Option<f64>,
    /// Objects as enclosing circles: middle and radius.
    taken: Vec<([f64; 2], f64)>,
    text: String,
}

impl<'a> Room<'a> {
    fn new(noise: &'a mut Noise) -> Self {
        let size = [between(noise, 4.0, 8.0), between(noise, 3.5, 6.0)];
        let divided =
            (size[0] > 5.5 && noise.uniform() < 0.6).then(|| between(noise, 2.4, size[0] - 2.4));
        Room { noise, size, divided, taken: Vec::new(), text: String::new() }
    }

    /// The text of the whole file; `None` if there is no place for the robot.
    fn furnish(mut self, seed: u64) -> Option<String> {
        self.walls();
        let pieces = 4 + self.noise.below(7);
        for _ in 0..pieces {
            let kind = KINDS[self.noise.below(KINDS.len() as u32) as usize];
            self.piece(kind);
        }
        self.walker();
        self.paint();
        let [x, y] = self.place(libm::hypot(HALF_LENGTH, HALF_WIDTH), 0.15)?;
        let heading = between(self.noise, -180.0, 180.0);
        let head = format!(
            "version = 1\nname = \"Random room {seed}\"\n\n[robot]\npose_m_deg = [{x:.3}, {y:.3}, {heading:.1}]\n"
        );
        Some(head + &self.text)
    }

    fn walls(&mut self) {
        let [w, h] = self.size;
        self.put(format_args!(
            "\n[[wall]]\nname = \"room\"\nclosed = true\ntexture = \"bricks\"\n\
             points_m = [[0.0, 0.0], [{w:.3}, 0.0], [{w:.3}, {h:.3}], [0.0, {h:.3}]]\n"
        ));
        if let Some(x) = self.divided {
            let door = between(self.noise, 0.9, 1.2);
            let from = between(self.noise, 0.5, h - door - 0.5);
            for (a, b) in [(0.0, from), (from + door, h)] {
                self.put(format_args!(
                    "\n[[wall]]\nname = \"partition\"\npoints_m = [[{x:.3}, {a:.3}], [{x:.3}, {b:.3}]]\n"
                ));
            }
            // The doorway stays free.
            self.taken.push(([x, from + door / 2.0], door / 2.0));
        }
    }

    /// Places a piece of furniture if there is space for it.
    fn piece(&mut self, kind: Kind) {
        let (name, least, most, height, at_wall, color, texture, echo) = kind;
        let size = [0, 1].map(|i| between(self.noise, least[i], most[i]));
        let radius = libm::hypot(size[0], size[1]) / 2.0;
        let spot = if at_wall { self.at_wall(size, radius) } else { self.in_the_open(radius) };
        let Some(([x, y], heading)) = spot else { return };
        let n = self.taken.len();
        self.taken.push(([x, y], radius));
        let [a, b] = size;
        self.put(format_args!(
            "\n[[box]]\nname = \"{name} {n}\"\npose_m_deg = [{x:.3}, {y:.3}, {heading:.1}]\n\
             size_m = [{a:.3}, {b:.3}]\nheight_m = {height}\n\
             color = \"{color}\"\ntexture = \"{texture}\"\necho = {echo}\n"
        ));
        if name == "carton" {
            let mass = between(self.noise, 0.3, 1.5);
            self.put(format_args!("mass_kg = {mass:.2}\n"));
        }
    }

    /// A place with its back to a wall, and its heading.
    fn at_wall(&mut self, size: [f64; 2], radius: f64) -> Option<([f64; 2], f64)> {
        for _ in 0..TRIES {
            let side = self.noise.below(4) as usize;
            let along = usize::from(side % 2 == 1);
            let mut at = [0.0; 2];
            at[along] =
                between(self.noise, size[0] / 2.0 + 0.1, self.size[along] - size[0] / 2.0 - 0.1);
            let off = size[1] / 2.0 + 0.06;
            at[1 - along] = if side < 2 { off } else { self.size[1 - along] - off };
            if self.free(at, radius, 0.05) {
                return Some((at, 90.0 * along as f64));
            }
        }
        None
    }

    fn in_the_open(&mut self, radius: f64) -> Option<([f64; 2], f64)> {
        let at = self.place(radius, PASSAGE)?;
        let straight = self.noise.uniform() < 0.5;
        let heading = between(self.noise, -90.0, 90.0);
        Some((at, if straight { 0.0 } else { heading }))
    }

    /// A place for a circle at this distance from the walls and all objects.
    fn place(&mut self, radius: f64, gap: f64) -> Option<[f64; 2]> {
        let edge = radius + gap + 0.05;
        if self.size.iter().any(|size| *size <= 2.0 * edge) {
            return None;
        }
        for _ in 0..TRIES {
            let at = self.size.map(|size| between(self.noise, edge, size - edge));
            if self.free(at, radius, gap) {
                return Some(at);
            }
        }
        None
    }

    /// Whether a circle leaves gaps to all objects.
    fn free(&self, at: [f64; 2], radius: f64, gap: f64) -> bool {
        let apart = |b: [f64; 2]| libm::hypot(at[0] - b[0], at[1] - b[1]);
        self.divided.is_none_or(|x| (at[0] - x).abs() > radius + gap + 0.05)
            && self.taken.iter().all(|(b, r)| apart(*b) > r + radius + gap)
    }

    /// A walker between two places with a free path.
    fn walker(&mut self) {
        if self.noise.uniform() < 0.5 {
            return;
        }
        let Some(from) = self.place(0.25, 0.2) else { return };
        let Some(to) = self.place(0.25, 0.2) else { return };
        let by = [to[0] - from[0], to[1] - from[1]];
        let clear = (0..=20).all(|i| {
            let share = f64::from(i) / 20.0;
            self.free([0, 1].map(|k| from[k] + by[k] * share), 0.25, 0.1)
        });
        if !clear || libm::hypot(by[0], by[1]) < 0.5 {
            return;
        }
        // The whole path is taken: the robot does not start on it.
        self.taken.extend((0..=8).map(|i| {
            let share = f64::from(i) / 8.0;
            ([0, 1].map(|k| from[k] + by[k] * share), 0.35)
        }));
        let speed = between(self.noise, 0.1, 0.4);
        self.put(format_args!(
            "\n[[box]]\nname = \"walker\"\npose_m_deg = [{:.3}, {:.3}, 0.0]\nsize_m = [0.35, 0.35]\n\
             height_m = 1.7\ncolor = \"#3f7b57\"\n\
             path = {{ by_m = [[{:.3}, {:.3}]], speed_m_s = {speed:.2}, wait_s = 3.0 }}\n",
            from[0], from[1], by[0], by[1]
        ));
    }

    /// Patches on the floor, and a source of infrared light.
    fn paint(&mut self) {
        for color in ["#b03030", "#3060b0"] {
            let [x, y] = self.size.map(|size| between(self.noise, 0.3, size - 0.9));
            let (r, t) = (x + 0.6, y + 0.6);
            self.put(format_args!(
                "\n[[patch]]\ncolor = \"{color}\"\n\
                 points_m = [[{x:.3}, {y:.3}], [{r:.3}, {y:.3}], [{r:.3}, {t:.3}], [{x:.3}, {t:.3}]]\n"
            ));
        }
        let [x, y] = self.size.map(|size| between(self.noise, 0.3, size - 0.3));
        self.put(format_args!(
            "\n[[infrared]]\nname = \"beacon\"\nposition_m = [{x:.3}, {y:.3}]\nheight_m = 1.0\n"
        ));
    }

    fn put(&mut self, text: std::fmt::Arguments<'_>) {
        let _ = self.text.write_fmt(text);
    }
}

fn between(noise: &mut Noise, low: f64, high: f64) -> f64 {
    low + (high - low) * noise.uniform()
}
