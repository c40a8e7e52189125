//! Tables of a file: columns with types, rows of constants.
//!
//! A template with a port of the type `table` reads them. Its toolbox declares it once. The graph has
//! a copy for each table, with the columns of the table as output ports.

mod bound;

use std::sync::Arc;

use crate::check::formula::Scope;
use crate::check::meant::decimal_comma;
use crate::check::names::{DeclaredNames, Indices};
use crate::check::scope::FileScope;
use crate::check::types::Types;
use crate::check::{shadows, size};
use crate::gather::PlanFile;
use crate::index::Recorder;
use crate::rows::MAX_ROWS;
use crate::table::{Cell, Column, Table};
use crate::toolbox::{OutPort, Template, Toolbox};
use crate::types::{Type, is_built_in};
use afp_syntax::ast::{self, Item, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use afp_syntax::message;

pub(super) use bound::{fits, read_by};

pub(super) fn own(
    file: &PlanFile,
    types: &Types,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> Vec<Arc<Table>> {
    let items = file.tree.items();
    let mut names = other_names(&items);
    let indices = Indices::default();
    let scope = Scope {
        types,
        tables: &[],
        entries: &[],
        indices: &indices,
        readable: &|_| false,
        unreadable: "write a value: a table has only constants",
        text: &file.source.text,
        record,
    };
    let nodes = items.iter().filter_map(|item| match item {
        Item::Table(node) => Some(node),
        _ => None,
    });
    let tables = nodes.filter_map(|node| {
        let table = read(node, &scope, diags)?;
        let name = Name { text: table.name.clone(), span: table.span };
        if is_built_in(&name.text) {
            shadows(&name, diags);
            return None;
        }
        names.declare(&name, diags).then(|| Arc::new(table))
    });
    tables.collect()
}

pub(super) fn other_names(items: &[Item]) -> DeclaredNames {
    let mut names = DeclaredNames::default();
    for item in items {
        let other = match item {
            Item::Plan(node) => node.name(),
            Item::Enum(node) => node.name(),
            _ => None,
        };
        if let Some(name) = other {
            // Their errors are reported elsewhere.
            names.declare(&name, &mut Diagnostics::default());
        }
    }
    names
}

/// Reads a table; `None` without a name.
fn read(node: &ast::Table, scope: &Scope<'_>, diags: &mut Diagnostics) -> Option<Table> {
    let columns = columns(node, scope, diags);
    let written = node.rows();
    let spans = written.iter().map(ast::Row::span);
    size::at_most(MAX_ROWS, ("a table", "rows"), spans, "split it into two tables", diags);
    let rows = written.iter().filter_map(|row| self::row(row, node, &columns, scope, diags));
    let rows = rows.collect();
    let name = node.name()?;
    if !diags.error_within(node.span()) {
        if columns.is_empty() {
            let message = message!("the table '{}' has no columns", name.text);
            let help = "name at least one in its brackets, such as '(x: length)'";
            diags.push(Diagnostic::new(Code::E0250, name.span, message).help(help));
        } else if written.is_empty() {
            let message = message!("the table '{}' has no rows", name.text);
            let help = "write rows in its braces";
            diags.push(Diagnostic::new(Code::E0252, name.span, message).help(help));
        }
    }
    Some(Table { name: name.text, doc: node.doc(), columns, rows, span: name.span })
}

fn columns(node: &ast::Table, scope: &Scope<'_>, diags: &mut Diagnostics) -> Vec<Column> {
    let mut names = DeclaredNames::default();
    let mut found = Vec::new();
    for column in node.columns() {
        let ty = column.ty().and_then(|ty| {
            let resolved = scope.types.resolve(&ty, scope.record, diags)?;
            let Type::Object(object) = &resolved else { return Some(resolved) };
            let message = message!("a table holds no objects such as '{}'", object.name);
            let help = "only the templates of its toolbox make one: keep it in an entry";
            diags.push(Diagnostic::new(Code::E0250, ty.span(), message).help(help));
            None
        });
        let Some(name) = column.name() else { continue };
        names.declare(&name, diags);
        found.push(Column { name: name.text, doc: column.doc(), ty, span: name.span });
    }
    found
}

/// The values of a row; `None` if it has an error.
fn row(
    row: &ast::Row,
    table: &ast::Table,
    columns: &[Column],
    scope: &Scope<'_>,
    diags: &mut Diagnostics,
) -> Option<Vec<Cell>> {
    let cells = row.cells();
    // The unparsed part may be the values.
    let whole = diags.syntax_errors_within(table.span()).next().is_none();
    let misfits = whole && cells.len() != columns.len() && !columns.is_empty();
    let comma =
        decimal_comma(cells.iter().flatten()).filter(|_| misfits && cells.len() > columns.len());
    // Parts of decimal numbers do not determine other values.
    let known = if comma.is_some() { &[] } else { columns };
    if misfits {
        diags.push(misfit(row, &cells, columns, comma));
    }
    let types = known.iter().map(|column| column.ty.as_ref()).chain(std::iter::repeat(None));
    let values: Vec<_> = cells
        .iter()
        .zip(types)
        .map(|(formula, ty)| {
            let formula = formula.as_ref()?;
            let Some(ty) = ty else {
                scope.names_only(formula);
                return None;
            };
            let (_, value) = scope.check(formula, Some(ty), diags)?;
            Some(Cell { value: value?, span: formula.span() })
        })
        .collect();
    let values: Option<Vec<_>> = values.into_iter().collect();
    values.filter(|values| values.len() == columns.len())
}

/// A row with too many or too few values.
fn misfit(
    row: &ast::Row,
    cells: &[Option<ast::Formula>],
    columns: &[Column],
    comma: Option<Message>,
) -> Diagnostic {
    let count = |count: usize, what: &str| match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    };
    let message = message!(
        "the row has {}, the table {}",
        Words(count(cells.len(), "value")),
        Words(count(columns.len(), "column"))
    );
    let much = cells.get(columns.len()).and_then(Option::as_ref).map(ast::Formula::span);
    let help = match (much, columns.get(cells.len())) {
        (None, Some(column)) => message!("write a value for '{}', too", column.name),
        _ => message!("remove the extra values, or add a column{}", comma.unwrap_or_default()),
    };
    let error = Diagnostic::new(Code::E0251, much.unwrap_or_else(|| row.span()), message);
    match columns.last() {
        Some(last) => error.note(columns[0].span.to(last.span), "the columns").help(help),
        None => error.help(help),
    }
}

/// Adds to the toolboxes in use the template that reads each table.
pub(super) fn specialise(
    linked: &mut [Arc<Toolbox>],
    scopes: &[FileScope<'_>],
    diags: &mut Diagnostics,
) {
    let mut tables: Vec<&Arc<Table>> = Vec::new();
    for table in scopes.iter().flat_map(|scope| &scope.tables) {
        if !tables.iter().any(|known| Arc::ptr_eq(known, table)) {
            tables.push(table);
        }
    }
    let readers = |toolbox: &Toolbox| -> Vec<Template> {
        let open = toolbox.templates.iter().filter(|template| template.reads_table.is_some());
        open.flat_map(|open| tables.iter().map(|table| of_table(open, table))).collect()
    };
    for toolbox in linked {
        let open = toolbox.templates.iter().filter(|template| template.reads_table.is_some());
        for template in open {
            tables.iter().for_each(|table| columns_fit(template, table, diags));
        }
        let readers = readers(toolbox);
        if !readers.is_empty() {
            Arc::make_mut(toolbox).templates.extend(readers);
        }
    }
}

/// Reports columns that are called like an input.
fn columns_fit(template: &Template, table: &Table, diags: &mut Diagnostics) {
    let is_port = |column: &&Column| template.inputs.iter().any(|port| port.name == column.name);
    for column in table.columns.iter().filter(is_port) {
        let (name, reader) = (&column.name, &template.name);
        let message =
            message!("a column cannot be called '{}': '{}' has a port of that name", name, reader);
        let error = Diagnostic::new(Code::E0250, column.span, message);
        diags.push(error.help("give the column another name"));
    }
}

/// The template with the columns of a table as its outputs on its first state, without the port of the table.
fn of_table(template: &Template, table: &Arc<Table>) -> Template {
    let output = |column: &Column| OutPort {
        name: column.name.clone(),
        doc: column.doc.clone(),
        // An unknown type is unknown in the signature, too.
        ty: column.ty.clone().unwrap_or(Type::FLOAT),
        on: vec![0],
        span: column.span,
    };
    let mut own = template.clone();
    own.inputs
        .retain(|port| Some(&port.name) != template.reads_table.as_ref().map(|it| &it.port.name));
    own.outputs = table.columns.iter().map(output).collect();
    if let Some(reads) = &mut own.reads_table {
        reads.table = Some(table.clone());
    }
    own
}
