//! Maps source places to items and their parts, and back.

use super::{Component, File, Outline, Plan};
use afp_syntax::item::Item;
use afp_syntax::source::Span;

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Identity {
    /// The file, as in [`Span::file`].
    pub file: u16,
    pub item: Item,
    pub part: Part,
}

/// A part of an item.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    Whole,
    /// The `n`-th `start` line of a plan.
    Start(u16),
    /// The binding of an input.
    Input {
        name: String,
        /// Number of its binding, from 1.
        nth: u16,
    },
    /// The binding of an output.
    Output {
        name: String,
        /// Number of its binding, from 1.
        nth: u16,
    },
    /// The edge of a state or event.
    Exit {
        name: String,
        /// Number of its edge, from 1.
        nth: u16,
    },
}

impl Outline {
    /// The smallest item or part that covers a byte, including its end.
    pub fn identity_at(&self, file: u16, offset: u32) -> Option<Identity> {
        let place = Span { file, start: offset, end: offset };
        let covers = |span: Span| span.contains(place);
        let made = |(item, part): (&Item, Part)| Identity { file, item: item.clone(), part };
        let own = self.files.iter().filter(|each| each.file == file);
        let mut outer = own.flat_map(|each| each.outer_items());
        if let Some((item, _)) = outer.find(|(_, span)| covers(*span)) {
            return Some(made((item, Part::Whole)));
        }
        // A misplaced inner plan begins after the outer one.
        let around = self.plans.iter().filter(|plan| covers(plan.span));
        let plan = around.max_by_key(|plan| plan.span.start)?;
        let starts = (1..).zip(&plan.starts).find(|(_, start)| covers(start.span));
        if let Some((nth, _)) = starts {
            return Some(made((&plan.item, Part::Start(nth))));
        }
        if let Some(entry) = plan.entries.iter().find(|entry| covers(entry.span)) {
            return Some(made((&entry.item, Part::Whole)));
        }
        // A local supervisor comes after its element, so the last one is the smallest.
        let components: Vec<_> = plan.components().filter(|each| covers(each.span)).collect();
        let found = match components.last() {
            Some(component) => (&component.item, part_at(component, covers)),
            None => (&plan.item, Part::Whole),
        };
        Some(made(found))
    }

    /// The place of an item or part, without surrounding comments.
    pub fn span_of(&self, identity: &Identity) -> Option<Span> {
        let Identity { file, item, part } = identity;
        if let Item::Enum { .. } | Item::Table { .. } = item {
            let own = self.files.iter().find(|each| each.file == *file)?;
            return own.outer_items().find(|(known, _)| *known == item).map(|(_, span)| span);
        }
        let plan = self.plan_of(*file, item)?;
        match part {
            Part::Start(nth) => {
                let index = usize::from(*nth).checked_sub(1)?;
                plan.starts.get(index).map(|start| start.span)
            }
            Part::Whole if plan.item == *item => Some(plan.span),
            Part::Whole => {
                let entry = plan.entries.iter().find(|entry| entry.item == *item);
                let span = entry.map(|entry| entry.span);
                span.or_else(|| plan.component(item).map(|component| component.span))
            }
            part => part_span(plan.component(item)?, part),
        }
    }

    /// The plan of an item, or the item itself if it is a plan.
    pub fn plan_of(&self, file: u16, item: &Item) -> Option<&Plan> {
        let name = item.plan_name();
        self.plans.iter().find(|plan| plan.file() == file && plan.item.name() == name)
    }
}

impl File {
    /// Enums and tables with their places.
    fn outer_items(&self) -> impl Iterator<Item = (&Item, Span)> {
        let enums = self.enums.iter().map(|each| (&each.item, each.span));
        enums.chain(self.tables.iter().map(|each| (&each.item, each.span)))
    }
}

impl Plan {
    pub fn component(&self, item: &Item) -> Option<&Component> {
        self.components().find(|component| component.item == *item)
    }
}

fn part_at(component: &Component, covers: impl Fn(Span) -> bool) -> Part {
    for input in &component.inputs {
        if input.binding.as_ref().is_some_and(|binding| covers(binding.span)) {
            return Part::Input { name: input.name.to_string(), nth: input.nth };
        }
    }
    for output in &component.outputs {
        if output.binding.as_ref().is_some_and(|binding| covers(binding.span)) {
            return Part::Output { name: output.name.to_string(), nth: output.nth };
        }
    }
    for exit in &component.exits {
        if exit.edge.as_ref().is_some_and(|edge| covers(edge.span)) {
            return Part::Exit { name: exit.name.to_string(), nth: exit.nth };
        }
    }
    Part::Whole
}

fn part_span(component: &Component, part: &Part) -> Option<Span> {
    match part {
        Part::Input { name, nth } => {
            let mut inputs = component.inputs.iter();
            let found = inputs.find(|input| *input.name == **name && input.nth == *nth)?;
            found.binding.as_ref().map(|binding| binding.span)
        }
        Part::Output { name, nth } => {
            let mut outputs = component.outputs.iter();
            let found = outputs.find(|output| *output.name == **name && output.nth == *nth)?;
            found.binding.as_ref().map(|binding| binding.span)
        }
        Part::Exit { name, nth } => {
            let mut exits = component.exits.iter();
            let found = exits.find(|exit| *exit.name == **name && exit.nth == *nth)?;
            found.edge.as_ref().map(|edge| edge.span)
        }
        Part::Whole | Part::Start(_) => None,
    }
}
