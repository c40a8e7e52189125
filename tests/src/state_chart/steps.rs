//! From a trace to the events of a chart and the active states in between.

use afp_core::Fault;
use afp_core::trace::{ComponentId, Ending, Outcome, Record};
use serde_json::{Value, json};

use super::places::{Kind, Place, Places};

/// The records about the flow of action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    StopRequested,
    Event(ComponentId, Outcome),
    AlreadyThere(ComponentId, Outcome),
    Diverted(ComponentId),
    Resumed(ComponentId),
    Interrupted(ComponentId),
    Suspended(ComponentId),
    Returned(ComponentId),
    Abandoned(ComponentId),
    Finished(ComponentId, Outcome),
    Started(ComponentId),
    Faulted(ComponentId),
    Ended(ComponentId, Ending),
}

/// The outermost plan.
const WHOLE: ComponentId = ComponentId(0);

impl Seen {
    pub fn of(record: &Record<'_>) -> Option<Seen> {
        Some(match *record {
            Record::StopRequested => Seen::StopRequested,
            Record::Event { supervisor, event, .. } => Seen::Event(supervisor, event),
            Record::AlreadyThere { supervisor, event, .. } => Seen::AlreadyThere(supervisor, event),
            Record::Diverted { element, .. } => Seen::Diverted(element),
            Record::Resumed { element, .. } => Seen::Resumed(element),
            Record::Interrupted { element } => Seen::Interrupted(element),
            Record::Suspended { element, .. } => Seen::Suspended(element),
            Record::Returned { component, .. } => Seen::Returned(component),
            Record::Abandoned { element, .. } => Seen::Abandoned(element),
            Record::Finished { element, state } => Seen::Finished(element, state),
            Record::Started { component } => Seen::Started(component),
            // The record names the panicking component; the whole plan fails.
            Record::Faulted { fault, .. } if fault == Fault::PANIC => Seen::Faulted(WHOLE),
            Record::Faulted { component, .. } => Seen::Faulted(component),
            Record::Ended { plan, ending } => Seen::Ended(plan, ending),
            _ => return None,
        })
    }
}

/// An event and the expectations after it.
#[derive(Default)]
struct Step {
    event: Option<String>,
    active: Vec<String>,
    only: Option<String>,
    same: bool,
}

/// A run.
pub struct Steps {
    /// The start and all events; never empty.
    steps: Vec<Step>,
    /// Whether the chart cannot follow the rest of the run.
    pub cut: bool,
    /// Whether the plan was asked to stop.
    stopping: bool,
    /// The step that ended with the last event or fault, before computations that could have
    /// resumed.
    found: usize,
    /// The elements that have started, and are neither left nor suspended.
    active: Vec<ComponentId>,
    /// The elements that are suspended.
    aside: Vec<ComponentId>,
}

impl Steps {
    /// The steps in the format of the engine's program.
    pub fn json(&self) -> Value {
        let step = |step: &Step| {
            let Step { event, active, only, same } = step;
            json!({ "event": event, "active": active, "only": only, "same": same })
        };
        self.steps.iter().map(step).collect()
    }

    /// Notes which elements are active and which are suspended.
    fn follow(&mut self, record: Seen) {
        match record {
            Seen::Started(element) | Seen::Returned(element) => {
                self.forget(element);
                self.active.push(element);
            }
            Seen::Suspended(element) => {
                self.forget(element);
                self.aside.push(element);
            }
            Seen::Interrupted(element) | Seen::Finished(element, _) | Seen::Abandoned(element) => {
                self.forget(element);
            }
            _ => {}
        }
    }

    fn forget(&mut self, element: ComponentId) {
        self.active.retain(|other| *other != element);
        self.aside.retain(|other| *other != element);
    }

    /// Whether an element is inside a suspended sub-plan.
    fn is_aside(&self, places: &Places, element: ComponentId) -> bool {
        let state = &places.get(element).state;
        self.aside.iter().any(|outer| {
            let inner = state.strip_prefix(&places.get(*outer).state);
            inner.is_some_and(|rest| rest.starts_with('.'))
        })
    }

    fn feed(&mut self, event: String) {
        self.steps.push(Step { event: Some(event), ..Step::default() });
    }

    fn last(&mut self) -> &mut Step {
        let last = self.steps.len() - 1;
        &mut self.steps[last]
    }

    /// The step that the last event ended.
    fn before(&mut self) -> &mut Step {
        &mut self.steps[self.found]
    }
}

impl Step {
    /// Control is at an element: exactly there, if the element has no inner states.
    fn is_at(&mut self, place: &Place) {
        match place.kind {
            Kind::Actor | Kind::Computation => self.only = Some(place.state.clone()),
            _ => self.is_at_least(place),
        }
    }

