//! What a run came to: counts from the trace, distance and wall error from the ground truth.

use afp_core::trace::{ComponentId, Ending, Kind, Names, Record};
use afp_core::{Duration, Fault, Instant, ValueRef};
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
pub struct WallError {
    sum: f64,
    /// The greatest, metres.
    pub max: f64,
    samples: u64,
}

impl WallError {
    /// The mean of its absolute value, metres.
    pub fn mean(&self) -> f64 {
        self.sum / self.samples as f64
    }

    /// How long it was judged, seconds.
    pub fn seconds(&self) -> f64 {
        self.samples as f64 * SAMPLE.as_secs_f64()
    }
}

/// Watches a run.
pub struct Judge {
    /// Activations of each component, by id.
    pub(crate) activations: Vec<u64>,
    /// How often each component reached each state or event, by id.
    pub(crate) outcomes: Vec<Vec<u64>>,
    /// How often an actor was interrupted.
    pub interruptions: u64,
    /// The way that the robot went, metres.
    pub distance: f64,
    /// How well it kept its distance to walls.
    pub wall: WallError,
    pub(crate) path: Vec<Step>,
    pub(crate) marks: Vec<Mark>,
    /// How the plan ended, once it has.
    pub ending: Option<Ending>,
    /// The actor or computation that was left last.
    left: Option<ComponentId>,
    /// What it was left for.
    cause: Option<Cause>,
    actor: Option<ComponentId>,
    follows: Option<Following>,
    followers: Vec<bool>,
    last: Option<Pose>,
}

/// What ends an activity.
#[derive(Clone, Copy, Debug)]
enum Cause {
    /// A state or event.
    Outcome(ComponentId, u16),
    /// A fault of a component.
    Fault(ComponentId, Fault),
    /// A request from outside.
    Stop,
}

#[derive(Clone, Copy)]
struct Following {
    actor: ComponentId,
    since: Instant,
    wanted: f64,
}

impl Judge {
    /// Nothing has happened yet.
    pub fn new(names: &impl Names) -> Self {
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
            left: None,
            cause: None,
            actor: None,
            follows: None,
            followers: ids().map(follows).collect(),
            last: None,
        }
    }

    /// Takes a record into account.
    pub fn hear(
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
                self.left(element, names);
            }
            Record::Finished { element, state } => {
                self.reached(element, state);
                if self.left(element, names) {
                    self.cause = Some(Cause::Outcome(element, state));
                }
            }
            Record::Faulted { component, fault } => {
                let active = self.actor;
                self.left(component, names);
                let failed = if component == ComponentId(0) { active } else { Some(component) };
                self.cause = Some(Cause::Fault(failed.unwrap_or(component), fault));
            }
            Record::Event { supervisor, event } => {
                self.reached(supervisor, event);
                self.cause = Some(Cause::Outcome(supervisor, event));
                self.marks.push(Mark { pose: truth.pose(), at, supervisor, event });
            }
            Record::StopRequested => self.cause = Some(Cause::Stop),
            Record::Ended { plan: ComponentId(0), ending } => self.ending = Some(ending),
            _ => {}
        }
    }

    /// Where the run was when it ended: the path of the actor, computation or supervisor that was left or
    /// failed last.
    pub fn place<'n>(&self, names: &'n impl Names) -> &'n str {
        let failed = match self.cause {
            Some(Cause::Fault(id, _)) => Some(id),
            _ => None,
        };
        failed.or(self.left).map_or("", |id| names.component(id).path)
    }

    /// What ended the run: a state or an event with its component, a fault by its code, or `stop`.
    pub fn cause(&self, names: &impl Names) -> String {
        match self.cause {
            None => String::new(),
            Some(Cause::Outcome(id, outcome)) => {
                format!("{}.{}", names.component(id).path, names.outcome(id, outcome))
            }
            Some(Cause::Fault(_, fault)) => fault.code().to_owned(),
            Some(Cause::Stop) => "stop".to_owned(),
        }
    }

    /// An element is left; whether it is one that does something itself.
    fn left(&mut self, element: ComponentId, names: &impl Names) -> bool {
        if self.actor == Some(element) {
            self.actor = None;
        }
        if self.follows.is_some_and(|following| following.actor == element) {
            self.follows = None;
        }
        let inner = !matches!(names.component(element).kind, Kind::Plan | Kind::SubPlan);
        if inner {
            self.left = Some(element);
        }
        inner
    }

    fn reached(&mut self, component: ComponentId, outcome: u16) {
        let counts = self.outcomes.get_mut(component.0 as usize);
        if let Some(count) = counts.and_then(|counts| counts.get_mut(usize::from(outcome))) {
            *count += 1;
        }
    }

    /// Looks at the truth; to be called every [`SAMPLE`].
    pub fn look(&mut self, now: Instant, truth: &Truth<'_>) {
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
