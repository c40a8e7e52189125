//! Prints the nanoseconds of one iteration: four guards as sources, an action as their sink.
//!
//! Its only argument is the number of batches; the best one counts.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::Instant;

use cu29::prelude::*;

/// The board: buttons, bumper, range, battery, odometer, walldist, command.
static BOARD: [AtomicU64; 7] = [const { AtomicU64::new(0) }; 7];
const ITERATIONS: u32 = 2_000;

fn read(cell: usize) -> f64 {
    f64::from_bits(BOARD[cell].load(Relaxed))
}

macro_rules! guard {
    ($name:ident, $fires:expr) => {
        #[derive(Reflect)]
        struct $name;

        impl Freezable for $name {}

        impl CuSrcTask for $name {
            type Resources<'r> = ();
            type Output<'m> = output_msg!(bool);

            fn new(_: Option<&ComponentConfig>, _: Self::Resources<'_>) -> CuResult<Self> {
                Ok(Self)
            }

            fn process(&mut self, _: &CuContext, output: &mut Self::Output<'_>) -> CuResult<()> {
                output.set_payload($fires);
                Ok(())
            }
        }
    };
}

guard!(CheckButton, BOARD[0].load(Relaxed) & 1 != 0);
guard!(CheckTouch, BOARD[1].load(Relaxed) != 0);
guard!(CheckRange, read(2) < read(5));
guard!(CheckBattery, read(3) < 10.0);

#[derive(Reflect)]
struct Drive {
    goal: f64,
}

impl Freezable for Drive {}

impl CuSinkTask for Drive {
    type Resources<'r> = ();
    type Input<'m> = input_msg!('m, bool, bool, bool, bool);

    fn new(_: Option<&ComponentConfig>, _: Self::Resources<'_>) -> CuResult<Self> {
        Ok(Self { goal: 101.0 })
    }

    fn process(&mut self, _: &CuContext, input: &Self::Input<'_>) -> CuResult<()> {
        let (button, touch, range, battery) = *input;
        let fired = [button, touch, range, battery].map(|guard| guard.payload() == Some(&true));
        let left = self.goal - read(4);
        let speed = if fired.contains(&true) || left <= 0.0 { 0.0 } else { (left * 0.5).min(0.3) };
        BOARD[6].store(speed.to_bits(), Relaxed);
        Ok(())
    }
}

#[copper_runtime(config = "copperconfig.ron")]
struct Robot {}

fn main() -> CuResult<()> {
    let batches: u32 = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(500);
    for (cell, value) in [(2, 2.0), (3, 12.0), (4, 1.0), (5, 0.3_f64)] {
        BOARD[cell].store(value.to_bits(), Relaxed);
    }
    let log = std::env::temp_dir().join(format!("afp-bench-{}.copper", std::process::id()));
    let (clock, _mock) = RobotClock::mock();
    let builder = Robot::builder().with_clock(clock).with_log_path(&log, Some(16 * 1024 * 1024))?;
    let mut robot = builder.build()?.start()?;
    let mut best = f64::INFINITY;
    for _ in 0..batches {
        let start = Instant::now();
        for _ in 0..ITERATIONS {
            robot.run_one_iteration()?;
        }
        best = best.min(start.elapsed().as_nanos() as f64 / f64::from(ITERATIONS));
    }
    drop(robot.stop()?);
    println!("{best:.2}");
    Ok(())
}
