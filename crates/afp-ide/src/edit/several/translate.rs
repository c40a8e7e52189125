//! Texts with assigned names.

use std::rc::Rc;

use super::super::tree::{Scope, children};
use super::super::workspace::Workspace;
use super::super::{Binding, Change, Item, Refused, name, rename};
use super::given::Given;
use afp_syntax::kind::Kind;
use afp_syntax::source::Source;

/// The context of a text in a stand-in plan: an item for each name that the text may mean.
struct Surroundings {
    plan: String,
    /// The name of an element in it.
    host: String,
    items: String,
    /// The requested names, with the assigned ones.
    names: Vec<(Item, String)>,
}

impl Given {
    /// A change with assigned names, except in its new text.
    pub(super) fn in_change(
        &self,
        workspace: &mut Workspace,
        change: Change,
    ) -> Result<Change, Refused> {
        let plan = match &change {
            Change::Bind { component: item, .. }
            | Change::SetTiming { supervisor: item, .. }
            | Change::SetEntryValue { entry: item, .. } => item.plan_name().to_owned(),
            _ => String::new(),
        };
        let mut translated = |text: String| formula(workspace, self, &plan, text);
        Ok(match self.in_names(change) {
            Change::Bind { component, port, to } => {
                let to = match to {
                    Binding::In(text) => Binding::In(translated(text)?),
                    Binding::Out(entry) => Binding::Out(self.name(&plan, entry)),
                };
                Change::Bind { component, port, to }
            }
            Change::SetTiming { supervisor, keyword, value } => {
                Change::SetTiming { supervisor, keyword, value: value.map(translated).transpose()? }
            }
            Change::SetEntryValue { entry, value } => {
                Change::SetEntryValue { entry, value: value.map(translated).transpose()? }
            }
            other => other,
        })
    }
}

/// A formula of a plan, with the assigned names of its items.
fn formula(
    workspace: &mut Workspace,
    given: &Given,
    plan: &str,
    text: String,
) -> Result<String, Refused> {
    let around = Surroundings::new(workspace, given, plan, &[]);
    let before = format!("actor {}: X(x = ", around.host);
    around.renamed(workspace, &before, &text, ") {}")
}

/// Items for a plan or supervisors for its element, with the assigned names of others; `declared`
/// are their own names in order, each with the assigned one.
pub(super) fn items(
    workspace: &mut Workspace,
    given: &Given,
    (plan, in_element): (&str, bool),
    text: &str,
    declared: &[(String, String)],
) -> Result<String, Refused> {
    let own: Vec<_> = declared.iter().map(|(name, _)| name.as_str()).collect();
    let mut around = Surroundings::new(workspace, given, plan, if in_element { &[] } else { &own });
    for (index, (name, given)) in declared.iter().enumerate().filter(|(_, (a, b))| a != b) {
        let number = own[..index].iter().filter(|known| *known == name).count() + 1;
        let name = format!("{name}#{number}");
        let item = match in_element {
            false => Item::inner(&around.plan, name),
            true => Item::local(&around.plan, &around.host, name),
        };
        around.names.push((item, given.clone()));
    }
    let (before, after) = match in_element {
        false => (String::new(), ""),
        true => (format!("actor {}: X {{\n", around.host), "\n}"),
    };
    around.renamed(workspace, &before, text, after)
}

impl Surroundings {
    /// The context of a text in a plan that itself declares some names.
    fn new(workspace: &mut Workspace, given: &Given, plan: &str, own: &[&str]) -> Surroundings {
        let others: Vec<_> =
            given.of_plan(plan).filter(|(wished, ..)| !own.contains(wished)).collect();
        let plan = name::fresh("Plan", &Scope::File(workspace.buffer().root()).names());
        let taken: Vec<_> =
            others.iter().map(|(name, ..)| *name).chain(own.iter().copied()).collect();
        let taken: Vec<_> = taken.into_iter().map(str::to_owned).collect();
        let host = name::fresh("host", &taken);
        let item = |(name, _, kind): &(&str, &str, Kind)| match kind {
            Kind::Entry => format!("var {name}: int\n"),
            Kind::Guard => format!("supervise {name}: X {{}}\n"),
            _ => format!("actor {name}: X {{}}\n"),
        };
        let items = others.iter().map(item).collect();
        let names =
            others.iter().map(|(name, given, _)| (Item::inner(&plan, *name), (*given).to_owned()));
        let names = names.collect();
        Surroundings { plan, host, items, names }
    }

    /// Replaces requested names in the part between two texts. The other files give its meaning.
    fn renamed(
        &self,
        workspace: &mut Workspace,
        before: &str,
        text: &str,
        after: &str,
    ) -> Result<String, Refused> {
        if self.names.is_empty() {
            return Ok(text.to_owned());
        }
        let root = workspace.buffer().root();
        let uses: String = children(&root, Kind::Use).map(|line| line.text().to_string()).collect();
        let others =
            root.children().filter(|item| !matches!(item.kind(), Kind::Use | Kind::Version));
        let others: String = others.map(|item| item.text().to_string()).collect();
        let before = format!("{uses}\nplan {} {{\n{}{before}", self.plan, self.items);
        let after = format!("{after}\n}}\n{others}");
        let sources = workspace.paths.iter().zip(&workspace.buffers);
        let mut sources: Vec<_> =
            sources.map(|(path, buffer)| Source::new(path, buffer.text())).collect();
        let home = workspace.home;
        sources[home].text = format!("{before}{text}{after}");
        let toolboxes = Rc::clone(&workspace.buffer().toolboxes);
        let mut apart = Workspace::new(&sources, &toolboxes, home);
        rename::within(&mut apart, &self.names, before.len(), after.len())?;
        let whole = apart.buffer().text();
        let inner = whole.strip_prefix(&*before).and_then(|rest| rest.strip_suffix(&*after));
        inner.map(str::to_owned).ok_or_else(|| Refused::new(format!("'{text}' cannot be read")))
    }
}
