//! Writes the states of a plan, with its sub-plans' states inside them.

use std::fmt::Write;

use super::names::{End, Scope, target};
use super::view::{Exit, ExitKind, Input, View};
use afp_dsl::graph::{Component, Element, Supervisor, Target};

/// The explanation for readers of the chart.
const HEAD: &str = "\
  The flow of action of an Action Flow Plan. Omitted, because state charts cannot express it:
  - the polling order of supervisors: a chart receives one event at a time, so its driver
    decides which of several events comes first (the plan: outer plans first, then the shorter
    deadline, then global before local, then as written);
  - periods, deadlines and the look before a start;
  - entries and values: formulas are only comments, and results of a sub-plan that do not
    convert, an 'Error' for its caller, are missing. A declared computation has its
    conditions and assignments in comments, too, because most of the compared values come
    from sensors and from outside: its states are events, like the states of every element.
  Events: 'element.State' when an actor or a computation reaches a state, 'element-supervisor.Event'
  when a supervisor of that element interrupts it, 'supervisor.Event' when a global one does,
  '.DeadlineMissed' and '.Error' likewise; an element's own reactions to a global supervisor are
  transitions of its state for the same events, which come before those of its plan; inside of sub-plans 'subplan:element.State' and so on.
  ':stopped' is a stop from outside, ':failed' a fault that no plan can handle.
  A transition without a target takes an event and does nothing: the event is ignored or resumes, or
  the supervisor's target is active already. A computation that resumes leads to the history of the element that
  was active.
  'suspend' leaves the active state for the state of its handler, and 'return' leads to the history of the
  state that was left. A chart enters that state again and starts it again, while the plan continues
  where it was. A state that is suspended and never continues is left earlier in the chart.";

/// A document during writing.
#[derive(Default)]
pub(super) struct Chart {
    out: String,
    depth: usize,
}

impl Chart {
    pub(super) fn into_text(self) -> String {
        self.out
    }

    pub(super) fn document(&mut self, view: &View, scope: &Scope) {
        self.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
        self.line(&format!("<!--\n  {HEAD}\n-->"));
        let id = &scope.id;
        let open = "<scxml xmlns=\"http://www.w3.org/2005/07/scxml\" version=\"1.0\"";
        self.open(&format!("{open} datamodel=\"null\" name=\"{id}\" initial=\"{id}\">"));
        let first = scope.state(&view.element(view.plan.start).name);
        self.open(&format!("<state id=\"{id}\" initial=\"{first}\">"));
        self.transition(":stopped", Some(&scope.end(End::Interrupted)));
        self.transition(":failed", Some(&scope.end(End::Error)));
        self.body(view, scope, false);
        self.close("state");
        self.ends(scope);
        self.close("scxml");
    }

    /// The global supervisors and the elements of a plan; `nested` if its ends are states inside
    /// its own state.
    fn body(&mut self, view: &View, scope: &Scope, nested: bool) {
        for supervisor in view.supervisors(None) {
            self.comment(&supervisor_call(view, supervisor));
            let path = scope.path(&supervisor.name);
            for exit in view.events(supervisor) {
                let to = taken(view, scope, &exit);
                let within = nested || exit.target.element().is_some();
                self.inner_transition(&event(&path, &exit), to.as_deref(), within);
            }
            let end = scope.end(End::Error);
            self.inner_transition(&format!("{path}.Error"), Some(&end), nested);
        }
        let elements = || view.plan.elements.iter();
        let computes = |element: &&Element| matches!(element.component, Component::Computation(_));
        let resumes = |element: &Element| {
            let mut targets = element.states.iter().flatten().chain(&element.on_error);
            targets.any(|target| *target == Target::Resume)
        };
        let handlers = view.plan.handlers();
        let handled = handlers.contains(&true);
        let resumed = elements().filter(computes).any(resumes);
        if !resumed && !handled {
            elements().for_each(|element| self.element(view, scope, element));
            return;
        }
        elements().filter(computes).for_each(|element| self.element(view, scope, element));
        let acting = |handles: bool| {
            let own = elements().zip(&handlers).filter(move |(_, is)| **is == handles);
            own.map(|(element, _)| element).filter(|element| !computes(element))
        };
        let usual = acting(false).next().map(|element| scope.state(&element.name));
        let usual = usual.unwrap_or_default();
        if resumed {
            self.with_history([&scope.acting(), &scope.history()], &usual);
        }
        if handled {
            acting(true).for_each(|element| self.element(view, scope, element));
            self.with_history([&scope.flowing(), &scope.suspended()], &usual);
        }
        acting(false).for_each(|element| self.element(view, scope, element));
        if handled {
            self.close("state");
        }
        if resumed {
            self.close("state");
        }
    }

