//! Scenarios made from a plan: every event of every supervisor, at five points of each actor's run.
//!
//! A run without stimuli says when each actor is active; what it never reaches has no scenario, and the
//! text says so.

use std::fmt::Write;

use afp_dsl::graph::{Component, ElementId, Graph, Plan, Supervisor, SupervisorId, Target};
use afp_dsl::toolbox::OutPort;
use afp_dsl::types::Type;

use crate::watch::Activation;

/// The points of an actor's run, in percent.
const POINTS: [u64; 5] = [10, 30, 50, 70, 90];
/// Points are whole milliseconds.
const GRAIN: u64 = 1_000_000;
/// A scenario goes on for so long behind its point, nanoseconds.
const BEHIND: u64 = 1_000_000_000;

/// The text of a file of scenarios.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generated {
    /// The text, as the formatter would have it but for alignment.
    pub text: String,
    /// How many scenarios it has.
    pub scenarios: usize,
    /// What has none, and why.
    pub left_out: Vec<String>,
}

/// Scenarios for the outermost plan of a graph. `from` is its file, seen from the one to be written;
/// `activations` are those of a run without stimuli, at seed 0 in the plan's own world.
pub fn generate(graph: &Graph, from: &str, activations: &[Activation]) -> Generated {
    let mut all = Generated { text: String::new(), scenarios: 0, left_out: Vec::new() };
    let plan = graph.main();
    for (element, number) in plan.elements.iter().zip(1_u32..) {
        if matches!(element.component, Component::Computation(_)) {
            continue;
        }
        let runs = activations.iter().filter(|run| run.element == number);
        let Some(run) = runs.max_by_key(|run| run.to.since(run.from)) else {
            all.left_out.push(format!("'{}' is not reached", element.name));
            continue;
        };
        let globals = (0..plan.globals).map(SupervisorId);
        let locals = element.supervisors.iter().copied();
        for id in globals.chain(locals) {
            let pair = Pair { graph, plan, element: ElementId((number - 1) as u16), id };
            pair.add(run, &mut all);
        }
    }
    let mut text = format!(
        "use \"{from}\"\n\n// Made by 'afpc test --generate'; seed 0, the plan's own world.\n"
    );
    for why in &all.left_out {
        let _ = writeln!(text, "// Left out: {why}.");
    }
    text.push_str(&all.text);
    Generated { text, ..all }
}

/// An actor or sub-plan and a supervisor that watches over it.
struct Pair<'a> {
    graph: &'a Graph,
    plan: &'a Plan,
    element: ElementId,
    id: SupervisorId,
}

impl Pair<'_> {
    fn supervisor(&self) -> &Supervisor {
        &self.plan.supervisors[self.id.index()]
    }

    fn add(&self, run: &Activation, all: &mut Generated) {
        let supervisor = self.supervisor();
        let events = &self.graph.template(supervisor.template).outcomes;
        for (place, (event, target)) in (0..).zip(events.iter().zip(&supervisor.events)) {
            let back = *target == Target::Element(self.element) && supervisor.owner.is_none();
            if *target == Target::Ignore || back {
                continue;
            }
            let Some(values) = self.values(place) else {
                all.left_out.push(format!("'{}.{}' brings an object", supervisor.name, event.name));
                continue;
            };
            let points = self.points(run);
            if points.is_empty() {
                let name = &self.plan.elements[self.element.index()].name;
                all.left_out.push(format!("'{name}' is active for too short a time"));
                return;
            }
            for (percent, at) in points {
                self.write(&event.name, *target, &values, (percent, at), all);
            }
        }
    }

    /// Points at which nothing else happens before the supervisor is polled next.
    fn points(&self, run: &Activation) -> Vec<(u64, u64)> {
        let (from, to) = (run.from.as_nanos(), run.to.as_nanos());
        let at = |percent: u64| (from + (to - from) / 100 * percent) / GRAIN * GRAIN;
        let points = POINTS.iter().map(|percent| (*percent, at(*percent)));
        points.filter(|(_, at)| *at > from && at + self.supervisor().every < to).collect()
    }

    fn write(
        &self,
        event: &str,
        target: Target,
        values: &str,
        (percent, at): (u64, u64),
        all: &mut Generated,
    ) {
        let supervisor = self.supervisor();
        let element = &self.plan.elements[self.element.index()].name;
        let target = match target {
            Target::Element(id) => &self.plan.elements[id.index()].name,
            Target::Terminate | Target::Ignore => "terminate",
        };
        let name = &supervisor.name;
        let path = match supervisor.owner {
            Some(_) => format!("{element}.{name}"),
            None => name.clone(),
        };
        let (every, time) = (spell(supervisor.every), spell(at));
        let until = spell(at + BEHIND);
        let _ = write!(
            all.text,
            "
scenario \"{element}: {name}.{event} at {percent} %\" for {plan} {{
    at {time}: fire {path}.{event}{values}
    expect {element} -> {target} by {name}.{event} within {every} after {time}
    until {until}
}}
",
            plan = self.plan.name,
        );
        all.scenarios += 1;
    }

    /// Values for the connected outputs of an event, in brackets; `None` when one is an object.
    fn values(&self, event: u16) -> Option<String> {
        let supervisor = self.supervisor();
        let ports = &self.graph.template(supervisor.template).outputs;
        let connected =
            supervisor.outputs.iter().filter_map(|out| ports.get(usize::from(out.port)));
        let carried = connected.filter(|port: &&OutPort| port.on.contains(&event));
        let values: Option<Vec<_>> = carried
            .map(|port| {
                let ty = match (&port.ty, &supervisor.generic) {
                    (Type::Any | Type::Number, Some(ty)) => ty,
                    (ty, _) => ty,
                };
                Some(format!("{} = {}", port.name, zero(ty)?))
            })
            .collect();
        let values = values?;
        Some(if values.is_empty() { String::new() } else { format!("({})", values.join(", ")) })
    }
}

/// A value of a type; there is none of an object.
fn zero(ty: &Type) -> Option<String> {
    Some(match ty {
        Type::Bool => "false".to_owned(),
        Type::Int => "0".to_owned(),
        Type::Quantity(dimension) => {
            format!("0.0 {}", dimension.usual_unit()).trim_end().to_owned()
        }
        Type::Text => "\"\"".to_owned(),
        Type::Enum(home) => format!("{}.{}", home.name, home.variants.first()?),
        Type::Object(_) | Type::Any | Type::Number => return None,
    })
}

/// Nanoseconds in the largest unit that needs no fraction.
fn spell(time: u64) -> String {
    match time {
        time if time.is_multiple_of(1_000_000_000) => format!("{} s", time / 1_000_000_000),
        time if time.is_multiple_of(1_000_000) => format!("{} ms", time / 1_000_000),
        time if time.is_multiple_of(1_000) => format!("{} us", time / 1_000),
        time => format!("{time} ns"),
    }
}
