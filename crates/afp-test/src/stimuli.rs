//! The actions of a scenario as requests to a session.

use std::collections::BTreeMap;

use afp_core::devices::{find_control, find_fault};
use afp_core::trace::{self, ComponentId, ComponentKind};
use afp_core::{Duration, EntryId, Instant};
use afp_dsl::scenario::{Action, Failure, MomentId, Outcome, Part, Scenario};
use afp_session::{AnySession, HOLD, Request, RequestError, RequestId};

/// Requests all actions after the moment `begin`, or after the start, and returns the line of each
/// request.
///
/// # Errors
/// A line with an impossible action, and the reason.
pub(crate) fn request(
    session: &mut dyn AnySession,
    scenario: &Scenario,
    from: Option<MomentId>,
    begin: Instant,
) -> Result<BTreeMap<RequestId, usize>, (usize, RequestError)> {
    let mut lines = BTreeMap::new();
    let stimuli = scenario.stimuli.iter().enumerate();
    for (line, stimulus) in stimuli.filter(|(_, stimulus)| stimulus.from == from) {
        let at = begin + Duration::from_nanos(stimulus.at);
        let made = requested(session, &stimulus.action);
        let made = made.and_then(|request| session.at(at, request));
        lines.insert(made.map_err(|why| (line, why))?, line);
    }
    Ok(lines)
}

fn requested(session: &dyn AnySession, action: &Action) -> Result<Request, RequestError> {
    let control = |control: &Part| {
        let id = find_control(session.devices(), &control.to_string());
        id.ok_or(RequestError::NoControl)
    };
    Ok(match action {
        Action::Set(entry, value) => Request::Write(EntryId(*entry), value.clone()),
        Action::Press(part, time) => {
            Request::Hold(control(part)?, time.map_or(HOLD, Duration::from_nanos))
        }
        Action::Release(part) => Request::Press(control(part)?, false),
        Action::Fail(failure, time) => {
            let Failure { fault, amount } = failure;
            let id = find_fault(session.devices(), &fault.device, &fault.name);
            let id = id.ok_or(RequestError::NoFault)?;
            let lasting = time.map_or(Duration::MAX, Duration::from_nanos);
            Request::Break(id, *amount, lasting)
        }
        Action::Idle(element) => Request::Idle(element.map(ComponentId)),
        Action::Inject(injection) => {
            let component = ComponentId(injection.component);
            let outcome = match (injection.outcome, session.names().component(component).kind) {
                (Outcome::Declared(outcome), _) => trace::Outcome::Declared(outcome),
                (Outcome::Special, ComponentKind::Supervisor) => trace::Outcome::DeadlineMissed,
                (Outcome::Special, _) => trace::Outcome::Error,
            };
            Request::Inject(component, outcome, injection.outputs.clone())
        }
    })
}
