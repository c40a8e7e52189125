//! Options that a run rejects, and the messages.

use super::QUIET;
use crate::common::{self, Place};

#[test]
fn options_that_need_another_option_name_it() {
    let place = Place::with_plan();
    let why = "'--rt-report' measures the real robot's control loop";
    place.afpc("run wall_following.afp --rt-report").fails(2, &[why, "help: "]);
    let why = "'--attach' needs a run in real time";
    place.afpc("run wall_following.afp --attach --speed max").fails(2, &[why, "help: "]);
    place
        .afpc("run wall_following.afp --press start@1s")
        .fails(2, &["no control 'start'; it has 'touch', 'escape'"]);
    place.afpc("run wall_following.afp --fail sonar.lost@1s").fails(2, &["there are battery, "]);
    place.afpc("run wall_following.afp --until 5").fails(2, &["20s or 500ms"]);
    place.afpc("run wall_following.afp --speed -2x").fails(2, &["a multiple of real time"]);
    place.afpc("run wall_following.afp --live=here").fails(2, &["expected a port, 8765, or"]);
    assert_eq!(place.files(), ["wall_following.afp"]);
}

#[test]
fn invalid_numbers_and_empty_names_get_a_message_with_the_valid_form() {
    let place = Place::with_plan();
    for (words, why) in [
        ("run wall_following.afp --until -1s", "a time cannot be negative"),
        ("sweep wall_following.afp --until -1s", "a time cannot be negative"),
        ("run wall_following.afp --seed -1", "expected a whole number from 0 to 184"),
        ("run wall_following.afp --seed 1.5", "expected a whole number from 0 to 184"),
        ("test --mutate --seed -1", "expected a whole number from 0 to 184"),
        ("sweep wall_following.afp --seeds -1..3", "expected seeds such as 0..1000"),
        ("sweep wall_following.afp --jobs -1", "expected a whole number of at least 1"),
        ("sweep wall_following.afp --jobs 0", "expected a whole number of at least 1"),
        ("graph wall_following.afp --scale -1", "expected a number from 0.1 to 10"),
        ("dap --port -1", "-1 is not in 0..=65535"),
        ("run wall_following.afp --log=", "expected the name of a file, or 'none'"),
        ("run wall_following.afp --svg=", "expected the name of a file, or 'none'"),
    ] {
        if cfg!(feature = "dap") || !words.starts_with("dap") {
            place.afpc(words).fails(2, &[why]);
        }
    }
    assert_eq!(place.files(), ["wall_following.afp"]);
}

#[test]
#[cfg(unix)]
fn a_name_that_is_not_utf8_is_reported() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let place = Place::with_plan();
    let name = OsStr::from_bytes(b"n\xff.afp");
    for before in ["check", "run", "graph", "fmt", "sweep", "run wall_following.afp --log"] {
        let mut command = place.command();
        let said = command.args(before.split(' ')).arg(name).output().unwrap();
        common::said(said).fails(2, &["'n\u{fffd}.afp' is not in UTF-8", "help: rename the file"]);
    }
}

#[test]
fn unusable_files_are_named() {
    let place = Place::with_plan();
    let said = place.afpc("run missing.afp");
    said.fails(
        1,
        &["error: cannot read the plan 'missing.afp'", "plans here: 'wall_following.afp'"],
    );
    place.afpc("run wall_following").fails(1, &["write 'wall_following.afp'"]);
    let said = place.afpc("run wall_following.afp --world missing.toml");
    said.fails(1, &["error: cannot read the world 'missing.toml'"]);
    let said = place.afpc("run wall_following.afp --log no/such/a.mcap");
    said.fails(1, &["error: cannot write the log 'no/such/a.mcap'", "help: check the path"]);
    let said = place.afpc("run wall_following.afp --until 1s --log none --svg no/such/a.svg");
    said.fails(1, &["error: cannot write the picture 'no/such/a.svg'"]);
    assert!(said.out.is_empty(), "it is said before the run: {}", said.out);
}

#[test]
fn a_start_far_away_is_refused_and_a_start_outside_is_reported() {
    let place = Place::with_plan();
    let start = |start: &str| {
        place.afpc(&format!("run wall_following.afp --until 100ms --log none --svg a.svg {start}"))
    };
    let far = "the start is not within 1000 m and 1000 deg of zero";
    for pose in ["1000000000m,1m,0deg", "1.7e308m,0m,0deg", "1m,-1001m,0deg", "1m,1m,1e9deg"] {
        start(&format!("--start {pose}")).fails(2, &[far]);
    }
    let outside = "warning: the robot starts outside of its world";
    for outer in ["--start 900m,1m,0deg", "--set world.robot.pose_m_deg.1=-1m"] {
        assert!(start(outer).succeeds().err.contains(outside), "{outer}");
        assert!(place.read("a.svg").len() < 100_000, "{outer}");
    }
    assert_eq!(start("--start 2m,1m,0deg").succeeds().err, "");
}

