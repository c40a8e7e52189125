//! The flow against the true flow of rendered pictures, which is known at every place.
//!
//! `cargo test --release -p afp-navigation --test flow -- --nocapture` prints the numbers of
//! `docs/optical-flow.md`; with `--features opencv`, they include OpenCV.

use afp_carbot::devices::{Camera, Navigator, Shift};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Fault};
use afp_navigation::flow::{LucasKanade, OpticalFlow, Picture, grid};
use afp_sim::{Simulation, World};
use std::time::Instant;

/// A room with patterns on walls and floor, and a trolley that crosses the view.
const ROOM: &str = r##"
version = 1
[robot]
pose_m_deg = [0.6, 1.5, 0.0]
[floor]
color = "#b8a888"
texture = "mottled"
[[wall]]
points_m = [[0.0, 0.0], [4.5, 0.0], [4.5, 3.0], [0.0, 3.0]]
closed = true
color = "#d8d0c0"
texture = "mottled"
[[box]]
pose_m_deg = [3.2, 0.9, 20.0]
size_m = [0.4, 0.4]
height_m = 0.6
color = "#3060a0"
texture = "mottled"
[[box]]
pose_m_deg = [2.3, 2.6, 0.0]
size_m = [0.5, 0.4]
height_m = 0.5
color = "#30a050"
texture = "mottled"
path = { by_m = [[0.0, -2.2]], speed_m_s = 0.3 }
"##;

/// The robot's motions: name, speed in m/s and turn in rad/s.
const MOTIONS: [(&str, f64, f64); 4] = [
    ("stands", 0.0, 0.0),
    ("drives straight ahead, 20 cm/s", 0.2, 0.0),
    ("turns in place, 30 deg/s", 0.0, 0.52),
    ("drives a curve, 25 cm/s and 20 deg/s", 0.25, 0.35),
];

/// Pairs of pictures from one motion.
const PAIRS: usize = 40;

#[derive(Debug)]
struct Figures {
    method: &'static str,
    motion: &'static str,
    /// Distances between the computed and the true end of the flow, in pixels, smallest first.
    errors: Vec<f64>,
    /// The number of places with a known true flow.
    places: usize,
    /// The lengths of the true flow, in pixels, smallest first.
    ways: Vec<f64>,
    nanos: u128,
}

fn share(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    sorted.get((last as f64 * share).round() as usize).copied().unwrap_or(f64::NAN)
}

fn methods() -> Vec<(&'static str, Box<dyn OpticalFlow>)> {
    let ours: Box<dyn OpticalFlow> = Box::new(LucasKanade::new(160, 120));
    let both = [("optical-flow-lk", Some(ours)), ("OpenCV", open_cv())];
    both.into_iter().filter_map(|(name, method)| Some((name, method?))).collect()
}

#[cfg(feature = "opencv")]
fn open_cv() -> Option<Box<dyn OpticalFlow>> {
    Some(Box::new(afp_navigation::flow::OpenCv::new()))
}

#[cfg(not(feature = "opencv"))]
fn open_cv() -> Option<Box<dyn OpticalFlow>> {
    None
}

fn measure() -> Result<Vec<Figures>, Fault> {
    let mut all = Vec::new();
    for (motion, speed, turn) in MOTIONS {
        for (method, mut flow) in methods() {
            let empty = || (Vec::new(), Vec::new());
            let ((mut errors, mut ways), mut places, mut nanos) = (empty(), 0, 0);
            each_pair(speed, turn, |sim, before, after| {
                let grid = grid(before.width(), before.height());
                let mut shifts = vec![None; grid.len()];
                let begun = Instant::now();
                flow.flow(before, after, &grid, &mut shifts)?;
                nanos += begun.elapsed().as_nanos();
                for (n, shift) in shifts.into_iter().enumerate() {
                    let (x, y) = grid.pixel(n);
                    let Some(truth) = sim.truth().flow(x as f64, y as f64) else { continue };
                    places += 1;
                    ways.push(truth[0].hypot(truth[1]));
                    errors.extend(shift.map(|shift| distance(shift, truth)));
                }
                Ok(())
            })?;
            errors.sort_by(f64::total_cmp);
            ways.sort_by(f64::total_cmp);
            let nanos = nanos / PAIRS as u128;
            all.push(Figures { method, motion, errors, places, ways, nanos });
        }
    }
    Ok(all)
}

fn distance(shift: Shift, truth: [f64; 2]) -> f64 {
    (f64::from(shift.right) - truth[0]).hypot(f64::from(shift.down) - truth[1])
}

/// Drives and shows every pair of pictures, one after the other.
fn each_pair(
    speed: f64,
    turn: f64,
    mut show: impl FnMut(&Simulation, &Picture, &Picture) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let world = World::parse(ROOM).expect("the room is well-formed");
    let mut sim = Simulation::new(&world, 1).expect("the room can be built");
    let [mut before, mut after] = [(); 2].map(|()| Picture::new(160, 120));
    let (mut last, mut pairs) = (0, 0);
    while pairs < PAIRS {
        let now = sim.now();
        sim.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        sim.advance_to(now + Duration::from_millis(10));
        let Ok(frame) = sim.frame().value else { continue };
        if frame.number == last {
            continue;
        }
        std::mem::swap(&mut before, &mut after);
        after.take(&frame);
        // First the robot accelerates.
        if frame.number > 5 {
            pairs += 1;
            show(&sim, &before, &after)?;
        }
        last = frame.number;
    }
    Ok(())
}

#[test]
fn the_flow_matches_the_rendered_pictures() {
    for figures in measure().expect("every method computes") {
        let Figures { method, motion, errors, places, ways, nanos } = figures;
        let (median, p90) = (share(&errors, 0.5), share(&errors, 0.9));
        let valid = errors.len() as f64 / places as f64;
        println!(
            "| {method} | {motion} | {:.2} ({:.1}) | {median:.3} | {p90:.2} | {:.0} % | {} |",
            share(&ways, 0.5),
            share(&ways, 1.0),
            100.0 * valid,
            nanos / 1000,
        );
        assert!(median < 0.1, "{method}, {motion}: {median} px");
        assert!(p90 < 0.8, "{method}, {motion}: {p90} px");
        assert!(valid > 0.65, "{method}, {motion}: {valid}");
    }
}
