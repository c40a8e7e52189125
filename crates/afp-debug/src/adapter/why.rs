//! Why an element is active or not: the edge that led to it, and the conditions of all edges to it.

use afp_core::trace::{ComponentId, Outcome};
use afp_core::{Duration, Instant};
use afp_dsl::unfold::ComponentKind;
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::{Adapter, Answer, Refusal, Run};
use crate::program::Program;
use crate::state::State;

#[derive(Deserialize)]
pub(super) struct Why {
    /// An element, or a supervisor, which means the element that it watches.
    path: String,
    /// The time in question, in seconds; the default is now.
    at: Option<f64>,
}

impl Adapter<'_> {
    /// Explains an element: its last start and the edge of it, and every edge to it, with its last
    /// use, whether its component looks now, and the values read.
    pub(super) fn why(&mut self, why: Why) -> Answer<Value> {
        let run = self.run()?;
        let past = why.at.map(|at| run.past(at)).transpose()?;
        let (program, now) = (run.target.program(), run.target.state());
        let state = past.as_ref().unwrap_or(now);
        let unknown = || Refusal(format!("the plan has no element '{}'", why.path));
        let found = program.parts().find(|(_, unit)| unit.path == why.path);
        let (found, unit) = found.ok_or_else(unknown)?;
        let id = unit.owner.filter(|_| unit.kind == ComponentKind::Supervisor).unwrap_or(found);
        let unit = program.unit(id).ok_or_else(unknown)?;
        let mut answer = json!({
            "path": unit.path, "active": state.is_on(id), "values": values(program, state, id),
            "edges": edges(program, state, unit.plan, &unit.name),
        });
        if let Some((since, led)) = state.cause(id) {
            answer["since"] = json!(since.as_secs_f64());
            let plan = program.unit(unit.plan).map_or("", |plan| &*plan.path);
            let began = || format!("{plan} starts with it");
            answer["because"] = json!(led.map_or_else(began, |led| led.text.clone()));
        }
        Ok(answer)
    }

    /// The explanation as text, a line for each edge.
    pub(super) fn why_in_words(&mut self, path: &str) -> Answer<String> {
        let told = self.why(Why { path: path.to_owned(), at: None })?;
        let word = |value: &Value, key: &str| value[key].as_str().unwrap_or_default().to_owned();
        let second = |value: &Value| value.as_f64().map(|at| format!("{at:.3} s"));
        let mut text = match (told["active"] == true, second(&told["since"])) {
            (true, Some(since)) => format!("{} is active since {since}", word(&told, "path")),
            (false, Some(since)) => {
                format!("{} is not active; it started last at {since}", word(&told, "path"))
            }
            // The start of a supervisor's watch is omitted.
            (true, None) => format!("{} watches", word(&told, "path")),
            (false, None) => format!("{} has not started yet", word(&told, "path")),
        };
        if !told["because"].is_null() {
            text += &format!(": {}", word(&told, "because"));
        }
        text += &in_words(&told["values"]);
        for edge in told["edges"].as_array().into_iter().flatten() {
            let looks = if edge["looks"] == true { "looks now" } else { "does not look now" };
            let last = second(&edge["last"]);
            let last = last.map_or("never taken".to_owned(), |at| format!("taken last at {at}"));
            let (from, outcome) = (word(edge, "from"), word(edge, "outcome"));
            text += &format!("\n  {from}.{outcome}: {looks}, {last}{}", in_words(&edge["values"]));
        }
        Ok(text)
    }
}

/// ` (distance -30 cm, speed 20 cm/s)`
fn in_words(values: &Value) -> String {
    let values = values.as_object().into_iter().flatten();
    let all = values.map(|(name, value)| format!("{name} {}", value.as_str().unwrap_or_default()));
    let all: Vec<_> = all.collect();
    if all.is_empty() { String::new() } else { format!(" ({})", all.join(", ")) }
}

impl Run<'_> {
    /// Returns the state at an earlier time.
    fn past(&mut self, at: f64) -> Answer<State> {
        if !(0.0..1e9).contains(&at) {
            return Err("'at' is a time in seconds from the start".into());
        }
        let (at, now) = (Instant::ZERO + Duration::from_secs_f64(at), self.target.now());
        if at > now {
            let now = now.as_secs_f64();
            return Err(Refusal(format!("the run is at {now:.3} s: later events are unknown")));
        }
        Ok(self.target.past(at)?)
    }
}

fn edges(program: &Program, state: &State, plan: ComponentId, name: &str) -> Vec<Value> {
    let inside = program.parts().filter(|(_, unit)| unit.plan == plan);
    let mut edges = Vec::new();
    for (id, unit) in inside {
        let known = unit.outcomes.iter().map(|(name, target)| (&**name, &**target));
        for (number, (outcome, _)) in (0..).zip(known).filter(|(_, (_, target))| *target == name) {
            let last = state.reached(id, Outcome::Declared(number)).map(|at| at.as_secs_f64());
            edges.push(json!({
                "from": unit.path, "outcome": outcome, "last": last, "looks": state.is_on(id),
                "values": values(program, state, id),
            }));
        }
        for (watcher, event, _) in unit.reactions.iter().filter(|(.., target)| target == name) {
            let Some(supervisor) = program.unit(*watcher) else { continue };
            let outcome = supervisor.outcomes.get(usize::from(event.number()));
            let outcome = outcome.map_or("DeadlineMissed", |(name, _)| name);
            edges.push(json!({
                "from": supervisor.path, "outcome": outcome, "during": unit.name,
                "last": state.reacted(id, *watcher, *event).map(|at| at.as_secs_f64()),
                "looks": state.is_on(*watcher) && state.is_on(id),
                "values": values(program, state, *watcher),
            }));
        }
    }
    edges
}

/// The inputs of a component at its last start.
fn values(program: &Program, state: &State, id: ComponentId) -> Map<String, Value> {
    let ports = program.unit(id).map_or(&[][..], |unit| &unit.inputs);
    let unit = |name: &str| ports.iter().find(|port| port.0 == name).map_or("", |port| &*port.1);
    let shown = |(name, value): (&str, &afp_session::Datum)| {
        (name.to_owned(), json!(value.in_unit(unit(name)).to_string()))
    };
    state.inputs(id).map(shown).collect()
}
