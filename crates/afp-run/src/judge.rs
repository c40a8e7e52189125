//! What a run came to: counts from the trace, distance and wall error from the ground truth.

use afp_core::trace::{ComponentId, Ending, Kind, Names, Record};
use afp_core::{Duration, Instant, ValueRef};
use afp_sim::{Pose, Truth};

use crate::rig::SAMPLE;

/// Wall following counts from so long after its start.
const SETTLING: Duration = Duration::from_secs(2);
/// The template whose wall distance is judged, and its input that says which.
const FOLLOWER: &str = "WallForward";
const DISTANCE_PORT: &str = "walldist";

/// A point of the path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub pose: Pose,
    /// The actor that was active.
    pub actor: Option<ComponentId>,
}

/// Something on the path worth a symbol.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    pub pose: Pose,
    pub at: Instant,
    pub supervisor: ComponentId,
    pub event: u16,
}

/// The error of wall following so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WallError {
    sum: f64,
    /// The greatest, metres.
    pub max: f64,
    samples: u64,
}

impl WallError {
    /// The mean of its absolute value, metres.
    pub(crate) fn mean(&self) -> f64 {
        self.sum / self.samples as f64
    }

    /// How long it was judged, seconds.
    pub(crate) fn seconds(&self) -> f64 {
        self.samples as f64 * SAMPLE.as_secs_f64()
    }
}

/// Watches a run.
pub(crate) struct Judge {
    /// Activations of each component, by id.
    pub activations: Vec<u64>,
    /// How often each component reached each state or event, by id.
    pub outcomes: Vec<Vec<u64>>,
    pub interruptions: u64,
    pub distance: f64,
    pub wall: WallError,
    pub path: Vec<Step>,
    pub marks: Vec<Mark>,
    pub ending: Option<Ending>,
    actor: Option<ComponentId>,
    follows: Option<Following>,
    followers: Vec<bool>,
    last: Option<Pose>,
}

#[derive(Clone, Copy)]
struct Following {
    actor: ComponentId,
    since: Instant,
    wanted: f64,
}

impl Judge {
    pub(crate) fn new(names: &impl Names) -> Self {
        let ids = || (0..names.components()).map(ComponentId);
        let known = |id| (0..).take_while(move |n| !names.outcome(id, *n).is_empty()).count();
        let follows = |id| {
            let name = names.component(id);
            name.template == FOLLOWER && name.kind == Kind::Actor
        };
        Judge {
            activations: vec![0; ids().count()],
            outcomes: ids().map(|id| vec![0; known(id)]).collect(),
            interruptions: 0,
            distance: 0.0,
            wall: WallError::default(),
            path: Vec::new(),
            marks: Vec::new(),
            ending: None,
            actor: None,
            follows: None,
            followers: ids().map(follows).collect(),
            last: None,
        }
    }

    /// Takes a record into account.
    pub(crate) fn hear(
        &mut self,
        at: Instant,
        record: &Record<'_>,
        names: &impl Names,
        truth: &Truth<'_>,
    ) {
        match *record {
            Record::Input { component, port, value: ValueRef::Float(wanted) }
                if self.followers.get(component.0 as usize) == Some(&true)
                    && names.input(component, port) == DISTANCE_PORT =>
            {
                self.follows = Some(Following { actor: component, since: at, wanted });
            }
            Record::Started { component } => {
                if let Some(count) = self.activations.get_mut(component.0 as usize) {
                    *count += 1;
                }
                if names.component(component).kind == Kind::Actor {
                    self.actor = Some(component);
                }
            }
            Record::Interrupted { element } => {
                if names.component(element).kind == Kind::Actor {
                    self.interruptions += 1;
                }
                self.left(element);
            }
            Record::Finished { element, state } => {
                self.reached(element, state);
                self.left(element);
            }
            Record::Faulted { component, .. } => self.left(component),
            Record::Event { supervisor, event } => {
                self.reached(supervisor, event);
                self.marks.push(Mark { pose: truth.pose(), at, supervisor, event });
            }
            Record::Ended { plan: ComponentId(0), ending } => self.ending = Some(ending),
            _ => {}
        }
    }

    fn left(&mut self, element: ComponentId) {
        if self.actor == Some(element) {
            self.actor = None;
        }
        if self.follows.is_some_and(|following| following.actor == element) {
            self.follows = None;
        }
    }

    fn reached(&mut self, component: ComponentId, outcome: u16) {
        let counts = self.outcomes.get_mut(component.0 as usize);
        if let Some(count) = counts.and_then(|counts| counts.get_mut(usize::from(outcome))) {
            *count += 1;
        }
    }

    /// Looks at the truth; to be called every [`SAMPLE`].
    pub(crate) fn look(&mut self, now: Instant, truth: &Truth<'_>) {
        let pose = truth.pose();
        if let Some(last) = self.last {
            self.distance += libm::hypot(pose.x - last.x, pose.y - last.y);
        }
        self.last = Some(pose);
        self.path.push(Step { pose, actor: self.actor });
        if let Some(following) = self.follows
            && now.since(following.since) >= SETTLING
            && let Some(gap) = truth.right_side_gap()
        {
            let error = (gap - following.wanted).abs();
            self.wall.sum += error;
            self.wall.max = self.wall.max.max(error);
            self.wall.samples += 1;
        }
    }
}
