//! One step with four due guards and a running action, nothing happening.

mod board;
mod bonsai;
mod components;
mod hand;
mod plan;

use crate::measure::Race;
use crate::report::{Report, Row};

/// The time from one step to the next, and the period of everything.
const PERIOD: u64 = 10_000_000;

/// Races all of them.
pub fn run(rounds: u32, report: &mut Report) {
    let mut race = Race::default();
    race.add("hand-written", hand::case());
    race.add("bonsai-bt", bonsai::sequence());
    race.add("bonsai-bt, when_all", bonsai::when_all());
    race.add("generated", plan::case());
    let times = race.run(rounds);
    let hand = &times[0];
    report.add(Row::new("step/hand-written", hand.best(), "ns"));
    for case in &times[1..] {
        report.race("step", case, hand, (case.name == "generated").then_some(6.0));
    }
}
