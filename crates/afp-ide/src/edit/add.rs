//! Adding: `use` lines, plans, and the items of a plan.

use super::buffer::{self, Splice, TextBuffer};
use super::list::{Page, Place};
use super::name;
use super::tree::{self, Scope, children, name_of};
use super::{Change, Item, Refused, TextEdit, braces, entry, fragment};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// Adds a `use` line after the others: for a toolbox, or for a plan file with its path in quotes.
pub(super) fn line_of_use(
    buffer: &mut TextBuffer,
    toolbox: &str,
    alias: Option<&str>,
) -> Result<(), Refused> {
    match path_in_quotes(toolbox) {
        Some(_) if alias.is_some() => {
            return Err(Refused::new(format!("{toolbox} is a file, which has no short name")));
        }
        Some(path) if !path.ends_with(".afp") => {
            return Err(Refused::new(format!(
                "{toolbox} is not a plan file: use a file that ends in '.afp'"
            )));
        }
        Some(_) => {}
        None => name::check(toolbox)?,
    }
    alias.map_or(Ok(()), name::check)?;
    let alias = alias.map(|alias| format!(" as {alias}")).unwrap_or_default();
    line(buffer, &format!("use {toolbox}{alias}"))
}

/// The contents of a text that is one string literal.
fn path_in_quotes(text: &str) -> Option<&str> {
    let path = text.strip_prefix('"')?.strip_suffix('"')?;
    (!path.contains(['"', '\\', '\n', '\r'])).then_some(path)
}

/// Returns the edit that imports a toolbox into a file; `None` if it is imported.
pub(crate) fn edit_of_use(text: &str, root: &Node, file: u16, toolbox: &str) -> Option<TextEdit> {
    let page = Page { text, root: root.clone() };
    let (range, text) = splice_of_line(&page, &format!("use {toolbox}")).ok()??;
    Some(TextEdit { span: buffer::span(file, range), text })
}

/// Adds a `use` line after the others, if it is missing.
pub(super) fn line(buffer: &mut TextBuffer, line: &str) -> Result<(), Refused> {
    let page = Page { text: buffer.text(), root: buffer.root() };
    if let Some(splice) = splice_of_line(&page, line)? {
        buffer.splice(vec![splice]);
    }
    Ok(())
}

/// The splice that adds a `use` line after the others; `None` if it exists.
pub(super) fn splice_of_line(page: &Page<'_>, line: &str) -> Result<Option<Splice>, Refused> {
    let root = &page.root;
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let same = |node: &Node| {
        let range = tree::solid_range(node).unwrap_or_default();
        words(page.text[range].trim_end_matches(',')) == words(line)
    };
    if children(root, Kind::Use).any(|node| same(&node)) {
        return Ok(None);
    }
    let last = children(root, Kind::Use).last().or_else(|| children(root, Kind::Version).next());
    let first = root.children().next();
    let (place, apart) = match (last, first) {
        (Some(last), _) => (Place::After(last), false),
        (None, Some(first)) => (Place::Before(first), true),
        (None, None) => (Place::Top, true),
    };
    page.insert_lines(root, place, line, apart).map(Some)
}

/// Adds plans after the last one; only computations, before the first plan.
pub(super) fn plans(buffer: &mut TextBuffer, text: &str) -> Result<(), Refused> {
    let (lines, nodes) = fragment::plans(text)?;
    let root = buffer.root();
    let scope = Scope::File(root.clone());
    new_names(&nodes, &scope)?;
    if let Some(first) = children(&root, Kind::Plan).next()
        && nodes.iter().all(|node| node.kind() == Kind::Template)
    {
        let page = Page { text: buffer.text(), root: root.clone() };
        let splice = page.insert_lines(&root, Place::Before(first), &lines, true)?;
        buffer.splice(vec![splice]);
        return Ok(());
    }
    let last = children(&root, Kind::Plan).last();
    below_plan(buffer, last.or_else(|| root.children().last()), &lines)
}

/// Adds a plan after an item of the file, or at the top.
pub(super) fn below_plan(
    buffer: &mut TextBuffer,
    item: Option<Node>,
    lines: &str,
) -> Result<(), Refused> {
    let root = buffer.root();
    let page = Page { text: buffer.text(), root: root.clone() };
    let place = item.map_or(Place::Top, Place::After);
    let splice = page.insert_lines(&root, place, lines, true)?;
    buffer.splice(vec![splice]);
    Ok(())
}