#[test]
fn a_value_of_the_wrong_type_gets_a_message_with_the_valid_form() {
    let place = Place::new();
    let plan = "use std
enum Side { left right }
plan Takes {
    in count: int = 1
    in often: bool = true
    in share: float = 1
    in bend: angle
    in side: Side = Side.left
    start go
    actor go: Wait(duration = 1 s) { Elapsed -> terminate }
}";
    place.write("takes.afp", plan);
    let bend = "write the unit: 'bend=1deg'";
    for (set, help) in [
        ("count=3.0", "'count=3.0': not an int\n  help: write 'count=3'\n"),
        ("count=3.5", "a whole number, such as 'count=3'"),
        ("count=many", "a whole number, such as 'count=3'"),
        ("often=1", "'often=1': not a bool\n  help: write 'often=true' or 'often=false'\n"),
        ("share=half", "'share=half': not a float\n  help: a number, such as 'share=0.5'\n"),
        ("share=nan", "a number, such as 'share=0.5'"),
        ("bend=1", bend),
        ("side=up", "one of: left, right"),
    ] {
        place.afpc(&format!("run takes.afp --set {set} {QUIET}")).fails(2, &[help]);
    }
    let missing = place.afpc(&format!("run takes.afp {QUIET}"));
    missing.fails(2, &["give it one with '--set bend=VALUE', an angle"]);
}

#[test]
#[cfg(unix)]
fn reading_a_world_without_an_end_stops() {
    let place = Place::with_plan();
    let said = place.afpc("run wall_following.afp --world /dev/zero");
    let endless = "it is longer than 64 MiB";
    said.fails(1, &["error: cannot read the world '/dev/zero'", endless]);
    place.write(
        "hall.yaml",
        "image: /dev/zero\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: 0.2\n",
    );
    let said = place.afpc("run wall_following.afp --world hall.yaml");
    let no_file = "it is a pipe or a device, not a file";
    said.fails(1, &["error: cannot read the map's picture '/dev/zero'", no_file]);
}

#[test]
fn helps_name_valid_options() {
    let place = Place::with_plan();
    place.write(
        "look.afp",
        "use carbot\nplan Look {\n    var map: DistanceMap\n    start look\n    \
         actor look: LookAround(map => map) { LookedAround -> terminate }\n}\n",
    );
    let object = "the entry 'map' has an object";
    let none = "this plan has no 'in' entries";
    place.afpc("run look.afp --set map=3").fails(2, &[object, none]);
    let itself = "'robot.port' is a setting of the real robot";
    place
        .afpc("run wall_following.afp --set robot.port=3")
        .fails(2, &[itself, "add '--robot hardware'"]);
    place.afpc("run wall_following.afp --press escpe@1s").fails(2, &["such as 'escape@1s'"]);
}

#[test]
fn errors_of_a_world_are_at_their_line() {
    let place = Place::with_plan();
    let run = "run wall_following.afp --world w.toml --log a.mcap --svg a.svg";
    place.write("w.toml", "version = 1\n[robot]\npose_m_deg = [0.0, 0.0, 0.0]\ncolour = 1\n");
    let told = ["'[robot]' has no 'colour'", "--> w.toml:4:1", "4 | colour = 1", "help: it has"];
    place.afpc(run).fails(1, &told);
    place.write("w.toml", "");
    place.afpc(run).fails(1, &["a world has no 'version'", "help: write 'version = 1'"]);
    place.write(
        "w.toml",
        "version = 1\n[robot]\npose_m_deg = [0.0, 0.0, 0.0]\n[[wall]]\nname = \"w\"\npoints_m = [[-1.0, 0.0], [1.0, 0.0]]\n",
    );
    place.afpc(run).fails(1, &["the robot starts inside of 'w'", "--> w.toml:3:"]);
    place.write("afp.toml", "[run]\nworlds = \"w.toml\"\n");
    place.afpc("run wall_following.afp").fails(1, &["'[run]' has no 'worlds'", "afp.toml:2:1"]);
    assert_eq!(place.files(), ["afp.toml", "w.toml", "wall_following.afp"]);
}
