//! Motion in a still room, seen from a driving robot, and failing cameras.

use super::*;
use crate::devices::{Camera, Flow, Frame, Grid, Lens, Motion, Reading, Shift};
use afp_core::Duration;
use afp_core::quantity::{AngularSpeed, Length};
use std::vec::Vec;

type Template = templates::CheckMotion;

const GRID: Grid = Grid::new(160, 120, 8, 9);

/// A stationary robot whose camera gives a flow every 50 ms.
struct Eyes {
    now: Instant,
    shifts: Vec<Option<Shift>>,
    /// Time of the latest picture.
    taken: Instant,
    frozen: bool,
    heading: f64,
    /// The odometry is silent from this time on, milliseconds.
    odometry_dies: u64,
}

impl Eyes {
    /// Everything is stationary.
    fn new() -> Self {
        let shifts = std::vec![Some(Shift::default()); GRID.len()];
        Eyes {
            now: Instant::ZERO,
            shifts,
            taken: Instant::ZERO,
            frozen: false,
            heading: 0.0,
            odometry_dies: u64::MAX,
        }
    }

    /// Moves the places in these columns and rows.
    fn move_places(&mut self, columns: &[usize], rows: &[usize], right: f32) {
        for place in rows.iter().flat_map(|row| columns.iter().map(move |c| row * GRID.columns + c))
        {
            self.shifts[place] = Some(Shift { right, down: 0.0 });
        }
    }

    /// Watches for `millis`; returns the number of reports and the last one.
    fn watch(&mut self, millis: u64) -> Result<(u32, Option<Event>), Fault> {
        let inputs = Inputs { speed: AngularSpeed::from_si(0.1) };
        let wanted = Events::from_bits(1);
        let mut watch: CheckMotion = Supervisor::<Template, Self>::start(inputs, self, self.now)?;
        let (mut seen, mut last) = (0, None);
        for _ in 0..millis / 10 {
            self.now += Duration::from_millis(10);
            if self.now.as_nanos().is_multiple_of(50_000_000) && !self.frozen {
                self.taken = self.now;
            }
            let now = self.now;
            let event = Supervisor::<Template, Self>::poll(&mut watch, Live {}, wanted, self, now)?;
            seen += u32::from(event.is_some());
            last = event.or(last);
        }
        Ok((seen, last))
    }
}

impl Camera for Eyes {
    fn frame(&self) -> Reading<Frame<'_>> {
        Reading { time: self.now, value: Err(Invalid::NoAnswer) }
    }

    fn lens(&self) -> Lens {
        Lens {
            forward: Length::from_si(0.18),
            height: Length::from_si(0.2),
            opening: Angle::from_deg(70.0),
            columns: 160,
            rows: 120,
        }
    }
}

impl FlowCamera for Eyes {
    fn flow(&mut self, now: Instant) -> Result<Reading<Flow<'_>>, Fault> {
        if now.since(self.taken) > Duration::from_millis(200) {
            return Ok(Reading::invalid(Invalid::Frozen, now));
        }
        let span = Duration::from_millis(50);
        Ok(Reading::valid(Flow { grid: GRID, shifts: &self.shifts, span }, self.taken))
    }
}

impl Odometry for Eyes {
    fn motion(&self) -> Reading<Motion> {
        if self.now.as_nanos() / 1_000_000 >= self.odometry_dies {
            return Reading::invalid(Invalid::NoAnswer, self.now);
        }
        Reading::valid(
            Motion { heading: Angle::from_si(self.heading), ..Motion::default() },
            self.now,
        )
    }
}

#[test]
fn motion_is_reported_with_its_bearing_and_share_from_the_second_picture() {
    let mut eyes = Eyes::new();
    eyes.move_places(&[2, 3, 4], &[4, 5, 6], 2.0);
    let (seen, last) = eyes.watch(200).unwrap();
    assert_eq!(seen, 3, "of the pictures at 50, 100, 150 and 200 ms all but the first");
    let Some(Event::MotionSeen { bearing, strength }) = last else { panic!("{last:?}") };
    // The middle column is 44.5 pixels left of the picture's centre.
    assert!((bearing.si().to_degrees() - 21.2).abs() < 1.5, "{bearing:?}");
    assert!((strength - 9.0 / GRID.len() as f64).abs() < 1e-9, "{strength}");
}

#[test]
fn slow_or_small_motion_is_not_reported() {
    assert_eq!(Eyes::new().watch(500), Ok((0, None)));
    let mut eyes = Eyes::new();
    eyes.move_places(&[2, 3, 4], &[4, 5, 6], 0.5);
    assert_eq!(eyes.watch(500), Ok((0, None)), "0.5 pixels are 5 deg/s");
    let mut eyes = Eyes::new();
    eyes.move_places(&[2, 3, 4], &[4], 3.0);
    eyes.move_places(&[9, 10, 11], &[4], 3.0);
    assert_eq!(eyes.watch(500), Ok((0, None)), "two threes are not a four");
}

#[test]
fn the_larger_of_two_objects_counts() {
    let mut eyes = Eyes::new();
    eyes.move_places(&[2, 3], &[4, 5], 3.0);
    eyes.move_places(&[12, 13, 14], &[4, 5], -3.0);
    let Ok((_, Some(Event::MotionSeen { bearing, .. }))) = eyes.watch(200) else { panic!() };
    assert!(bearing.si() < 0.0, "on the right: {bearing:?}");
}

#[test]
fn a_dead_odometry_is_named_and_a_grid_above_the_limit_is_rejected() {
    let mut eyes = Eyes::new();
    eyes.odometry_dies = 500;
    assert_eq!(eyes.watch(950), Ok((0, None)), "it is patient");
    assert_eq!(eyes.watch(1200), Err(NO_ODOMETRY));
    let grid = Grid::new(320, 240, 8, 9);
    let shifts = std::vec![Some(Shift::default()); grid.len()];
    let flow = Flow { grid, shifts: &shifts, span: Duration::from_millis(50) };
    let mut history = History::new();
    history.note(Eyes::new().motion());
    let lens = Eyes::new().lens();
    let step = Step::between(&history, &lens, Instant::ZERO, Instant::ZERO).unwrap();
    let view = View { lens, step, flow, speed: 0.1 };
    assert_eq!(view.largest(), Err(moving::TOO_MANY_PLACES));
}

#[test]
fn a_frozen_or_covered_camera_is_a_fault() {
    let mut frozen = Eyes::new();
    frozen.frozen = true;
    assert_eq!(frozen.watch(800), Err(NO_FLOW));
    let mut covered = Eyes::new();
    covered.shifts.fill(None);
    assert_eq!(covered.watch(500), Ok((0, None)), "it is patient");
    assert_eq!(covered.watch(800), Err(NO_FLOW));
}
