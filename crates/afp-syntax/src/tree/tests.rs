//! The text of the tree equals the parsed text, whatever that is.

use proptest::prelude::*;

use super::parse;
use crate::diagnostics::{Code, Diagnostics};
use crate::kind::Kind;

fn errors(text: &str) -> Vec<(Code, String)> {
    let mut diags = Diagnostics::default();
    let parse = parse(text, 0, &mut diags);
    assert_eq!(parse.text(), text);
    diags.iter().map(|each| (each.code, each.message_text())).collect()
}

const WALL_FOLLOWING: &str = include_str!("../../../../plans/wall_following.afp");
const SCENARIO: &str = r#"afp 1
use "../plans/wall_following.afp"
use carbot as c

scenario "bumps into a crate while searching" for WallFollowing {
    world "worlds/room_with_crate.toml"
    robot at (0.5 m, 2 m) heading 0 deg
    seed 7
    set walldist = 25 cm
    at 2 s:  press touch                 // stimuli and faults
    at 8 s:  fail ultrasonic.frozen for 500 ms
    at 50 s: press escape
    at 51 s: set a.b = 3 + 4
    at 52 s: fire searchFirstWall.touch.TouchSensorPressed
    expect searchFirstWall -> backupCollision by touch within 3 ms after 2 s
    expect followWall active before 30 s
    expect walldist == 25 cm always
    expect running
    never collision after 10 s
    expect end by escape.EscapeButtonPressed
    expect followWall -> terminate
    until 60 s
}
"#;

#[test]
fn plans_toolboxes_and_scenarios_parse_without_an_error() {
    assert_eq!(errors(WALL_FOLLOWING), []);
    assert_eq!(errors(SCENARIO), []);
    for toolbox in afp_toolboxes::ALL {
        assert_eq!(errors(toolbox.text), [], "{}", toolbox.file_name);
    }
}

#[test]
fn an_edge_may_have_many_names_and_any_white_space() {
    let names: Vec<_> = (0..500).map(|at| format!("S{at}")).collect();
    let text = format!("plan P {{ actor a: A {{ {} -> b }} }}", names.join(", "));
    assert_eq!(errors(&text), []);
    let text = "plan P { actor a: A { left -> terminate, right
            -> terminate, up, down
            , away -> terminate }
        }
        toolbox t supervisor S { event E
            once }";
    assert_eq!(errors(text), []);
}

#[test]
fn keywords_are_names_if_a_value_is_bound_to_them() {
    let text = "plan P { in start: length = 4 m
        var in: bool
        actor a: A(live = 2 m = 3 range => start) { state -> terminate actor -> a supervise -> a } }
        toolbox t version \"1\" actor A { in live: bool in live live: bool state to }";
    assert_eq!(errors(text), []);
    let devices = "toolbox t version \"1\" device press { press press stop stop fault fault
        signal signal: bool fault signal(fault: float = 1) press signal truth
        signal truth: pose } sensor robot { } robot { truth robot: bool }";
    assert_eq!(errors(devices), []);
}

#[test]
fn ten_thousand_brackets_do_not_overflow_the_stack() {
    for (open, close) in [("(", ")"), ("-", ""), ("{", "}"), ("[", "]"), ("-(", ")"), ("1+(", ")")]
    {
        let nested = format!("{}1{}", open.repeat(10_000), close.repeat(10_000));
        let codes = errors(&format!("plan P {{ const a = {nested} }}"));
        assert!(!codes.is_empty());
        errors(&nested);
        errors(&format!("actor a: B({nested}) {{ {nested} }}"));
        errors(&format!("actor A {{ every {nested} }}"));
    }
    errors(&format!("plan P {{ const a = 1{} }}", "+1".repeat(100_000)));
    errors(&"plan P { actor a: A { supervise b: B {".repeat(3_000));
}

#[test]
fn a_point_takes_no_item_of_the_next_line() {
    let text = "plan P {\n    in side: Side = Side.\n    in far: length\n    actor a: c.\n    \
                actor b: c.Turn {}\n}\nscenario \"s\" for P {\n    expect a.\n    until 3 s\n}\n";
    let mut diags = Diagnostics::default();
    let root = parse(text, 0, &mut diags).root();
    let count = |kind| root.descendants().filter(|node| node.kind() == kind).count();
    assert_eq!((count(Kind::Entry), count(Kind::Element), count(Kind::Until)), (2, 2, 1));
}

#[test]
fn nesting_is_reported_once() {
    let text = format!("plan P {{ const a = {}1{} }}", "(".repeat(10_000), ")".repeat(10_000));
    let codes: Vec<_> = errors(&text).into_iter().map(|(code, _)| code).collect();
    assert_eq!(codes, [Code::E0111]);
}

/// Fragments for invalid files.
const PIECES: &[&str] = &[
    "plan",
    "P",
    "{",
    "}",
    "(",
    ")",
    "actor",
    "a",
    ":",
    "Forward",
    "=",
    "=>",
    "->",
    "terminate",
    "30",
    "cm",
    "2,5 m",
    "90°",
    "3 µs",
    "/*",
    "*/",
    "//",
    "///",
    "\n",
    " ",
    "\"",
    "supervise",
    "every",
    "deadline",
    "in",
    "out",
    "var",
    "const",
    "start",
    "[",
    "]",
    "@",
    "resume",
    "suspend",
    "return",
    "resumable",
    "suspended",
    ".",
    "^",
    "-",
    "+",
    "%",
    "toolbox",
    "device",
    "sensor",
    "robot",
    "press",
    "fault",
    "signal",
    "enum",
    "scenario",
    "for",
    "at",
    "expect",
    "|",
    "on",
    "from",
    "to",
    "ä",
    "\u{0}",
    "\r",
];

proptest! {
    #[test]
    fn the_tree_of_any_text_has_the_same_text(text in any::<String>()) {
        errors(&text);
    }

    #[test]
    fn the_tree_of_any_mix_of_tokens_has_the_same_text(
        picks in prop::collection::vec((0..PIECES.len(), any::<bool>()), 0..200)
    ) {
        let pieces = picks.iter().map(|(pick, gap)| {
            format!("{}{}", PIECES[*pick], if *gap { " " } else { "" })
        });
        errors(&pieces.collect::<String>());
    }

    #[test]
    fn a_broken_file_keeps_its_text(
        which in 0..4_usize, cuts in prop::collection::vec((any::<u16>(), 0..20_usize, 0..PIECES.len()), 1..8)
    ) {
        let texts = [WALL_FOLLOWING, SCENARIO, afp_toolboxes::ALL[0].text, afp_toolboxes::ALL[1].text];
        let mut text: Vec<char> = texts[which].chars().collect();
        for (place, length, piece) in cuts {
            let from = usize::from(place) % (text.len() + 1);
            let to = (from + length).min(text.len());
            text.splice(from..to, PIECES[piece].chars());
        }
        errors(&text.iter().collect::<String>());
    }
}
