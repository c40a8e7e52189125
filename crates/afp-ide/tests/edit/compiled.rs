//! Extracting and inlining on plans that compile: the result compiles.

use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_ide::edit::{Change, apply};
use afp_syntax::item::Item;
use afp_syntax::source::Source;

use crate::edit;

const WALL_FOLLOWING: &str = include_str!("../../../../plans/wall_following.afp");
const SUB_PLANS: &str = include_str!("../../../afp-dsl/tests/graph/sub_plans.afp");

/// The dump of the graph of a text, which must compile.
#[track_caller]
fn dump(text: &str) -> String {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("case.afp", text), &toolboxes, &Texts::default());
    let graph = compiled.graph.as_ref();
    graph.unwrap_or_else(|| panic!("{}\n{text}", compiled.render(false))).dump()
}

fn changed(text: &str, change: &Change) -> String {
    apply(text, &edit(text, change).unwrap_or_else(|refused| panic!("{change:?}: {refused}")))
}

/// The lines of a dump in order, since elements may have moved.
fn sorted(dump: &str) -> Vec<&str> {
    let mut lines: Vec<_> = dump.lines().collect();
    lines.sort_unstable();
    lines
}

#[test]
fn every_extracted_selection_compiles_and_can_be_inlined() {
    let cases: [(&str, &str, &[&str]); 2] = [
        (
            WALL_FOLLOWING,
            "WallFollowing",
            &[
                "searchFirstWall",
                "backupCollision",
                "findWallAngle",
                "parallelToWall",
                "followWall",
                "turnAfterWallLost",
            ],
        ),
        (SUB_PLANS, "Patrol", &["first", "count", "second", "compare", "say", "back", "turn"]),
    ];
    let mut extractions = 0;
    for (text, plan, elements) in cases {
        let before = dump(text);
        for chosen in 1..1_usize << elements.len() {
            let names = elements.iter().enumerate().filter(|(place, _)| chosen >> place & 1 == 1);
            let extract = Change::Extract {
                plan: plan.into(),
                elements: names.map(|(_, name)| (*name).to_owned()).collect(),
                new_plan: "Part".into(),
                element: "part".into(),
            };
            let Ok(edits) = edit(text, &extract) else { continue };
            extractions += 1;
            let extracted = apply(text, &edits);
            dump(&extracted);
            let inline = Change::Inline { plan: plan.into(), element: "part".into() };
            let Ok(edits) = edit(&extracted, &inline) else { continue };
            let remove = Change::Remove { item: Item::plan("Part") };
            let back = changed(&apply(&extracted, &edits), &remove);
            assert_eq!(sorted(&dump(&back)), sorted(&before), "{back}");
        }
    }
    assert!(extractions > 10, "{extractions}");
}

#[test]
fn a_renamed_plan_means_the_same() {
    let items = ["searchFirstWall", "walldist", "wallangle", "escape", "followWall"];
    for name in items {
        let item = Item::inner("WallFollowing", name);
        let renamed = changed(WALL_FOLLOWING, &Change::Rename { item, to: "another".into() });
        let expected = dump(WALL_FOLLOWING);
        // The port has an entry's name here and keeps it.
        let same = dump(&renamed).replace("another", name);
        assert_eq!(same, expected);
    }
}
