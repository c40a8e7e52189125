//! Random changes: the text has exactly the expected content, and only comments of removed items
//! disappear.

mod changes;
mod compiled;
mod inverse;
mod model;
#[path = "../../../afp-format/tests/format/mutate.rs"]
mod mutate;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use afp_dsl::Toolboxes;
use afp_ide::edit::{Binding, Change, Refused, TextEdit, apply};
use afp_syntax::item::Item;
use afp_syntax::source::Source;
use proptest::prelude::*;

use changes::{Pick, change};
use model::{Model, comments};

static TOOLBOXES: LazyLock<Toolboxes> = LazyLock::new(|| afp_toolboxes::sources().collect());

/// The edits of a file without a project.
fn edit(text: &str, change: &Change) -> Result<Vec<TextEdit>, Refused> {
    afp_ide::edit::edit(&[Source::new("case.afp", text)], &TOOLBOXES, 0, change)
}

const PLANS: &[&str] = &[
    include_str!("../../../../plans/wall_following.afp"),
    include_str!("../../../afp-dsl/tests/graph/sub_plans.afp"),
    include_str!("../../../afp-dsl/tests/graph/conversions.afp"),
    include_str!("../../../afp-dsl/tests/graph/declared.afp"),
    "plan P { in a: int, out b: int start x supervise g: G { E -> y } \
     actor x: X(p = a, q => b) { supervise l: L every 1 ms { E -> x, F -> ignore } S -> y T -> z } \
     actor y: Y { S -> z } computation z: Z(p = b) { S -> terminate U -> x } }",
];

/// A plan in a random format; `None` if that has syntax errors.
fn text(base: prop::sample::Index, seeds: &[u8]) -> Option<String> {
    let plan = PLANS[base.index(PLANS.len())].split("\n// Graph:").next().unwrap_or_default();
    let text = mutate::mutated(plan, seeds);
    afp_format::format(&text).is_ok().then_some(text)
}

/// The number of occurrences of each comment.
fn counted(text: &str) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for (_, comment) in comments(text) {
        *counts.entry(comment).or_insert(0) += 1;
    }
    counts
}

