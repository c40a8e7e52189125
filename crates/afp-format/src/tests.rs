//! The canonical form, case by case.

use super::format;

const WALL_FOLLOWING: &str = include_str!("../../../plans/wall_following.afp");
const SCENARIO: &str = "\
afp 1
use \"../plans/wall_following.afp\"
use carbot as c

scenario \"bumps into a crate while searching\" for WallFollowing {
    world \"worlds/room_with_crate.toml\"
    robot at (0.5 m, 2 m) heading -(0 deg + 1 deg)
    set walldist = 25 cm

    at 2 s:  press touch // stimuli and faults
    at 8 s:  fail ultrasonic.frozen for 500 ms
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
fn lines_that_count_from_a_moment_are_indented() {
    becomes(
        "scenario \"s\" for P{from  go active{at 1 s:press touch,until 2 s}from go->back{expect end within 1 s // soon
        from end{until 1 s}}}",
        "scenario \"s\" for P {
    from go active { at 1 s: press touch, until 2 s }
    from go -> back {
        expect end within 1 s // soon
        from end { until 1 s }
    }
}
",
    );
}

#[test]
fn bodies_of_states_stay_on_their_line_or_are_broken() {
    becomes(
        "computation Count{in value:int state Again when value<3 and  value!=-1{next=value+1,all=0}
        state Done{
        // From the start.
        next=0
        all=0}
        state Last { } }
",
        "computation Count {
    in value: int
    state Again when value < 3 and value != -1 { next = value + 1, all = 0 }
    state Done {
        // From the start.
        next = 0
        all = 0
    }
    state Last {}
}
",
    );
}

#[test]
fn an_edge_instead_of_braces_stays_on_the_line_of_its_element() {
    becomes(
        "plan P{start a actor a:Wait(duration=1 s)->b// soon
  subplan b:Q(x=1,
y=>z)
 ->  fail \"no\",computation c:Log->a}",
        "plan P {
    start a
    actor a: Wait(duration = 1 s) -> b // soon
    subplan b: Q(
        x = 1,
        y => z,
    ) -> fail \"no\"
    computation c: Log -> a
}
",
    );
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
         in d=-min ( 1 ,2,clamp(3,(4),5) )out bb:int const k=3 start go,actor go:c . Forward(distance=a,driven=>bb){supervise t:T \
         every 3ms deadline 1 ms{E->go,F->ignore}Done ,\n Lost->go,Error->terminate}}",
        "\
use std
use carbot as c
enum E { a b }

plan P {
    in  a:  length/duration^-2 = -(3 cm/s * 2)
    in  d = -min(1, 2, clamp(3, (4), 5))
    out bb: int
    const k = 3
    start go
    actor go: c.Forward(distance = a, driven => bb) {
        supervise t: T every 3 ms deadline 1 ms { E -> go, F -> ignore }
        Done, Lost -> go
        Error      -> terminate
    }
}
",
    );
}

#[test]
fn devices_keep_their_written_form() {
    becomes(
        "toolbox t /// Help.\ndevice wheels{fault blocked fault slip( share:float=0.5 from 0 to 1 )}\
         robot { }sensor bumper{press left,right\nsignal l:bool signal right:bool\n// why\nstop a}\
         device x { }",
        "\
toolbox t

/// Help.
device wheels { fault blocked, fault slip(share: float = 0.5 from 0 to 1) }
robot {}

sensor bumper {
    press left right
    signal l:     bool
    signal right: bool
    // why
    stop a
}

device x {}
",
    );
}

#[test]
fn reactions_keep_their_written_form() {
    becomes(
        "plan P { start a supervise k:K{E->b} actor a:A{on k{E->terminate}F->b}\
         actor b:B{on k{E,G->ignore\nH->a}}}",
        "\
plan P {
    start a
    supervise k: K { E -> b }
    actor a: A {
        on k { E -> terminate }
        F -> b
    }
    actor b: B {
        on k {
            E, G -> ignore
            H    -> a
        }
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
fn comments_keep_their_places() {
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
fn a_text_with_syntax_errors_is_not_changed() {
    let diags = format("plan P { start }").unwrap_err();
    assert!(diags.has_errors());
    assert_eq!(formatted(""), "");
}

#[test]
fn lines_end_like_the_first_one_and_a_byte_order_mark_stays() {
    for (text, expected) in [
        ("// a\r\nuse   std\r\n", "// a\r\nuse std\r\n"),
        ("// a\r\nuse   std\n", "// a\r\nuse std\r\n"),
        ("// a\nuse   std\r\n", "// a\nuse std\n"),
        ("// a \r\nuse   std", "// a\r\nuse std\r\n"),
        ("\u{feff}use   std\n", "\u{feff}use std\n"),
        ("\u{feff}enum E {a,\r\nb}\r\n\r\n", "\u{feff}enum E {\r\n    a\r\n    b\r\n}\r\n"),
        ("\u{feff}\r\n", "\u{feff}"),
    ] {
        becomes(text, expected);
    }
}

#[test]
fn values_of_a_table_are_aligned() {
    becomes(
        "table route ( x:length,y : length name:string, ){(1m,-2 m,\"door\"),( 10 m+5 cm , 3 m,\"\",)
        // the last one
        (7 m, 8 m, \"end\")}
        table t(a:int){(1)(2),}
        table broken(a:int // here
        , b:int){(1
        ,2)}",
        "\
table route(x: length, y: length, name: string) {
    (1 m,         -2 m, \"door\")
    (10 m + 5 cm, 3 m,  \"\")
    // the last one
    (7 m, 8 m, \"end\")
}

table t(a: int) { (1) (2) }

table broken(
    a: int, // here
    b: int,
) {
    (
        1,
        2,
    )
}
",
    );
}
