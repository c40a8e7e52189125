//! A step with a transition: guards polled, an actor finishes, its output is committed, two guards
//! start and look, the next actor starts.

use afp_core::StillClock;
use afp_core::trace::NoTrace;

use crate::clocks::Ring;
use crate::measure::Race;
use crate::plans::{loaded_transition, transition::Transition};
use crate::report::{Report, Row};
use crate::steps::steps;

/// Races the generated and the interpreted plan.
pub fn run(rounds: u32, report: &mut Report) {
    let mut race = Race::default();
    race.add("generated", steps(Transition::new(), NoTrace, StillClock));
    race.add("generated, ring trace", steps(Transition::new(), Ring::new(), StillClock));
    race.add("interpreted", steps(loaded_transition(), NoTrace, StillClock));
    race.add("interpreted, ring trace", steps(loaded_transition(), Ring::new(), StillClock));
    let times = race.run(rounds);
    let Some(generated) = times.first() else { return };
    report.add(Row::new("transition/generated", generated.median, "ns"));
    for case in &times[1..] {
        report.race("transition", case, generated, None);
    }
}