/// Converts the addition of an item from its parts to that of its text; keeps other changes.
pub(super) fn from_parts(change: Change) -> Result<Change, Refused> {
    let (plan, owner, text) = match change {
        Change::AddEntry { plan, keyword, name, ty, value } => {
            (plan, None, entry::text(&keyword, &name, ty.as_deref(), value.as_deref())?)
        }
        Change::AddComponent { plan, owner, keyword, name, template } => {
            name::check_element(&name)?;
            fragment::reference(&template)?;
            if !matches!(&*keyword, "actor" | "computation" | "subplan" | "supervise") {
                return Err(Refused::new(format!("there is no kind of component '{keyword}'")));
            }
            (plan, owner, format!("{keyword} {name}: {} {{}}", template.trim()))
        }
        other => return Ok(other),
    };
    Ok(Change::Add { plan, owner, text, before: None })
}

/// Adds items to a plan or supervisors to an element.
pub(super) fn items(
    buffer: &mut TextBuffer,
    plan: &str,
    owner: Option<&str>,
    text: &str,
    before: Option<&str>,
) -> Result<(), Refused> {
    let root = buffer.root();
    let (lines, nodes) = fragment::items(text, owner.is_some())?;
    let (mut list, scope) = match owner {
        None => {
            let list = tree::plan(&root, plan)?;
            (list.clone(), Scope::Plan(list))
        }
        Some(owner) => {
            let list = tree::element(&root, plan, owner)?;
            can_be_supervised(&list)?;
            (list.clone(), Scope::Element(list))
        }
    };
    new_names(&nodes, &scope)?;
    if let Some(owner) = owner {
        braces::with_braces(buffer, &Item::inner(plan, owner))?;
        list = tree::element(&buffer.root(), plan, owner)?;
    }
    place(buffer, &list, &lines, nodes[0].kind(), before)
}

pub(super) fn can_be_supervised(element: &Node) -> Result<(), Refused> {
    match tree::keyword(element) {
        Some(keyword) if keyword.text() == "computation" => {
            let name = name_of(element).unwrap_or_default();
            Err(Refused::new(format!("'{name}' is a computation, which has no supervisors")))
        }
        _ => Ok(()),
    }
}

/// Checks that the names of new items are valid, free and different.
fn new_names(nodes: &[Node], scope: &Scope) -> Result<(), Refused> {
    let mut seen: Vec<String> = Vec::new();
    for node in nodes {
        let new = name_of(node).unwrap_or_default();
        match node.kind() {
            Kind::Element => name::check_element(&new)?,
            _ => name::check(&new)?,
        }
        name::check_free(scope, &new, None)?;
        if name::fresh(&new, &seen) != new {
            return Err(Refused::new(format!("'{new}' is given twice")));
        }
        seen.push(new);
    }
    Ok(())
}

/// Adds lines to a plan or element: before the item `before`, or else after the last item of their
/// kind.
pub(super) fn place(
    buffer: &mut TextBuffer,
    list: &Node,
    lines: &str,
    kind: Kind,
    before: Option<&str>,
) -> Result<(), Refused> {
    let page = Page { text: buffer.text(), root: buffer.root() };
    let neighbour = match before {
        Some(before) => Place::Before(sibling(list, before)?),
        None => usual_place(list, kind),
    };
    let tall = lines.contains('\n');
    let apart = match &neighbour {
        Place::Top => {
            let next = list.children().next();
            list.kind() == Kind::Plan && next.is_some_and(|next| tall || next.kind() != kind)
        }
        Place::Before(item) | Place::After(item) => {
            list.kind() == Kind::Plan
                && (item.kind() != kind || (kind != Kind::Entry && (tall || is_tall(item))))
        }
    };
    let splice = page.insert_lines(list, neighbour, lines, apart)?;
    buffer.splice(vec![splice]);
    Ok(())
}

/// Finds an item of a list by name.
pub(super) fn sibling(list: &Node, name: &str) -> Result<Node, Refused> {
    let found = match list.kind() {
        Kind::Plan => tree::inner(list, name),
        Kind::File => children(list, Kind::Plan).find(|plan| tree::is_named(plan, name)),
        _ => children(list, Kind::Guard).find(|guard| tree::is_named(guard, name)),
    };
    found.ok_or_else(|| Refused::new(format!("there is no '{name}' to insert before")))
}

/// The place after the last item of the kind, or else after the kinds that usually precede it.
fn usual_place(list: &Node, kind: Kind) -> Place {
    let above: &[Kind] = match (list.kind(), kind) {
        (Kind::Plan, Kind::Entry) => &[Kind::Entry],
        (Kind::Plan, Kind::Start) => &[Kind::Entry],
        (Kind::Plan, Kind::Guard) => &[Kind::Guard, Kind::Start, Kind::Entry],
        (Kind::Plan, _) => &[Kind::Element, Kind::Guard, Kind::Start, Kind::Entry],
        _ => &[Kind::Guard],
    };
    let last = above.iter().find_map(|kind| children(list, *kind).last());
    last.map_or(Place::Top, Place::After)
}

fn is_tall(item: &Node) -> bool {
    tree::solid_range(item).is_some_and(|_| item.text().to_string().trim().contains('\n'))
}