/// Checks that missing comments belong to removed items.
fn check_comments(before: &str, after: &str, change: &Change) -> Result<(), TestCaseError> {
    let removed = Model::of(before).removed_by(change);
    let kept = counted(after);
    for (place, comment) in comments(before) {
        if kept.contains_key(&comment) {
            continue;
        }
        let belongs = removed.iter().any(|range| {
            let (gap, above) = match place < range.start {
                true => (&before[place + comment.len()..range.start], true),
                false => (&before[range.end.min(place)..place], false),
            };
            let inside = range.contains(&place);
            let solid = gap.lines().any(|line| {
                !line.trim().is_empty() && !line.trim().starts_with("//") && line.trim() != ","
            });
            inside || (!solid && (above || !gap.contains('\n')))
        });
        prop_assert!(belongs, "'{}' is lost by {:?}\n{}\n---\n{}", comment, change, before, after);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn the_text_has_exactly_the_change(
        base in any::<prop::sample::Index>(),
        seeds in prop::collection::vec(any::<u8>(), 1..300),
        pick in any::<Pick>(),
    ) {
        let Some(before) = text(base, &seeds) else { return Ok(()) };
        let Some((change, expected)) = change(&Model::of(&before), &pick) else { return Ok(()) };
        let edits = match edit(&before, &change) {
            Ok(edits) => edits,
            Err(refused) => {
                prop_assert!(!refused.reason.is_empty());
                // A comment inside a replaced part is a reason to refuse.
                let commented = refused.reason.contains("comment");
                prop_assert!(commented || expected.is_none(), "{}: {:?}\n{}", refused, change, before);
                return Ok(());
            }
        };
        let after = apply(&before, &edits);
        let Some(expected) = expected else {
            prop_assert!(false, "{:?} should be refused\n{}", change, before);
            return Ok(());
        };
        prop_assert!(afp_format::format(&after).is_ok(), "{:?}\n{}\n---\n{}", change, before, after);
        prop_assert_eq!(Model::of(&after), expected, "{:?}\n{}\n---\n{}", change, before, after);
        check_comments(&before, &after, &change)?;
        for edit in &edits {
            let old = &before[edit.span.start as usize..edit.span.end as usize];
            prop_assert_ne!(old, &edit.text, "an edit that changes nothing");
        }
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn an_extracted_plan_can_be_inlined(
        base in any::<prop::sample::Index>(),
        seeds in prop::collection::vec(any::<u8>(), 1..300),
        plan in any::<prop::sample::Index>(),
        chosen in any::<u8>(),
    ) {
        let Some(before) = text(base, &seeds) else { return Ok(()) };
        let model = Model::of(&before);
        let plan = plan.get(&model.plans);
        let bit = |place: usize| chosen >> (place % 8) & 1 == 1;
        let names = plan.elements.iter().enumerate().filter(|(place, _)| bit(*place));
        let extract = Change::Extract {
            plan: plan.name.clone(),
            elements: names.map(|(_, element)| element.name.clone()).collect(),
            new_plan: "Extracted".into(),
            element: "extracted".into(),
        };
        let Ok(edits) = edit(&before, &extract) else { return Ok(()) };
        let extracted = apply(&before, &edits);
        prop_assert!(afp_format::format(&extracted).is_ok(), "{}\n---\n{}", before, extracted);
        prop_assert_eq!(counted(&extracted), counted(&before), "{}\n---\n{}", before, extracted);
        let inline = Change::Inline { plan: plan.name.clone(), element: "extracted".into() };
        let Ok(edits) = edit(&extracted, &inline) else { return Ok(()) };
        let inlined = apply(&extracted, &edits);
        let remove = Change::Remove { item: Item::plan("Extracted") };
        let edits = edit(&inlined, &remove).unwrap();
        let back = apply(&inlined, &edits);
        prop_assert_eq!(Model::of(&back).sorted(), model.sorted(), "{}\n---\n{}", before, back);
    }
}

/// Words for changes and texts.
const WORDS: &[&str] = &[
    "P",
    "x",
    "y",
    "z",
    "l",
    "g",
    "a",
    "b",
    "S",
    "new",
    "terminate",
    "fail",
    "fail \"it is stuck\"",
    "resume",
    "suspend",
    "return",
    "in",
    "3 cm",
    "-(a + 1)",
    "",
];

/// A change of any kind, of items that may exist.
fn any_change(which: u8, words: [&str; 4]) -> Change {
    let [one, two, three, four] = words.map(str::to_owned);
    let some = |word: String| (!word.is_empty()).then_some(word);
    let item = match which / 32 % 3 {
        0 => Item::plan(&one),
        1 => Item::inner("P", &one),
        _ => Item::local("P", "x", &one),
    };
    let plan = "P".to_owned();
    match which % 24 {
        0 => Change::AddUse { toolbox: one, alias: some(two) },
        1 => Change::AddPlan { text: format!("plan {one} {{ {two} }}") },
        2 => Change::Add { plan, owner: None, text: format!("var {one}: int"), before: some(two) },
        3 => {
            let text = format!("supervise {one}: G {{}}");
            Change::Add { plan, owner: some(two), text, before: some(three) }
        }
        4 => Change::Remove { item },
        5 => Change::Rename { item, to: two },
        6 => Change::Connect { from: item, outcome: two, to: three },
        7 => Change::Disconnect { from: item, outcome: two },
        8 => Change::SetStart { plan, to: one },
        9 => Change::Reorder { item, before: some(two) },
        10 => Change::Bind { component: item, port: two, to: Binding::In(three) },
        11 => Change::Bind { component: item, port: two, to: Binding::Out(three) },
        12 => Change::Unbind { component: item, port: two },
        13 => Change::SetTemplate { component: item, template: two },
        14 => Change::SetTiming { supervisor: item, keyword: "every".into(), value: some(two) },
        15 => Change::SetEntryKind { entry: item, keyword: two },
        16 => Change::SetEntryType { entry: item, ty: some(two) },
        17 => Change::SetEntryValue { entry: item, value: some(two) },
        18 => Change::SetDoc { item, text: two },
        19 => Change::Move { item, plan: two, owner: some(three) },
        20 => Change::SetNote { item, text: two },
        21 => Change::SetCondition { computation: one, state: two, condition: some(three) },
        22 => Change::Assign { computation: one, state: two, output: three, formula: some(four) },
        _ => Change::Extract { plan, elements: vec![one, two], new_plan: three, element: four },
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    /// A text with errors is changed, or the change is refused; a valid text stays valid.
    #[test]
    fn any_edit_of_any_patchwork_has_a_result(
        base in any::<prop::sample::Index>(),
        cuts in prop::collection::vec((any::<u16>(), 0..20_usize, 0..WORDS.len()), 0..4),
        which in any::<u8>(),
        words in any::<[prop::sample::Index; 4]>(),
    ) {
        let mut text: Vec<char> = PLANS[base.index(PLANS.len())].chars().collect();
        for (place, length, word) in cuts {
            let from = usize::from(place) % (text.len() + 1);
            text.splice(from..(from + length).min(text.len()), WORDS[word].chars());
        }
        let text: String = text.into_iter().collect();
        let change = any_change(which, words.map(|word| WORDS[word.index(WORDS.len())]));
        let Ok(edits) = edit(&text, &change) else { return Ok(()) };
        for pair in edits.windows(2) {
            prop_assert!(pair[0].span.end <= pair[1].span.start, "{:?}", edits);
        }
        let after = apply(&text, &edits);
        if afp_format::format(&text).is_ok() {
            prop_assert!(afp_format::format(&after).is_ok(), "{:?}\n{}\n---\n{}", change, text, after);
        }
    }
}
