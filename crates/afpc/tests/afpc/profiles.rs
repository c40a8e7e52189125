//! Each profile, from a new project to a robot, on a machine that has only the command line.

use std::path::Path;

use crate::calibrate::Ugv;
use crate::common::{Place, Said, said};
use crate::profile::Running;
use crate::wired::rig::Rig;

const PROFILES: [&str; 4] = ["carbot", "pi", "ugv", "picarx"];

/// Runs a command in a folder, with an empty environment: no other program is found.
fn alone(place: &Place, folder: &str, arguments: &str) -> Said {
    let mut command = place.command();
    command.env_clear().env("HOME", place.path("home")).env("PATH", "");
    command.current_dir(place.path(folder)).args(arguments.split_whitespace());
    said(command.output().unwrap())
}

#[test]
fn every_profile_gets_from_a_new_project_to_a_robot_with_only_the_program() {
    for profile in PROFILES {
        let place = Place::new();
        let made = alone(&place, ".", &format!("new mycar --profile {profile}"));
        made.succeeds();
        assert!(made.out.contains("--robot hardware"), "{}", made.out);
        let here = |arguments: &str| alone(&place, "mycar", arguments);
        here("check plans/mycar.afp").succeeds();
        here("graph plans/mycar.afp").succeeds();
        here("run plans/mycar.afp --until 10s").succeeds();
        let tested = here("test");
        tested.succeeds();
        assert!(tested.out.contains(" 0 failed"), "{profile}: {}", tested.out);
        // On a busy machine the program and the imitation may lose each other.
        let drove = (0..5).any(|turn| drives(profile, &place, turn));
        assert!(drove, "{profile}: no run of five drove the robot");
    }
}

/// Runs the plan on an imitation of the robot; returns whether it drove. The motors are off
/// afterwards.
fn drives(profile: &str, place: &Place, turn: u32) -> bool {
    let run = |key: &str, value: &str| {
        // A busy machine is no fault of the robot.
        let set = format!("--set robot.realtime.stall=10s --set robot.{key}={value}");
        alone(place, "mycar", &format!("run plans/mycar.afp --robot hardware {set} --until 3s"))
    };
    let moved = |ways: [f64; 2]| ways.iter().all(|way| *way > 0.05);
    match profile {
        "carbot" => {
            let controller = Running::start(|_| {});
            let ran = run("port", &controller.port);
            controller.with(|fake| {
                assert!(fake.controller.is_stopped() && !fake.is_moving(), "{ran:?}");
                ran.code == 0 && moved(fake.ways.map(f64::from))
            })
        }
        "ugv" => {
            let robot = Ugv::start();
            let ran = run("port", &robot.port);
            let fake = robot.fake.lock().unwrap();
            ran.code == 0 && moved(fake.ways) && fake.speeds == [0.0; 2]
        }
        _ => {
            let path = place.path(&format!("rig{turn}"));
            let rig = Rig::start(&path, [1.0, 1.0, 0.0]).unwrap();
            let ran = run("chip", &path.display().to_string());
            let state = rig.state();
            ran.code == 0 && moved(state.ways) && !state.enabled.0
        }
    }
}

#[test]
fn the_drawing_of_the_wires_has_the_rows_of_the_table() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/images");
    for profile in PROFILES {
        let place = Place::new();
        place.afpc(&format!("new mycar --profile {profile}")).succeeds();
        let table = alone(&place, "mycar", "robot wiring").succeeds().out.clone();
        alone(&place, "mycar", "robot wiring -o wiring.svg").succeeds();
        let svg = place.read("mycar/wiring.svg");
        let drawn = texts(&svg, "pin").into_iter().zip(texts(&svg, "at"));
        let rows = table.lines().map(cells);
        assert!(drawn.eq(rows.clone().map(|row| (row[1].clone(), row[3].clone()))), "{table}");
        let notes: Vec<_> = rows.clone().filter_map(|row| row.get(4).cloned()).collect();
        assert_eq!(texts(&svg, "note"), notes);
        let mut names: Vec<_> = rows.flat_map(|row| [row[0].clone(), row[2].clone()]).collect();
        let mut boxes = texts(&svg, "name");
        for list in [&mut names, &mut boxes] {
            list.sort();
            list.dedup();
        }
        assert_eq!(boxes, names);
        for line in lines_of(&place.read("mycar/afp.toml")) {
            assert!(table.contains(&format!("GPIO {line} (")), "{profile}: {line}\n{table}");
        }
        let known = docs.join(format!("wiring-{profile}.svg"));
        if std::env::var_os("AFP_BLESS").is_some() {
            std::fs::write(&known, &svg).unwrap();
        }
        let known = std::fs::read_to_string(&known).unwrap();
        assert!(known == svg, "AFP_BLESS=1 writes docs/images/wiring-{profile}.svg");
    }
}

