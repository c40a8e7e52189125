//! Whatever is changed: the text then says exactly that, and no comment is lost but those of what
//! is removed.

mod changes;
mod model;
mod mutate;

use std::collections::BTreeMap;

use afp_dsl::edit::{Change, Item, apply, edit};
use proptest::prelude::*;

use changes::{Pick, change};
use model::{Model, comments};

const PLANS: &[&str] = &[
    include_str!("../../../../plans/wall_following.afp"),
    include_str!("../graph/sub_plans.afp"),
    include_str!("../graph/conversions.afp"),
    "plan P { in a: int, out b: int start x supervise g: G { E -> y } \
     actor x: X(p = a, q => b) { supervise l: L every 1 ms { E -> x, F -> ignore } S -> y T -> z } \
     actor y: Y { S -> z } computation z: Z(p = b) { S -> terminate U -> x } }",
];

/// One of the plans in another form; `None` when the form has syntax errors.
fn text(base: prop::sample::Index, seeds: &[u8]) -> Option<String> {
    let plan = PLANS[base.index(PLANS.len())].split("\n// Graph:").next().unwrap_or_default();
    let text = mutate::mutated(plan, seeds);
    afp_dsl::format(&text).is_ok().then_some(text)
}

/// How often each comment occurs.
fn counted(text: &str) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for (_, comment) in comments(text) {
        *counts.entry(comment).or_insert(0) += 1;
    }
    counts
}

/// Checks that the comments that are gone belong to what was removed.
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
    fn the_text_says_exactly_the_change(
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
                // A comment in what is replaced stands in the way.
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
        prop_assert!(afp_dsl::format(&after).is_ok(), "{:?}\n{}\n---\n{}", change, before, after);
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
    fn what_is_extracted_can_be_inlined(
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
        prop_assert!(afp_dsl::format(&extracted).is_ok(), "{}\n---\n{}", before, extracted);
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
