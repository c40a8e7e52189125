//! The scenarios of one element and one of its supervisors.

use afp_core::Instant;
use afp_dsl::graph::Component;
use afp_dsl::scenario::DEFAULT_UNTIL;
use afp_dsl::unfold::{Goal, Place};

use super::draft::Draft;
use super::reach::SampleRun;
use super::{Generated, Rest};
use crate::parts::Parts;
use crate::watch::Activation;
use afp_dsl::types::text::duration;

/// The points of an element's run, in percent.
const POINTS: [u64; 5] = [10, 30, 50, 70, 90];
/// The duration of a scenario after the robot has to stop, in nanoseconds.
const BEHIND: u64 = 200_000_000;

/// An element and one of its supervisors.
pub(super) struct Pair<'a> {
    pub parts: &'a Parts<'a>,
    pub rest: Rest,
    /// The run and the time of the element's activation.
    pub run: &'a SampleRun,
    pub active: Activation,
    pub element: u32,
    pub supervisor: u32,
}

/// A poll of the supervisor.
#[derive(Clone, Copy)]
struct Point {
    percent: u64,
    /// Nanoseconds from the start of the run.
    at: u64,
}

impl Pair<'_> {
    pub fn add(&self, all: &mut Generated) {
        let Some(place) = self.parts.place(self.supervisor) else { return };
        let points = self.points();
        for event in (0..).take(place.outcomes.len()) {
            let goal = self.parts.goal_at(self.element, self.supervisor, event);
            let Some(goal) = goal.filter(|goal| *goal != Goal::Ignore) else { continue };
            let name = self.parts.outcome(self.supervisor, event);
            let computes = |to| self.parts.place(to).is_some_and(|place| place.resumes);
            if matches!(goal, Goal::Element(to) if computes(to)) {
                let path = self.parts.path(self.supervisor);
                all.left_out.push(format!(
                    "'{path}.{name}' leads to computations, whose values select the next element"
                ));
                continue;
            }
            if matches!(goal, Goal::Suspend(_) | Goal::Return) {
                let path = self.parts.path(self.supervisor);
                all.left_out.push(format!("'{path}.{name}' suspends or returns"));
                continue;
            }
            let Some((_, fire)) = self.parts.injection(self.supervisor, event) else {
                let path = self.parts.path(self.supervisor);
                all.left_out.push(format!("'{path}.{name}' has an object"));
                continue;
            };
            if points.is_empty() {
                let path = self.parts.path(self.element);
                let supervisor = self.parts.name(self.supervisor);
                all.left_out.push(format!(
                    "'{path}' is active for too short a time to be interrupted by '{supervisor}'"
                ));
                return;
            }
            let drafts = points.iter().filter_map(|point| self.draft(*point, event, goal, &fire));
            all.drafts.extend(drafts);
        }
    }

    /// The polls at these percentages of the element's run.
    fn points(&self) -> Vec<Point> {
        let Some(every) =
            self.parts.supervisor(self.supervisor).map(|each| each.timing.period.as_nanos())
        else {
            return Vec::new();
        };
        let (from, to) = (self.active.from.as_nanos(), self.active.to.as_nanos());
        let point = |percent: &u64| {
            let wanted = from + (to - from) / 100 * percent;
            let since = self.run.since(self.supervisor, Instant::from_nanos(wanted))?.as_nanos();
            let polls = (wanted - since).div_ceil(every);
            let at = since + polls * every;
            (from < at && at < to).then_some(Point { percent: *percent, at })
        };
        let mut points: Vec<_> = POINTS.iter().filter_map(point).collect();
        points.dedup_by_key(|point| point.at);
        points
    }

    /// The longest time to the next poll, in nanoseconds. The polls continue across elements, so
    /// their phase varies.
    fn wait(&self) -> u64 {
        let own = |place: &Place| place.owner == Some(self.element);
        match self.parts.place(self.supervisor).is_some_and(own) {
            true => 0,
            false => self
                .parts
                .supervisor(self.supervisor)
                .map_or(0, |each| each.timing.period.as_nanos()),
        }
    }

    /// Marks the plan's supervisor in a title, if the element has one with the same name.
    fn whose(&self) -> &'static str {
        let name = self.parts.name(self.supervisor);
        let over = self.parts.supervisors_over(self.element).into_iter();
        let same = over.filter(|other| self.parts.name(*other) == name).count();
        let own = self.parts.place(self.supervisor).is_some_and(|place| place.owner.is_some());
        if same > 1 && !own { " of the plan" } else { "" }
    }

    fn draft(&self, point: Point, event: u16, goal: Goal, fire: &str) -> Option<Draft> {
        let Point { percent, at } = point;
        let since = self.active.from.as_nanos();
        let supervisor = self.parts.supervisor(self.supervisor)?;
        let (parts, element) = (self.parts, self.parts.path(self.element));
        let name = format!("{}.{}", supervisor.name, parts.outcome(self.supervisor, event));
        // It resumes, or the global supervisor's target is already active.
        let there = goal == Goal::Resume
            || goal == Goal::Element(self.element) && supervisor.owner.is_none();
        let wait = self.wait();
        let (time, within) =
            (duration(at - since), duration(wait + supervisor.timing.deadline.as_nanos()));
        let soon = format!("within {within} after {time}");
        let stand = self.standstill(at).map(|stand| stand + wait);
        let ending = self.ending(goal, &soon).filter(|_| !there);
        let (mut lines, ends) = (Vec::new(), ending.is_some());
        if !there {
            lines.push(format!("at {time}: idle all"));
        }
        lines.push(format!("at {time}: {fire}"));
        if there {
            lines.push(format!("never interrupt of {element} {soon}"));
        } else {
            let to =
                goal.map(|to| self.beside(parts.name(to)), |()| ()).text(String::clone).to_string();
            lines.push(format!("expect {element} -> {to} by {name} once {soon}"));
            lines.extend(ending);
            match goal {
                Goal::Suspend(_) => lines.push(format!("expect {element} suspended {soon}")),
                _ => lines.extend(self.interrupts(at, &soon)),
            }
            lines.extend(self.commits(at, event, goal, &soon));
            if self.rest.halted {
                lines.push(format!("expect halted always after {}", duration(at + wait - since)));
            }
            lines.extend(
                stand.filter(|_| self.rest.standing).map(|stand| {
                    format!("expect standing always after {}", duration(stand - since))
                }),
            );
        }
        let end = stand.unwrap_or(at + wait + supervisor.timing.deadline.as_nanos()) + BEHIND;
        Some(Draft {
            title: format!("{element}: {name}{} at {percent} %", self.whose()),
            plan: parts.path(0).to_owned(),
            setting: self.setting(at),
            element: element.to_owned(),
            lines,
            until: duration(end - since),
            ends,
            proven: false,
        })
    }

    /// The lines that lead to the element: the seed, the actions on the path, and a margin for a
    /// longer path.
    fn setting(&self, at: u64) -> Vec<String> {
        let seed = (self.run.seed != 0).then(|| format!("seed {}", self.run.seed));
        let steps = self.run.steps_before(at).map(|step| {
            let element = self.parts.path(step.active.element);
            format!("from {element} active {{ at {}: {} }}", duration(step.after()), step.text)
        });
        let until = (at > DEFAULT_UNTIL / 2).then(|| format!("until {}", duration(2 * at)));
        seed.into_iter().chain(steps).chain(until).collect()
    }

    /// The full name of an element in the same plan.
    fn beside(&self, name: &str) -> String {
        let path = self.parts.path(self.element);
        path.rsplit_once('.').map_or(name.to_owned(), |(home, _)| format!("{home}.{name}"))
    }

    /// The ending of the outermost plan, if the sub-plans on the path only end.
    fn ending(&self, goal: Goal, soon: &str) -> Option<String> {
        let mut how = ended_by(goal, "Interrupted")?;
        let mut plan = self.parts.place(self.element)?.plan;
        while plan != 0 {
            let place = self.parts.place(plan)?;
            let outcomes = 0..u16::try_from(place.outcomes.len()).ok()?;
            let mut named = outcomes.filter(|number| self.parts.outcome(plan, *number) == how);
            how = ended_by(self.parts.goal(plan, named.next()?)?, "OK")?;
            plan = place.plan;
        }
        Some(format!("expect end by {how} once {soon}"))
    }

    /// The interrupted components: the element and the active ones inside it.
    fn chain(&self, at: u64) -> Vec<u32> {
        let lasts = |number: &u32| {
            let component = self.parts.component(*number);
            matches!(component, Some(Component::Actor(_) | Component::SubPlan(_)))
        };
        let within = |number: &u32| self.parts.is_within(*number, self.element);
        self.run
            .active(Instant::from_nanos(at))
            .filter(|each| lasts(each) && within(each))
            .collect()
    }

    fn interrupts(&self, at: u64, soon: &str) -> Vec<String> {
        let interrupt =
            |number| format!("expect interrupt of {} once {soon}", self.parts.path(number));
        self.chain(at).into_iter().map(interrupt).collect()
    }

    /// The event's commit is complete and happens once, and interrupted components write nothing.
    fn commits(&self, at: u64, event: u16, goal: Goal, soon: &str) -> Vec<String> {
        let parts = self.parts;
        let path = parts.path(self.supervisor);
        let brought: Vec<u32> =
            parts.brought(self.supervisor, event).into_iter().map(|out| out.0).collect();
        let mut lines = Vec::new();
        if !brought.is_empty() {
            lines.push(format!("expect commit by {path} once {soon}"));
        } else if !parts.written(self.supervisor).is_empty() {
            lines.push(format!("never commit by {path} {soon}"));
        }
        for entry in &brought {
            let entry = parts.entry(*entry);
            lines.push(format!("expect commit of {entry} by {path} once {soon}"));
        }
        // If the plan continues with more than an actor, others may also write the entries.
        let alone = match goal {
            Goal::Element(to) => matches!(parts.component(to), Some(Component::Actor(_))),
            Goal::Terminate | Goal::Fail(_) => {
                parts.place(self.element).is_some_and(|place| place.plan == 0)
            }
            Goal::Ignore | Goal::Resume | Goal::Suspend(_) | Goal::Return => false,
        };
        for number in self.chain(at) {
            let written = parts.written(number);
            if !written.is_empty() {
                lines.push(format!("never commit by {} {soon}", parts.path(number)));
            }
            for entry in written.iter().filter(|entry| alone && !brought.contains(*entry)) {
                lines.push(format!("never commit of {} {soon}", parts.entry(*entry)));
            }
        }
        lines
    }

    /// The instant when the robot must have stopped: each interrupted actor stops within its stop
    /// time.
    fn standstill(&self, at: u64) -> Option<u64> {
        let now = Instant::from_nanos(at);
        let chain = self.chain(at);
        let mut active = chain.iter().filter_map(|number| self.parts.stop(*number));
        active.next()?;
        let ends = self.run.before(now).filter_map(|active| {
            let end = active.to.as_nanos().min(at);
            Some(end + self.parts.stop(active.element)?)
        });
        ends.max()
    }
}

/// The ending of a plan whose edge has that target; `terminated` names the end by `terminate`.
fn ended_by(goal: Goal, terminated: &'static str) -> Option<&'static str> {
    match goal {
        Goal::Terminate => Some(terminated),
        Goal::Fail(_) => Some("Error"),
        Goal::Element(_) | Goal::Ignore | Goal::Resume | Goal::Suspend(_) | Goal::Return => None,
    }
}
