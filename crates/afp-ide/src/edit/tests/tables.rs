//! Every kind of reference to a table.

use super::{Change, Item, after, edit};

const TEXT: &str = "\
use std

// The way.
table route(x: length) { (1 m) }

plan P {
    start at
    var route2: length
    computation at: Row(table = route, index = 0, x => route2) { Row -> at, End -> terminate }
}
";

fn rename(to: &str) -> Change {
    Change::Rename { item: Item::table("route"), to: to.to_owned() }
}

#[test]
fn a_table_is_renamed_where_it_is_read() {
    let wanted = TEXT.replace("table route(", "table way(").replace("= route,", "= way,");
    assert_eq!(after(TEXT, rename("way")), wanted);
}

#[test]
fn a_table_needs_an_unused_name() {
    let refused = |to: &str| edit(TEXT, &rename(to)).unwrap_err().reason;
    assert_eq!(refused("length"), "'length' is a type of the language");
    assert!(refused("P").contains("'P' already exists"), "{}", refused("P"));
    let text = format!("{TEXT}\nenum Side {{ left right }}\n");
    for item in [Item::plan("P"), Item::enumeration("Side")] {
        let change = Change::Rename { item, to: "route".to_owned() };
        assert_eq!(edit(&text, &change).unwrap_err().reason, "'route' already exists");
    }
}

#[test]
fn a_table_in_use_is_not_removed() {
    let remove = || Change::Remove { item: Item::table("route") };
    assert_eq!(edit(TEXT, &remove()).unwrap_err().reason, "'route' is used in the file");
    let unused = TEXT.replace("= route,", "= other,");
    assert!(!after(&unused, remove()).contains("table route"));
}

#[test]
fn a_column_is_renamed_where_it_is_bound() {
    let rename = |to: &str| Change::RenameColumn {
        table: "route".to_owned(),
        column: "x".to_owned(),
        to: to.to_owned(),
    };
    let two = TEXT.replace("route(x: length) { (1 m) }", "route(x: length, y: int) { (1 m, 2) }");
    let wanted = two.replace("route(x:", "route(far:").replace(", x =>", ", far =>");
    assert_eq!(after(&two, rename("far")), wanted);
    let refused = |to: &str| edit(&two, &rename(to)).unwrap_err().reason;
    assert_eq!(refused("y"), "'y' already exists");
    assert_eq!(refused("index"), "'index' is a port of computations that read tables");
    assert_eq!(refused("2"), "'2' cannot be a name");
}
