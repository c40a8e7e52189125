//! Reads a toolbox file and checks its declarations.

mod cases;
mod condition;
mod device;
mod facts;
mod ports;
mod template;

use std::sync::Arc;

use crate::check::names::DeclaredNames;
use crate::check::types::Types;
use crate::check::{enums, imports, shadows, size};
use crate::gather::{ToolboxFile, Toolboxes};
use crate::index::{self, Meanings, Recorder};
use crate::rows::MAX_ROWS;
use crate::toolbox::{Device, Template, Toolbox};
use crate::types::{Object, is_built_in};
use afp_syntax::ast::{self, File, Item, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::parse;
use afp_syntax::source::{Source, Span};
use afp_syntax::unquote;

use device::Devices;
use ports::Site;

impl Toolbox {
    /// Reads a toolbox file. `file` is the index for its spans, `rust_path` the path of the crate
    /// that implements the toolbox.
    ///
    /// Returns `None` if there are errors; all of them are reported.
    pub fn parse(source: &Source, file: u16, rust_path: &str) -> (Option<Toolbox>, Diagnostics) {
        let read = read_file(source, file, rust_path);
        (read.toolbox, read.diags)
    }

    /// Like [`Toolbox::parse`], but returns the readable parts of a toolbox with errors, so that
    /// its templates are not reported as missing.
    pub fn parse_broken(
        source: &Source,
        file: u16,
        rust_path: &str,
    ) -> (Option<Toolbox>, Diagnostics) {
        let mut diags = Diagnostics::default();
        let tree = parse(&source.text, file, &mut diags).file();
        let read = read(&tree, source, file, rust_path, &Recorder::default(), &mut diags);
        diags.sort();
        (read, diags)
    }
}

impl Toolboxes {
    /// Reads a toolbox file and adds it. `rust_path` is the path of the crate that implements it.
    /// Returns the name in the file, if there is one.
    ///
    /// Its diagnostics are in [`Toolboxes::diagnostics`]. It replaces an earlier toolbox of the
    /// same name.
    pub fn add(&mut self, source: Source, rust_path: &str) -> Option<String> {
        let source = Arc::new(source);
        let file = self.add_source(source.clone())?;
        let read = read_file(&source, file, rust_path);
        let name = read.name.as_ref().map(|name| name.text.clone());
        self.add_read(read);
        name
    }
}

/// Reads toolbox files, each given as the name of its file, its text, and the path of the crate that
/// implements it, as `afp_toolboxes::sources()` gives them.
impl<'a> FromIterator<(&'a str, &'a str, &'a str)> for Toolboxes {
    fn from_iter<I: IntoIterator<Item = (&'a str, &'a str, &'a str)>>(files: I) -> Toolboxes {
        let mut toolboxes = Toolboxes::default();
        for (name, text, rust_path) in files {
            toolboxes.add(Source::new(name, text), rust_path);
        }
        toolboxes
    }
}

/// Reads a toolbox file; for parameters see [`Toolbox::parse`].
fn read_file(source: &Source, file: u16, rust_path: &str) -> ToolboxFile {
    let mut diags = Diagnostics::default();
    let tree = parse(&source.text, file, &mut diags).file();
    let record = Recorder::default();
    let toolbox = read(&tree, source, file, rust_path, &record, &mut diags);
    diags.sort();
    let mut meanings = Meanings::new(record.take());
    index::unread(tree.root(), file, &mut meanings);
    let items = tree.items();
    let name = items.iter().find_map(|item| match item {
        Item::Toolbox(head) => head.name(),
        _ => None,
    });
    ToolboxFile {
        toolbox: toolbox.filter(|_| !diags.has_errors()),
        name,
        diags,
        declared: index::of_toolbox(&items, &meanings),
        meanings,
    }
}

/// Reads a computation declared in a plan file.
pub(crate) fn computation(
    node: &ast::Template,
    (types, source): (&Types, &str),
    record: &Recorder,
    diags: &mut Diagnostics,
) -> Option<Template> {
    template::read(node, &Site { types, source, record, devices: &[] }, diags)
}

/// Resolves names of declarations that only toolboxes may have, in a file that is not a toolbox.
pub(crate) fn names_only(tree: &File, source: &Source, file: u16, record: &Recorder) {
    read(tree, source, file, "", record, &mut Diagnostics::default());
}

