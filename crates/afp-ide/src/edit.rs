//! Changes of meaning as text edits, for the drawing and for code actions.
//!
//! Every change gives the smallest edits. All other text keeps its bytes, comments, blank lines and
//! order. An item moves with the comments above it, up to a blank line, and the comment after it.
//! The text may have errors elsewhere, but the changed items must be valid. If plans use plans of
//! other files, a change can edit several files.

mod add;
mod braces;
mod buffer;
mod case;
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

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Binding {
    /// An input: `port = formula`.
    In(String),
    /// An output: `port => entry`.
    Out(String),
}

/// A change of meaning. Its fragments of text are checked first.
///
/// In messages each is an object with its name in camel case, and items are paths: `{"connect":
/// {"from": "Patrol.go", "outcome": "ForwardSuccessful", "to": "turn"}}`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", rename_all_fields = "camelCase", deny_unknown_fields)]
pub enum Change {
    /// Adds `use toolbox as alias` below the other `use` lines.
    AddUse {
        /// The toolbox, or the path of a different plan file in quotes.
        toolbox: String,
        alias: Option<String>,
    },
    /// Adds plans and computations, given as text, after the last plan; only computations, before
    /// the first plan.
    AddPlan { text: String },
    /// Adds entries, elements or supervisors, given as text.
    Add {
        /// The new plan of the items.
        plan: String,
        /// The element, for supervisors.
        owner: Option<String>,
        text: String,
        /// The next item; by default items follow the last item of their kind.
        before: Option<String>,
    },
    /// Adds an element or supervisor without bindings and edges, from its parts.
    AddComponent {
        plan: String,
        /// The element, for supervisors.
        owner: Option<String>,
        /// `actor`, `computation`, `subplan` or `supervise`.
        keyword: String,
        name: String,
        /// `Name` or `home.Name`
        template: String,
    },
    /// Adds an entry from its parts.
    AddEntry {
        plan: String,
        /// `in`, `out`, `var` or `const`.
        keyword: String,
        name: String,
        /// Its type; by default that of the value.
        ty: Option<String>,
        value: Option<String>,
    },
    /// Removes an item and its comments. Removing an element also removes edges and a `start` to
    /// it. Removing an entry also removes the outputs bound to it.
    Remove {
        #[serde(with = "wire")]
        item: Item,
    },
    /// Renames an item in all files, including scenarios.
    Rename {
        #[serde(with = "wire")]
        item: Item,
        to: String,
    },
    /// Renames a column of a table and its bindings in all files.
    RenameColumn { table: String, column: String, to: String },
    /// Renames a value of an enum in all files.
    RenameValue { enumeration: String, value: String, to: String },
    /// Connects a state or event, or changes its target.
    Connect {
        #[serde(with = "wire")]
        from: Item,
        outcome: String,
        /// An element of the plan, `terminate`, `fail`, `fail "reason"`; for an event `ignore`, `resume` or
        /// `suspend NAME`, for a computation `resume` or `suspend NAME`, for a handler `return`.
        to: String,
    },
    /// Removes the edge of a state or event.
    Disconnect {
        #[serde(with = "wire")]
        from: Item,
        outcome: String,
    },
    /// Sets the first element of a plan.
    SetStart { plan: String, to: String },
    /// Moves an item before another one of its list, or after the last of its kind.
    Reorder {
        #[serde(with = "wire")]
        item: Item,
        /// The next item.
        before: Option<String>,
    },
    Bind {
        #[serde(with = "wire")]
        component: Item,
        port: String,
        to: Binding,
    },
    /// Removes the binding of a port.
    Unbind {
        #[serde(with = "wire")]
        component: Item,
        port: String,
    },
    /// Changes the template of an element or supervisor and keeps bindings and edges.
    SetTemplate {
        #[serde(with = "wire")]
        component: Item,
        /// `Name` or `home.Name`
        template: String,
    },
    /// Sets `every` or `deadline` of a supervisor; without a value removes it.
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
    /// Sets or removes the condition of a state of a declared computation.
    SetCondition {
        computation: String,
        state: String,
        /// Comparisons with `and` between them.
        condition: Option<String>,
    },
    /// Sets or removes the formula that a state of a declared computation assigns to an output.
    Assign { computation: String, state: String, output: String, formula: Option<String> },
    /// Sets or removes the help text above an item.
    SetDoc {
        #[serde(with = "wire")]
        item: Item,
        /// Its lines without slashes; empty to remove it.
        text: String,
    },
    /// Sets or removes the `//` lines above an item.
    SetNote {
        #[serde(with = "wire")]
        item: Item,
        /// Lines without slashes; empty to remove them.
        text: String,
    },
    /// Moves an entry, element or supervisor to another plan, or a supervisor to another owner.
    ///
    /// Edges whose target is missing in the new plan are removed, and so are edges of the old plan
    /// to a moved element. Their states and events become unconnected.
    Move {
        #[serde(with = "wire")]
        item: Item,
        plan: String,
        /// The new element, for supervisors.
        owner: Option<String>,
    },
    /// Moves elements into a new plan and replaces them by a sub-plan.
    ///
    /// Values written by these elements become visible outside only when the sub-plan ends.
    Extract {
        plan: String,
        elements: Vec<String>,
        new_plan: String,
        /// Name of the sub-plan in the old plan.
        element: String,
    },
    /// Replaces a sub-plan by its elements. Its plan stays, and may be in a different file. New
    /// `use` lines import the names of the elements.
    Inline { plan: String, element: String },
}

