//! Layout files: read, written, and updated after changes.

use proptest::prelude::*;

use super::{Layout, LayoutError, Position};
use afp_syntax::item::Item;

const FILE: &str = "\
# placed by hand
#zoom 120
P.back 300 -40
P.go 10 20 folded wide
P.go.touch 12 60
Q.go 0 0
";

fn read(text: &str) -> Layout {
    let (layout, errors) = Layout::read(text);
    assert_eq!(errors, []);
    layout
}

#[test]
fn a_file_is_written_as_read() {
    let layout = read(FILE);
    assert_eq!(layout.write(), FILE);
    assert_eq!(layout.get(&Item::inner("P", "back")), Some(Position { x: 300, y: -40 }));
    assert_eq!(layout.get(&Item::local("P", "go", "touch")), Some(Position { x: 12, y: 60 }));
    assert_eq!(layout.get(&Item::inner("P", "touch")), None);
    assert_eq!(read("P.b 1 1\r\n\n  P.a   2  2 \n").write(), "P.a 2 2\nP.b 1 1\n");
}

#[test]
fn lines_are_sorted_like_strings() {
    let mut layout = Layout::default();
    for name in ["b", "a_b", "aB", "a"] {
        layout.set(Item::inner("P", name), Position { x: 1, y: 2 });
    }
    layout.set(Item::local("P", "a", "z"), Position { x: 1, y: 2 });
    assert_eq!(layout.write(), "P.a 1 2\nP.a.z 1 2\nP.aB 1 2\nP.a_b 1 2\nP.b 1 2\n");
}

/// Unknown lines are kept and reported.
const OTHER_FORM: &str = "expected a line such as 'Plan.element 300 120'";

#[test]
fn invalid_lines_are_reported_and_kept() {
    for line in [
        "nonsense",
        "go 300 300",
        "P.go: 300 300",
        "  P.ä 1 2",
        "P.go.touch.x 1 2",
        ". 1 2",
        "P-go 1 2",
    ] {
        let (layout, errors) = Layout::read(line);
        let [LayoutError { line: 1, column, message }] = &*errors else {
            panic!("{line}: {errors:?}")
        };
        let word = line.split_whitespace().next().unwrap();
        assert_eq!(message, &format!("{OTHER_FORM}, found '{word}'"));
        assert_eq!(line.find(word).unwrap() + 1, *column, "{line}");
        assert_eq!(layout.write(), format!("{line}\n"));
    }
}

#[test]
fn lines_with_unknown_names_get_a_suggestion_and_are_kept() {
    let plan = "use carbot
        plan Square { in side: length = 1 m start drive
            supervise esc: CheckEscapeButton { EscapeButtonPressed -> terminate }
            actor drive: Forward(distance = side) {
                supervise touch: CheckTouchSensor { TouchSensorPressed -> terminate }
                ForwardSuccessful -> terminate } }";
    let outline = crate::sample::compiled(plan).outline;
    for (path, says) in [
        ("Square.drive", None),
        ("Square.drive.touch", None),
        ("Square.esc", None),
        ("Square.side", None),
        ("Square.start", None),
        ("Square.terminate", None),
        ("Sqare.drive", Some("write 'Square.drive'")),
        ("Square.drvie", Some("write 'Square.drive'")),
        ("Square.drive.tuch", Some("write 'Square.drive.touch'")),
        ("Circle.turn", Some("remove the line")),
    ] {
        let text = format!("# by hand\n  {path} 300 300\n");
        let (layout, errors) = Layout::read_for(&text, &outline, outline.plans[0].file());
        let said: Vec<_> = errors.iter().map(ToString::to_string).collect();
        let expected = says.map(|it| format!("2:3: unknown item '{path}': {it}"));
        assert_eq!(said, Vec::from_iter(expected));
        assert_eq!(layout, Layout::read(&text).0, "it may be there again");
    }
}

#[test]
fn errors_have_a_place_and_do_not_affect_other_lines() {
    let (_, errors) =
        Layout::read("P.a 1\nP.b 1 2\nP.b 3 4\n  P.ä 1 2\nP.c 1.5 2\n  P.d 1 99999999999\n");
    let error = |line, column, message: &str| LayoutError { line, column, message: message.into() };
    let expected = [
        error(1, 6, "expected a whole number, found the end of the line"),
        error(3, 1, "'P.b' already has a position: remove one of the lines"),
        error(4, 3, &format!("{OTHER_FORM}, found 'P.ä'")),
        error(5, 5, "expected a whole number, found '1.5'"),
        error(6, 9, "expected a whole number, found '99999999999'"),
    ];
    assert_eq!(errors, expected);
    assert_eq!(errors[0].to_string(), "1:6: expected a whole number, found the end of the line");
}

#[test]
fn no_line_is_lost_when_an_item_moves() {
    let text =
        "P.c 1.5 2\nP.b 1 2 wide\nP.a 1\nP.b 3 4\nP.b 5 6 far\n  P.d 1 99999999999\n<<<<<<<\n";
    let mut layout = Layout::read(text).0;
    assert_eq!(layout.get(&Item::inner("P", "b")), Some(Position { x: 1, y: 2 }), "the first one");
    let kept = "P.c 1.5 2\nP.a 1\n  P.d 1 99999999999\n<<<<<<<\n";
    assert_eq!(layout.write(), format!("{kept}P.b 1 2 wide\nP.b 3 4\nP.b 5 6 far\n"));
    layout.set(Item::inner("P", "b"), Position { x: 7, y: 8 });
    layout.set(Item::inner("P", "e"), Position { x: 1, y: 1 });
    assert_eq!(layout.write(), format!("{kept}P.b 7 8 wide\nP.b 3 4\nP.b 5 6 far\nP.e 1 1\n"));
    layout.relocate(&Item::inner("P", "b"), &Item::inner("P", "f"));
    assert_eq!(layout.write(), format!("{kept}P.e 1 1\nP.f 7 8 wide\nP.f 3 4\nP.f 5 6 far\n"));
    layout.remove(&Item::inner("P", "f"));
    assert_eq!(layout.write(), format!("{kept}P.e 1 1\n"), "none of them moves it");
}

#[test]
fn a_reused_name_gets_the_position_of_the_renamed_item() {
    for left in ["a", "c"] {
        let mut layout = read(&format!("P.b 1 2\nP.b.t 3 4\nP.{left} 5 6\nP.{left}.u 7 8\n"));
        layout.relocate(&Item::inner("P", "b"), &Item::inner("P", left));
        assert_eq!(layout.write(), format!("P.{left} 1 2\nP.{left}.t 3 4\n"));
    }
}

proptest! {
    #[test]
    fn any_text_is_read_and_a_written_text_is_read_again(text in "([A-C]\\.[a-c](\\.[a-c])? -?[0-9]{1,3} -?[0-9]{1,12}( \\PC{0,5})?\n|\\PC{0,9}\n){0,20}") {
        let (layout, errors) = Layout::read(&text);
        let written = layout.write();
        let (again, still) = Layout::read(&written);
        let messages = |errors: Vec<LayoutError>| {
            let mut all: Vec<_> = errors.into_iter().map(|error| error.message).collect();
            all.sort();
            all
        };
        prop_assert_eq!(messages(still), messages(errors));
        prop_assert_eq!(&again, &layout);
        prop_assert_eq!(again.write(), written);
    }
}
