//! Positions after changes.

use super::{Change, Item, follow};
use afp_draw::layout_file::Layout;

const FILE: &str = "\
# placed by hand
#zoom 120
P.back 300 -40
P.go 10 20 folded wide
P.go.touch 12 60
Q.go 0 0
";

fn after(change: Change) -> String {
    let (mut layout, errors) = Layout::read(FILE);
    assert_eq!(errors, []);
    follow(&mut layout, &change);
    layout.write()
}

#[test]
fn positions_follow_names() {
    let rename = |item: Item, to: &str| after(Change::Rename { item, to: to.into() });
    let go = rename(Item::inner("P", "go"), "drive");
    assert_eq!(go, FILE.replace("P.go", "P.drive"));
    assert_eq!(rename(Item::local("P", "go", "touch"), "bump"), FILE.replace("touch", "bump"));
    assert_eq!(rename(Item::plan("P"), "A"), FILE.replace("P.", "A."));
}

#[test]
fn positions_follow_other_changes() {
    let go = || Item::inner("P", "go");
    let removed = after(Change::Remove { item: go() });
    assert_eq!(removed, "# placed by hand\n#zoom 120\nP.back 300 -40\nQ.go 0 0\n");
    let moved = after(Change::Move { item: go(), plan: "R".into(), owner: None });
    assert!(moved.ends_with("Q.go 0 0\nR.go 10 20 folded wide\nR.go.touch 12 60\n"), "{moved}");
    let owner = Some("back".to_owned());
    let touch = Item::local("P", "go", "touch");
    let moved = after(Change::Move { item: touch, plan: "P".into(), owner });
    assert!(moved.contains("P.back 300 -40\nP.back.touch 12 60\nP.go 10"), "{moved}");
    let extracted = after(Change::Extract {
        plan: "P".into(),
        elements: vec!["go".into()],
        new_plan: "R".into(),
        element: "inner".into(),
    });
    assert!(extracted.contains("P.back 300 -40\nP.inner 10 20\nQ.go 0 0\nR.go 10"), "{extracted}");
    let inlined = after(Change::Inline { plan: "P".into(), element: "back".into() });
    assert_eq!(inlined, FILE.replace("P.back 300 -40\n", ""));
}
