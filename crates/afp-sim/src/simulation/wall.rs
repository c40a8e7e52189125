//! The error of the robot's distance to a wall while it follows one: an optional measure.

use afp_core::trace::{ComponentId, ComponentKind, Record};
use afp_core::{Duration, Instant, ValueRef};
use afp_session::{Figure, FigureValue, Measure, NamedRecord, SAMPLE};

use super::Simulation;

/// Errors count after this time of wall following.
const SETTLING: Duration = Duration::from_secs(2);
/// The template for wall following, and the input with its distance.
const FOLLOWER: &str = "WallForward";
const DISTANCE_PORT: &str = "walldist";

#[derive(Clone, Debug, Default)]
pub(crate) struct WallDistance {
    /// The sum of absolute values, in metres.
    sum: f64,
    max: f64,
    samples: u64,
    following: Option<Following>,
}

#[derive(Clone, Copy, Debug)]
struct Following {
    actor: ComponentId,
    since: Instant,
    wanted: f64,
}

impl WallDistance {
    pub(crate) const NAME: &str = "wall";
}

impl Measure<Simulation> for WallDistance {
    fn on_record(&mut self, named: &NamedRecord<'_>, _: &Simulation) {
        let names = named.names;
        match *named.record {
            Record::Input { component, port, value: ValueRef::Float(wanted) } => {
                let known = names.component(component);
                let follows = known.template == FOLLOWER && known.kind == ComponentKind::Actor;
                if follows && names.input(component, port) == DISTANCE_PORT {
                    self.following = Some(Following { actor: component, since: named.at, wanted });
                }
            }
            Record::Suspended { started: true, .. } => self.following = None,
            Record::Interrupted { element: left }
            | Record::Finished { element: left, .. }
            | Record::Faulted { component: left, .. }
                if self.following.is_some_and(|following| following.actor == left) =>
            {
                self.following = None;
            }
            _ => {}
        }
    }

    fn on_sample(&mut self, at: Instant, robot: &Simulation) {
        if let Some(following) = self.following
            && at.since(following.since) >= SETTLING
            && let Some(gap) = robot.truth().right_side_wall()
        {
            let error = (gap - following.wanted).abs();
            self.sum += error;
            self.max = self.max.max(error);
            self.samples += 1;
        }
    }

    fn figures(&self) -> Vec<Figure> {
        if self.samples == 0 {
            return Vec::new();
        }
        let (mean, max) = (self.sum / self.samples as f64, self.max);
        let judged = self.samples as f64 * SAMPLE.as_secs_f64();
        let text = format!(
            "{:.2} cm mean, {:.2} cm at most, {judged:.1} s judged",
            mean * 100.0,
            max * 100.0
        );
        let numbers = vec![("mean_m", mean), ("max_m", max), ("judged_s", judged)];
        vec![Figure { name: "wall_error", value: FigureValue::Numbers(numbers), text }]
    }

    fn keyframe(&self) -> Option<Box<dyn Measure<Simulation>>> {
        Some(Box::new(self.clone()))
    }
}