impl Change {
    /// Whether it may affect other files: the users of its file, and the files that they use.
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

/// Returns the edits of a change of the file `home`, by file, in order and without overlaps.
///
/// `files` are the project's files, with paths relative to each other; a span contains the index of
/// its file. `toolboxes` define which ports are outputs. A rename edits every referring file, and
/// inlining reads plans of other files. All other changes edit only their own file, and are refused
/// if another file needs a removed name. A change without an effect returns no edits.
///
/// # Errors
/// A missing item, an invalid fragment, an unusable name, a change with side effects, or a `home`
/// outside `files`; the reason names the problem.
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

fn end(workspace: Workspace, files: &[Source], errors: usize) -> Result<Vec<TextEdit>, Refused> {
    if workspace.syntax_errors() > errors {
        return Err(Refused::new("the edit would break the syntax of the file"));
    }
    let buffers = (0..=u16::MAX).zip(files).zip(workspace.buffers);
    Ok(buffers.flat_map(|((file, source), buffer)| buffer.edits(source.text.len(), file)).collect())
}

/// Returns an unused name: the name itself, or with the lowest free number. Names that differ only
/// in case or `_` count as equal.
pub fn fresh_name(name: &str, taken: &[String]) -> String {
    name::fresh(name, taken)
}

/// Returns a text after edits of its file, in order and without overlaps, as from [`edit`].
///
/// Edits that do not fit the text are skipped.
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

/// Whether a text of items has only supervisors, which can be added to an element.
pub fn has_only_supervisors(text: &str) -> bool {
    fragment::items(text, true).is_ok()
}

/// The span of an item with its comments, as removed by [`Change::Remove`].
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
        Change::SetCondition { computation, state, condition } => {
            return in_form(workspace, |workspace| {
                let state = (computation.as_str(), state.as_str());
                case::set_condition(workspace.buffer(), state, condition.as_deref())
            });
        }
        Change::Assign { computation, state, output, formula } => {
            return in_form(workspace, |workspace| {
                let state = (computation.as_str(), state.as_str());
                case::assign(workspace.buffer(), state, output, formula.as_deref())
            });
        }
        Change::AddComponent { .. } | Change::AddEntry { .. } => {
            return make(workspace, &add::from_parts(change.clone())?);
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

/// Makes a change that moves lines, and keeps files in canonical form.
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
        Change::AddComponent { .. }
        | Change::AddEntry { .. }
        | Change::Rename { .. }
        | Change::Extract { .. }
        | Change::RenameColumn { .. }
        | Change::RenameValue { .. }
        | Change::SetCondition { .. }
        | Change::Assign { .. }
        | Change::Inline { .. } => Ok(()),
    }
}

#[cfg(test)]
mod tests;
