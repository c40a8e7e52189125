//! Completions at a place, best first.
//!
//! The syntax tree gives the grammatical context, see `context`. Index and outline give the
//! candidates, so that every valid name is offered.

pub(crate) mod bodies;
mod context;
mod plans;
mod reactions;
mod scenarios;
mod toolboxes;
mod values;

use std::collections::BTreeMap;

use crate::View;
use crate::describe::declaration;
use crate::edit::TextEdit;
use afp_dsl::index::{DefinitionId, DefinitionKind};
use afp_syntax::source::Span;

pub use bodies::{Piece, plain};
use context::{Context, Place};
pub(crate) use values::type_names;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The name in the list, also used for filtering.
    pub label: String,
    pub kind: CompletionKind,
    /// Its declaration in one line, or an empty string.
    pub detail: String,
    pub doc: String,
    /// The text for [`Completion::replaces`], with placeholders.
    pub insert: Vec<Piece>,
    pub replaces: Span,
    /// Additional edits in the file: a `use` line.
    pub with: Vec<TextEdit>,
    /// The sort order; lower is better.
    pub rank: u8,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompletionKind {
    Keyword,
    Definition(DefinitionKind),
    Type,
    Unit,
    Value,
    Function,
}

/// Returns all completions at a byte offset, best first; the word before it counts as a prefix.
pub fn completions(view: &View, offset: u32) -> Vec<Completion> {
    let context = Context::at(view, offset);
    let mut list = List { view, replaces: context.word, all: Vec::new(), uses: BTreeMap::new() };
    match &context.place {
        Place::Nothing => {}
        Place::File => match view.is_plan_file() {
            true => plans::of_file(&mut list),
            false => toolboxes::of_file(&mut list),
        },
        Place::Uses => plans::uses(&mut list),
        Place::Plan(node) => plans::items(&mut list, view.plan(node), node),
        Place::Element(node) => {
            plans::of_component(&mut list, view.component(node), true);
            reactions::whole(&mut list, view.component(node), offset);
        }
        Place::Supervisor(node) => plans::of_component(&mut list, view.component(node), false),
        Place::Watchers(node) => reactions::watchers(&mut list, view.component(node), offset),
        Place::Reactions(node) => reactions::events(&mut list, view.component(node), offset),
        Place::Made(node, home) => plans::templates(&mut list, node, *home),
        Place::Times => plans::times(&mut list),
        Place::Ports(node) => values::ports(&mut list, view.component(node)),
        Place::Target { from } => plans::targets(&mut list, offset, *from),
        Place::Start => plans::elements(&mut list, offset),
        Place::Type => values::types(&mut list, offset),
        Place::Output { component, port } => {
            values::outputs(&mut list, view.component(component), port, offset)
        }
        Place::Value(wanted) if values::takes_table(view, wanted) => {
            plans::tables(&mut list, offset);
        }
        Place::Value(wanted) => values::formulas(&mut list, wanted, offset),
        Place::Unit(wanted) => {
            let wanted = values::wanted(view, wanted, offset);
            values::units(&mut list, wanted.as_ref());
        }
        Place::Member(home) => scenarios::members(&mut list, *home),
        Place::Scenario => scenarios::lines(&mut list, true),
        Place::Moment => scenarios::lines(&mut list, false),
        Place::Path(word) => scenarios::paths(&mut list, word, offset),
        Place::Cause(claim) => scenarios::causes(&mut list, claim, offset),
        Place::Set { later } => scenarios::entries(&mut list, *later, offset),
        Place::PlanName => plans::plan_names(&mut list),
        Place::Toolbox(kind) => toolboxes::parts(&mut list, *kind),
        Place::Case => list.keyword("when", bodies::with_holes("when ‹value < 1› {‹›}"), 0),
        Place::Assigned(state) => toolboxes::assigned(&mut list, state),
    }
    let mut all = list.all;
    all.sort_by(|a, b| (a.rank, &a.label).cmp(&(b.rank, &b.label)));
    all.dedup_by(|a, b| a.label == b.label && a.insert == b.insert);
    all
}

struct List<'v, 'a> {
    view: &'v View<'a>,
    replaces: Span,
    all: Vec<Completion>,
    /// The edits that import toolboxes, by toolbox; each needs the whole file.
    uses: BTreeMap<String, Option<TextEdit>>,
}

impl List<'_, '_> {
    /// Adds a keyword and the text after it.
    fn keyword(&mut self, label: &str, insert: Vec<Piece>, rank: u8) {
        self.add(label, CompletionKind::Keyword, insert, rank);
    }

    fn keywords(&mut self, words: &[&str], rank: u8) {
        words.iter().for_each(|word| self.keyword(word, plain(&format!("{word} ")), rank));
    }

    /// Adds keywords without a following space.
    fn keywords_alone(&mut self, words: &[&str], rank: u8) {
        words.iter().for_each(|word| self.keyword(word, plain(word), rank));
    }

    fn add(&mut self, label: &str, kind: CompletionKind, insert: Vec<Piece>, rank: u8) {
        self.all.push(Completion {
            label: label.to_owned(),
            kind,
            detail: String::new(),
            doc: String::new(),
            insert,
            replaces: self.replaces,
            with: Vec::new(),
            rank,
        });
    }

    fn definitions(&mut self, ids: impl IntoIterator<Item = DefinitionId>, rank: u8) {
        ids.into_iter().for_each(|id| self.definition(id, rank));
    }

    fn definition(&mut self, id: DefinitionId, rank: u8) {
        let name = self.view.name_of(id).to_owned();
        self.definition_as(id, &name, plain(&name), rank);
    }

    fn definition_as(&mut self, id: DefinitionId, label: &str, insert: Vec<Piece>, rank: u8) {
        let definition = self.view.index().definition(id);
        self.all.push(Completion {
            label: label.to_owned(),
            kind: CompletionKind::Definition(definition.kind),
            detail: declaration(self.view, id),
            doc: definition.doc.clone(),
            insert,
            replaces: self.replaces,
            with: Vec::new(),
            rank,
        });
    }
}