#[test]
fn an_l298n_has_its_own_pins_and_a_servo_may_have_one() {
    let place = Place::new();
    place.afpc("new mycar --profile pi").succeeds();
    let text = place.read("mycar/afp.toml").replace("\"tb6612\"", "\"l298n\"");
    place.write("mycar/afp.toml", &text.replace("pwmchip1/0", "pwmchip0/1"));
    let text = place.read("mycar/afp.toml").replacen("pwmchip0/1", "pwmchip2/0", 1);
    place.write("mycar/afp.toml", &text);
    let table = alone(&place, "mycar", "robot wiring").succeeds().out.clone();
    let has = |pin: &str, at: &str| {
        table.lines().map(cells).any(|row| row[1].starts_with(pin) && row[3] == at)
    };
    assert!(has("GPIO 12", "ENA") && has("channel 0", "ENB") && has("GPIO 25", "gate"), "{table}");
    assert!(has("GPIO 13", "signal") && !table.contains("STBY"), "{table}");
}

/// The Pico's program, the table and the book name the same pins. One more selects the motor driver.
#[test]
fn the_pico_has_the_pins_of_the_table() {
    let place = Place::new();
    place.afpc("new mycar --profile carbot").succeeds();
    let table = alone(&place, "mycar", "robot wiring").succeeds().out.clone();
    let program = concat!(env!("CARGO_MANIFEST_DIR"), "/../../firmware/drive/src/bin/pico.rs");
    let program = std::fs::read_to_string(program).unwrap();
    let numbers = |text: &str, before: &str| {
        let found = text.split(before).skip(1).filter_map(|rest| {
            rest.split(|c: char| !c.is_ascii_digit()).next()?.parse::<u32>().ok()
        });
        let mut found: Vec<u32> = found.collect();
        found.sort_unstable();
        found.dedup();
        found
    };
    let mut wired = numbers(&table, "  GP");
    wired.push(9);
    wired.sort_unstable();
    assert_eq!(numbers(&program, "p.PIN_"), wired);
    let book = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/robot-from-parts.md");
    let book = std::fs::read_to_string(book).unwrap();
    for row in table.lines().map(cells).filter(|row| row[1].starts_with("GP")) {
        let line = book.lines().find(|line| line.starts_with("| GP") && line.contains(&row[1]));
        assert!(
            line.is_some_and(|line| line.contains(row[3].split(' ').next_back().unwrap())),
            "{row:?}"
        );
    }
}

/// The texts of a class, in order.
fn texts(svg: &str, class: &str) -> Vec<String> {
    let start = format!("<text class=\"{class}\"");
    let text = |rest: &str| {
        let (_, text) = rest.split_once('>')?;
        Some(text.split_once('<')?.0.to_owned())
    };
    svg.split(&start).skip(1).filter_map(text).collect()
}

/// The cells of a line of the table.
fn cells(line: &str) -> Vec<String> {
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_owned).collect()
}

/// The lines of the GPIO chip in a project file.
fn lines_of(toml: &str) -> Vec<u32> {
    let keys = ["in", "encoder", "line", "trigger", "echo", "pin"];
    let values = toml.lines().filter_map(|line| line.split_once(" = "));
    let values = values.filter(|(key, _)| keys.contains(key));
    let numbers = values.flat_map(|(_, value)| value.trim_matches(['[', ']']).split(", "));
    numbers.filter_map(|number| number.parse().ok()).collect()
}
