//! The parts of an item for forms: ports, exits, times, and the declaration of its computation.

use crate::View;
use crate::candidates::{PortCandidates, of_port};
use crate::completion::type_names;
use afp_draw::formula;
use afp_dsl::outline::{Component, ComponentKind};
use afp_dsl::toolbox::Template;
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use serde::Serialize;

/// The parts of a plan, an entry, an element or a supervisor.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Parts {
    /// The keyword of an element or supervisor; empty for a plan or an entry.
    pub kind: &'static str,
    /// Its template as written; empty without one.
    pub template: String,
    /// The place of the template's name.
    #[serde(skip)]
    pub template_span: Option<Span>,
    pub ports: Vec<Port>,
    pub exits: Vec<Exit>,
    /// The written times of a supervisor.
    pub timing: Option<Times>,
    /// The help text above it.
    pub help: String,
    /// The comment above it.
    pub note: String,
    /// The declaration of its computation, if it is in the same file.
    pub computation: Option<Computation>,
    /// The types that an entry of the file can have, usual ones first; only for plans and entries.
    pub types: Vec<String>,
}

/// A port with its candidates.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Port {
    pub name: String,
    /// Whether it is an output.
    pub out: bool,
    pub answer: Option<PortCandidates>,
}

/// A state or an event.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Exit {
    pub name: String,
    /// Its target as written; empty without one.
    pub to: String,
}

/// The times of a supervisor as written; empty for its template's.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Times {
    pub every: String,
    pub deadline: String,
}

/// A declared computation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Computation {
    pub name: String,
    pub states: Vec<State>,
}

/// A state of a declared computation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct State {
    pub name: String,
    /// Its condition; `None` for the last state, which has none.
    pub condition: Option<String>,
    /// Each output with the formula that the state assigns; empty for none.
    pub writes: Vec<(String, String)>,
}

/// Returns the parts of an item of the file; `None` if it does not exist.
pub fn parts(view: &View, item: &Item) -> Option<Parts> {
    let plan = view.outline().plan_of(view.file, item)?;
    if let Some(component) = plan.component(item) {
        return Some(of_component(view, component));
    }
    let entry = plan.entries.iter().find(|entry| entry.item == *item);
    let (help, note) = match entry {
        Some(entry) => (&entry.doc, &entry.note),
        None if plan.item == *item => (&plan.doc, &plan.note),
        None => return None,
    };
    let (help, note) = (help.clone(), note.clone());
    Some(Parts { help, note, types: type_names(view), ..Parts::default() })
}

fn of_component(view: &View, component: &Component) -> Parts {
    let port = |(name, out): (&str, bool)| Port {
        name: name.to_owned(),
        out,
        answer: of_port(view, &component.item, name),
    };
    let inputs = component.inputs.iter().filter(|port| port.nth == 1);
    let outputs = component.outputs.iter().filter(|port| port.nth == 1);
    let names = inputs.map(|port| (&*port.name, false));
    let names = names.chain(outputs.map(|port| (&*port.name, true)));
    let exits = component.exits.iter().filter(|exit| exit.nth == 1).map(|exit| {
        let target = exit.edge.as_ref().and_then(|edge| edge.target.as_ref());
        let to = target.map(|target| target.text.clone()).unwrap_or_default();
        Exit { name: exit.name.to_string(), to }
    });
    let time = |keyword: &str, span: Option<Span>| {
        let written = span.map_or("", |span| view.text_of(span));
        written.strip_prefix(keyword).unwrap_or(written).trim().to_owned()
    };
    let times = component.times.filter(|_| component.kind == ComponentKind::Supervisor);
    let own = |template: &&Template| template.span.file == view.file;
    Parts {
        kind: component.kind.keyword(),
        template: component.template.as_ref().map(|it| it.text.clone()).unwrap_or_default(),
        template_span: component.template.as_ref().map(|it| it.name_span),
        ports: names.map(port).collect(),
        exits: exits.collect(),
        timing: times.map(|it| Times {
            every: time("every", it.every_span),
            deadline: time("deadline", it.deadline_span),
        }),
        help: component.doc.clone(),
        note: component.note.clone(),
        computation: component.template().filter(own).and_then(computation),
        types: Vec::new(),
    }
}

