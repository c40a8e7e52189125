//! Several changes as one: all of them or none.
//!
//! What is added may wish for a name that is taken. It gets another one, and later changes mean it by
//! the name that was wished for.

use std::rc::Rc;

use super::project::Workspace;
use super::tree::{self, Scope, children, name_of};
use super::{Change, Item, Refused, TextEdit, begin, edit_with, end, fragment, make, name};
use afp_dsl::toolbox::Toolboxes;
use afp_syntax::kind::Kind;
use afp_syntax::source::Source;

/// What several changes come to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Made {
    /// The edits, file by file, in order and without overlaps.
    pub edits: Vec<TextEdit>,
    /// The changes as they were made, under the names that were given.
    pub changes: Vec<Change>,
    /// The names that were wished for and taken, each with the one given instead.
    pub names: Vec<(String, String)>,
    /// What was added.
    pub added: Vec<Item>,
}

/// The edits that make all changes of the file `home`, one after the other, as
/// [`edit`](super::edit) makes one. The first element of a plan becomes its start.
///
/// # Errors
/// One of the changes is refused; then none is made.
pub fn edit_all(
    files: &[Source],
    toolboxes: &Toolboxes,
    home: usize,
    changes: &[Change],
) -> Result<Made, Refused> {
    let mut workspace = begin(files, Rc::new(toolboxes.clone()), home)?;
    let errors = workspace.syntax_errors();
    let mut made = Made::default();
    let mut given: Vec<Given> = Vec::new();
    for change in changes {
        let mut change = given.iter().fold(change.clone(), |change, given| given.in_change(change));
        if let Change::Add { plan, owner, text, .. } = &mut change {
            let new = add_free(&mut workspace, plan, owner.as_deref(), text)?;
            made.added.extend(new.items);
            given.extend(new.given);
        }
        make(&mut workspace, &change)?;
        let start = first_start(&mut workspace, &change);
        made.changes.push(change);
        if let Some(start) = start {
            make(&mut workspace, &start)?;
            made.changes.push(start);
        }
    }
    made.names = given.into_iter().map(|given| (given.wanted, given.given)).collect();
    made.edits = end(workspace, files, errors)?;
    Ok(made)
}

/// A name in a plan, or of a supervisor of an element, that was given in place of another.
struct Given {
    plan: String,
    owner: Option<String>,
    wanted: String,
    given: String,
}

#[derive(Default)]
struct New {
    items: Vec<Item>,
    given: Vec<Given>,
}

/// Gives the items of a text names that are free where they are put.
fn add_free(
    workspace: &mut Workspace,
    plan: &str,
    owner: Option<&str>,
    text: &mut String,
) -> Result<New, Refused> {
    let root = workspace.buffer().root();
    let scope = match owner {
        None => Scope::Plan(tree::plan(&root, plan)?),
        Some(owner) => Scope::Element(tree::element(&root, plan, owner)?),
    };
    let item = |name: &str| match owner {
        None => Item::inner(plan, name),
        Some(owner) => Item::local(plan, owner, name),
    };
    let (_, nodes) = fragment::items(text, owner.is_some())?;
    let wanted: Vec<_> = nodes.iter().filter_map(name_of).collect();
    let mut taken = scope.names();
    let mut new = New::default();
    for (index, wanted) in wanted.iter().enumerate() {
        let mut others = taken.clone();
        others.extend(wanted_elsewhere(index, &nodes));
        let given = name::fresh(wanted, &taken);
        let given = if given == *wanted { given } else { name::fresh(wanted, &others) };
        if given != *wanted {
            let toolboxes = workspace.buffer().toolboxes.clone();
            *text = renamed(text, toolboxes, owner.is_some(), wanted, &given)?;
            let (plan, owner) = (plan.to_owned(), owner.map(str::to_owned));
            new.given.push(Given { plan, owner, wanted: wanted.clone(), given: given.clone() });
        }
        new.items.push(item(&given));
        taken.push(given);
    }
    Ok(new)
}

/// The names of all nodes but one.
fn wanted_elsewhere(index: usize, nodes: &[afp_syntax::Node]) -> Vec<String> {
    let others = nodes.iter().enumerate().filter(|(other, _)| *other != index);
    others.filter_map(|(_, node)| name_of(node)).collect()
}

