//! One step with four due guards and a running action, without events.

mod bonsai;
mod hand;
mod instructions;

use std::hint::black_box;

use afp_core::trace::NoTrace;
use afp_core::{Clock, Instant, StillClock};
use afp_session::Kept;

use crate::clocks::{Monotonic, Ring};
use crate::measure::Race;
use crate::plans::{loaded_step, step::Step};
use crate::report::{Report, Row};
use crate::steps::{any_session_steps, session_steps, steps};

pub use instructions::repeat;

/// The largest ratio of a generated plan to a hand-written loop, and to a behaviour tree.
const GENERATED: (f64, f64) = (6.0, 0.5);
/// The clock is read before the supervisors and after each of them.
const READINGS: u32 = 5;
/// The largest ratio of a generated plan with a real clock to the readings of the clock.
const CLOCK: f64 = 1.5;
/// The largest ratio of an interpreted plan to a behaviour tree.
const INTERPRETED: f64 = 3.0;

/// The largest overhead of a session over the bare scheduler, in nanoseconds per step: without a
/// trace, and with records kept.
const SESSION: [(&str, f64); 2] = [("session", 3.0), ("session, records kept", 6.0)];

/// Races all of them.
pub fn run(rounds: u32, report: &mut Report) {
    let mut race = Race::default();
    race.add("hand-written", hand::case());
    race.add("bonsai-bt", bonsai::when_all());
    race.add("bonsai-bt, sequence", bonsai::sequence());
    race.add("generated", steps(Step::new(), NoTrace, StillClock));
    race.add("generated, ring trace", steps(Step::new(), Ring::new(), StillClock));
    race.add("generated, monotonic clock", steps(Step::new(), NoTrace, Monotonic::new()));
    race.add("clock, five readings", readings(Monotonic::new()));
    race.add("interpreted", steps(loaded_step(), NoTrace, StillClock));
    race.add("interpreted, ring trace", steps(loaded_step(), Ring::new(), StillClock));
    race.add("interpreted, monotonic clock", steps(loaded_step(), NoTrace, Monotonic::new()));
    race.add("session", session_steps(Step::new(), NoTrace));
    race.add("session, records kept", session_steps(Step::new(), Kept::default()));
    race.add("session, any", any_session_steps(Step::new()));
    let times = race.run(rounds);
    let [hand, bonsai, ..] = &times[..] else { return };
    report.add(Row::new("step/hand-written", hand.median, "ns"));
    for case in &times[1..] {
        let generated = case.name == "generated";
        report.race("step", case, hand, generated.then_some(GENERATED.0));
        if generated {
            report.race("step", case, bonsai, Some(GENERATED.1));
        }
        if case.name == "interpreted" {
            report.race("step", case, bonsai, Some(INTERPRETED));
        }
    }
    instructions::run(report);
    let named = |name: &str| times.iter().find(|case| case.name == name);
    let clocks = named("generated, monotonic clock").zip(named("clock, five readings"));
    if let Some((step, readings)) = clocks {
        report.race("step", step, readings, Some(CLOCK));
    }
    for (name, most) in SESSION {
        if let Some((session, bare)) = named(name).zip(named("generated")) {
            let beyond = session.beyond(bare);
            let row = Row::new(format!("step/{name}, beyond generated"), beyond, "ns");
            report.add(row.limit(format!("<= {most} ns"), beyond <= most));
        }
    }
}

/// The readings of a clock in one step.
fn readings(clock: Monotonic) -> impl FnMut(u64) {
    move |count| {
        for _ in 0..count {
            for _ in 0..READINGS {
                black_box(clock.now(black_box(Instant::ZERO)));
            }
        }
    }
}