    /// Control is at an element or inside it.
    fn is_at_least(&mut self, place: &Place) {
        self.active.push(place.state.clone());
    }
}

pub fn steps(places: &Places, seen: &[Seen]) -> Steps {
    let start = Step::default();
    let mut steps = Steps {
        steps: vec![start],
        cut: false,
        stopping: false,
        found: 0,
        active: Vec::new(),
        aside: Vec::new(),
    };
    for (at, record) in seen.iter().enumerate() {
        let previous = at.checked_sub(1).map(|previous| seen[previous]);
        step(places, &mut steps, previous, *record, &seen[at + 1..]);
        steps.follow(*record);
        if steps.cut {
            break;
        }
    }
    steps
}

fn step(places: &Places, steps: &mut Steps, previous: Option<Seen>, record: Seen, rest: &[Seen]) {
    match record {
        Seen::StopRequested => steps.stopping = true,
        Seen::Event(supervisor, event) => {
            let place = places.get(supervisor);
            steps.last().is_at(place);
            if !fails(rest) {
                steps.found = steps.steps.len() - 1;
                steps.feed(place.event(event));
            }
        }
        Seen::AlreadyThere(supervisor, event) => {
            steps.feed(places.get(supervisor).event(event));
            steps.last().same = true;
        }
        // Both come after the event that caused them.
        Seen::Diverted(element) => steps.before().is_at_least(places.get(element)),
        Seen::Resumed(element) => steps.last().is_at_least(places.get(element)),
        // The chart has left it with the suspended sub-plan.
        Seen::Interrupted(element) if steps.is_aside(places, element) => {}
        Seen::Interrupted(element) => {
            let step = if steps.stopping { steps.last() } else { steps.before() };
            step.is_at(places.get(element));
        }
        Seen::Suspended(element) => steps.before().is_at_least(places.get(element)),
        Seen::Returned(component) if places.get(component).kind == Kind::Supervisor => {}
        Seen::Returned(element) => steps.last().is_at_least(places.get(element)),
        Seen::Abandoned(_) => {}
        Seen::Started(component) => steps.last().is_at(places.get(component)),
        // The chart itself makes the event for the end of a sub-plan's body.
        Seen::Finished(element, _) if places.get(element).kind == Kind::SubPlan => {}
        Seen::Finished(element, state) => {
            let place = places.get(element);
            steps.last().is_at(place);
            steps.feed(place.event(state));
        }
        Seen::Faulted(component) => faulted(places, steps, previous, component, rest),
        Seen::Ended(WHOLE, ending) => ended(places, ending, steps),
        Seen::Ended(plan, ending) => {
            let finishes = matches!(rest, [Seen::Finished(element, _), ..] if *element == plan);
            // An initial value is out of its range, but the chart is already inside the plan.
            let never_began = previous == Some(Seen::Started(plan));
            steps.cut = never_began || !matches!(ending, Ending::Error(_)) && !finishes;
        }
    }
}

/// Whether the whole run fails next: an `interrupt` failed or a component panicked, so control is
/// nowhere.
fn fails(rest: &[Seen]) -> bool {
    let mut faults = rest.iter().map_while(|record| match record {
        Seen::Faulted(component) => Some(*component),
        _ => None,
    });
    faults.any(|component| component == WHOLE)
}

fn faulted(
    places: &Places,
    steps: &mut Steps,
    previous: Option<Seen>,
    component: ComponentId,
    rest: &[Seen],
) {
    // A sub-plan whose body has ended in `Error` has already ended.
    let left = matches!(
        previous,
        Some(Seen::Ended(plan, Ending::Error(_))) if plan == component && plan != WHOLE
    );
    if fails(rest) || left {
        return;
    }
    let place = places.get(component);
    // The element could not be suspended, but the chart is already at the handler.
    let by_event = matches!(previous, Some(Seen::Event(..) | Seen::Finished(..)));
    if by_event && place.kind != Kind::Computation && steps.active.contains(&component) {
        steps.cut = true;
        return;
    }
    steps.last().is_at_least(place);
    if place.kind != Kind::Computation {
        steps.found = steps.steps.len() - 1;
    }
    steps.feed(place.fault());
}

fn ended(places: &Places, ending: Ending, steps: &mut Steps) {
    if steps.stopping && ending == Ending::Interrupted {
        steps.feed(":stopped".to_owned());
    }
    let end = match ending {
        Ending::Ok => "OK",
        Ending::Interrupted => "Interrupted",
        Ending::Error(_) => "Error",
    };
    steps.last().only = Some(format!("{}-{end}", places.get(WHOLE).state));
}
