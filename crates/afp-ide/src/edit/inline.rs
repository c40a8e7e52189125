//! Replaces a sub-plan by its elements.
//!
//! This needs inputs that stay constant during the sub-plan, and a plan without initial values and
//! without global supervisors.

mod data;
mod text;
mod visibility;

use super::project::Project;
use super::tree::{self, Scope, children, name_of, name_token, range, target};
use super::workspace::Workspace;
use super::{Item, Refused, add, connect, name, refer, remove};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

use data::Data;

struct Call {
    project: Project,
    /// The file of the inner plan.
    from: usize,
    /// The plan around it.
    outer: Node,
    element: Node,
    /// Its plan.
    inner: Node,
    /// The target of its states.
    ok: String,
    /// The target of its events.
    interrupted: Option<String>,
    /// The target of its faults.
    error: Option<String>,
    /// The elements of the inner plan with their new names.
    names: Vec<(String, String)>,
    /// The new name of the first one.
    first: String,
}

pub(super) fn run(workspace: &mut Workspace, plan: &str, element: &str) -> Result<(), Refused> {
    workspace.check_inside(&Item::inner(plan, element))?;
    let call = Call::of(workspace.project(), workspace.home, plan, element)?;
    let from = call.from;
    let data = Data::of(&call)?;
    let lines = text::elements(&call, &data, workspace.buffers[from].text())?;
    redirect(workspace, &call, &data, plan, element)?;
    if from != workspace.home {
        visibility::bring(workspace, &call.inner, from)?;
    }
    let buffer = workspace.buffer();
    let list = tree::plan(&buffer.root(), plan)?;
    add::place(buffer, &list, &lines, Kind::Element, Some(element))?;
    let inner = name_of(&call.inner).unwrap_or_default();
    let list = tree::plan(&buffer.root(), plan)?;
    let is_call = |node: &Node| {
        tree::is_named(node, element) && tree::template(node).as_deref() == Some(&inner)
    };
    if let Some(node) = children(&list, Kind::Element).find(is_call) {
        remove::take_out(buffer, &node);
    }
    for entry in &data.new_entries {
        let list = tree::plan(&buffer.root(), plan)?;
        add::place(buffer, &list, entry, Kind::Entry, None)?;
    }
    let Some(error) = &call.error else { return Ok(()) };
    for (_, new) in &call.names {
        let item = Item::inner(plan, new);
        if tree::edge(&tree::find(&buffer.root(), &item)?, "Error").is_none() {
            connect::connect(buffer, &item, "Error", error)?;
        }
    }
    Ok(())
}

impl Call {
    /// Finds the sub-plan, and the file of its plan.
    fn of(project: Project, home: usize, plan: &str, element: &str) -> Result<Call, Refused> {
        let root = &project.roots[home];
        let outer = tree::plan(root, plan)?;
        let node = tree::element(root, plan, element)?;
        let template = children(&node, Kind::Ref).next().and_then(|name| tree::single(&name));
        let template = template.filter(|_| tree::is_subplan(&node));
        let template = template
            .ok_or_else(|| Refused::new(format!("'{element}' is not a sub-plan of a plan")))?;
        let found = project.item(home, &template).filter(|(_, node)| node.kind() == Kind::Plan);
        let missing = || Refused::new(format!("there is no plan '{}'", template.text()));
        let (from, inner) = found.ok_or_else(missing)?;
        if inner == outer {
            return Err(Refused::new(format!("'{plan}' contains itself")));
        }
        for (component, what) in [(&node, element), (&inner, &name_of(&inner).unwrap_or_default())]
        {
            if children(component, Kind::Guard).next().is_some() {
                return Err(Refused::new(format!(
                    "the supervisors of '{what}' watch it as a whole; move them to its elements first"
                )));
            }
        }
        if children(&node, Kind::Reactions).next().is_some() {
            return Err(Refused::new(format!(
                "'{element}' reacts as a whole to supervisors of '{plan}'; write its reactions into the elements first"
            )));
        }
        let leads = refer::to_element(&project, home, &Item::inner(plan, element));
        if leads.iter().any(tree::suspends) {
            return Err(Refused::new(format!(
                "'{element}' handles an interruption as a whole, which its elements cannot do"
            )));
        }
        let start = children(&inner, Kind::Start).next().and_then(|start| name_token(&start));
        let names = new_names(&outer, &inner, element);
        let first = start.and_then(|start| {
            names.iter().find(|(old, _)| old == start.text()).map(|(_, new)| new.clone())
        });
        let first = first.ok_or_else(|| Refused::new("the sub-plan's plan has no 'start'"))?;
        let leads = |outcome: &str| {
            let target = tree::edge(&node, outcome).and_then(|edge| target(&edge))?;
            let leads_back = project.item(home, &target).is_some_and(|(_, item)| item == node);
            Some(if leads_back { first.clone() } else { target.text().to_owned() })
        };
        let ok = leads("OK")
            .ok_or_else(|| Refused::new(format!("'OK' of '{element}' is not connected")))?;
        let (interrupted, error) = (leads("Interrupted"), leads("Error"));
        Ok(Call {
            project,
            from,
            outer,
            inner,
            ok,
            interrupted,
            error,
            names,
            first,
            element: node,
        })
    }
}

/// New names for the elements of a plan, unused in the outer plan.
fn new_names(outer: &Node, inner: &Node, element: &str) -> Vec<(String, String)> {
    let mut taken = Scope::Plan(outer.clone()).names();
    taken.retain(|name| name != element);
    let mut names = Vec::new();
    for old in children(inner, Kind::Element).filter_map(|element| name_of(&element)) {
        let new = name::fresh(&old, &taken);
        taken.push(new.clone());
        names.push((old, new));
    }
    names
}

/// Redirects edges and scenarios from the sub-plan to its elements.
fn redirect(
    workspace: &mut Workspace,
    call: &Call,
    data: &Data,
    plan: &str,
    element: &str,
) -> Result<(), Refused> {
    let wanted = Item::inner(plan, element);
    let mut splices: Vec<_> = refer::to_element(&call.project, workspace.home, &wanted)
        .iter()
        .map(|token| (range(token), call.first.clone()))
        .collect();
    let mut seen = Vec::new();
    for token in refer::in_scenarios(&call.project, workspace.home, &[wanted], workspace.home) {
        let names: Vec<_> = token
            .parent()
            .iter()
            .flat_map(|path| tree::tokens(path, Kind::Name).collect::<Vec<_>>())
            .collect();
        let next = names.iter().skip_while(|name| **name != token).nth(1).cloned();
        if seen.contains(&token) {
            continue;
        }
        seen.push(token.clone());
        if next.is_none() && is_left(&token) {
            return Err(Refused::new(format!(
                "a scenario expects something after '{element}' as a whole"
            )));
        }
        splices.push(match next {
            None => (range(&token), call.first.clone()),
            Some(next) => {
                let new = call.names.iter().find(|(old, _)| old == next.text());
                let new = new.map(|(_, new)| new.as_str()).or_else(|| data.written_to(next.text()));
                let new = new.ok_or_else(|| {
                    Refused::new(format!("a scenario names '{element}.{}'", next.text()))
                })?;
                (range(&token).start..range(&next).end, new.to_owned())
            }
        });
    }
    workspace.buffer().splice(splices);
    Ok(())
}

/// Whether a name is before the arrow of a claim.
fn is_left(token: &Token) -> bool {
    let claim = token.parent().and_then(|path| path.parent());
    let arrow = claim.and_then(|claim| tree::tokens(&claim, Kind::Arrow).next());
    arrow.is_some_and(|arrow| range(token).end <= range(&arrow).start)
}
