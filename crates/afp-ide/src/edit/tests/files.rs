//! Changes of several files.

use super::toolboxes;
use crate::edit::{Change, apply, edit};
use afp_dsl::compile;
use afp_dsl::files::{Files, Texts};
use afp_syntax::item::Item;
use afp_syntax::source::Source;

/// The files of the tests; the first one is `main.afp`.
const FILES: &str = "\
use std
use \"lib/lap.afp\"

plan Main {
    var seen: length
    var mood: Mood = Mood.calm // Mood
    start lap
    subplan lap: Lap(way = 1 m, seen => seen) { OK -> other }
    subplan other: Other { OK -> terminate }
}

plan Other {
    start go
    actor go: Wait { Elapsed -> terminate }
}

scenario \"far\" for Main {
    expect lap.way == 2 m
    expect lap.forth active
    expect mood == Mood.wild
}
// file: lib/lap.afp
use carbot as c
use \"deep/rest.afp\"

enum Mood { calm wild }

plan Lap {
    in way: length // the way
    out seen: length
    var mood: Mood
    start forth
    // on
    actor forth: c.Forward(distance = way, driven => seen) { ForwardSuccessful -> rest }
    subplan rest: Rest(mode = Mode.deep) { OK -> terminate }
}
// file: lib/deep/rest.afp
use std

enum Mode { light deep }

plan Rest {
    in mode: Mode
    start pause
    actor pause: Wait(duration = 1 s) { Elapsed -> terminate }
}
// file: far.afp
use std

/// Not that of lib/lap.afp, which this file does not use.
plan Lap {
    in way: length = 1 m
    start go
    actor go: Wait { Elapsed -> terminate }
}

plan User {
    start lap
    subplan lap: Lap(way = 2 m) { OK -> terminate }
}
";

const PATHS: [&str; 4] = ["main.afp", "lib/lap.afp", "lib/deep/rest.afp", "far.afp"];

fn files() -> Vec<Source> {
    let (first, texts) = Texts::in_one(FILES);
    let others = PATHS[1..].iter().map(|path| Source::new(*path, texts.read(path).unwrap()));
    std::iter::once(Source::new(PATHS[0], first)).chain(others).collect()
}

#[track_caller]
fn after(files: &[Source], home: usize, change: &Change) -> Vec<String> {
    let edits =
        edit(files, &toolboxes(), home, change).unwrap_or_else(|why| panic!("{change:?}: {why}"));
    let text = |(index, file): (usize, &Source)| {
        let own = edits.iter().filter(|edit| usize::from(edit.span.file) == index);
        apply(&file.text, &own.cloned().collect::<Vec<_>>())
    };
    files.iter().enumerate().map(text).collect()
}

/// Checks that a change of a file replaces exactly these texts, and nothing else.
#[track_caller]
fn replaces(home: usize, change: &Change, wanted: &[(usize, &str, &str)]) {
    let mut expected: Vec<_> = files().into_iter().map(|file| file.text).collect();
    for (file, old, new) in wanted {
        assert!(expected[*file].contains(old), "{old}");
        expected[*file] = expected[*file].replace(old, new);
    }
    assert_eq!(after(&files(), home, change), expected);
    assert_compiles(&expected);
}

#[track_caller]
fn refused(home: usize, change: &Change, why: &str) {
    assert_eq!(edit(&files(), &toolboxes(), home, change).unwrap_err().reason, why);
}

/// Checks that the first file compiles with the others.
#[track_caller]
fn assert_compiles(texts: &[String]) {
    let mut others = Texts::default();
    PATHS.iter().zip(texts).for_each(|(path, text)| others.add(path, text.as_str()));
    let compiled = compile(&Source::new(PATHS[0], &*texts[0]), &toolboxes(), &others);
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
}

fn rename(item: Item, to: &str) -> Change {
    Change::Rename { item, to: to.into() }
}

#[test]
fn a_plan_is_renamed_only_where_it_is_visible() {
    let wanted = [(0, "lap: Lap", "lap: Round"), (1, "plan Lap", "plan Round")];
    replaces(1, &rename(Item::plan("Lap"), "Round"), &wanted);
    let wanted = [(3, "plan Lap", "plan Round"), (3, "lap: Lap", "lap: Round")];
    replaces(3, &rename(Item::plan("Lap"), "Round"), &wanted);
    let wanted = [(0, "plan Main", "plan Start"), (0, "for Main", "for Start")];
    replaces(0, &rename(Item::plan("Main"), "Start"), &wanted);
}

#[test]
fn a_new_name_must_be_free_where_it_is_visible() {
    let change = rename(Item::plan("Lap"), "Other");
    refused(1, &change, "'Other' already exists in 'main.afp'");
    refused(1, &rename(Item::plan("Lap"), "Rest"), "'Rest' already exists in 'lib/deep/rest.afp'");
    refused(1, &rename(Item::enumeration("Mood"), "length"), "'length' is a type of the language");
    let object = "'DistanceMap' is a type of the toolbox 'carbot'";
    refused(1, &rename(Item::enumeration("Mood"), "DistanceMap"), object);
}

