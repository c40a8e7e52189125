//! The canonical form: idempotent, and nothing but white space and commas changes.

use proptest::prelude::*;

use super::format;
use crate::diagnostics::Diagnostics;
use crate::syntax::kind::Kind;
use crate::syntax::parse;

const WALL_FOLLOWING: &str = include_str!("../../../../plans/wall_following.afp");
const SCENARIO: &str = "\
afp 1
use \"../plans/wall_following.afp\"
use carbot as c

scenario \"bumps into a crate while searching\" for WallFollowing {
    world \"worlds/room_with_crate.toml\"
    robot at (0.5 m, 2 m) heading -(0 deg + 1 deg)
    set walldist = 25 cm

    at 2 s:  press touch // stimuli and faults
    at 8 s:  fail ultrasonic(kind = \"frozen\") for 500 ms
    at 50 s: press escape

    expect searchFirstWall -> backupCollision by touch within 3 ms after 2 s
    expect walldist == -25 cm always
    until 60 s
}
";

fn formatted(text: &str) -> String {
    format(text).unwrap_or_else(|diags| panic!("{text}\n{diags:?}"))
}

#[track_caller]
fn becomes(text: &str, expected: &str) {
    assert_eq!(formatted(text), expected);
    assert_eq!(formatted(expected), expected, "again");
}

#[test]
fn the_plan_of_the_paper_and_a_scenario_are_canonical() {
    becomes(WALL_FOLLOWING, WALL_FOLLOWING);
    becomes(SCENARIO, SCENARIO);
}

#[test]
fn white_space_follows_the_structure() {
    becomes(
        "use std use carbot as c enum E{a,b}\n\n\n\nplan P{in a:length/duration ^ - 2=- ( 3cm/s*2 ),\
         out bb:int const k=3 start go,actor go:c . Forward(distance=a,driven=>bb){supervise t:T \
         every 3ms deadline 1 ms{E->go,F->ignore}Done->go,Error->terminate}}",
        "\
use std
use carbot as c
enum E { a b }

plan P {
    in  a:  length/duration^-2 = -(3 cm/s * 2)
    out bb: int
    const k = 3
    start go
    actor go: c.Forward(distance = a, driven => bb) {
        supervise t: T every 3 ms deadline 1 ms { E -> go, F -> ignore }
        Done  -> go
        Error -> terminate
    }
}
",
    );
}

#[test]
fn a_list_with_a_line_break_gets_one_line_for_each_item() {
    becomes(
        "plan P { start go actor go: A(x = 1, // one\ny = 2 +\n3) { A -> go,\nBB -> go }\n\n\nactor b: B( ) { } }",
        "\
plan P {
    start go
    actor go: A(
        x = 1, // one
        y = 2 + 3,
    ) {
        A  -> go
        BB -> go
    }

    actor b: B() {}
}
",
    );
}

#[test]
fn comments_stay_where_they_are() {
    becomes(
        "// head\n\n\n\n// of the plan  \nplan P { // behind the brace\n\n// free\n\n\n//own\nstart go //start\n
        /// help /// more\nactor // middle\n\n// and own\ngo: A { A -> go // a\n// b\n, // c\nBBB -> go//d\n
        // last\n\n } // end\n// tail\n}// over\n// the end",
        "\
// head

// of the plan
plan P { // behind the brace
    // free

    //own
    start go //start

    /// help /// more
    actor // middle
            // and own
            go: A {
        A -> go // a
        // b
        // c
        BBB -> go //d

        // last
    } // end
    // tail
} // over
// the end
",
    );
}

#[test]
fn parts_of_a_template_may_share_a_line() {
    becomes(
        "toolbox t version \"1\" /// help\nactor A { icon \"a\" uses a uses b every 1 ms budget 2 us\nstop 3 ms
        in live x:length=3 cm from 1 cm to 4 cm out y:int on S|T state S state T } object O actor B{state S}",
        "\
toolbox t version \"1\"

/// help
actor A {
    icon \"a\"
    uses a uses b
    every 1 ms budget 2 us
    stop 3 ms
    in  live x: length = 3 cm from 1 cm to 4 cm
    out y:      int on S | T
    state S
    state T
}

object O

actor B {
    state S
}
",
    );
}

#[test]
fn a_text_with_syntax_errors_is_left_alone() {
    let diags = format("plan P { start }").unwrap_err();
    assert!(diags.has_errors());
    assert_eq!(formatted(""), "");
    assert_eq!(formatted("\u{feff}\r\n"), "");
    assert_eq!(formatted("// a\r\nuse std\r\n"), "// a\nuse std\n");
}

/// Solid tokens without list commas, and comments, each in order.
fn content(text: &str) -> (Vec<String>, Vec<String>) {
    let root = parse(text, 0, &mut Diagnostics::default()).root();
    let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    let tokens = tokens.filter(|token| !matches!(token.kind(), Kind::Whitespace | Kind::Comma));
    let (comments, solid): (Vec<_>, Vec<_>) = tokens.partition(|token| token.kind().is_trivia());
    let texts = |tokens: Vec<crate::syntax::Token>| {
        tokens.into_iter().map(|token| token.text().trim_end().to_owned()).collect()
    };
    (texts(solid), texts(comments))
}

/// Replaces white space between tokens, now and then by a comment.
fn mutated(text: &str, picks: &[u8]) -> String {
    let root = parse(text, 0, &mut Diagnostics::default()).root();
    let mut result = String::new();
    let mut picks = picks.iter().cycle();
    for token in root.descendants_with_tokens().filter_map(|each| each.into_token()) {
        if token.kind() != Kind::Whitespace {
            result += token.text();
            continue;
        }
        result += match picks.next().copied().unwrap_or(0) % 16 {
            0 => " // a comment\n",
            1 => "\n// an own line\n",
            2 => "\n\n// free\n\n",
            3 => "\n /// help\n",
            4 => "\n",
            5 => "\n\n\n",
            6 => "\t",
            7 => ",\n",
            8 => ", // behind a comma\n",
            _ if token.prev_token().is_some_and(|t| t.kind().is_trivia()) => "\n",
            _ => " ",
        };
    }
    result
}

const CASES: &[&str] = &[
    WALL_FOLLOWING,
    SCENARIO,
    include_str!("../../tests/graph/sub_plans.afp"),
    afp_toolboxes::ALL[0].text,
    afp_toolboxes::ALL[1].text,
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn formatting_is_idempotent_and_keeps_tokens_and_comments(
        which in 0..CASES.len(),
        quiet in 0..3_u8,
        picks in prop::collection::vec(any::<u8>(), 1..400),
    ) {
        // Few mutations first: most texts with many of them have syntax errors.
        let picks: Vec<_> = picks.iter().map(|pick| match quiet {
            0 => pick % 16,
            1 if pick % 5 > 0 => 15,
            2 if pick % 29 > 0 => 15,
            _ => pick / 8,
        }).collect();
        let text = mutated(CASES[which], &picks);
        if let Ok(once) = format(&text) {
            prop_assert_eq!(&formatted(&once), &once);
            prop_assert_eq!(content(&once), content(&text));
        }
    }
}
