//! The `use` lines of a file, and the order of its items.

use std::sync::Arc;

use crate::check::names::unknown;
use crate::gather::Toolboxes;
use crate::graph::ToolboxId;
use crate::index::Recorder;
use crate::toolbox::Toolbox;
use afp_syntax::ast::{File, Item, Name, Use};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Sought, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

#[derive(Clone)]
pub(crate) struct Import {
    pub qualifier: String,
    /// Declaration of the qualifier: after `as`, or in the toolbox.
    pub span: Span,
    pub toolbox: Arc<Toolbox>,
    /// Its index among the compilation's toolboxes.
    pub id: ToolboxId,
}

/// Resolves the `use` lines for toolboxes; returns whether one failed. New toolboxes are added to
/// `linked`.
pub(crate) fn read(
    file: &File,
    toolboxes: &Toolboxes,
    linked: &mut Vec<Arc<Toolbox>>,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> (Vec<Import>, bool) {
    let mut failed = false;
    let mut imports: Vec<(Import, Span)> = Vec::new();
    let uses = file.items().into_iter().filter_map(|item| match item {
        Item::Use(line) => line.toolbox().map(|name| (line, name)),
        _ => None,
    });
    for (line, name) in uses {
        let Some(import) = one(&line, name, toolboxes, linked, record, diags) else {
            failed = true;
            continue;
        };
        let span = line.span();
        if let Some(name) = line.toolbox() {
            devices_of_two(&name, &import.toolbox, (toolboxes, linked), diags);
        }
        if let Some((_, first)) =
            imports.iter().find(|(known, _)| known.qualifier == import.qualifier)
        {
            let message = message!("two toolboxes are used as '{}'", import.qualifier);
            let message =
                if imports.iter().any(|(known, _)| Arc::ptr_eq(&known.toolbox, &import.toolbox)) {
                    message!("'{}' is used twice", import.qualifier)
                } else {
                    message
                };
            diags.push(
                Diagnostic::new(Code::E0212, span, message)
                    .note(*first, "first used here")
                    .help("remove one of the lines, or give one a short name with 'as'"),
            );
            continue;
        }
        imports.push((import, span));
    }
    (imports.into_iter().map(|(import, _)| import).collect(), failed)
}

/// Reports devices that an earlier toolbox also declares. The robot's own toolbox is exempt, since
/// it may have devices of another toolbox for that toolbox's templates.
fn devices_of_two(
    name: &Name,
    toolbox: &Arc<Toolbox>,
    (toolboxes, linked): (&Toolboxes, &[Arc<Toolbox>]),
    diags: &mut Diagnostics,
) {
    let robot = toolboxes.said_robot();
    let of_robot =
        |name: &str| robot.is_some_and(|robot| robot.devices.iter().any(|own| own.name == name));
    let before = linked.iter().take_while(|known| !Arc::ptr_eq(known, toolbox));
    let mut devices = before.flat_map(|it| it.devices.iter().map(move |device| (it, device)));
    let both = devices.find_map(|(other, device)| {
        let own = toolbox.devices.iter().find(|own| own.name == device.name)?;
        if of_robot(&own.name) {
            return None;
        }
        Some((&other.name, device, own))
    });
    let Some((other, device, own)) = both else { return };
    let message =
        message!("'{}' and '{}' both declare the device '{}'", other, toolbox.name, own.name);
    diags.push(
        Diagnostic::new(Code::E0517, name.span, message)
            .note(device.span, "one declaration")
            .note(own.span, "the other declaration")
            .help("use one of the toolboxes, or give the device another name in one of them"),
    );
}

fn one(
    line: &Use,
    name: Name,
    toolboxes: &Toolboxes,
    linked: &mut Vec<Arc<Toolbox>>,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> Option<Import> {
    let Some(toolbox) = toolboxes.get(&name.text) else {
        match toolboxes.broken(&name.text) {
            Some(definition) => record.definition(name.span, definition),
            None => record.unknown(name.span),
        }
        // A toolbox with errors has been reported.
        if toolboxes.broken(&name.text).is_none() {
            let known: Vec<_> = toolboxes.iter().map(|toolbox| toolbox.name.as_str()).collect();
            let message = message!("there is no toolbox '{}'", name.text);
            let none = "remove the line";
            let error = unknown(Code::E0238, name.span, message, &name.text, known, none);
            diags.push(error.unknown(Sought::Toolbox, &name.text));
        }
        return None;
    };
    record.definition(name.span, toolbox.span);
    let alias = line.alias().unwrap_or(Name { text: name.text, span: toolbox.span });
    let known = linked.iter().position(|known| Arc::ptr_eq(known, toolbox));
    let index = known.unwrap_or(linked.len());
    if known.is_none() {
        linked.push(toolbox.clone());
    }
    Some(Import {
        qualifier: alias.text,
        span: alias.span,
        toolbox: toolbox.clone(),
        id: ToolboxId(u16::try_from(index).ok()?),
    })
}

/// Reports misplaced items: `use` after other items, plans in a toolbox.
pub(crate) fn check_order(file: &File, diags: &mut Diagnostics) {
    let items = file.items();
    let toolbox = items.iter().find_map(|item| match item {
        Item::Toolbox(head) => Some(head.span()),
        _ => None,
    });
    let mut others = false;
    for item in &items {
        let (span, what) = match item {
            Item::Use(line) => {
                // A `use` in a plan has been reported.
                if others && line.is_in_place() {
                    diags.push(
                        Diagnostic::new(
                            Code::E0114,
                            line.span(),
                            "a 'use' comes after other items",
                        )
                        .help("move it to the top of the file"),
                    );
                }
                continue;
            }
            Item::Plan(plan) => {
                (plan.name().map_or_else(|| plan.span(), |name| name.span), "a plan")
            }
            Item::Table(table) => {
                (table.name().map_or_else(|| table.span(), |name| name.span), "a table")
            }
            Item::Scenario(one) => {
                (one.name().map_or_else(|| one.span(), |name| name.span), "a scenario")
            }
            _ => {
                others = true;
                continue;
            }
        };
        others = true;
        if let Some(head) = toolbox {
            diags.push(
                Diagnostic::new(
                    Code::E0114,
                    span,
                    message!("{} is not allowed in a toolbox", Words(&what)),
                )
                .note(head, "this makes the file a toolbox")
                .help("move it to a separate file"),
            );
        }
    }
}

/// Reports templates, object types and devices in a plan file.
pub(crate) fn check_no_templates(file: &File, diags: &mut Diagnostics) {
    let items = file.items();
    if items.iter().any(|item| matches!(item, Item::Toolbox(_))) {
        return;
    }
    for item in &items {
        let name = match item {
            Item::Template(template) if template.is_declared() => None,
            Item::Template(template) => template.name(),
            Item::Object(object) => object.name(),
            Item::Device(device) => device.name().or_else(|| device.keyword()),
            _ => None,
        };
        if let Some(name) = name {
            let message = message!("'{}' is declared outside of a toolbox", name.text);
            diags.push(
                Diagnostic::new(Code::E0114, name.span, message)
                    .help("move it to a file that begins with 'toolbox' and a name"),
            );
        }
    }
}

/// Reports an unknown language version.
pub(crate) fn check_version(file: &File, diags: &mut Diagnostics) {
    if let Some(version) = file.version().filter(|version| version.text != "1") {
        let message = message!("version {} of the language is not known", Words(version.text));
        diags.push(
            Diagnostic::new(Code::E0505, version.span, message)
                .help("write 'afp 1', or use a newer compiler")
                .replace("1"),
        );
    }
}
