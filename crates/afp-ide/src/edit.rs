//! Changes of meaning as changes of text, for the editor and for code actions.
//!
//! Every change comes to the smallest edits of the text: what it does not mean stays byte for byte,
//! with its comments, blank lines and order. Comments above an item up to a blank line and the
//! comment behind it go where the item goes. The text may have errors elsewhere; only the items
//! that a change touches must be whole. Plans may use plans of other files: a change then comes to
//! edits of several files.

mod add;
mod buffer;
mod connect;
mod doc;
mod entry;
mod extract;
mod fragment;
mod inline;
mod list;
mod name;
mod port;
mod positions;
mod project;
mod refer;
mod refused;
mod relocate;
mod remove;
mod rename;
mod several;
mod tree;
mod wire;
mod workspace;

use std::rc::Rc;

use buffer::TextBuffer;
use workspace::Workspace;

use afp_dsl::Toolboxes;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::item::Item;
use afp_syntax::kind::Kind;
use afp_syntax::source::{Source, Span};
use serde::{Deserialize, Serialize};

pub(crate) use add::edit_of_use;
pub use afp_syntax::diagnostics::Edit as TextEdit;
pub use buffer::difference;
pub(crate) use name::Taken;
pub use positions::follow;
pub use project::used_files;
pub use refused::Refused;
pub use several::{Given, Made, edit_all};
pub use wire::{item, path};

/// What a port is bound to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Binding {
    /// `port = formula`
    In(String),
    /// `port => entry`
    Out(String),
}

/// A change of meaning. Fragments of text are checked before anything is changed.
///
/// In messages each is an object under its name in camel case, with items as paths:
/// `{"connect": {"from": "Patrol.go", "outcome": "ForwardSuccessful", "to": "turn"}}`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", rename_all_fields = "camelCase", deny_unknown_fields)]
pub enum Change {
    /// Adds `use toolbox as alias` below the other `use` lines.
    AddUse {
        /// The toolbox, or the path of another plan file in quotes.
        toolbox: String,
        /// Its short name.
        alias: Option<String>,
    },
    /// Adds plans, given as text, below the last plan.
    AddPlan {
        /// The text of one or more plans.
        text: String,
    },
    /// Adds entries, elements or supervisors, given as text.
    Add {
        /// The plan that they are put into.
        plan: String,
        /// The element that they belong to; supervisors only.
        owner: Option<String>,
        /// The text of one or more items.
        text: String,
        /// The item above which they stand; without one they go below their like.
        before: Option<String>,
    },
    /// Removes an item with its comments. With an element go the edges to it and a `start` that
    /// names it, with an entry the outputs that are bound to it.
    Remove {
        #[serde(with = "wire")]
        item: Item,
    },
    /// Gives an item another name wherever the files refer to it, scenarios included.
    Rename {
        #[serde(with = "wire")]
        item: Item,
        to: String,
    },
    /// Gives a column of a table another name wherever the files bind it.
    RenameColumn { table: String, column: String, to: String },
    /// Gives a value of an enum another name wherever the files refer to it.
    RenameValue { enumeration: String, value: String, to: String },
    /// Connects a state or event, or leads its edge elsewhere.
    Connect {
        #[serde(with = "wire")]
        from: Item,
        outcome: String,
        /// An element of the plan, `terminate`, `fail`, `fail "reason"`; for an event `ignore` or `resume`, for a
        /// computation `resume`.
        to: String,
    },
    /// Removes the edge of a state or event.
    Disconnect {
        #[serde(with = "wire")]
        from: Item,
        outcome: String,
    },
    /// Lets the plan start with an element.
    SetStart { plan: String, to: String },
    /// Moves an item above another one of its list, or below its like.
    Reorder {
        #[serde(with = "wire")]
        item: Item,
        /// The item that it shall stand above.
        before: Option<String>,
    },
    /// Binds a port, or changes what it is bound to.
    Bind {
        #[serde(with = "wire")]
        component: Item,
        port: String,
        /// What it is bound to.
        to: Binding,
    },
    /// Removes the binding of a port.
    Unbind {
        #[serde(with = "wire")]
        component: Item,
        port: String,
    },
    /// Makes an element or supervisor from another template; bindings and edges stay.
    SetTemplate {
        #[serde(with = "wire")]
        component: Item,
        /// `Name` or `home.Name`
        template: String,
    },
    /// Sets, or without a value removes, `every` or `deadline` of a supervisor.
    SetTiming {
        #[serde(with = "wire")]
        supervisor: Item,
        /// `every` or `deadline`
        keyword: String,
        /// A time such as `10 ms`.
        value: Option<String>,
    },
    /// Makes an entry an `in`, `out`, `var` or `const`.
    SetEntryKind {
        #[serde(with = "wire")]
        entry: Item,
        keyword: String,
    },
    /// Sets or removes the type of an entry.
    SetEntryType {
        #[serde(with = "wire")]
        entry: Item,
        ty: Option<String>,
    },
    /// Sets or removes the initial value of an entry.
    SetEntryValue {
        #[serde(with = "wire")]
        entry: Item,
        value: Option<String>,
    },
    /// Sets or removes the help text above an item.
    SetDoc {
        #[serde(with = "wire")]
        item: Item,
        /// Its lines, without the slashes; empty for none.
        text: String,
    },
    /// Sets or removes the `//` lines above an item.
    SetNote {
        #[serde(with = "wire")]
        item: Item,
        /// Its lines, without the slashes; empty for none.
        text: String,
    },
    /// Moves an entry, element or supervisor to another plan, or a supervisor to another owner.
    ///
    /// Edges whose target is not in the new plan, and edges of the old plan to what has moved, are
    /// removed: their states and events are unconnected then.
    Move {
        #[serde(with = "wire")]
        item: Item,
        /// The plan that it is put into.
        plan: String,
        /// The element that it belongs to from now on; supervisors only.
        owner: Option<String>,
    },
    /// Makes a plan of some elements and puts a sub-plan in their place.
    ///
    /// What the elements write is visible outside when the sub-plan ends, no longer at once.
    Extract {
        plan: String,
        elements: Vec<String>,
        /// The name of the new plan.
        new_plan: String,
        /// The name of the sub-plan in the old plan.
        element: String,
    },
    /// Puts the elements of a sub-plan in its place; the plan that it was made from, which may stand
    /// in another file, stays. What its elements name is brought into view with `use` lines.
    Inline {
        plan: String,
        /// The sub-plan.
        element: String,
    },
}

