//! Builds the outline from the trees and the results of the check.

use std::mem::take;

use crate::check::draft::{self, in_one_line};
use crate::check::{Members, PlanHead, Program};
use crate::gather::PlanFile;
use crate::graph::EntryKind;
use crate::index::{Found, Lookup, Meanings, Word};
use crate::outline::{
    Column, Component, Destination, ElementId, Entry, EntryId, Enum, File, Findings, Outline, Plan,
    PlanId, Scenario, Start, Table, Target, Use, Value,
};
use afp_syntax::ast::{self, Name};
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use rustc_hash::FxHashMap;

/// The input of the outline.
pub(crate) struct Material<'a> {
    /// The syntax trees.
    pub program: &'a Program<'a>,
    pub files: &'a [PlanFile],
    /// The components of each plan.
    pub members: Vec<Members>,
    pub meanings: &'a Meanings,
    /// The requested plan.
    pub main: Option<usize>,
}

pub(crate) fn build(mut material: Material<'_>) -> Outline {
    let mut members = take(&mut material.members).into_iter();
    let material = &material;
    let heads = material.program.plans.iter();
    let names = heads.enumerate().filter_map(|(at, head)| Some((head.name.as_ref()?.span, at)));
    let names: FxHashMap<Span, usize> = names.collect();
    let mut outline = Outline { main: material.main.map(PlanId::new), ..Outline::default() };
    for (at, file) in material.files.iter().enumerate() {
        outline.files.push(self::file(material, at, file, &names));
        let heads = || material.program.plans.iter().filter(|head| head.file == at);
        let items = numbered(heads().map(|head| head.name.as_ref()));
        // Plans are ordered by file.
        for ((head, item), members) in heads().zip(items).zip(members.by_ref()) {
            outline.plans.push(plan(material, head, members, item));
        }
    }
    outline
}

fn file(
    material: &Material<'_>,
    at: usize,
    file: &PlanFile,
    plans: &FxHashMap<Span, usize>,
) -> File {
    let mut read = File { file: file.index, path: file.path.clone(), ..File::default() };
    let heads = material.program.plans.iter().enumerate();
    let computations = material.program.files.get(at).into_iter().flat_map(|it| &it.computations);
    read.computations = computations.map(|import| import.toolbox.clone()).collect();
    read.plans = heads.filter(|(_, h)| h.file == at).map(|(at, _)| PlanId::new(at)).collect();
    let (mut enums, mut tables) = (Vec::new(), Vec::new());
    for item in file.tree.items() {
        match item {
            ast::Item::Use(line) => read.uses.push(used(material, &line)),
            ast::Item::Enum(node) => enums.push(node),
            ast::Item::Table(node) => tables.push(node),
            ast::Item::Scenario(node) => {
                let reference = node.plan().and_then(|plan| plan.name());
                let found = reference.and_then(|name| material.meanings.get(name.span));
                let plan = match found {
                    Some(Found::Definition(span)) => plans.get(&span).copied().map(PlanId::new),
                    _ => None,
                };
                let (name, span) = (node.name(), node.span());
                read.scenarios.push(Scenario { name, span, plan, findings: Findings::default() });
            }
            _ => {}
        }
    }
    let names: Vec<_> = enums.iter().map(ast::Enum::name).collect();
    let items = numbered(names.iter().map(Option::as_ref));
    read.enums = items
        .zip(&enums)
        .zip(&names)
        .map(|((item, node), name)| Enum {
            item: Item::enumeration(item),
            name: name.clone(),
            doc: node.doc(),
            note: node.note(),
            span: node.span(),
            variants: node.variants(),
            findings: Findings::default(),
        })
        .collect();
    read.tables = self::tables(material, &tables);
    read
}

fn tables(material: &Material<'_>, nodes: &[ast::Table]) -> Vec<Table> {
    let names: Vec<_> = nodes.iter().map(ast::Table::name).collect();
    let items = numbered(names.iter().map(Option::as_ref));
    let known = || material.program.files.iter().flat_map(|file| &file.tables);
    let known = || known().flat_map(|table| &table.columns);
    let column = |node: ast::Column| {
        let name = node.name()?;
        let ty = known().find(|column| column.span == name.span).and_then(|it| it.ty.clone());
        Some(Column { name, doc: node.doc(), span: node.span(), ty })
    };
    let tables = items.zip(nodes).zip(&names).map(|((item, node), name)| Table {
        item: Item::table(item),
        name: name.clone(),
        doc: node.doc(),
        note: node.note(),
        span: node.span(),
        columns: node.columns().into_iter().filter_map(column).collect(),
        findings: Findings::default(),
    });
    tables.collect()
}