/// The items of a text with another name for one of them, wherever they refer to it.
fn renamed(
    text: &str,
    toolboxes: Rc<Toolboxes>,
    in_element: bool,
    wanted: &str,
    given: &str,
) -> Result<String, Refused> {
    let (before, after, item) = match in_element {
        false => ("plan P {\n", "\n}\n", Item::inner("P", wanted)),
        true => ("plan P {\nactor A: A {\n", "\n}\n}\n", Item::local("P", "A", wanted)),
    };
    let whole = format!("{before}{text}{after}");
    let change = Change::Rename { item, to: given.to_owned() };
    let edits = edit_with(&[Source::new("", whole.as_str())], toolboxes, 0, &change)?;
    let whole = super::apply(&whole, &edits);
    let inner = whole.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
    inner.map(str::to_owned).ok_or_else(|| Refused::new(format!("'{wanted}' is taken")))
}

/// Lets a plan without a start begin with the first element that was added to it: it is the only one, or the start that
/// was cut out comes back.
fn first_start(workspace: &mut Workspace, change: &Change) -> Option<Change> {
    let Change::Add { plan, owner: None, text, .. } = change else { return None };
    let node = tree::plan(&workspace.buffer().root(), plan).ok()?;
    if children(&node, Kind::Start).next().is_some() {
        return None;
    }
    let (_, added) = fragment::items(text, false).ok()?;
    let to = added.iter().find(|node| node.kind() == Kind::Element).and_then(name_of)?;
    Some(Change::SetStart { plan: plan.clone(), to })
}

impl Given {
    /// A name of the plan, as it is given.
    fn name(&self, plan: &str, name: String) -> String {
        let own = self.owner.is_none() && self.plan == plan && self.wanted == name;
        if own { self.given.clone() } else { name }
    }

    fn item(&self, item: Item) -> Item {
        match item {
            Item::Inner { plan, name } => Item::Inner { name: self.name(&plan, name), plan },
            Item::Local { plan, owner, name } => {
                let own =
                    self.plan == plan && self.owner.as_ref() == Some(&owner) && self.wanted == name;
                let name = if own { self.given.clone() } else { name };
                Item::Local { owner: self.name(&plan, owner), plan, name }
            }
            other => other,
        }
    }

    fn in_change(&self, change: Change) -> Change {
        use Change as C;

        let in_plan = |plan: &str, name: Option<String>| name.map(|name| self.name(plan, name));
        match change {
            C::Add { owner, text, before, plan } => {
                let (owner, before) = (in_plan(&plan, owner), in_plan(&plan, before));
                C::Add { owner, text, before, plan }
            }
            C::Remove { item } => C::Remove { item: self.item(item) },
            C::Rename { item, to } => C::Rename { item: self.item(item), to },
            C::RenameColumn { .. } | C::RenameValue { .. } => change,
            C::Connect { from, outcome, to } => {
                let to = self.name(from.plan_name(), to);
                C::Connect { from: self.item(from), outcome, to }
            }
            C::Disconnect { from, outcome } => C::Disconnect { from: self.item(from), outcome },
            C::SetStart { plan, to } => C::SetStart { to: self.name(&plan, to), plan },
            C::Reorder { item, before } => {
                let before = in_plan(item.plan_name(), before);
                C::Reorder { item: self.item(item), before }
            }
            C::Bind { component, port, to } => {
                C::Bind { component: self.item(component), port, to }
            }
            C::Unbind { component, port } => C::Unbind { component: self.item(component), port },
            C::SetTemplate { component, template } => {
                C::SetTemplate { component: self.item(component), template }
            }
            C::SetTiming { supervisor, keyword, value } => {
                C::SetTiming { supervisor: self.item(supervisor), keyword, value }
            }
            C::SetEntryKind { entry, keyword } => {
                C::SetEntryKind { entry: self.item(entry), keyword }
            }
            C::SetEntryType { entry, ty } => C::SetEntryType { entry: self.item(entry), ty },
            C::SetEntryValue { entry, value } => {
                C::SetEntryValue { entry: self.item(entry), value }
            }
            C::SetDoc { item, text } => C::SetDoc { item: self.item(item), text },
            C::SetNote { item, text } => C::SetNote { item: self.item(item), text },
            C::Move { item, plan, owner } => {
                let owner = in_plan(&plan, owner);
                C::Move { item: self.item(item), plan, owner }
            }
            C::Extract { plan, elements, new_plan, element } => {
                let elements = elements.into_iter().map(|name| self.name(&plan, name)).collect();
                C::Extract { plan, elements, new_plan, element }
            }
            C::Inline { plan, element } => C::Inline { element: self.name(&plan, element), plan },
            other @ (C::AddUse { .. } | C::AddPlan { .. }) => other,
        }
    }
}