    /// Opens a state with a history of its active state, which is `usual` at first.
    fn with_history(&mut self, [state, history]: [&str; 2], usual: &str) {
        self.open(&format!("<state id=\"{state}\">"));
        self.line(&format!("<history id=\"{history}\" type=\"deep\">"));
        self.line(&format!("  <transition target=\"{usual}\"/>"));
        self.line("</history>");
    }

    fn element(&mut self, view: &View, scope: &Scope, element: &Element) {
        let id = scope.state(&element.name);
        self.comment(&element_call(view, element));
        match element.component {
            Component::Actor(_) | Component::Computation(_) => {
                self.open(&format!("<state id=\"{id}\">"));
                self.states(view, scope, element);
                self.faults(view, scope, element);
                self.supervisors(view, scope, element);
            }
            Component::SubPlan(plan) => {
                let inside = scope.inner(&element.name);
                let body = View { plan: view.graph.plan(plan), ..*view };
                let first = inside.state(&body.element(body.plan.start).name);
                self.open(&format!("<state id=\"{id}\" initial=\"{first}\">"));
                self.done(view, scope, element, &inside);
                self.faults(view, scope, element);
                self.supervisors(view, scope, element);
                self.body(&body, &inside, true);
                self.ends(&inside);
            }
        }
        self.close("state");
    }

    /// The states of an actor or of a computation.
    fn states(&mut self, view: &View, scope: &Scope, element: &Element) {
        let path = scope.path(&element.name);
        let declared = view.declared(element);
        for exit in view.states(element).iter().filter(|exit| exit.kind == ExitKind::State) {
            if let Some((_, text)) = declared.iter().find(|(name, _)| *name == exit.name) {
                self.comment(text);
            }
            self.transition(&event(&path, exit), taken(view, scope, exit).as_deref());
        }
    }

    /// The three endings of a sub-plan's body.
    fn done(&mut self, view: &View, scope: &Scope, element: &Element, inside: &Scope) {
        let states = view.states(element);
        let named = |name: &str| {
            let exit = states.iter().find(|exit| exit.kind == ExitKind::State && exit.name == name);
            exit.and_then(|exit| taken(view, scope, exit))
        };
        let ways = [
            (End::Ok, named("OK")),
            (End::Interrupted, named("Interrupted")),
            (End::Error, Some(after_fault(view, scope, element))),
        ];
        for (end, to) in ways {
            // An unconnected exit cannot happen.
            let Some(to) = to else { continue };
            let (id, end) = (&inside.id, inside.end(end));
            self.line(&format!(
                "<transition event=\"done.state.{id}\" cond=\"In('{end}')\" target=\"{to}\"/>"
            ));
        }
    }

    fn faults(&mut self, view: &View, scope: &Scope, element: &Element) {
        let locals = view.supervisors(Some(element)).into_iter();
        let locals = locals.map(|local| scope.local(&element.name, &local.name));
        let paths = std::iter::once(scope.path(&element.name)).chain(locals);
        let events: Vec<_> = paths.map(|path| format!("{path}.Error")).collect();
        self.transition(&events.join(" "), Some(&after_fault(view, scope, element)));
    }

