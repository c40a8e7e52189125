//! What happens to the robot and the plan in a scenario, in order of time.

use std::collections::BTreeMap;

use afp::load::Injection;
use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant, Text, Value};
use afp_dsl::scenario::devices::{Control, Failure};
use afp_dsl::scenario::{self, Action, Scenario};
use afp_dsl::toolbox::Constant;
use afp_sim::Fault;

/// How long something is pressed unless a scenario says otherwise, as with `--press`.
const HOLD: u64 = 200_000_000;

/// Something to be done.
#[derive(Clone, Debug)]
pub(crate) enum Deed {
    /// An entry is written.
    Set(u16, Value),
    /// A control is held down or let go.
    Hold(Control, bool),
    /// Something breaks.
    Break(Fault, Duration),
    /// A component reports what it does not see.
    Inject(Injection),
    /// An actor, or all of them, do nothing from their next start on.
    Idle(Option<ComponentId>),
}

/// What is still to happen; at one instant in the order of the text.
#[derive(Debug, Default)]
pub(crate) struct Stimuli {
    deeds: BTreeMap<(u64, usize), (usize, Deed)>,
}

impl Stimuli {
    /// All of a scenario.
    ///
    /// # Errors
    /// The line of a fault that the simulator does not have.
    pub(crate) fn new(scenario: &Scenario) -> Result<Self, usize> {
        let mut deeds = BTreeMap::new();
        let mut add = |at: u64, line: usize, deed| {
            let order = deeds.len();
            deeds.insert((at, order), (line, deed));
        };
        for (line, stimulus) in scenario.stimuli.iter().enumerate() {
            let at = stimulus.at;
            match &stimulus.action {
                Action::Set(entry, value) => add(at, line, Deed::Set(*entry, owned(value))),
                Action::Press(control, time) => {
                    add(at, line, Deed::Hold(*control, true));
                    let end = at.saturating_add(time.unwrap_or(HOLD));
                    add(end, line, Deed::Hold(*control, false));
                }
                Action::Release(control) => add(at, line, Deed::Hold(*control, false)),
                Action::Fail(failure, time) => {
                    let fault = fault(failure).ok_or(line)?;
                    let time = time.map_or(Duration::MAX, Duration::from_nanos);
                    add(at, line, Deed::Break(fault, time));
                }
                Action::Idle(element) => {
                    add(at, line, Deed::Idle(element.map(ComponentId)));
                }
                Action::Inject(injection) => add(at, line, Deed::Inject(injected(injection))),
            }
        }
        Ok(Stimuli { deeds })
    }

    /// When the next thing happens.
    pub(crate) fn next(&self) -> Instant {
        self.deeds.keys().next().map_or(Instant::MAX, |(at, _)| Instant::from_nanos(*at))
    }

    /// The next thing that is due, with the number of its stimulus.
    pub(crate) fn take_due(&mut self, now: Instant) -> Option<(usize, Deed)> {
        if self.next() > now {
            return None;
        }
        self.deeds.pop_first().map(|(_, due)| due)
    }
}

/// A value as the run time has it.
pub(crate) fn owned(value: &Constant) -> Value {
    match value {
        Constant::Bool(value) => Value::Bool(*value),
        Constant::Int(value) => Value::Int(*value),
        Constant::Float(value) => Value::Float(*value),
        // The compiler lets no longer text through.
        Constant::Text(text) => Value::Text(Text::try_from(text.as_str()).unwrap_or_default()),
        Constant::Choice(value) => Value::Choice(*value),
    }
}

fn injected(injection: &scenario::Injection) -> Injection {
    Injection {
        component: ComponentId(injection.component),
        outcome: injection.outcome,
        outputs: injection.outputs.iter().map(|(port, value)| (*port, owned(value))).collect(),
    }
}

/// The simulator's fault.
pub(crate) fn fault(failure: &Failure) -> Option<Fault> {
    let amount = match &failure.amount {
        Some(Constant::Float(amount)) => Some(*amount),
        _ => None,
    };
    afp_carbot::table::named(failure.device, failure.kind, amount)
}
