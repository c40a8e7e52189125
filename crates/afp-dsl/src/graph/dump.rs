//! A graph as text, for tests and for work on the compiler.

use std::fmt::Write;

use crate::graph::{
    Component, Element, Entry, EntryKind, Formula, Graph, Op, Output, Part, Plan, Reactions,
    Supervisor, Target, TemplateId,
};
use crate::types::text::{self, duration};
use crate::types::{Conversion, Type};

impl Graph {
    /// The whole graph, line by line, sub-plans first. The format may change.
    pub fn dump(&self) -> String {
        let mut text = String::new();
        for (index, plan) in self.plans.iter().enumerate() {
            Dump { graph: self, plan, text: &mut text }.plan(index == self.main.index());
        }
        text
    }
}

struct Dump<'a> {
    graph: &'a Graph,
    plan: &'a Plan,
    text: &'a mut String,
}

/// The names that a component's signature gives to ports and outcomes.
struct Named {
    head: String,
    inputs: Vec<String>,
    outputs: Vec<String>,
    outcomes: Vec<String>,
}

impl Dump<'_> {
    fn line(&mut self, depth: usize, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{:indent$}{line}", "", indent = 2 * depth);
    }

    fn plan(&mut self, main: bool) {
        let plan = self.plan;
        let mut head = format!("plan {}", plan.name);
        if main {
            head += " (main)";
        }
        if let Some(file) = &plan.file {
            head += &format!(" of {file}");
        }
        if plan.forever {
            head += " (forever)";
        }
        if plan.interruptible {
            head += " (interruptible)";
        }
        self.line(0, &head);
        for entry in &plan.entries {
            self.entry(entry);
        }
        self.line(1, &format!("start {}", plan.elements[plan.start.index()].name));
        for supervisor in &plan.supervisors[..usize::from(plan.globals)] {
            self.supervisor(1, supervisor);
        }
        for element in &plan.elements {
            self.element(element);
        }
    }

    fn entry(&mut self, entry: &Entry) {
        let kind = match entry.kind {
            EntryKind::In if entry.live => "in live",
            kind => kind.word(),
        };
        let mut line = format!("{kind} {}: {}", entry.name, entry.ty);
        if let Some(init) = &entry.init {
            line += &format!(" = {}", self.formula(init.part()));
        }
        if let Some((least, greatest)) = entry.range {
            let [least, greatest] = [least, greatest].map(|end| text::value(end, &entry.ty));
            line += &format!(" from {least} to {greatest}");
        }
        self.line(1, &line);
    }

    fn element(&mut self, element: &Element) {
        let (keyword, named) = match element.component {
            Component::Actor(id) => ("actor", self.of_template(id)),
            Component::Computation(id) => ("computation", self.of_template(id)),
            Component::SubPlan(id) => ("subplan", of_plan(self.graph.plan(id))),
        };
        let generic = generic(element.generic.as_ref());
        self.line(1, &format!("{keyword} {}: {}{generic}", element.name, named.head));
        if let Component::Computation(id) = element.component {
            self.table(id);
        }
        self.binds(&named, &element.inputs, &element.outputs);
        for (state, target) in named.outcomes.iter().zip(&element.states) {
            if let Some(target) = target {
                self.edge(state, *target);
            }
        }
        if let Some(target) = element.on_error {
            self.edge("Error", target);
        }
        for id in &element.supervisors {
            self.supervisor(2, &self.plan.supervisors[id.index()]);
        }
        for table in &element.reactions {
            self.reactions(table);
        }
    }

    fn reactions(&mut self, table: &Reactions) {
        let supervisor = &self.plan.supervisors[table.supervisor.index()];
        let named = self.of_template(supervisor.template);
        self.line(2, &format!("on {}", supervisor.name));
        let events = named.outcomes.iter().zip(&table.events);
        let events = events.map(|(event, target)| (event.as_str(), *target));
        for (event, target) in events.chain([("DeadlineMissed", table.on_miss)]) {
            if let Some(target) = target {
                self.edge(event, target);
            }
        }
    }

    fn table(&mut self, id: TemplateId) {
        if let Some((_, table)) = self.graph.template(id).table() {
            self.line(3, &format!("table = {} ({} rows)", table.name, table.rows.len()));
        }
    }

    fn supervisor(&mut self, depth: usize, supervisor: &Supervisor) {
        let named = self.of_template(supervisor.template);
        let generic = generic(supervisor.generic.as_ref());
        self.line(
            depth,
            &format!(
                "supervise {}: {}{generic} every {} deadline {}",
                supervisor.name,
                named.head,
                duration(supervisor.timing.period.as_nanos()),
                duration(supervisor.timing.deadline.as_nanos())
            ),
        );
        self.binds(&named, &supervisor.inputs, &supervisor.outputs);
        for (event, target) in named.outcomes.iter().zip(&supervisor.events) {
            self.edge(event, *target);
        }
        if let Some(target) = supervisor.on_miss {
            self.edge("DeadlineMissed", target);
        }
    }

    fn of_template(&self, id: TemplateId) -> Named {
        let toolbox = &self.graph.toolboxes[id.toolbox.index()];
        let template = self.graph.template(id);
        Named {
            head: match toolbox.is_named() {
                true => format!("{}.{}", toolbox.name, template.name),
                false => template.name.clone(),
            },
            inputs: template.inputs.iter().map(|port| port.name.clone()).collect(),
            outputs: template.outputs.iter().map(|port| port.name.clone()).collect(),
            outcomes: template.outcomes.iter().map(|outcome| outcome.name.clone()).collect(),
        }
    }

    fn binds(&mut self, named: &Named, inputs: &[Formula], outputs: &[Output]) {
        for (port, formula) in named.inputs.iter().zip(inputs) {
            let formula = self.formula(formula.part());
            self.line(3, &format!("{port} = {formula}"));
        }
        for output in outputs {
            let port = &named.outputs[usize::from(output.port)];
            let entry = &self.plan.entries[output.entry.index()].name;
            let shown = match &output.conversion {
                Some(conversion) => format!("{}({port})", conversion_name(conversion)),
                None => port.clone(),
            };
            self.line(3, &format!("{shown} => {entry}"));
        }
    }

    fn edge(&mut self, outcome: &str, target: Target) {
        let target = match target {
            Target::Fail(id) => format!("fail {:?}", self.plan.reasons[id.index()]),
            target => target.text(|id| &self.plan.elements[id.index()].name).to_string(),
        };
        self.line(3, &format!("{outcome} -> {target}"));
    }

    fn formula(&self, formula: Part<'_>) -> String {
        let operands: Vec<_> = formula.operands().map(|operand| self.formula(operand)).collect();
        match formula.op() {
            Op::Bool(value) => value.to_string(),
            Op::Int(value) => value.to_string(),
            // With a decimal point, to distinguish floats from ints.
            Op::Float(value) => format!("{value:?}"),
            Op::Text(text) => format!("{text:?}"),
            Op::Choice(index) => match &formula.ty {
                Type::Enum(home) => {
                    format!("{}.{}", home.name, home.variants[usize::from(*index)])
                }
                _ => index.to_string(),
            },
            Op::Entry(id) => self.plan.entries[id.index()].name.clone(),
            Op::Neg => format!("-{}", operands.join("")),
            Op::Binary(operator) => {
                format!("({})", operands.join(&format!(" {} ", operator.sign())))
            }
            Op::Call(function) => format!("{}({})", function.name(), operands.join(", ")),
            Op::Convert(conversion) => {
                format!("{}({})", conversion_name(conversion), operands.join(", "))
            }
        }
    }
}

fn of_plan(plan: &Plan) -> Named {
    let names = |kind| {
        let entries = plan.entries.iter().filter(move |entry| entry.kind == kind);
        entries.map(|entry| entry.name.clone()).collect()
    };
    Named {
        head: plan.name.clone(),
        inputs: names(EntryKind::In),
        outputs: names(EntryKind::Out),
        outcomes: vec!["OK".to_owned(), "Interrupted".to_owned()],
    }
}

fn generic(ty: Option<&Type>) -> String {
    ty.map(|ty| format!(" for {ty}")).unwrap_or_default()
}

fn conversion_name(conversion: &Conversion) -> String {
    match conversion {
        Conversion::IntToFloat => "int_to_float".to_owned(),
        Conversion::FloatToInt => "float_to_int".to_owned(),
        Conversion::BoolToInt => "bool_to_int".to_owned(),
        Conversion::BoolToFloat => "bool_to_float".to_owned(),
        Conversion::ToText(from) => format!("{from}_to_string"),
        Conversion::FromText(to) => format!("string_to_{to}"),
    }
}
