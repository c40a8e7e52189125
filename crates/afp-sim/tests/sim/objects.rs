//! How well objects are found by their colours in camera pictures of random rooms. A second picture
//! of the same room without the object provides the ground truth.
//!
//! `AFP_VIEWS` sets the number of views.

use std::env;

use afp_carbot::devices::{Camera, Frame};
use afp_carbot::{Appearance, Sighting};
use afp_core::quantity::{Angle, Length};
use afp_sim::{Simulation, World};

use crate::wait;

/// The default number of views.
const VIEWS: u64 = 60;
/// Colours that no furniture has: pink, lime and turquoise.
const COLORS: [[u8; 3]; 3] = [[217, 26, 128], [112, 208, 26], [16, 176, 192]];
/// An object must be found if this number of pixels show it.
const SEEN: usize = 40;
/// The maximum angle between a found object and its true direction, in radians.
const RIGHT: f64 = 4.0 / 180.0 * std::f64::consts::PI;
/// Between this number of pixels and [`SEEN`], finding an object is neither right nor wrong.
const HINT: usize = 8;

struct View {
    sim: Simulation,
}

impl View {
    fn of(text: &str, seed: u64) -> Option<View> {
        let world = World::parse(text).ok()?;
        let mut sim = Simulation::new(&world, seed).ok()?;
        wait(&mut sim, 100);
        Some(View { sim })
    }

    fn frame(&self) -> Frame<'_> {
        self.sim.frame().value.expect("the camera works")
    }
}

/// The pixels of an object that only one of two pictures shows, and the middle of their columns.
fn truth(with: &Frame<'_>, without: &Frame<'_>) -> (usize, f64) {
    let differs = |n: &usize| with.rgb[3 * n..3 * n + 3] != without.rgb[3 * n..3 * n + 3];
    let columns = (0..with.width * with.height).filter(differs).map(|n| n % with.width);
    let (count, sum) = columns.fold((0, 0), |(count, sum), x| (count + 1, sum + x));
    (count, sum as f64 / count.max(1) as f64)
}

/// Numbers from 0 to 1, the same for the same seed.
fn chances(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A room, and a coloured box ahead of the robot: near or far, small or large, visible or half
/// hidden.
fn views(seed: u64) -> Option<(View, View, [u8; 3])> {
    let (room, start) = (World::random_text(seed), World::random(seed).start);
    let mut chance = chances(seed);
    for _ in 0..8 {
        chance();
    }
    let color = COLORS[(chance() * 3.0) as usize % 3];
    let (far, aside) = (0.6 + 3.0 * chance(), 0.9 * (chance() - 0.5));
    let [x, y] = [
        start.x + far * (start.heading + aside).cos(),
        start.y + far * (start.heading + aside).sin(),
    ];
    let (turned, size, height) = (90.0 * chance(), 0.15 + 0.2 * chance(), 0.2 + 0.6 * chance());
    let [r, g, b] = color;
    let object = format!(
        "\n[[box]]\nname = \"object\"\npose_m_deg = [{x:.3}, {y:.3}, {turned:.1}]\nsize_m = [{size:.3}, {size:.3}]\n\
         height_m = {height:.3}\ncolor = \"#{r:02x}{g:02x}{b:02x}\"\n"
    );
    Some((View::of(&(room.clone() + &object), seed)?, View::of(&room, seed)?, color))
}

/// How often a visible object was found or missed, and how often an object was found at a wrong
/// place.
#[derive(Debug, Default)]
struct Score {
    right: f64,
    missed: f64,
    wrong: f64,
}

impl Score {
    fn add(&mut self, seen: Option<Sighting>, (pixels, column): (usize, f64), view: &View) {
        let (focus, middle) = (view.sim.lens().focus(), view.frame().width as f64 / 2.0);
        let bearing = ((middle - column - 0.5) / focus).atan();
        match seen {
            Some(seen) if pixels >= HINT && (seen.bearing.si() - bearing).abs() <= RIGHT => {
                self.right += 1.0;
            }
            Some(_) => self.wrong += 1.0,
            None if pixels >= SEEN => self.missed += 1.0,
            None => {}
        }
    }

    fn precision(&self) -> f64 {
        self.right / (self.right + self.wrong)
    }

    fn recall(&self) -> f64 {
        self.right / (self.right + self.missed)
    }
}

#[test]
fn visible_objects_are_found_by_their_colours() {
    let count = env::var("AFP_VIEWS").map_or(VIEWS, |text| text.parse().expect("a number"));
    let mut score = Score::default();
    let mut done = 0;
    for (seed, (with, without, [r, g, b])) in (0..).filter_map(|seed| Some((seed, views(seed)?))) {
        let look = Appearance::of_color([r, g, b].map(f64::from), 0.08);
        let (lens, there) = (with.sim.lens(), truth(&with.frame(), &without.frame()));
        let before = score.wrong + score.missed;
        score.add(look.find(&with.frame(), &lens), there, &with);
        if score.wrong + score.missed > before {
            println!("room {seed}: {there:?} {:?}", look.find(&with.frame(), &lens));
        }
        // The same room without the object must have no find.
        score.add(look.find(&without.frame(), &lens), (0, 0.0), &without);
        done += 1;
        if done == count {
            break;
        }
    }
    println!("{count} views: precision {:.3}, recall {:.3}", score.precision(), score.recall());
    assert!(score.precision() >= 0.95 && score.recall() >= 0.95, "{score:?}");
}

#[test]
fn the_foot_of_an_object_gives_its_distance() {
    for far in [0.6, 1.0, 2.0, 3.0] {
        let text = crate::the_box([far + 0.15, 0.0], [0.3, 0.3], 0.4);
        let mut sim = crate::among(&(text + "color = \"#d91a80\"\n"));
        wait(&mut sim, 100);
        let look = Appearance::of_color([0.85, 0.1, 0.5], 0.08);
        let frame = sim.frame().value.expect("the camera works");
        let seen = look.find(&frame, &sim.lens()).expect("it stands there");
        let (distance, ahead) = (Length::from_si(far) - sim.lens().forward, Angle::from_deg(2.0));
        let off = (seen.distance - distance).si().abs();
        assert!(seen.bearing.si().abs() < ahead.si() && off < 0.05 + 0.1 * far, "{far}: {seen:?}");
    }
}
