//! Moves elements into a new plan, with a sub-plan in their place.
//!
//! A sub-plan has one entry and two exits: its states lead to `OK`, its events to `Interrupted`. If
//! a selection needs more, the change is refused with a reason.

mod data;
mod flow;
mod scenarios;

use super::buffer::{Splice, TextBuffer};
use super::list::{Page, indented};
use super::project::Project;
use super::tree::{self, Scope, children, is_named, name_of, range};
use super::workspace::Workspace;
use super::{Item, Refused, add, fragment, name, remove};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

pub(super) use data::type_of;

use data::Data;
use flow::Flow;

pub(super) struct Selection {
    pub plan: Node,
    pub elements: Vec<Node>,
    project: Project,
}

impl Selection {
    fn new(buffer: &TextBuffer, plan: &str, names: &[String]) -> Result<Selection, Refused> {
        let root = &buffer.root();
        for name in names {
            tree::element(root, plan, name)?;
        }
        let plan = tree::plan(root, plan)?;
        let is_chosen = |element: &Node| names.iter().any(|name| is_named(element, name));
        let elements: Vec<_> = children(&plan, Kind::Element).filter(is_chosen).collect();
        if elements.is_empty() {
            return Err(Refused::new("no element is selected"));
        }
        Ok(Selection { plan, elements, project: Project::alone(buffer) })
    }

    /// Whether a token means a selected element.
    pub fn is_inside(&self, token: &Token) -> bool {
        self.project.item(0, token).is_some_and(|(_, node)| self.elements.contains(&node))
    }

    pub fn entry(&self, token: &Token) -> Option<String> {
        self.project.entry(0, token)
    }

    pub fn is_output(&self, bind: &Node) -> bool {
        self.project.is_output(0, bind)
    }

    /// Whether an element of that name is selected.
    pub fn holds(&self, name: &str) -> bool {
        self.elements.iter().any(|element| is_named(element, name))
    }
}

/// Moves elements into a new plan and adapts the scenarios of all files.
pub(super) fn run(
    workspace: &mut Workspace,
    plan: &str,
    elements: &[String],
    new_plan: &str,
    element: &str,
) -> Result<(), Refused> {
    let items: Vec<_> = elements.iter().map(|name| Item::inner(plan, name)).collect();
    for item in &items {
        workspace.check_unused(item)?;
    }
    let (project, home) = (workspace.project(), workspace.home);
    let follow = |file| scenarios::splices(&project, (home, &items), file, element);
    let mut scenarios: Vec<_> = (0..workspace.buffers.len()).map(follow).collect();
    let own = std::mem::take(&mut scenarios[home]);
    in_file(workspace.buffer(), (plan, elements), (new_plan, element), own)?;
    for (buffer, splices) in workspace.buffers.iter_mut().zip(scenarios) {
        buffer.splice(splices);
    }
    Ok(())
}

fn in_file(
    buffer: &mut TextBuffer,
    (plan, elements): (&str, &[String]),
    (new_plan, element): (&str, &str),
    scenarios: Vec<Splice>,
) -> Result<(), Refused> {
    let root = buffer.root();
    let selection = Selection::new(buffer, plan, elements)?;
    check_names(&root, &selection, new_plan, element)?;
    check_reactions(&selection)?;
    let flow = Flow::of(&selection)?;
    let data = Data::of(&selection, &flow.first)?;
    lead_through(buffer, &flow, element, scenarios);
    let text = plan_text(buffer, plan, &selection, &flow, &data, new_plan)?;
    let call = call_text(&flow, &data, new_plan, element);
    let first = name_of(&selection.elements[0]).unwrap_or_default();
    let list = tree::plan(&buffer.root(), plan)?;
    add::place(buffer, &list, &call, Kind::Element, Some(&first))?;
    while let Some(node) = chosen(&buffer.root(), plan, &selection, new_plan).into_iter().next() {
        remove::take_out(buffer, &node);
    }
    let below = tree::plan(&buffer.root(), plan)?;
    add::below_plan(buffer, Some(below), &text)
}

fn check_names(
    root: &Node,
    selection: &Selection,
    new_plan: &str,
    element: &str,
) -> Result<(), Refused> {
    name::check(new_plan)?;
    name::check_free(&Scope::File(root.clone()), new_plan, None)?;
    name::check_element(element)?;
    let names = Scope::Plan(selection.plan.clone()).names();
    let staying: Vec<_> = names.into_iter().filter(|name| !selection.holds(name)).collect();
    if name::fresh(element, &staying) != element {
        return Err(Refused::new(format!("'{element}' already exists")));
    }
    Ok(())
}

/// Refuses reactions: the new plan does not see the supervisors of the old one.
fn check_reactions(selection: &Selection) -> Result<(), Refused> {
    let mut elements = selection.elements.iter();
    let reacts = elements.find(|element| children(element, Kind::Reactions).next().is_some());
    let Some(element) = reacts else { return Ok(()) };
    let name = name_of(element).unwrap_or_default();
    Err(Refused::new(format!("'{name}' reacts to a supervisor that stays in the plan")))
}

/// The selected elements in the current text, without the sub-plan that replaces them.
fn chosen(root: &Node, plan: &str, selection: &Selection, new_plan: &str) -> Vec<Node> {
    let Ok(plan) = tree::plan(root, plan) else { return Vec::new() };
    let is_call = |element: &Node| {
        tree::is_subplan(element) && tree::template(element).as_deref() == Some(new_plan)
    };
    children(&plan, Kind::Element)
        .filter(|element| name_of(element).is_some_and(|name| selection.holds(&name)))
        .filter(|element| !is_call(element))
        .collect()
}

/// Redirects edges into the selection to the sub-plan, edges out of it to `terminate`, and the
/// paths of scenarios.
fn lead_through(buffer: &mut TextBuffer, flow: &Flow, element: &str, scenarios: Vec<Splice>) {
    let mut splices: Vec<_> =
        flow.ways_in.iter().map(|token| (range(token), element.to_owned())).collect();
    splices.extend(flow.ways_out.iter().map(|token| (range(token), "terminate".to_owned())));
    splices.extend(scenarios);
    buffer.splice(splices);
}

fn plan_text(
    buffer: &TextBuffer,
    plan: &str,
    selection: &Selection,
    flow: &Flow,
    data: &Data,
    new_plan: &str,
) -> Result<String, Refused> {
    let root = buffer.root();
    let page = Page { text: buffer.text(), root: root.clone() };
    let texts: Vec<_> =
        chosen(&root, plan, selection, new_plan).iter().map(|node| page.lines_of(node)).collect();
    let gap = if texts.iter().any(|text| text.contains('\n')) { "\n\n" } else { "\n" };
    let entries = data.entries();
    let entries = match entries.is_empty() {
        true => String::new(),
        false => fragment::items(&entries.join("\n"), false)?.0 + "\n\n",
    };
    let body = format!("{entries}start {}\n\n{}", flow.first, texts.join(gap));
    Ok(format!("plan {new_plan} {{\n{}\n}}", indented(&body, "    ")))
}

fn call_text(flow: &Flow, data: &Data, new_plan: &str, element: &str) -> String {
    let ports = data.ports().join(", ");
    let args = if ports.is_empty() { String::new() } else { format!("({ports})") };
    let ok = format!("OK -> {}", flow.ok.as_deref().unwrap_or("terminate"));
    let interrupted = flow.interrupted.iter().map(|target| format!("Interrupted -> {target}"));
    let edges: Vec<_> = std::iter::once(ok).chain(interrupted).collect();
    format!("subplan {element}: {new_plan}{args} {{ {} }}", edges.join(", "))
}
