//! What a scenario does to the robot and the plan, as requests of a session.

use std::collections::BTreeMap;

use afp::load::Injection;
use afp_core::devices::{find_control, find_fault};
use afp_core::trace::{ComponentId, DEADLINE_MISSED, ERROR, Kind, Names};
use afp_core::{Duration, Instant, Text, Value};
use afp_dsl::scenario::{self, Action, Failure, Outcome, Part, Scenario};
use afp_dsl::toolbox::Constant;
use afp_session::{AnySession, HOLD, Request, RequestError, RequestId};

/// Asks for all that happens in a scenario; gives the line that each request stands for.
///
/// # Errors
/// A line that can never be done, and why.
pub(crate) fn request(
    session: &mut dyn AnySession,
    scenario: &Scenario,
) -> Result<BTreeMap<RequestId, usize>, (usize, RequestError)> {
    let mut lines = BTreeMap::new();
    for (line, stimulus) in scenario.stimuli.iter().enumerate() {
        let at = Instant::from_nanos(stimulus.at);
        let requests = requests(session, at, &stimulus.action).map_err(|why| (line, why))?;
        for (at, request) in requests {
            lines.insert(session.at(at, request).map_err(|why| (line, why))?, line);
        }
    }
    Ok(lines)
}

/// What an action asks for, and when.
fn requests(
    session: &dyn AnySession,
    at: Instant,
    action: &Action,
) -> Result<Vec<(Instant, Request)>, RequestError> {
    let press = |at: Instant, control: &Part, held| {
        let id = find_control(session.devices(), &control.to_string());
        let id = id.ok_or(RequestError::NoControl)?;
        Ok((at, Request::Press(id, held)))
    };
    Ok(match action {
        Action::Set(entry, value) => vec![(at, Request::Write(*entry, owned(value)))],
        Action::Press(control, time) => {
            let end = at + time.map_or(HOLD, Duration::from_nanos);
            vec![press(at, control, true)?, press(end, control, false)?]
        }
        Action::Release(control) => vec![press(at, control, false)?],
        Action::Fail(failure, time) => {
            let Failure { fault, amount } = failure;
            let id = find_fault(session.devices(), &fault.device, &fault.name);
            let id = id.ok_or(RequestError::NoFault)?;
            let lasting = time.map_or(Duration::MAX, Duration::from_nanos);
            vec![(at, Request::Break(id, *amount, lasting))]
        }
        Action::Idle(element) => vec![(at, Request::Idle(element.map(ComponentId)))],
        Action::Inject(injection) => {
            vec![(at, Request::Inject(injected(injection, session.names())))]
        }
    })
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

fn injected(injection: &scenario::Injection, names: &dyn Names) -> Injection {
    let component = ComponentId(injection.component);
    Injection {
        component,
        outcome: match (injection.outcome, names.component(component).kind) {
            (Outcome::Declared(outcome), _) => outcome,
            (Outcome::Special, Kind::Supervisor) => DEADLINE_MISSED,
            (Outcome::Special, _) => ERROR,
        },
        outputs: injection.outputs.iter().map(|(port, value)| (*port, owned(value))).collect(),
    }
}