impl Change {
    /// Whether it may concern other files than its own: those that use that one, and what they see besides.
    pub fn concerns_others(&self) -> bool {
        matches!(
            self,
            Change::Remove { .. }
                | Change::Rename { .. }
                | Change::RenameColumn { .. }
                | Change::RenameValue { .. }
                | Change::Move { .. }
                | Change::Extract { .. }
                | Change::Inline { .. }
        )
    }
}

/// The edits that make a change of the file `home`, file by file, in order and without overlaps.
///
/// `files` are the files of the project, with paths under which they find each other; spans carry a
/// file's place among them. `toolboxes` tell which ports are outputs. A rename edits every file that
/// refers to the item, inlining takes plans of other files; other changes edit their own file alone,
/// and are refused where another file names what they take away. A change that is already made needs
/// no edits.
///
/// # Errors
/// The change names what is not there, a fragment of text cannot be read, a name cannot be used, or
/// the change would alter more than it says; the reason tells which. So does a `home` that is none of
/// the files.
pub fn edit(
    files: &[Source],
    toolboxes: &Toolboxes,
    home: usize,
    change: &Change,
) -> Result<Vec<TextEdit>, Refused> {
    edit_with(files, Rc::new(toolboxes.clone()), home, change)
}

fn edit_with(
    files: &[Source],
    toolboxes: Rc<Toolboxes>,
    home: usize,
    change: &Change,
) -> Result<Vec<TextEdit>, Refused> {
    let mut workspace = begin(files, toolboxes, home)?;
    let errors = workspace.syntax_errors();
    make(&mut workspace, change)?;
    end(workspace, files, errors)
}

fn begin(files: &[Source], toolboxes: Rc<Toolboxes>, home: usize) -> Result<Workspace, Refused> {
    match home < files.len() {
        true => Ok(Workspace::new(files, &toolboxes, home)),
        false => Err(Refused::new("there is no such file")),
    }
}

/// The edits that a workspace has come to.
fn end(workspace: Workspace, files: &[Source], errors: usize) -> Result<Vec<TextEdit>, Refused> {
    if workspace.syntax_errors() > errors {
        return Err(Refused::new("the text could not be read any more"));
    }
    let buffers = (0..=u16::MAX).zip(files).zip(workspace.buffers);
    Ok(buffers.flat_map(|((file, source), buffer)| buffer.edits(source.text.len(), file)).collect())
}

/// A name that none of those taken is equal to, or differs from in case or `_` alone: the name itself,
/// or with the least number behind it.
pub fn fresh_name(name: &str, taken: &[String]) -> String {
    name::fresh(name, taken)
}

