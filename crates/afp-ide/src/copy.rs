//! Items as text for another place, with the `use` lines that they need.

use std::collections::BTreeSet;

use crate::View;
use crate::edit::with_comments;
use afp_dsl::outline::{Destination, Use};
use afp_syntax::item::Item;

/// Returns items of one plan with their comments, in source order and with the blank lines between
/// them.
///
/// The `use` lines of their templates come first, then `start NAME` if the plan starts at one of
/// the items. An item inside of another one comes with it. Unknown items are left out.
pub fn copied(view: &View, items: &[Item]) -> String {
    let is_apart = |item: &&Item| !items.iter().any(|other| other != *item && item.lies_in(other));
    let spans = items.iter().filter(is_apart);
    let mut spans: Vec<_> =
        spans.filter_map(|item| with_comments(view.file, view.text(), item)).collect();
    spans.sort_by_key(|span| span.start);
    let mut text = uses(view, items);
    text.extend(start(view, items).map(|name| format!("start {name}\n")));
    let mut end = None;
    for span in spans {
        let range = span.start as usize..span.end as usize;
        let gap = end.and_then(|end| view.text().get(end..range.start)).unwrap_or_default();
        if gap.matches('\n').count() > 1 {
            text.push('\n');
        }
        text += view.text().get(range.clone()).unwrap_or_default();
        text.push('\n');
        end = Some(range.end);
    }
    text
}

/// The `use` lines of the toolboxes of the items' templates, as written.
fn uses(view: &View, items: &[Item]) -> String {
    let is_copied = |item: &Item| items.iter().any(|copied| item.lies_in(copied));
    let components = view.plans().flat_map(|plan| plan.components());
    let components = components.filter(|component| is_copied(&component.item));
    let toolboxes: BTreeSet<_> =
        components.filter_map(|component| Some(component.toolbox()?.name.as_str())).collect();
    let file = view.outline().files.iter().find(|file| file.file == view.file);
    let is_needed =
        |line: &&Use| line.toolbox.as_ref().is_some_and(|it| toolboxes.contains(it.text.as_str()));
    let lines = file.into_iter().flat_map(|file| &file.uses).filter(is_needed);
    lines.map(|line| format!("{}\n", view.text_of(line.span).trim())).collect()
}

/// The name of the plan's first element, if it is among the items.
fn start<'a>(view: &View<'a>, items: &[Item]) -> Option<&'a str> {
    let plan = view.outline().plan_of(view.file, items.first()?)?;
    let Destination::Element(Some(id)) = plan.starts.first()?.target.as_ref()?.to else {
        return None;
    };
    let first = plan.elements.get(id.index())?;
    items.contains(&first.item).then(|| first.item.name())
}

#[cfg(test)]
mod tests {
    use super::copied;
    use crate::View;
    use afp_dsl::{Toolboxes, compile};
    use afp_syntax::item::Item;
    use afp_syntax::source::Source;

    const PLAN: &str = "use carbot as c
use std
plan P {
    var gap: length = 20 cm

    start go
    // Slowly.
    actor go: c.Forward {
        supervise tired: CheckTimeout { TimedOut -> rest }
        ForwardSuccessful -> rest
    }

    actor rest: Wait { Elapsed -> terminate }
    actor turn: c.Turn { TurnSuccessful -> rest }
}
";

    fn of(names: &[Item]) -> String {
        let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        let none = |_: &str| Err(String::new());
        let compiled = compile(&Source::new("p.afp", PLAN), &toolboxes, &none);
        let file = u16::try_from(compiled.plan_files.start).unwrap();
        copied(&View::new(&compiled, &toolboxes, file), names)
    }

    #[test]
    fn items_come_in_source_order_with_comments_use_lines_and_start() {
        let inner = |name: &str| Item::inner("P", name);
        let text = of(&[inner("rest"), inner("go"), Item::local("P", "go", "tired")]);
        let from = PLAN.find("    // Slowly").unwrap();
        let end = PLAN.find("    actor turn").unwrap();
        let own = format!("use carbot as c\nuse std\nstart go\n{}", PLAN[from..end].trim_start());
        assert_eq!(text, own.replace("\n\n    actor rest", "\n\nactor rest"));
        assert_eq!(
            of(&[inner("turn")]),
            "use carbot as c\nactor turn: c.Turn { TurnSuccessful -> rest }\n"
        );
        assert_eq!(
            of(&[Item::local("P", "go", "tired")]),
            "use std\nsupervise tired: CheckTimeout { TimedOut -> rest }\n"
        );
        assert_eq!(of(&[inner("gap")]), "var gap: length = 20 cm\n");
        assert_eq!(of(&[inner("none")]), "");
    }
}