    /// The events of an element's supervisors, the element's reactions to global supervisors, and
    /// the events that lead to the element and are ignored while it is active. They come before the
    /// events of its plan.
    fn supervisors(&mut self, view: &View, scope: &Scope, element: &Element) {
        for supervisor in view.supervisors(Some(element)) {
            self.comment(&supervisor_call(view, supervisor));
            let path = scope.local(&element.name, &supervisor.name);
            for exit in view.events(supervisor) {
                self.transition(&event(&path, &exit), taken(view, scope, &exit).as_deref());
            }
        }
        if matches!(element.component, Component::Computation(_)) {
            return;
        }
        let here = |exit: &Exit| matches!(exit.target, Target::Element(id) | Target::Suspend(id) if view.element(id).name == element.name);
        for (supervisor, exits) in view.global_events(element) {
            let path = scope.path(&supervisor.name);
            for (exit, replaced) in exits {
                if here(&exit) {
                    self.transition(&event(&path, &exit), None);
                } else if replaced {
                    self.transition(&event(&path, &exit), taken(view, scope, &exit).as_deref());
                }
            }
        }
    }

    fn ends(&mut self, scope: &Scope) {
        for end in End::ALL {
            self.line(&format!("<final id=\"{}\"/>", scope.end(end)));
        }
    }

    fn transition(&mut self, event: &str, target: Option<&str>) {
        self.inner_transition(event, target, false);
    }

    /// A transition that does not leave its state if its target is `within` it.
    fn inner_transition(&mut self, event: &str, target: Option<&str>, within: bool) {
        let target = target.map(|id| {
            let kind = if within { " type=\"internal\"" } else { "" };
            format!("{kind} target=\"{id}\"")
        });
        let target = target.unwrap_or_default();
        self.line(&format!("<transition event=\"{event}\"{target}/>"));
    }

    /// A comment on one line; two dashes would end it.
    fn comment(&mut self, text: &str) {
        let words: Vec<_> = text.split_whitespace().collect();
        let mut text = words.join(" ");
        while text.contains("--") {
            text = text.replace("--", "- -");
        }
        self.line(&format!("<!-- {text} -->"));
    }

    fn open(&mut self, tag: &str) {
        self.line(tag);
        self.depth += 1;
    }

    fn close(&mut self, name: &str) {
        self.depth -= 1;
        self.line(&format!("</{name}>"));
    }

    fn line(&mut self, text: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.out, "{:width$}{text}", "", width = 2 * self.depth);
    }
}

fn event(path: &str, exit: &Exit) -> String {
    format!("{path}.{}", exit.name)
}

/// The target state of an exit.
fn taken(view: &View, scope: &Scope, exit: &Exit) -> Option<String> {
    let end = match exit.kind {
        ExitKind::State | ExitKind::Error => End::Ok,
        ExitKind::Event | ExitKind::Missed => End::Interrupted,
    };
    target(scope, exit.target, end, |id| &view.element(id).name)
}

fn after_fault(view: &View, scope: &Scope, element: &Element) -> String {
    let connected = element.on_error;
    let to = connected.and_then(|to| target(scope, to, End::Ok, |id| &view.element(id).name));
    to.unwrap_or_else(|| scope.end(End::Error))
}

fn element_call(view: &View, element: &Element) -> String {
    call(view.template_name(element), &view.inputs(element), &view.outputs(element))
}

fn supervisor_call(view: &View, supervisor: &Supervisor) -> String {
    let template = view.graph.template(supervisor.template);
    let (inputs, outputs) =
        (view.supervisor_inputs(supervisor), view.supervisor_outputs(supervisor));
    call(&template.name, &inputs, &outputs)
}

/// `Template(port = formula, port => entry)`
fn call(template: &str, inputs: &[Input], outputs: &[(&str, &str)]) -> String {
    let inputs = inputs.iter().filter(|input| input.bound);
    let inputs = inputs.map(|input| format!("{} = {}", input.port, input.text));
    let outputs = outputs.iter().map(|(port, entry)| format!("{port} => {entry}"));
    let ports: Vec<_> = inputs.chain(outputs).collect();
    let ports = ports.join(", ");
    if ports.is_empty() { template.to_owned() } else { format!("{template}({ports})") }
}