/// The text after the edits of its file, which must be in order and without overlaps, as [`edit`]
/// gives them.
///
/// Edits that do not fit the text are left out.
pub fn apply(text: &str, edits: &[TextEdit]) -> String {
    let mut result = String::new();
    let mut at = 0;
    for edit in edits {
        let (start, end) = (edit.span.start as usize, edit.span.end as usize);
        let Some(kept) = text.get(at..start).filter(|_| text.get(start..end).is_some()) else {
            continue;
        };
        result += kept;
        result += &edit.text;
        at = end;
    }
    result + text.get(at..).unwrap_or_default()
}

/// The place of an item of a file with the comments that belong to it, as [`Change::Remove`] takes them out.
pub fn with_comments(file: u16, text: &str, item: &Item) -> Option<Span> {
    let root = afp_syntax::parse(text, file, &mut Diagnostics::default()).root();
    tree::find(&root, item).ok().map(|node| buffer::span(file, tree::own_range(&node)))
}

fn make(workspace: &mut Workspace, change: &Change) -> Result<(), Refused> {
    match change {
        Change::Rename { item, to } => return rename::item(workspace, item, to),
        Change::RenameColumn { table, column, to } => {
            return rename::column(workspace, table, column, to);
        }
        Change::RenameValue { enumeration, value, to } => {
            return rename::value(workspace, enumeration, value, to);
        }
        Change::Inline { plan, element } => {
            return in_form(workspace, |workspace| inline::run(workspace, plan, element));
        }
        Change::Remove { item: item @ Item::Plan { .. } } => workspace.check_inside(item)?,
        Change::Remove { item } | Change::Move { item, .. } => workspace.check_unused(item)?,
        Change::Extract { plan, elements, new_plan, element } => {
            return extract::run(workspace, plan, elements, new_plan, element);
        }
        _ => {}
    }
    inside(workspace.buffer(), change)
}

/// Makes a change that moves lines about: files that were in canonical form before it are so after it.
fn in_form(
    workspace: &mut Workspace,
    change: impl FnOnce(&mut Workspace) -> Result<(), Refused>,
) -> Result<(), Refused> {
    let canonical: Vec<_> = workspace.buffers.iter().map(TextBuffer::is_canonical).collect();
    change(workspace)?;
    let buffers = workspace.buffers.iter_mut().zip(canonical);
    buffers.filter(|(_, before)| *before).for_each(|(buffer, _)| buffer.make_canonical());
    Ok(())
}

/// Makes a change that edits one file.
fn inside(buffer: &mut TextBuffer, change: &Change) -> Result<(), Refused> {
    match change {
        Change::AddUse { toolbox, alias } => add::line_of_use(buffer, toolbox, alias.as_deref()),
        Change::AddPlan { text } => add::plans(buffer, text),
        Change::Add { plan, owner, text, before } => {
            add::items(buffer, plan, owner.as_deref(), text, before.as_deref())
        }
        Change::Remove { item } => remove::item(buffer, item),
        Change::Connect { from, outcome, to } => connect::connect(buffer, from, outcome, to),
        Change::Disconnect { from, outcome } => connect::disconnect(buffer, from, outcome),
        Change::SetStart { plan, to } => connect::start(buffer, plan, to),
        Change::Reorder { item, before } => relocate::reorder(buffer, item, before.as_deref()),
        Change::Bind { component, port, to } => port::bind(buffer, component, port, to),
        Change::Unbind { component, port } => port::unbind(buffer, component, port),
        Change::SetTemplate { component, template } => {
            port::set_template(buffer, component, template)
        }
        Change::SetTiming { supervisor, keyword, value } => {
            port::set_timing(buffer, supervisor, keyword, value.as_deref())
        }
        Change::SetEntryKind { entry, keyword } => entry::set_kind(buffer, entry, keyword),
        Change::SetEntryType { entry, ty } => entry::set_type(buffer, entry, ty.as_deref()),
        Change::SetEntryValue { entry, value } => entry::set_value(buffer, entry, value.as_deref()),
        Change::SetDoc { item, text } => doc::set(buffer, item, text, Kind::Doc),
        Change::SetNote { item, text } => doc::set(buffer, item, text, Kind::Comment),
        Change::Move { item, plan, owner } => relocate::shift(buffer, item, plan, owner.as_deref()),
        Change::Rename { .. }
        | Change::Extract { .. }
        | Change::RenameColumn { .. }
        | Change::RenameValue { .. }
        | Change::Inline { .. } => Ok(()),
    }
}

#[cfg(test)]
mod tests;