fn used(material: &Material<'_>, line: &ast::Use) -> Use {
    let path = line.path();
    let file = match path.as_ref().and_then(|path| material.meanings.get(path.span)) {
        Some(Found::File(file)) => Some(file),
        _ => None,
    };
    Use { span: line.span(), toolbox: line.toolbox(), alias: line.alias(), path, file }
}

fn plan(material: &Material<'_>, head: &PlanHead, members: Members, item: String) -> Plan {
    let node = &head.node;
    let entries = node.entries();
    let mut entry_names: Vec<_> = entries.iter().map(ast::Entry::name).collect();
    let names = [
        Vec::from_iter(entries.iter().zip(&entry_names).map(|(e, n)| (n.as_ref(), e.span().start))),
        named(&members.globals),
        named(&members.elements),
    ];
    let [entry_items, guard_items, element_items] = inner_items(&names);
    let places = Places {
        text: &material.files[head.file].source.text,
        meanings: material.meanings.lookup(),
        elements: spans(members.elements.iter().map(|member| member.name.as_ref())),
        entries: spans(entry_names.iter().map(Option::as_ref)),
    };
    let entries = entries.iter().zip(entry_names.drain(..)).zip(entry_items);
    let entries = entries
        .map(|((node, name), own)| entry(head, &places, node, name, Item::inner(&item, own)))
        .collect();
    let (mut supervisors, mut elements) = (members.globals, members.elements);
    for (component, own) in supervisors.iter_mut().zip(guard_items) {
        places.settle(component, Item::inner(&item, own));
    }
    for (element, own) in elements.iter_mut().zip(element_items) {
        settle(&places, element, &item, own);
    }
    Plan {
        entries,
        starts: node.starts().iter().map(|start| places.start(start)).collect(),
        supervisors,
        elements,
        name: head.name.clone(),
        doc: node.doc(),
        note: node.note(),
        span: node.span(),
        interruptible: head.interrupting.is_some(),
        forever: node.forever().is_some(),
        findings: Findings::default(),
        item: Item::plan(item),
    }
}

/// Sets the paths and meanings of an element, its supervisors and reactions.
fn settle(places: &Places<'_>, element: &mut Component, plan: &str, own: String) {
    for (each, name) in items(&mut element.supervisors) {
        places.settle(each, Item::local(plan, &own, name));
    }
    for (each, name) in items(&mut element.reactions) {
        places.settle(each, Item::reactions(plan, &own, &name));
    }
    places.settle(element, Item::inner(plan, own));
}

/// Supervisors or reactions of an element, with their names in paths.
fn items(all: &mut [Component]) -> impl Iterator<Item = (&mut Component, String)> {
    let names = all.iter().map(|each| each.name.as_ref());
    let items: Vec<_> = if all.is_empty() { Vec::new() } else { numbered(names).collect() };
    all.iter_mut().zip(items)
}

/// The names of components, each with its first byte.
fn named(components: &[Component]) -> Vec<(Option<&Name>, u32)> {
    components.iter().map(|each| (each.name.as_ref(), each.span.start)).collect()
}

fn entry(
    head: &PlanHead,
    places: &Places<'_>,
    node: &ast::Entry,
    name: Option<Name>,
    item: Item,
) -> Entry {
    let draft = name.as_ref().and_then(|name| {
        let index = head.entries.binary_search_by_key(&name.span, |draft| draft.name.span).ok()?;
        head.entries.get(index)
    });
    let written_type = node.ty().map(|ty| {
        let span = ty.span();
        Name { text: in_one_line(places.text, span).unwrap_or_else(|| ty.in_one_line()), span }
    });
    Entry {
        item,
        kind: match node.keyword().as_str() {
            "in" => EntryKind::In,
            "out" => EntryKind::Out,
            "const" => EntryKind::Const,
            _ => EntryKind::Var,
        },
        name,
        live: node.live().is_some(),
        doc: node.doc(),
        note: node.note(),
        span: node.span(),
        written_type,
        ty: draft.and_then(|draft| draft.ty.clone()),
        init: node.init().map(|init| places.value(&init)),
        range: node.range().map(|(least, most, _)| [places.value(&least), places.value(&most)]),
        findings: Findings::default(),
    }
}