/// The declaration of a computation whose states have conditions.
fn computation(template: &Template) -> Option<Computation> {
    let cases = template.cases.as_deref()?;
    let last = cases.len().saturating_sub(1);
    let states = template.outcomes.iter().zip(cases).enumerate().map(|(at, (state, case))| {
        let written: Vec<_> = formula::writes(case, template).collect();
        let formula = |output: &str| {
            let found = written.iter().find(|(name, _)| *name == output);
            found.map(|(_, formula)| formula.clone()).unwrap_or_default()
        };
        let outputs = template.outputs.iter().map(|port| (port.name.clone(), formula(&port.name)));
        State {
            name: state.name.clone(),
            condition: (at < last).then(|| formula::condition(case, template)),
            writes: outputs.collect(),
        }
    });
    Some(Computation { name: template.name.clone(), states: states.collect() })
}

#[cfg(test)]
mod tests {
    use super::{Parts, State, parts};
    use crate::View;
    use afp_dsl::{Toolboxes, compile};
    use afp_syntax::item::Item;
    use afp_syntax::source::Source;

    const PLAN: &str = "use carbot
/// Drives a little.
plan P {
    var gap: length = 20 cm
    start go
    // Slowly.
    actor go: Forward(distance = gap) {
        supervise touch: CheckTouchSensor every 5 ms { TouchSensorPressed -> count }
        ForwardSuccessful -> terminate
    }
    computation count: Next { Again -> go, Done -> terminate }
}
computation Next {
    in value: int = 0
    out next: int
    state Again when value < 3 { next = value + 1 }
    state Done {}
}
";

    fn of(item: Item) -> Option<Parts> {
        let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        let none = |_: &str| Err(String::new());
        let compiled = compile(&Source::new("p.afp", PLAN), &toolboxes, &none);
        let file = u16::try_from(compiled.plan_files.start).unwrap();
        parts(&View::new(&compiled, &toolboxes, file), &item)
    }

    #[test]
    fn an_element_has_ports_exits_and_its_note() {
        let go = of(Item::inner("P", "go")).unwrap();
        assert_eq!(
            (go.kind, go.template.as_str(), go.note.as_str()),
            ("actor", "Forward", "Slowly.")
        );
        let ports: Vec<_> = go.ports.iter().map(|port| (port.name.as_str(), port.out)).collect();
        assert_eq!(ports[0], ("distance", false));
        assert_eq!(go.ports[0].answer.as_ref().unwrap().value.as_deref(), Some("gap"));
        assert_eq!(
            (go.exits[0].name.as_str(), go.exits[0].to.as_str()),
            ("ForwardSuccessful", "terminate")
        );
        assert_eq!(go.timing, None);
        let touch = of(Item::local("P", "go", "touch")).unwrap();
        assert_eq!(touch.timing.map(|times| times.every).as_deref(), Some("5 ms"));
    }

    #[test]
    fn a_plan_and_an_entry_have_help_and_types() {
        let plan = of(Item::plan("P")).unwrap();
        assert_eq!((plan.help.as_str(), plan.kind), ("Drives a little.", ""));
        let entry = of(Item::inner("P", "gap")).unwrap();
        assert!(["length", "int", "bool"].iter().all(|ty| entry.types.iter().any(|it| it == ty)));
        assert_eq!(of(Item::inner("P", "none")), None);
    }

    #[test]
    fn a_declared_computation_has_conditions_and_assignments() {
        let count = of(Item::inner("P", "count")).unwrap().computation.unwrap();
        let state = |name: &str, condition: Option<&str>, next: &str| State {
            name: name.to_owned(),
            condition: condition.map(str::to_owned),
            writes: vec![("next".to_owned(), next.to_owned())],
        };
        assert_eq!(count.name, "Next");
        assert_eq!(
            count.states,
            [state("Again", Some("value < 3"), "value + 1"), state("Done", None, "")]
        );
    }
}