#[test]
fn an_entry_is_renamed_as_a_port_and_in_scenarios() {
    let wanted = [
        (0, "Lap(way", "Lap(reach"),
        (0, "lap.way", "lap.reach"),
        (1, "in way", "in reach"),
        (1, "= way", "= reach"),
    ];
    replaces(1, &rename(Item::inner("Lap", "way"), "reach"), &wanted);
    let wanted =
        [(0, ", seen =>", ", found =>"), (1, "out seen", "out found"), (1, "=> seen", "=> found")];
    replaces(1, &rename(Item::inner("Lap", "seen"), "found"), &wanted);
}

#[test]
fn an_element_is_renamed_in_scenarios_of_other_files() {
    let wanted = [
        (0, "lap.forth", "lap.away"),
        (1, "start forth", "start away"),
        (1, "actor forth", "actor away"),
    ];
    replaces(1, &rename(Item::inner("Lap", "forth"), "away"), &wanted);
}

#[test]
fn a_value_of_an_enum_is_renamed_in_all_files() {
    let change = |to: &str| Change::RenameValue {
        enumeration: "Mood".into(),
        value: "wild".into(),
        to: to.into(),
    };
    let wanted = [(0, "Mood.wild", "Mood.mad"), (1, "calm wild", "calm mad")];
    replaces(1, &change("mad"), &wanted);
    refused(1, &change("calm"), "'calm' already exists");
    refused(1, &change("1"), "'1' cannot be a name");
    refused(0, &change("mad"), "there is no enum 'Mood'");
}

#[test]
fn an_enum_is_renamed_in_types_and_values() {
    let wanted = [
        (0, "mood: Mood = Mood.calm", "mood: Temper = Temper.calm"),
        (0, "Mood.wild", "Temper.wild"),
        (1, "enum Mood", "enum Temper"),
        (1, "mood: Mood", "mood: Temper"),
    ];
    replaces(1, &rename(Item::enumeration("Mood"), "Temper"), &wanted);
}

#[test]
fn names_used_by_another_file_stay() {
    let remove = |item| Change::Remove { item };
    let named = |name: &str| format!("'main.afp' uses '{name}': remove that use first");
    refused(1, &remove(Item::plan("Lap")), &named("Lap"));
    refused(1, &remove(Item::inner("Lap", "seen")), &named("seen"));
    refused(1, &remove(Item::enumeration("Mood")), &named("Mood"));
    refused(9, &remove(Item::plan("Lap")), "there is no such file");
}

#[test]
fn scenarios_of_other_files_do_not_keep_an_element() {
    let texts = after(&files(), 1, &Change::Remove { item: Item::inner("Lap", "forth") });
    assert!(!texts[1].contains("forth"), "{}", texts[1]);
    assert_eq!(texts[0], files()[0].text, "what names it there is for the check to mark");
    let extract = Change::Extract {
        plan: "Lap".into(),
        elements: vec!["forth".into()],
        new_plan: "New".into(),
        element: "new".into(),
    };
    let mut files = files();
    let text = &mut files[0].text;
    *text = text.replace(
        "    expect lap.forth active
",
        "    expect lap.forth active
    expect lap.forth -> lap.rest
",
    );
    let texts = after(&files, 1, &extract);
    for wanted in [
        "expect lap.new.forth active
",
        "expect lap.new -> lap.rest
",
    ] {
        assert!(texts[0].contains(wanted), "{wanted}: {}", texts[0]);
    }
    assert_compiles(&texts);
}

#[test]
fn a_plan_of_another_file_is_inlined_with_its_imports() {
    let inline = Change::Inline { plan: "Main".into(), element: "lap".into() };
    refused(0, &inline, "a scenario names 'lap.way'");
    let mut files = files();
    files[0].text = files[0].text.replace("    expect lap.way == 2 m\n", "");
    let texts = after(&files, 0, &inline);
    let expected = "\
use std
use \"lib/lap.afp\"
use carbot as c
use \"lib/deep/rest.afp\"

plan Main {
    var seen:  length
    var mood:  Mood = Mood.calm // Mood
    var mood2: Mood
    start forth
    // on
    actor forth: c.Forward(distance = 1 m, driven => seen) { ForwardSuccessful -> rest }

    subplan rest: Rest(mode = Mode.deep) { OK -> other }

    subplan other: Other { OK -> terminate }
}
";
    assert_compiles(&texts);
    assert!(texts[0].starts_with(expected), "{}", texts[0]);
    assert!(texts[0].contains("    expect forth active\n"), "{}", texts[0]);
    assert_eq!(texts[1..], files[1..].iter().map(|file| file.text.clone()).collect::<Vec<_>>());
    files[0].text = files[0].text.replace("use std\n", "use std as c\n");
    let why = edit(&files, &toolboxes(), 0, &inline).unwrap_err().reason;
    assert_eq!(why, "'c' is another toolbox there");
}
