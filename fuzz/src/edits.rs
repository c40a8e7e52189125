//! Edits of any kind on any text: in order, inside the text, and no harm to what could be read.

use std::sync::LazyLock;

use afp_draw::layout_file::Layout;
use afp_dsl::Toolboxes;
use afp_ide::edit::{Binding, Change, TextEdit, apply, edit, follow};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::item::Item;
use afp_syntax::parse;
use afp_syntax::source::Source;
use arbitrary::{Result, Unstructured};

use crate::names::Names;

/// The built-in ones.
static TOOLBOXES: LazyLock<Toolboxes> = LazyLock::new(|| afp_toolboxes::sources().collect());

/// Strings for formulas, types, times and items.
const FRAGMENTS: &[&str] = &[
    "2 * (a + 3 cm)",
    "length",
    "10 ms",
    "var",
    "every",
    "deadline",
    "actor fresh: Forward { ForwardSuccessful -> terminate }",
    "supervise fresh: CheckTouchSensor { TouchSensorPressed -> terminate } // beside",
    "var fresh: length = 3 cm",
    "plan Fresh { start a actor a: Forward { ForwardSuccessful -> terminate } }",
    "help\nin two lines",
    "}",
    "// open",
    "\"",
];

/// The first bytes choose a change, the others are the text that it is made on.
///
/// # Panics
/// When an edit is out of order, leaves the text, or makes it less readable.
pub fn edits(data: &[u8]) {
    let (head, tail) = data.split_at(data.len().min(16));
    let text = crate::text::text(tail);
    let names = Names::of(&text);
    let Ok(change) = change(&mut Unstructured::new(head), &names) else { return };
    follow(&mut Layout::read("A.b 1 2\nA.b.c 3 4").0, &change);
    // The second file sees the first one and says much the same.
    let user = format!("use \"fuzzed.afp\"\n{}", text.replace("plan ", "plan other_"));
    let files = [Source::new("fuzzed.afp", text), Source::new("user.afp", user)];
    let home = usize::from(head.first().is_some_and(|byte| byte % 2 == 1));
    let Ok(edits) = edit(&files, &TOOLBOXES, home, &change) else { return };
    for (place, file) in files.iter().enumerate() {
        let own: Vec<_> =
            edits.iter().filter(|edit| usize::from(edit.span.file) == place).cloned().collect();
        check(&file.text, &own, &change);
    }
}

/// Checks the edits of one file.
fn check(text: &str, edits: &[TextEdit], change: &Change) {
    let mut end = 0;
    for edit in edits {
        assert!(end <= edit.span.start && edit.span.start <= edit.span.end, "{change:?}");
        assert!(text.get(edit.span.start as usize..edit.span.end as usize).is_some(), "{change:?}");
        end = edit.span.end;
    }
    let after = apply(text, edits);
    assert!(errors(&after) <= errors(text), "{change:?} makes\n{after}");
}

fn errors(text: &str) -> usize {
    let mut diags = Diagnostics::default();
    parse(text, 0, &mut diags);
    diags.iter().count()
}

fn change(bytes: &mut Unstructured<'_>, names: &Names) -> Result<Change> {
    let which = bytes.int_in_range(0..=23)?;
    let item = item(bytes, names)?;
    let name = names.choose(bytes)?;
    let fragment = (*bytes.choose(FRAGMENTS)?).to_owned();
    let maybe = if bytes.arbitrary()? { Some(fragment.clone()) } else { None };
    let (plan, owner) = (item.plan_name().to_owned(), names.maybe(bytes)?);
    Ok(match which {
        0 => Change::AddUse { toolbox: name, alias: owner },
        1 => Change::AddPlan { text: fragment },
        2 => Change::Add { plan, owner, text: fragment, before: names.maybe(bytes)? },
        3 => Change::Remove { item },
        4 => Change::Rename { item, to: name },
        5 => Change::Connect { from: item, outcome: name, to: names.choose(bytes)? },
        6 => Change::Disconnect { from: item, outcome: name },
        7 => Change::SetStart { plan, to: name },
        8 => Change::Reorder { item, before: owner },
        9 => Change::Bind { component: item, port: name, to: Binding::In(fragment) },
        10 => Change::Bind { component: item, port: name, to: Binding::Out(names.choose(bytes)?) },
        11 => Change::Unbind { component: item, port: name },
        12 => Change::SetTemplate { component: item, template: name },
        13 => {
            let keyword = (*bytes.choose(&["every", "deadline", "budget"])?).to_owned();
            Change::SetTiming { supervisor: item, keyword, value: maybe }
        }
        14 => {
            let keyword = (*bytes.choose(&["in", "out", "var", "const", "let"])?).to_owned();
            Change::SetEntryKind { entry: item, keyword }
        }
        15 => Change::SetEntryType { entry: item, ty: maybe },
        16 => Change::SetEntryValue { entry: item, value: maybe },
        17 => Change::SetDoc { item, text: fragment },
        18 => Change::Move { item, plan: name, owner },
        19 => {
            let elements = vec![item.name().to_owned(), names.choose(bytes)?];
            Change::Extract { plan, elements, new_plan: "Fresh".into(), element: "fresh".into() }
        }
        20 => Change::SetNote { item, text: fragment },
        21 => Change::SetCondition { computation: plan, state: name, condition: maybe },
        22 => Change::Assign { computation: plan, state: name, output: fragment, formula: maybe },
        _ => Change::Inline { plan, element: name },
    })
}

fn item(bytes: &mut Unstructured<'_>, names: &Names) -> Result<Item> {
    let (plan, owner, name) = (names.choose(bytes)?, names.choose(bytes)?, names.choose(bytes)?);
    Ok(match bytes.int_in_range(0..=4)? {
        0 => Item::plan(plan),
        1 => Item::local(plan, owner, name),
        2 => Item::enumeration(plan),
        _ => Item::inner(plan, name),
    })
}
