//! `afpc log`: timeline, facts, repair.

use std::fs;

use crate::common::Place;

fn place() -> Place {
    let place = Place::with_plan();
    place.afpc("run wall_following.afp --until 20s --log a.mcap --svg run.svg").succeeds();
    place
}

#[test]
fn a_log_has_the_timeline_of_the_run() {
    let place = place();
    let run = place.afpc("run wall_following.afp --until 20s --log none --svg none");
    let said = place.afpc("log a.mcap --svg log.svg");
    said.succeeds();
    let live: Vec<&str> = run.out.lines().filter(|line| line.contains(['▶', '⚡', '◆'])).collect();
    assert!(live.len() > 10);
    for line in live {
        assert!(said.out.contains(line), "{line} is not in {}", said.out);
    }
    assert!(said.out.contains("searchFirstWall.touch"), "{}", said.out);
    assert!(said.out.contains("  never: escape.EscapeButtonPressed"), "{}", said.out);
    let path = |name: &str| {
        let picture = place.read(name);
        picture.lines().filter(|line| line.contains("polyline")).map(str::to_owned).collect()
    };
    let (run, log): (Vec<String>, Vec<String>) = (path("run.svg"), path("log.svg"));
    assert!(run.len() > 5 && run == log, "the picture from the log is not that of the run");
}

#[test]
fn missed_deadlines_are_counted_alike_in_the_summary_and_the_table() {
    let place = Place::with_plan();
    let slow = "--fail ultrasonic.slow=15ms@1s..1.2s";
    let run = place.afpc(&format!(
        "run wall_following.afp {slow} --until 2s --seed 1 --log a.mcap --svg none"
    ));
    run.succeeds();
    let told = run.out.lines().find_map(|line| line.trim().strip_prefix("deadline misses"));
    let told: u64 = told.unwrap().trim().parse().unwrap();
    let log = place.afpc("log a.mcap");
    let table = log.out.lines().skip_while(|line| !line.starts_with("supervisor ")).skip(1);
    let counted = table.take_while(|line| !line.is_empty()).map(|line| {
        let line = line.replace('/', " ");
        let columns = line.split_whitespace().skip(4).take(3);
        columns.map(|number| number.parse::<u64>().unwrap()).sum::<u64>()
    });
    assert_eq!(counted.sum::<u64>(), told, "{}", log.out);
    assert!(told > 10, "{}", run.out);
    for said in [run, log] {
        assert!(said.out.contains(" releases skipped\n"), "{}", said.out);
        assert!(!said.out.contains("by 0.000 ms"), "{}", said.out);
    }
}

