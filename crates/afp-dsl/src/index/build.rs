//! Builds the index from declarations and recorded names.

use super::declare::{self, Declared};
use super::record::{Found, Meanings, key};
use super::{Candidates, Definition, DefinitionId, Index, Meaning, Name};
use crate::outline::Outline;
use afp_syntax::source::Span;
use rustc_hash::FxHashMap;

/// The index of a compilation. `all` has the toolboxes' declarations, the outline the others.
pub(crate) fn build(outline: &Outline, meanings: &Meanings, mut all: Vec<Declared>) -> Index {
    declare::of_outline(outline, meanings, &mut all);
    all.sort_by_key(|each| key(each.name));
    all.dedup_by_key(|each| each.name);
    let own: Vec<Span> = all.iter().map(|each| each.name).collect();
    let ids: FxHashMap<u64, DefinitionId> = own.iter().map(|name| key(*name)).zip(ids()).collect();
    let known = |name: Span| ids.get(&key(name)).copied();
    let names = names(&own, meanings, &known);
    let (uses, first_uses) = uses(&names, own.len());
    let several = meanings.several.iter();
    let several = several.map(|spans| spans.iter().filter_map(|span| known(*span)).collect());
    let several = several.collect();
    let definitions = all.into_iter().map(|each| Definition {
        kind: each.kind,
        name: each.name,
        span: each.span,
        owner: each.owner.and_then(known),
        made_from: each.made_from.and_then(known),
        doc: each.doc,
    });
    Index { definitions: definitions.collect(), names, uses, first_uses, several }
}

fn ids() -> impl Iterator<Item = DefinitionId> {
    (0..).map(DefinitionId)
}

/// The references of each definition, and the start of each definition's list.
fn uses(names: &[Name], definitions: usize) -> (Vec<u32>, Vec<u32>) {
    let of = |(at, name): (u32, &Name)| name.meaning.referred().map(move |id| (id.index(), at));
    let referring = || (0..).zip(names).flat_map(of);
    let mut first = vec![0_u32; definitions + 1];
    referring().for_each(|(id, _)| first[id + 1] += 1);
    for id in 0..definitions {
        first[id + 1] += first[id];
    }
    let mut next = first.clone();
    let mut uses = vec![0; first[definitions] as usize];
    for (id, at) in referring() {
        uses[next[id] as usize] = at;
        next[id] += 1;
    }
    (uses, first)
}

/// Merges declaring and recorded names, both sorted.
fn names(
    own: &[Span],
    meanings: &Meanings,
    known: &dyn Fn(Span) -> Option<DefinitionId>,
) -> Vec<Name> {
    let ports = meanings.alone.iter();
    let ports = ports.filter_map(|(name, port)| Some((key(*name), known(*port)?)));
    let alone: FxHashMap<u64, DefinitionId> = ports.collect();
    let mut names = Vec::with_capacity(own.len() + meanings.names.len());
    let mut declared = ids().zip(own).peekable();
    for (span, found) in &meanings.names {
        while let Some((id, name)) = declared.next_if(|(_, name)| *name <= span) {
            names.push(Name { span: *name, meaning: Meaning::Declares(id) });
        }
        // A declaration is not a reference.
        if names.last().is_some_and(|last| last.span == *span) {
            continue;
        }
        let meaning = match found {
            Found::Unread => Meaning::Unread,
            Found::Unknown => Meaning::Unknown,
            Found::Word(word) => Meaning::Word(*word),
            Found::File(file) => Meaning::File(*file),
            Found::Several(place) => Meaning::Ambiguous(Candidates(*place)),
            Found::Definition(definition) => match (known(*definition), alone.get(&key(*span))) {
                (Some(entry), Some(port)) => Meaning::Both { entry, port: *port },
                (known, _) => known.map_or(Meaning::Unknown, Meaning::Refers),
            },
        };
        names.push(Name { span: *span, meaning });
    }
    names.extend(declared.map(|(id, name)| Name { span: *name, meaning: Meaning::Declares(id) }));
    names
}
