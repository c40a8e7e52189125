//! Requested names that were taken, and their meaning in later changes.

use std::collections::BTreeMap;

use super::super::{Change, Item};
use afp_syntax::kind::Kind;

/// The assigned names of items with a taken name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Given {
    /// By plan, element of a supervisor, and requested name. Each name is looked up only once.
    names: BTreeMap<(String, Option<String>, String), Name>,
    all: Vec<(String, String)>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Name {
    given: String,
    kind: Kind,
}

impl Given {
    /// The requested names with the assigned ones, in order of insertion.
    pub fn all(&self) -> &[(String, String)] {
        &self.all
    }

    /// The item with assigned names.
    pub fn item(&self, item: Item) -> Item {
        match item {
            Item::Inner { plan, name } => Item::Inner { name: self.name(&plan, name), plan },
            Item::Local { plan, owner, name } => {
                let owner = self.name(&plan, owner);
                self.local(Item::local(plan, owner, name))
            }
            other => other,
        }
    }

    /// A supervisor or reactions with assigned names, for an element with an assigned name.
    fn local(&self, item: Item) -> Item {
        let supervisor = item.reacts_to().map(|to| self.name(item.plan_name(), to.to_owned()));
        let Item::Local { plan, owner, name } = item else { return item };
        if let Some(supervisor) = supervisor {
            return Item::reactions(plan, owner, &supervisor);
        }
        let key = (plan, Some(owner), name);
        let given = self.names.get(&key).map(|name| name.given.clone());
        let (plan, owner, name) = key;
        Item::local(plan, owner.unwrap_or_default(), given.unwrap_or(name))
    }

    /// The assigned name of an item in a plan.
    pub(super) fn name(&self, plan: &str, name: String) -> String {
        let key = (plan.to_owned(), None, name);
        self.names.get(&key).map_or(key.2, |name| name.given.clone())
    }

    /// The requested names of a plan, with the assigned names and the kinds of the items.
    pub(super) fn of_plan<'g>(
        &'g self,
        plan: &'g str,
    ) -> impl Iterator<Item = (&'g str, &'g str, Kind)> {
        let all =
            self.names.iter().filter(move |((of, owner, _), _)| of == plan && owner.is_none());
        all.map(|((.., wished), name)| (&**wished, &*name.given, name.kind))
    }

    /// Records the name of a new item, which the requested name means from now on.
    pub(super) fn insert(
        &mut self,
        (plan, owner): (&str, Option<&str>),
        wished: String,
        given: String,
        kind: Kind,
    ) {
        let key = (plan.to_owned(), owner.map(str::to_owned), wished.clone());
        if wished == given {
            self.names.remove(&key);
            return;
        }
        self.names.insert(key, Name { given: given.clone(), kind });
        self.all.push((wished, given));
    }

    pub(super) fn in_names(&self, change: Change) -> Change {
        use Change as C;

        let in_plan = |plan: &str, name: Option<String>| name.map(|name| self.name(plan, name));
        match change {
            C::Add { owner, text, before, plan } => {
                let owner = in_plan(&plan, owner);
                let before = before.map(|before| self.beside(&plan, owner.as_deref(), before));
                C::Add { owner, text, before, plan }
            }
            C::Remove { item } => C::Remove { item: self.item(item) },
            C::Rename { item, to } => C::Rename { item: self.item(item), to },
            C::AddComponent { .. }
            | C::AddEntry { .. }
            | C::RenameColumn { .. }
            | C::RenameValue { .. }
            | C::SetCondition { .. }
            | C::Assign { .. } => change,
            C::Connect { from, outcome, to } => {
                let to = self.target(from.plan_name(), to);
                C::Connect { from: self.item(from), outcome, to }
            }
            C::Disconnect { from, outcome } => C::Disconnect { from: self.item(from), outcome },
            C::SetStart { plan, to } => C::SetStart { to: self.name(&plan, to), plan },
            C::Reorder { item, before } => {
                let item = self.item(item);
                let owner = match &item {
                    Item::Local { owner, .. } => Some(&**owner),
                    _ => None,
                };
                let before = before.map(|before| self.beside(item.plan_name(), owner, before));
                C::Reorder { item, before }
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

    /// The target of an edge with its assigned name, if it is an element.
    fn target(&self, plan: &str, to: String) -> String {
        match &*to {
            "terminate" | "fail" | "ignore" | "resume" | "return" => to,
            _ => match to.strip_prefix("suspend ") {
                Some(name) => format!("suspend {}", self.name(plan, name.to_owned())),
                None => self.name(plan, to),
            },
        }
    }

    /// A name of a plan, or of a supervisor of an element with its assigned name.
    fn beside(&self, plan: &str, owner: Option<&str>, name: String) -> String {
        match owner {
            None => self.name(plan, name),
            Some(owner) => self.local(Item::local(plan, owner, name)).name().to_owned(),
        }
    }
}
