//! Names visible in each plan file: its toolboxes, its own plans, enums and tables, and those of
//! directly used files.

use std::sync::Arc;

use crate::check::imports;
use crate::check::names::DeclaredNames;
use crate::check::scope::FileScope;
use crate::check::signature::Signatures;
use crate::check::types::Types;
use crate::check::{
    PlanHead, Program, choices, computations, endings, entries, enums, recursion, shadows, tables,
};
use crate::files::relative;
use crate::gather::{PlanFile, Toolboxes};
use crate::index::Recorder;
use crate::toolbox::Toolbox;
use crate::types::{Enum, is_built_in};
use afp_syntax::ast::{Item, Name};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Span;
use rustc_hash::FxHashMap;

/// Reads the declarations of all files.
pub(super) fn program<'a>(
    files: &'a [PlanFile],
    toolboxes: &'a Toolboxes,
    record: &'a Recorder,
    diags: &mut Diagnostics,
) -> Program<'a> {
    let enums: Vec<_> = files.iter().map(|file| own_enums(file, diags)).collect();
    let mut linked = Vec::new();
    let places = files.iter().enumerate();
    let mut scopes: Vec<_> =
        places.map(|file| scope(file, toolboxes, &enums, &mut linked, record, diags)).collect();
    let hidden: Vec<_> = (0..files.len()).map(|place| hidden_enums(files, place, &enums)).collect();
    for (scope, hidden) in scopes.iter_mut().zip(hidden) {
        scope.types.hidden = hidden;
    }
    let own_tables = files.iter().zip(&scopes);
    let own_tables: Vec<_> =
        own_tables.map(|(file, scope)| tables::own(file, &scope.types, record, diags)).collect();
    let own_computations = files.iter().zip(&scopes);
    let own_computations: Vec<_> = own_computations
        .map(|(file, scope)| computations::own(file, &scope.types, &mut linked, record, diags))
        .collect();
    let mut plans = Vec::new();
    let mut own: Vec<FxHashMap<String, usize>> = Vec::new();
    for (index, file) in files.iter().enumerate() {
        let first = plans.len();
        plans.extend(heads(file, index, &scopes[index].types, record, diags));
        let mut names = FxHashMap::default();
        for (at, head) in plans.iter().enumerate().skip(first) {
            if let Some(name) = &head.name {
                names.entry(name.text.clone()).or_insert(at);
            }
        }
        own.push(names);
    }
    for (index, file) in files.iter().enumerate() {
        for seen in std::iter::once(&index).chain(&file.uses) {
            scopes[index].tables.extend(own_tables[*seen].iter().cloned());
            scopes[index].computations.extend(own_computations[*seen].clone());
            for (name, at) in &own[*seen] {
                scopes[index].plans.entry(name.clone()).or_default().push(*at);
            }
        }
    }
    choices::specialise(&mut linked, files, &scopes);
    tables::specialise(&mut linked, &scopes, diags);
    let signatures = Signatures::of(&linked, &plans);
    let sub_plans = plans.iter().map(|head| recursion::sub_plans(head, &scopes)).collect();
    Program { toolboxes, linked, files: scopes, plans, sub_plans, signatures, record }
}

/// A scope without plans. `enums` has those of all files.
fn scope<'a>(
    (place, file): (usize, &'a PlanFile),
    toolboxes: &Toolboxes,
    enums: &[Vec<Arc<Enum>>],
    linked: &mut Vec<Arc<Toolbox>>,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> FileScope<'a> {
    let (imports, failed) = imports::read(&file.tree, toolboxes, linked, record, diags);
    let mut types = Types { incomplete: failed || file.incomplete, ..Types::default() };
    let seen = std::iter::once(&place).chain(&file.uses).flat_map(|seen| &enums[*seen]);
    types.enums.extend(seen.map(|each| (None, each.clone())));
    for import in &imports {
        let qualifier = || Some(import.qualifier.clone());
        types.homes.push((import.qualifier.clone(), import.span));
        types.enums.extend(import.toolbox.enums.iter().map(|each| (qualifier(), each.clone())));
        types.objects.extend(import.toolbox.objects.iter().map(|each| (qualifier(), each.clone())));
    }
    FileScope {
        path: &file.path,
        text: &file.source.text,
        source: (file.index, &file.source),
        imports,
        computations: Vec::new(),
        types,
        tables: Vec::new(),
        incomplete: file.incomplete,
        plans: FxHashMap::default(),
        top: top(file),
    }
}

/// Enums of indirectly used files, each with the missing `use` line and its place.
fn hidden_enums(
    files: &[PlanFile],
    place: usize,
    enums: &[Vec<Arc<Enum>>],
) -> Vec<(String, String, Span)> {
    let file = &files[place];
    let others = files.iter().zip(enums).enumerate();
    let others = others.filter(|(other, _)| *other != place && !file.uses.contains(other));
    let mut found = Vec::new();
    for (_, (other, enums)) in others {
        let Some(path) = relative(&file.path, &other.path).filter(|_| !enums.is_empty()) else {
            continue;
        };
        let line = format!("use \"{path}\"");
        found.extend(enums.iter().map(|each| (each.name.clone(), line.clone(), top(file))));
    }
    found
}

fn own_enums(file: &PlanFile, diags: &mut Diagnostics) -> Vec<Arc<Enum>> {
    let mut found = Vec::new();
    let mut names = DeclaredNames::default();
    for item in file.tree.items() {
        let Item::Enum(node) = item else { continue };
        let Some(home) = enums::read(&node, None, diags) else { continue };
        let name = Name { text: home.name.clone(), span: home.span };
        if is_built_in(&name.text) {
            shadows(&name, diags);
        } else if names.declare(&name, diags) {
            found.push(home);
        }
    }
    found
}

/// The plans of a file, without their components.
fn heads(
    file: &PlanFile,
    index: usize,
    types: &Types,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> Vec<PlanHead> {
    let nodes = file.tree.items().into_iter().filter_map(|item| match item {
        Item::Plan(plan) => Some(plan),
        _ => None,
    });
    let heads: Vec<_> = nodes
        .map(|node| {
            let (entries, indices) = entries::read(&node, types, &file.source.text, record, diags);
            let interrupting = endings::interrupting(&node);
            PlanHead { name: node.name(), file: index, entries, indices, interrupting, node }
        })
        .collect();
    let mut names = DeclaredNames::default();
    for name in heads.iter().filter_map(|head| head.name.as_ref()) {
        names.declare(name, diags);
    }
    heads
}

/// The place after the language version.
fn top(file: &PlanFile) -> Span {
    let Some(version) = file.tree.version() else { return file.whole().before() };
    let text = &file.source.text;
    let line = text[version.span.end as usize..].find('\n').map_or(text.len() as u32, |length| {
        version.span.end + u32::try_from(length + 1).unwrap_or(0)
    });
    Span { start: line, end: line, ..version.span }
}
