//! Reads the outline from the trees, with what the check has found out about names and types.

use super::read::Reader;
use super::{
    Column, Component, Destination, ElementId, Entry, EntryId, Enum, File, Findings, Outline, Plan,
    PlanId, Scenario, Start, Table, Target, Use, Value,
};
use crate::check::{Member, Members, PlanHead, Program};
use crate::gather::PlanFile;
use crate::graph::EntryKind;
use crate::index::{Found, Lookup, Meanings, Word};
use afp_syntax::ast::{self, Name};
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use rustc_hash::FxHashMap;

/// What the outline is made of.
pub(crate) struct Material<'a> {
    /// Everything that was read.
    pub program: &'a Program<'a>,
    /// The files.
    pub files: &'a [PlanFile],
    /// The components of each plan.
    pub members: Vec<Members>,
    /// What names mean.
    pub meanings: &'a Meanings,
    /// The plan that was asked for.
    pub main: Option<usize>,
}

/// Reads the outline of all files.
pub(crate) fn build(mut material: Material<'_>) -> Outline {
    let mut members = std::mem::take(&mut material.members).into_iter();
    let material = &material;
    let heads = material.program.plans.iter();
    let names = heads.enumerate().filter_map(|(at, head)| Some((head.name.as_ref()?.span, at)));
    let names: FxHashMap<Span, usize> = names.collect();
    let mut outline = Outline { main: material.main.map(PlanId::new), ..Outline::default() };
    for (at, file) in material.files.iter().enumerate() {
        outline.files.push(self::file(material, at, file, &names));
        let heads = || material.program.plans.iter().filter(|head| head.file == at);
        let items = numbered(heads().map(|head| head.name.as_ref()));
        // Plans stand file by file.
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
    let (entries, guards, elements) = (node.entries(), node.guards(), node.elements());
    let mut entry_names: Vec<_> = entries.iter().map(ast::Entry::name).collect();
    let names = [
        Vec::from_iter(entries.iter().zip(&entry_names).map(|(e, n)| (n.as_ref(), e.span().start))),
        named(&guards, &members.globals, |guard| guard.span().start),
        named(&elements, &members.elements, |element| element.span().start),
    ];
    let [entry_items, guard_items, element_items] = inner_items(&names);
    let places = Places {
        text: &material.files[head.file].source.text,
        meanings: material.meanings.lookup(),
        elements: spans(members.elements.iter().map(|member| member.name.as_ref())),
        entries: spans(entry_names.iter().map(Option::as_ref)),
    };
    let reader = Reader { places: &places, plan: &item };
    let entries = entries.iter().zip(entry_names.drain(..)).zip(entry_items);
    let guards = guards.iter().zip(members.globals).zip(guard_items);
    let elements = elements.iter().zip(members.elements).zip(element_items);
    Plan {
        entries: entries
            .map(|((node, name), own)| entry(head, &places, node, name, Item::inner(&item, own)))
            .collect(),
        starts: node.starts().iter().map(|start| places.start(start)).collect(),
        supervisors: guards
            .map(|((node, member), own)| reader.guard(node, member, Item::inner(&item, own)))
            .collect(),
        elements: elements
            .map(|((node, mut member), own)| {
                let supervisors = locals(&reader, node, std::mem::take(&mut member.locals), &own);
                let tables = std::mem::take(&mut member.reactions);
                let reactions = reactions(&reader, node, tables, &own);
                let element = reader.element(node, member, Item::inner(&item, own));
                Component { supervisors, reactions, ..element }
            })
            .collect(),
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

/// The supervisors of an element.
fn locals(
    reader: &Reader<'_>,
    node: &ast::Element,
    members: Vec<Member>,
    owner: &str,
) -> Vec<Component> {
    if members.is_empty() {
        return Vec::new();
    }
    let items: Vec<_> = numbered(members.iter().map(|member| member.name.as_ref())).collect();
    let guards = node.guards();
    let guards = guards.iter().zip(members).zip(items);
    let read = guards.map(|((node, member), own)| {
        reader.guard(node, member, Item::local(reader.plan, owner, own))
    });
    read.collect()
}

/// The reactions of an element.
fn reactions(
    reader: &Reader<'_>,
    node: &ast::Element,
    members: Vec<Member>,
    owner: &str,
) -> Vec<Component> {
    if members.is_empty() {
        return Vec::new();
    }
    let items: Vec<_> = numbered(members.iter().map(|member| member.name.as_ref())).collect();
    let nodes = node.reactions();
    let nodes = nodes.iter().zip(members).zip(items);
    let read = nodes.map(|((node, member), own)| {
        reader.reactions(node, member, Item::reactions(reader.plan, owner, &own))
    });
    read.collect()
}

/// The names of members, each with where it begins.
fn named<'m, N>(
    nodes: &[N],
    members: &'m [Member],
    start: impl Fn(&N) -> u32,
) -> Vec<(Option<&'m Name>, u32)> {
    let members = nodes.iter().zip(members);
    members.map(|(node, member)| (member.name.as_ref(), start(node))).collect()
}

fn entry(
    head: &PlanHead,
    places: &Places<'_>,
    node: &ast::Entry,
    name: Option<Name>,
    item: Item,
) -> Entry {
    let draft = name.as_ref().and_then(|name| {
        let place = head.entries.binary_search_by_key(&name.span, |draft| draft.name.span).ok()?;
        head.entries.get(place)
    });
    let written_type = node.ty().map(|ty| {
        let span = ty.span();
        Name { text: places.in_one_line(span).unwrap_or_else(|| ty.in_one_line()), span }
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

/// What names mean inside of one plan.
pub(super) struct Places<'a> {
    /// The text of the file.
    text: &'a str,
    pub meanings: Lookup<'a>,
    /// The names of elements, in order, with their places.
    elements: Vec<(Span, usize)>,
    /// The names of entries, in order, with their places.
    entries: Vec<(Span, usize)>,
}

impl Places<'_> {
    /// Where a name of an edge or `start` leads.
    pub fn target(&self, name: Name) -> Target {
        let to = match self.meanings.get(name.span) {
            Some(Found::Word(Word::Terminate)) => Destination::Terminate,
            Some(Found::Word(Word::Fail)) => Destination::Fail,
            Some(Found::Word(Word::Ignore)) => Destination::Ignore,
            Some(Found::Word(Word::Resume)) => Destination::Resume,
            Some(Found::Definition(span)) => find(&self.elements, span)
                .map_or(Destination::Unknown, |place| Destination::Element(ElementId::new(place))),
            _ => Destination::Unknown,
        };
        Target { text: name.text, span: name.span, to }
    }

    /// The entry that a name means.
    pub fn entry(&self, name: Span) -> Option<EntryId> {
        match self.meanings.get(name)? {
            Found::Definition(span) => find(&self.entries, span).map(EntryId::new),
            _ => None,
        }
    }

    /// A formula.
    pub fn value(&self, formula: &ast::Formula) -> Value {
        let span = formula.span();
        let text = self.in_one_line(span).unwrap_or_else(|| formula.in_one_line());
        let entry = if formula.is_name() { self.entry(span) } else { None };
        Value { text, span, entry }
    }

    /// The text at a place, where it stands in one line without comments and spare blanks.
    pub fn in_one_line(&self, span: Span) -> Option<String> {
        let text = self.text.get(span.start as usize..span.end as usize)?;
        let mut before = b'\0';
        let fits = text.bytes().all(|byte| {
            let two = [std::mem::replace(&mut before, byte), byte];
            !matches!(byte, b'\n' | b'\r' | b'\t') && !matches!(&two, b"  " | b"//" | b"/*")
        });
        fits.then(|| text.to_owned())
    }

    fn start(&self, start: &ast::Start) -> Start {
        let target = start.target().map(|target| self.target(target));
        Start { span: start.span(), target, findings: Findings::default() }
    }
}

fn spans<'n>(names: impl Iterator<Item = Option<&'n Name>>) -> Vec<(Span, usize)> {
    names.enumerate().filter_map(|(place, name)| Some((name?.span, place))).collect()
}

fn find(known: &[(Span, usize)], span: Span) -> Option<usize> {
    let place = known.binary_search_by_key(&span, |(known, _)| *known).ok()?;
    Some(known[place].1)
}

/// The names of items of one scope in their paths: the second of a name has `#2` behind it.
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

/// The names of entries, global supervisors and elements, which share one scope, in their paths.
/// Each comes with where it begins.
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