#[test]
fn log_messages_of_a_plan_are_in_the_timeline() {
    let place = Place::new();
    let text = r#"use std
plan P {
    in gap: length = 42 cm
    in side: string = "right"
    var turn: Side = Side.left
    start wide
    computation wide: Log(value = gap * 2) { Done -> where }
    computation where: Log(value = side) { Done -> round }
    computation round: Log(value = turn) { Done -> terminate }
}
enum Side { right, left }
"#;
    place.write("p.afp", text);
    let run = place.afpc("run p.afp --log a.mcap --svg none");
    let log = place.afpc("log a.mcap");
    for said in [run, log] {
        said.succeeds();
        let lines =
            ["✎ wide: value = 84 cm", r#"✎ where: value = "right""#, "✎ round: value = Side.left"];
        for line in lines.map(|line| format!("0.000  {line}")) {
            assert!(said.out.contains(&line), "{line} is not in {}", said.out);
        }
    }
}

#[test]
fn components_that_failed_to_start_are_in_the_tables() {
    let place = Place::new();
    place.write(
        "p.afp",
        r#"use std
plan P {
    in time: string = "soon"
    start late
    actor late: Wait(duration = time) { Elapsed -> watched, Error -> watched }
    actor watched: Wait {
        supervise over: CheckTimeout(duration = time) { TimedOut -> terminate }
        Elapsed -> terminate
        Error -> terminate
    }
}
"#,
    );
    place.afpc("run p.afp --log a.mcap --svg none").succeeds();
    let said = place.afpc("log a.mcap");
    said.succeeds();
    let row = |path: &str| {
        let mut lines = said.out.lines().skip_while(|line| !line.starts_with("element"));
        let row = lines.find(|line| line.starts_with(path)).unwrap_or_default();
        row.split_whitespace().map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(row("late "), ["late", "0", "0", "1", "0.000", "s"], "{}", said.out);
    assert_eq!(row("watched.over")[..4], ["watched.over", "0", "0", "1"], "{}", said.out);
}

#[test]
fn the_plan_of_a_log_is_drawn_with_its_usage() {
    let place = place();
    place.afpc("log a.mcap --coverage cover.svg --svg path.png").succeeds();
    let drawing = place.read("cover.svg");
    assert!(drawing.contains("TouchSensorPressed  ×1"), "{drawing}");
    assert!(place.bytes("path.png").starts_with(b"\x89PNG"));
    place.afpc("log a.mcap --coverage cover.gif").fails(2, &["neither an SVG nor a PNG"]);
}

#[test]
fn pictures_show_the_first_and_the_last_position_of_pushed_objects() {
    let place = Place::new();
    let push = "actor go: Forward(distance = 2 m) { ForwardSuccessful -> terminate }";
    place.write("push.afp", &format!("use carbot\nplan Push {{ start go {push} }}\n"));
    let world = "version = 1\nrobot = { pose_m_deg = [0.6, 1, 0] }\n[[wall]]\n\
        points_m = [[0, 0], [5, 0], [5, 2], [0, 2]]\nclosed = true\n[[box]]\nname = \"carton\"\n\
        pose_m_deg = [1.6, 1, 0]\nsize_m = [0.3, 0.3]\nheight_m = 0.3\nmass_kg = 0.5\n";
    place.write("push.toml", world);
    place.afpc("run push.afp --world push.toml --log a.mcap --svg a.svg").succeeds();
    place.afpc("log a.mcap --svg b.svg").succeeds();
    let things = |picture: &str| -> Vec<String> {
        let text = place.read(picture);
        let shown =
            text.lines().filter(|it| it.contains("class=\"high") || it.contains(">carton<"));
        shown.map(str::to_owned).collect()
    };
    let (run, log) = (things("a.svg"), things("b.svg"));
    assert_eq!(run, log);
    let began = run.iter().filter(|line| line.contains("\"high began\"")).count();
    assert_eq!(
        (began, run.len()),
        (1, 1 + 4 + 1 + 1),
        "where it began, walls, where it ended, its name"
    );
}

#[test]
fn echoes_and_camera_pictures_are_drawn() {
    let place = Place::with_plan();
    let run = "run wall_following.afp --until 1s --camera --log a.mcap --svg none";
    place.afpc(run).succeeds();
    place.afpc("log a.mcap --sonar map.svg --film film.svg").succeeds();
    let map = place.read("map.svg");
    assert!(map.matches("class=\"echo true\"").count() > 10, "{map}");
    assert!(map.contains("echo, from the robot's position") && map.contains("drift"), "{map}");
    let film = place.read("film.svg");
    // Two pictures a second.
    assert_eq!(film.matches("data:image/png;base64,iVBORw0KGgo").count(), 2);
    assert!(film.contains("searchFirstWall") && film.contains("2 pictures of the camera"));
    place.afpc("log a.mcap --film film.png").succeeds();
    assert!(place.bytes("film.png").starts_with(b"\x89PNG"));
    assert!(place.afpc("log a.mcap info").succeeds().out.contains("foxglove.CompressedImage"));
}

#[test]
fn a_log_without_camera_pictures_explains_the_camera_option() {
    let place = place();
    place
        .afpc("log a.mcap --film film.svg")
        .fails(2, &["the log has no camera pictures", "afpc run plan.afp --camera --log run.mcap"]);
    assert!(!place.exists("film.svg"));
    let nowhere = place.afpc("run wall_following.afp --camera --log none");
    nowhere.fails(2, &["'--camera' logs the camera's pictures, and there is no log"]);
    place.afpc("run wall_following.afp --until 5ms --log b.mcap --svg none").succeeds();
    place
        .afpc("log b.mcap --sonar map.svg")
        .fails(2, &["the log has no echoes", "something in reach of the range sensor"]);
    assert!(!place.exists("map.svg"));
}

#[test]
fn facts_are_enough_to_repeat_a_run() {
    let place = place();
    let said = place.afpc("log a.mcap info");
    said.succeeds();
    for text in [
        "plan  WallFollowing",
        "seed  0",
        "physics_step_ns  5000000",
        "whole  yes",
        "/tf",
        "foxglove.LaserScan",
        "attachment  wall_following.afp",
    ] {
        assert!(said.out.contains(text), "no {text:?} in {}", said.out);
    }
    assert_eq!(place.afpc("log a.mcap doctor").succeeds().out, "sound\n");
}

#[test]
fn a_log_that_was_cut_short_is_saved() {
    let place = place();
    let bytes = fs::read(place.path("a.mcap")).unwrap();
    fs::write(place.path("b.mcap.part"), &bytes[..bytes.len() * 2 / 3]).unwrap();
    let said = place.afpc("log b.mcap.part");
    said.succeeds();
    assert!(said.err.starts_with("warning: 'b.mcap.part' is incomplete: "), "{}", said.err);
    let sick = place.afpc("log b.mcap.part doctor");
    assert_eq!(sick.code, 1, "{sick:#?}");
    let said = place.afpc("log b.mcap.part recover");
    said.succeeds();
    assert_eq!(said.out.lines().last(), Some("b.recovered.mcap"));
    assert_eq!(place.afpc("log b.recovered.mcap doctor").succeeds().out, "sound\n");
    let again = place.afpc("run --again b.recovered.mcap --log none --svg none");
    again.succeeds();
    let missed = "'b.recovered.mcap' is incomplete: it was recovered, and lacks the messages from ";
    assert!(again.err.contains(missed) && !again.err.contains("trace"), "{}", again.err);
    place.afpc("log a.mcap recover -o a.mcap").fails(2, &["into itself"]);
}

#[test]
fn a_file_that_is_not_a_log_is_refused() {
    let place = Place::with_plan();
    place.afpc("log wall_following.afp").fails(
        1,
        &["'wall_following.afp' is not an MCAP log", "help: name a file that a run wrote"],
    );
    place
        .afpc("log missing.mcap info")
        .fails(1, &["cannot read the log 'missing.mcap'", "help: check the path"]);
    place.afpc("log a.mcap burn").fails(2, &["burn"]);
}

#[test]
fn a_log_of_another_program_is_reported() {
    let place = Place::with_plan();
    let magic = b"\x89MCAP0\r\n";
    let record =
        |code: u8, body: &[u8]| [&[code], &(body.len() as u64).to_le_bytes()[..], body].concat();
    let bytes =
        [&magic[..], &record(1, &[0; 8]), &record(15, &[0; 4]), &record(2, &[0; 20]), magic]
            .concat();
    std::fs::write(place.path("foreign.mcap"), bytes).unwrap();
    let why = "'foreign.mcap' is not the log of an AFP run";
    for words in [
        "log foreign.mcap",
        "log foreign.mcap --svg a.svg",
        "log foreign.mcap --sonar a.svg",
        "log foreign.mcap --film a.svg",
        "log foreign.mcap --coverage a.svg",
        "run --again foreign.mcap",
    ] {
        place.afpc(words).fails(1, &[why, "help: name a file that a run wrote"]);
    }
    assert!(!place.exists("a.svg"));
    assert!(place.afpc("log foreign.mcap info").succeeds().out.contains("whole  yes"));
}

#[test]
fn useless_or_misplaced_arguments_are_reported() {
    let place = Place::with_plan();
    place.afpc("run wall_following.afp --until 100ms --log a.mcap --svg none").succeeds();
    for action in ["", "info", "doctor"] {
        let said = place.afpc(&format!("log a.mcap {action} -o other.mcap"));
        said.fails(2, &["'-o' is only for 'recover'", "'--svg'"]);
        if !action.is_empty() {
            let said = place.afpc(&format!("log {action} a.mcap"));
            said.fails(
                2,
                &["must follow the log's name", &format!("write 'afpc log a.mcap {action}'")],
            );
        }
    }
}