fn read(
    tree: &File,
    source: &Source,
    file: u16,
    rust_path: &str,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> Option<Toolbox> {
    imports::check_version(tree, diags);
    imports::check_order(tree, diags);
    let items = tree.items();
    let head = head(&items, file, diags);
    no_uses(&items, diags);
    let name = head.and_then(|head| head.name());
    if let Some(name) = &name {
        DeclaredNames::default().declare(name, diags);
    }
    let version = head.and_then(|head| head.version());
    let mut toolbox = Toolbox {
        version: version.map(|version| unquote(&version, diags)).unwrap_or_default(),
        doc: head.map(|head| head.doc()).unwrap_or_default(),
        rust_path: rust_path.to_owned(),
        span: name.as_ref().map(|name| name.span).unwrap_or_default(),
        name: name.as_ref().map(|name| name.text.clone()).unwrap_or_default(),
        ..Toolbox::default()
    };
    let types = declare(&items, &mut toolbox, diags);
    let site = Site { types: &types, source: &source.text, record, devices: &[] };
    toolbox.devices = devices(&items, &site, diags);
    let site = Site { devices: &toolbox.devices, ..site };
    toolbox.templates = templates(&items, &site, diags);
    let spans = toolbox.templates.iter().map(|template| template.span);
    size::at_most(
        MAX_ROWS,
        ("a toolbox", "templates"),
        spans,
        "split it into two toolboxes",
        diags,
    );
    name.map(|_| toolbox)
}

/// The line that names the toolbox of a file.
fn head<'i>(items: &'i [Item], file: u16, diags: &mut Diagnostics) -> Option<&'i ast::Toolbox> {
    let mut heads = items.iter().filter_map(|item| match item {
        Item::Toolbox(head) => Some(head),
        _ => None,
    });
    let Some(first) = heads.next() else {
        let start = Span { file, start: 0, end: 0 };
        diags.push(
            Diagnostic::new(Code::E0114, start, "the file does not name its toolbox")
                .help("write 'toolbox' and a name above the templates"),
        );
        return None;
    };
    for other in heads {
        diags.push(
            Diagnostic::new(Code::E0212, other.span(), "a file has only one toolbox")
                .note(first.span(), "the first one")
                .help("move it to a separate file"),
        );
    }
    Some(first)
}

fn no_uses(items: &[Item], diags: &mut Diagnostics) {
    for item in items {
        if let Item::Use(line) = item {
            diags.push(
                Diagnostic::new(Code::E0114, line.span(), "a toolbox cannot use other files")
                    .help("declare the types that it needs in this file"),
            );
        }
    }
}

/// Enums, object types and the names of all declarations of the toolbox.
fn declare(items: &[Item], toolbox: &mut Toolbox, diags: &mut Diagnostics) -> Types {
    let mut types = Types { generic: true, ..Types::default() };
    let mut names = DeclaredNames::default();
    let mut is_new = |name: &Name, is_type: bool, diags: &mut Diagnostics| {
        if is_type && is_built_in(&name.text) {
            shadows(name, diags);
            return false;
        }
        names.declare(name, diags)
    };
    for item in items {
        match item {
            Item::Enum(node) => {
                let Some(home) = enums::read(node, Some(&toolbox.name), diags) else { continue };
                let name = Name { text: home.name.clone(), span: home.span };
                if is_new(&name, true, diags) {
                    types.enums.push((None, home.clone()));
                    toolbox.enums.push(home);
                }
            }
            Item::Object(node) => {
                let Some(name) = node.name() else { continue };
                if is_new(&name, true, diags) {
                    let object = Arc::new(Object {
                        doc: node.doc(),
                        toolbox: toolbox.name.clone(),
                        span: name.span,
                        name: name.text,
                    });
                    types.objects.push((None, object.clone()));
                    toolbox.objects.push(object);
                }
            }
            Item::Template(node) => {
                if let Some(name) = node.name() {
                    is_new(&name, false, diags);
                }
            }
            _ => {}
        }
    }
    types
}

fn devices(items: &[Item], site: &Site<'_>, diags: &mut Diagnostics) -> Vec<Device> {
    let mut devices = Devices::default();
    for item in items {
        if let Item::Device(node) = item {
            devices.read(node, site, diags);
        }
    }
    let all = || devices.all.iter();
    let controls = all().flat_map(|it| it.controls.iter().map(|row| row.span));
    let faults = all().flat_map(|it| it.faults.iter().map(|row| row.span.unwrap_or(it.span)));
    let signals = all().flat_map(|it| it.signals.iter().map(|row| row.span));
    let mut at_most = |what, spans: &mut dyn Iterator<Item = Span>| {
        let help = "declare fewer of them";
        size::at_most(MAX_ROWS, ("a toolbox", what), spans, help, diags);
    };
    at_most("devices", &mut all().map(|it| it.span));
    at_most("controls", &mut controls.into_iter());
    at_most("faults", &mut faults.into_iter());
    at_most("signals", &mut signals.into_iter());
    devices.all
}

fn templates(items: &[Item], site: &Site<'_>, diags: &mut Diagnostics) -> Vec<Template> {
    let nodes = items.iter().filter_map(|item| match item {
        Item::Template(node) => Some(node),
        _ => None,
    });
    nodes.filter_map(|node| template::read(node, site, diags)).collect()
}
