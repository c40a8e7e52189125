//! Random stimuli: faults, presses of the button, bumps.

use std::fmt;

use afp_carbot::table::{Carbot, TABLE};
use afp_core::devices::{Devices, faults};
use afp_core::{Duration, Instant};
use afp_sim::{Fault, Simulation};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

use crate::sensor::Sensor;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stimulus {
    /// A fault with its duration; [`Duration::MAX`] is permanent.
    Break(Fault, Duration),
    /// The escape button is pressed or released.
    Escape(bool),
    /// The bumper is pressed or released.
    Bump(bool),
}

/// The stimuli in order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chance(pub Vec<(Instant, Stimulus)>);

/// A stream of random numbers.
pub(crate) struct Dice(Pcg32);

impl Dice {
    pub(crate) fn new(number: u64, stream: u64) -> Self {
        // An odd multiplier spreads neighbouring numbers over the generator's state.
        Dice(Pcg32::new(number.wrapping_mul(0x9e37_79b9_7f4a_7c15), stream))
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        self.0.next_u32() as usize % bound
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.next_u32()) / 4_294_967_296.0
    }

    fn percent(&mut self, chance: usize) -> bool {
        self.below(100) < chance
    }

    /// Whole milliseconds, so that the schedule is easy to write.
    fn millis(&mut self, low: f64, high: f64) -> Duration {
        Duration::from_millis(self.between(low * 1e3, high * 1e3) as u64)
    }
}

impl Chance {
    /// Up to four faults, up to three bumps, and sometimes the escape button, within `seconds`.
    pub(crate) fn random(dice: &mut Dice, seconds: f64) -> Chance {
        let mut stimuli = Vec::new();
        for _ in 0..dice.below(5) {
            let from = Instant::ZERO + dice.millis(0.0, seconds);
            let fault = fault(dice);
            let during = dice.millis(0.02, 5.0);
            let during = if dice.percent(15) { Duration::MAX } else { during };
            stimuli.push((from, Stimulus::Break(fault, during)));
        }
        for _ in 0..dice.below(4) {
            hold(dice, &mut stimuli, seconds, Stimulus::Bump);
        }
        if dice.percent(30) {
            hold(dice, &mut stimuli, seconds, Stimulus::Escape);
        }
        // The sort is stable: of two stimuli at the same time the first one stays first.
        stimuli.sort_by_key(|(at, _)| *at);
        Chance(stimuli)
    }

    /// Applies every due stimulus to the robot.
    pub(crate) fn happen(&self, next: &mut usize, sim: &mut Simulation) {
        while let Some((at, stimulus)) = self.0.get(*next)
            && *at <= sim.now()
        {
            *next += 1;
            match *stimulus {
                Stimulus::Break(fault, during) => sim.inject(fault, *at, during),
                Stimulus::Escape(true) => sim.press_escape(),
                Stimulus::Escape(false) => sim.release_escape(),
                Stimulus::Bump(true) => sim.press_bumper(),
                Stimulus::Bump(false) => sim.release_bumper(),
            }
        }
    }
}

fn fault(dice: &mut Dice) -> Fault {
    // The other faults of the controller end every run at once.
    let ends = |device: &str, name: &str| device == "controller" && name != "dead";
    let mut rows: Vec<_> =
        faults(TABLE).filter(|(_, device, row)| !ends(device.name, row.name)).collect();
    // The recorded worlds depend on this order: faults of all sensors, then the others, then the
    // battery's.
    rows.sort_by_key(|(_, device, row)| match row.name {
        "frozen" | "lost" | "nan" | "delayed" | "slow" => 0,
        _ if device.name == Sensor::Battery.name() => 2,
        _ => 1,
    });
    let (id, _, row) = rows[dice.below(rows.len())];
    let time = if row.name == "slow" { dice.millis(0.001, 0.04) } else { dice.millis(0.01, 0.6) };
    let share = dice.between(0.03, 0.5);
    let amount = row.amount.map(|of| if of.unit == "s" { time.as_secs_f64() } else { share });
    Carbot::fault(id, amount).expect("the amount is within its bounds")
}

/// Presses something for a while.
fn hold(
    dice: &mut Dice,
    stimuli: &mut Vec<(Instant, Stimulus)>,
    seconds: f64,
    stimulus: fn(bool) -> Stimulus,
) {
    let at = Instant::ZERO + dice.millis(0.0, seconds);
    stimuli.push((at, stimulus(true)));
    stimuli.push((at + dice.millis(0.01, 0.5), stimulus(false)));
}

impl fmt::Display for Chance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, stimulus) in &self.0 {
            match stimulus {
                Stimulus::Break(fault, Duration::MAX) => {
                    writeln!(f, "{at}: {fault:?}, permanently")?
                }
                Stimulus::Break(fault, during) => writeln!(f, "{at}: {fault:?} for {during}")?,
                Stimulus::Escape(down) => writeln!(f, "{at}: escape {}", word(*down))?,
                Stimulus::Bump(down) => writeln!(f, "{at}: bumper {}", word(*down))?,
            }
        }
        Ok(())
    }
}

fn word(down: bool) -> &'static str {
    if down { "pressed" } else { "let go" }
}
