//! Draws the optical flow of the simulated camera over its picture, next to the true flow: `cargo
//! run --package afp-navigation --example arrows -- FILE.png`.

use afp_carbot::devices::{Camera, Flow, FlowCamera, Navigator};
use afp_core::Duration;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_sim::{Simulation, World};
use std::error::Error;
use std::fs::File;

/// The hall with a trolley of the scenarios.
const HALL: &str = include_str!("../../afp-test/tests/motion/hall.toml");
/// The scale of the drawing: pixels per camera pixel.
const SCALE: usize = 4;
/// The scale of the arrows, relative to the flow.
const LONGER: f64 = 3.0;
/// Between the two pictures, pixels.
const GAP: usize = 8;

const MEASURED: [u8; 3] = [200, 20, 40];
const TRUE: [u8; 3] = [0, 70, 160];

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("give the name of the picture")?;
    let mut sim = Simulation::new(&World::parse(HALL)?, 1)?;
    let mut time = None;
    // The trolley crosses after the fourth second.
    while sim.now().as_secs_f64() < 6.5 {
        let now = sim.now();
        let turn = if now.as_secs_f64() < 5.5 { 0.0 } else { 0.2 };
        sim.drive(Speed::from_si(0.15), AngularSpeed::from_si(turn), now);
        sim.advance_to(now + Duration::from_millis(5));
        let now = sim.now();
        time = sim.flow(now)?.value.ok().map(|_| now);
    }
    if time.is_none() {
        return Err("the camera has no flow".into());
    }
    let mut drawing = draw_picture(&sim)?;
    let truth = truths(&mut sim)?;
    let now = sim.now();
    let flow = sim.flow(now)?.value.map_err(|why| format!("{why:?}"))?;
    for (place, shift) in places(&flow) {
        if let Some([right, down]) = shift {
            drawing.arrow(0, place, [right, down], MEASURED);
        }
    }
    for (place, shift) in truth {
        drawing.arrow(drawing.second, place, shift, TRUE);
    }
    drawing.write(&file)
}

/// Each place of the grid with its shift.
fn places<'a>(flow: &'a Flow<'_>) -> impl Iterator<Item = ([f64; 2], Option<[f64; 2]>)> + 'a {
    flow.shifts.iter().enumerate().map(|(n, shift)| {
        let (x, y) = flow.grid.pixel(n);
        let shift = shift.map(|shift| [f64::from(shift.right), f64::from(shift.down)]);
        ([x as f64, y as f64], shift)
    })
}

/// A place in the picture and its shift: to the right and down.
type Arrow = ([f64; 2], [f64; 2]);

/// The true shift of every place.
fn truths(sim: &mut Simulation) -> Result<Vec<Arrow>, Box<dyn Error>> {
    let now = sim.now();
    let flow = sim.flow(now)?.value.map_err(|why| format!("{why:?}"))?;
    let all: Vec<_> = places(&flow).map(|(place, _)| place).collect();
    let truth = sim.truth();
    Ok(all.into_iter().filter_map(|at| Some((at, truth.flow(at[0], at[1])?))).collect())
}

struct Drawing {
    width: usize,
    height: usize,
    second: usize,
    rgb: Vec<u8>,
}

/// The camera's picture twice, side by side, in pale colours.
fn draw_picture(sim: &Simulation) -> Result<Drawing, Box<dyn Error>> {
    let frame = sim.frame().value.map_err(|why| format!("{why:?}"))?;
    let second = frame.width * SCALE + GAP;
    let (width, height) = (second + frame.width * SCALE, frame.height * SCALE);
    let mut drawing = Drawing { width, height, second, rgb: vec![255; width * height * 3] };
    for y in 0..height {
        for x in 0..frame.width * SCALE {
            let pixel = frame.pixel(x / SCALE, y / SCALE).unwrap_or_default();
            let pale = pixel.map(|part| 110 + (u16::from(part) * 145 / 255) as u8);
            drawing.put(x, y, pale);
            drawing.put(second + x, y, pale);
        }
    }
    Ok(drawing)
}

impl Drawing {
    fn put(&mut self, x: usize, y: usize, color: [u8; 3]) {
        if x < self.width && y < self.height {
            let first = (y * self.width + x) * 3;
            self.rgb[first..first + 3].copy_from_slice(&color);
        }
    }

    /// A dot at a place and a line from there.
    fn arrow(&mut self, left: usize, [x, y]: [f64; 2], shift: [f64; 2], color: [u8; 3]) {
        let scale = SCALE as f64;
        let at = [(x + 0.5) * scale + left as f64, (y + 0.5) * scale];
        let way = shift.map(|part| part * scale * LONGER);
        let steps = way[0].hypot(way[1]).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let [x, y] = [0, 1].map(|i| (at[i] + way[i] * share).max(0.0) as usize);
            let thick = if step == 0 { 3 } else { 2 };
            for (i, k) in (0..thick * thick).map(|n| (n % thick, n / thick)) {
                if x + i >= left && (left > 0 || x + i + GAP < self.second) {
                    self.put(x + i, y + k, color);
                }
            }
        }
    }

    fn write(self, file: &str) -> Result<(), Box<dyn Error>> {
        let size = (u32::try_from(self.width)?, u32::try_from(self.height)?);
        let mut encoder = png::Encoder::new(File::create(file)?, size.0, size.1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&self.rgb)?;
        Ok(())
    }
}