/// The meanings of names inside a plan.
struct Places<'a> {
    /// The text of the file.
    text: &'a str,
    meanings: Lookup<'a>,
    /// The names of elements, in order, with their spans.
    elements: Vec<(Span, usize)>,
    /// The names of entries, in order, with their spans.
    entries: Vec<(Span, usize)>,
}

impl Places<'_> {
    /// Sets the path of a component and the meanings of the names in it.
    fn settle(&self, component: &mut Component, item: Item) {
        component.item = item;
        let inputs = component.inputs.iter_mut().filter_map(|input| input.binding.as_mut());
        let outputs = component.outputs.iter_mut().filter_map(|output| output.binding.as_mut());
        for value in inputs.chain(outputs).filter_map(|binding| binding.value.as_mut()) {
            value.entry = self.entry(value.span);
        }
        for exit in &mut component.exits {
            let Some(edge) = &mut exit.edge else { continue };
            if !exit.known {
                let meaning = self.meanings.get(edge.name_span);
                exit.known = !matches!(meaning, None | Some(Found::Unknown));
            }
            if let Some(target) = &mut edge.target {
                target.to = self.leads_to(target);
            }
        }
    }

    /// The target of an edge or of `start`.
    fn leads_to(&self, target: &Target) -> Destination {
        match self.meanings.get(target.name_span()) {
            Some(Found::Word(Word::Terminate)) => Destination::Terminate,
            Some(Found::Word(Word::Fail)) => Destination::Fail(()),
            Some(Found::Word(Word::Ignore)) => Destination::Ignore,
            Some(Found::Word(Word::Resume)) => Destination::Resume,
            Some(Found::Word(Word::Return)) => Destination::Return,
            found => {
                let element = match found {
                    Some(Found::Definition(span)) => find(&self.elements, span),
                    _ => None,
                };
                let element = element.map(ElementId::new);
                match target.suspends() {
                    true => Destination::Suspend(element),
                    false => Destination::Element(element),
                }
            }
        }
    }

    fn entry(&self, name: Span) -> Option<EntryId> {
        match self.meanings.get(name)? {
            Found::Definition(span) => find(&self.entries, span).map(EntryId::new),
            _ => None,
        }
    }

    fn value(&self, formula: &ast::Formula) -> Value {
        let value = draft::value(self.text, formula);
        Value { entry: self.entry(value.span), ..value }
    }

    fn start(&self, start: &ast::Start) -> Start {
        let target = start.target().map(|name| {
            let target = draft::target(name);
            Target { to: self.leads_to(&target), ..target }
        });
        Start { span: start.span(), target, findings: Findings::default() }
    }
}

fn spans<'n>(names: impl Iterator<Item = Option<&'n Name>>) -> Vec<(Span, usize)> {
    names.enumerate().filter_map(|(index, name)| Some((name?.span, index))).collect()
}

fn find(known: &[(Span, usize)], span: Span) -> Option<usize> {
    let index = known.binary_search_by_key(&span, |(known, _)| *known).ok()?;
    Some(known[index].1)
}

/// The names of items of one scope in paths: the second item of a name has the suffix `#2`.
fn numbered<'n>(names: impl Iterator<Item = Option<&'n Name>>) -> impl Iterator<Item = String> {
    let mut seen: FxHashMap<&str, u32> = FxHashMap::default();
    names.map(move |name| path_name(name, &mut seen))
}

fn path_name<'n>(name: Option<&'n Name>, seen: &mut FxHashMap<&'n str, u32>) -> String {
    let text = name.map_or("", |name| name.text.as_str());
    let count = seen.entry(text).or_default();
    *count += 1;
    match count {
        1 if !text.is_empty() => text.to_owned(),
        _ => format!("{text}#{count}"),
    }
}

/// The names of entries, global supervisors and elements, which share one scope, in paths. Each has
/// its first byte.
fn inner_items(names: &[Vec<(Option<&Name>, u32)>; 3]) -> [Vec<String>; 3] {
    let mut order: Vec<(u32, usize, usize)> = Vec::new();
    for (list, names) in names.iter().enumerate() {
        order.extend(names.iter().enumerate().map(|(at, (_, start))| (*start, list, at)));
    }
    order.sort_unstable();
    let mut seen = FxHashMap::default();
    let mut items = [Vec::new(), Vec::new(), Vec::new()];
    for (_, list, at) in order {
        items[list].push(path_name(names[list][at].0, &mut seen));
    }
    items
}
