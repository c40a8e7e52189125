//! Valid and invalid project files.

use super::read;
use crate::project::{Origin, Project};

#[test]
fn a_whole_file_is_read() {
    let text = "\
[run]
world = 'w.toml'
measures = ['wall']

[toolboxes]
b = { path = 'b.afp' }
a.path = 'a.afp'
a.crate = { git = 'https://x', package = 'aa', module = 'm' }
c = { path = 'c.afp', crate = 'cc' }

[target.pi]
capacity = 0.5
[target.toy]
tick = '2 ms'
slowdown = 20
budgets.carbot.Forward = '30 us'
[target.toy.budgets.a]
Grip = '1 ms'

[afp]
version = '0.1'
";
    let (project, mistakes) = read(text);
    assert_eq!(mistakes, []);
    assert_eq!(project.world.as_deref(), Some("w.toml"));
    assert_eq!(project.measures, ["wall"]);
    assert_eq!(project.afp, Some(Origin::Version("0.1".to_owned())));
    let names: Vec<_> = project.toolboxes.iter().map(|toolbox| &*toolbox.name).collect();
    assert_eq!(names, ["b", "a", "c"]);
    let krate = &project.toolboxes[1].krate;
    assert_eq!(krate.origin, Some(Origin::Git("https://x".to_owned())));
    assert_eq!((krate.package.as_deref(), krate.module.as_deref()), (Some("aa"), Some("m")));
    assert_eq!(project.toolboxes[2].krate.package.as_deref(), Some("cc"));
    let [pi, toy] = &project.targets[..] else { panic!("{:?}", project.targets) };
    assert_eq!((pi.tick, pi.capacity), (None, Some(0.5)));
    assert_eq!((toy.tick, toy.capacity), (Some(2_000_000), None));
    assert_eq!((pi.slowdown, toy.slowdown), (None, Some(20.0)));
    assert_eq!((toy.budgets["carbot"]["Forward"], toy.budgets["a"]["Grip"]), (30_000, 1_000_000));
    assert_eq!(read("").0, Project::default());
}

/// The texts at the errors.
fn wrong(text: &str) -> Vec<&str> {
    let (_, mistakes) = read(text);
    for mistake in &mistakes {
        assert!(!mistake.message.is_empty() && !mistake.message.contains('\n'), "{mistake}");
    }
    mistakes.iter().map(|mistake| &text[mistake.span.clone().unwrap()]).collect()
}

#[test]
fn all_errors_are_reported_at_their_places() {
    assert_eq!(wrong("run = 3\n[rum]\n[afp]\npaht = 1"), ["3", "rum", "paht"]);
    assert_eq!(wrong("[run]\nworlds = 'x'\nworld = 7"), ["worlds", "7"]);
    assert_eq!(wrong("[run]\nmeasures = 'wall'"), ["'wall'"]);
    assert_eq!(wrong("[run]\nmeasures = [1]"), ["[1]"]);
    assert_eq!(wrong("[toolboxes]\na = 1\nb = {}\nc = { crate = 'x' }"), ["1", "b", "c"]);
    assert_eq!(wrong("[toolboxes]\na = { path = 'x', crate = 3 }"), ["3"]);
    assert_eq!(wrong("[toolboxes]\na = { path = '', krate = 'x' }"), ["''", "krate"]);
    assert_eq!(wrong("[toolboxes]\na.path = 'x'\na.crate = { git = 1, nam = 2 }"), ["1", "nam"]);
    assert_eq!(wrong("[afp]\npath = 'x'\ngit = 'y'"), ["afp"]);
}

#[test]
fn an_error_of_a_target_is_reported_at_its_place() {
    assert_eq!(wrong("[target.a]\ntock = 1"), ["tock"]);
    assert_eq!(wrong("[target.a]\ntick = 1"), ["1"]);
    assert_eq!(wrong("[target.a]\ntick = \"0 s\""), ["\"0 s\""]);
    assert_eq!(wrong("[target.a]\ntick = \"3 cm\""), ["\"3 cm\""]);
    assert_eq!(wrong("[target.a]\ncapacity = 1.5\ntick = 1"), ["1.5", "1"]);
    assert_eq!(wrong("[target.a]\nslowdown = 0"), ["0"]);
    assert_eq!(wrong("[target.a]\nslowdown = inf"), ["inf"]);
    assert_eq!(wrong("[target.a]\nbudgets = 3"), ["3"]);
    assert_eq!(wrong("[target.a.budgets]\nForward = '1 ms'"), ["'1 ms'"]);
    assert_eq!(wrong("[target.a.budgets.b]\nForward = 1"), ["1"]);
    assert_eq!(wrong("[target]\na = 3"), ["3"]);
    assert_eq!(wrong("target = 3"), ["3"]);
}

#[test]
fn any_text_is_read_without_a_panic() {
    for text in ["[", "a = ", "[a]\n[a]", "\u{0}", "run.world.x = 1", "[[toolboxes]]\na = 1"] {
        let (_, mistakes) = read(text);
        assert!(!mistakes.is_empty(), "{text:?}");
        for mistake in mistakes {
            let place = mistake.span.clone().and_then(|span| text.get(span));
            assert!(place.is_some(), "{text:?}: {mistake:?}");
        }
    }
}

#[test]
fn a_robot_is_read_with_its_toolbox_above_or_below() {
    let of = |text: &str| {
        let (project, mistakes) = read(text);
        assert_eq!(mistakes, []);
        let robot = project.robot.unwrap();
        (robot.toolbox, robot.sim, robot.krate.and_then(|krate| krate.origin))
    };
    let vacuum = Some("vacuum".to_owned());
    let text =
        "[robot]\ntoolbox = 'vacuum'\nsim = 'sim::Vacuum'\n[toolboxes]\nvacuum.path = 'v.afp'";
    assert_eq!(of(text), (vacuum, Some("sim::Vacuum".to_owned()), None));
    let text = "[robot]\nsim = 'Toy'\ncrate = { path = 'toy' }";
    assert_eq!(of(text), (None, Some("Toy".to_owned()), Some(Origin::Path("toy".to_owned()))));
    assert_eq!(read("[run]").0.robot, None);
}

#[test]
fn the_real_robot_is_read_in_one_line_or_in_a_table() {
    let of = |text: &str| {
        let (project, mistakes) = read(text);
        assert_eq!(mistakes, []);
        project
            .robot
            .and_then(|robot| robot.hardware)
            .map(|itself| (itself.ty, itself.krate.and_then(|krate| krate.origin), itself.settings))
    };
    let board = Some(Origin::Path("board".to_owned()));
    let line = "[robot]\nsim = 'V'\nhardware = { type = 'Board', crate = { path = 'board' } }";
    assert_eq!(of(line), Some(("Board".to_owned(), board, Vec::new())));
    let table = "[robot]\nsim = 'V'\n[robot.hardware]\ntype = 'b::Board'\n[robot.hardware.settings]\n\
                 port = '/dev/ttyUSB0'\nbaud = 9600\nscale = 0.5\necho = true";
    let settings = [("port", "/dev/ttyUSB0"), ("baud", "9600"), ("scale", "0.5"), ("echo", "true")];
    let settings = settings.map(|(name, value)| (name.to_owned(), value.to_owned())).to_vec();
    assert_eq!(of(table), Some(("b::Board".to_owned(), None, settings)));
    assert_eq!(of("[robot]\nsim = 'V'"), None);
}

#[test]
fn an_error_of_the_robot_is_reported_at_its_place() {
    let hardware = |text: &str| format!("[robot]\nsim = 'V'\nhardware = {text}");
    let wrong_in = |text: &str| wrong(hardware(text).leak()).join(" ");
    assert_eq!(wrong_in("3"), "3");
    assert_eq!(wrong_in("{ crate = 'b' }"), "hardware");
    assert_eq!(wrong_in("{ type = 'a b' }"), "'a b'");
    assert_eq!(wrong_in("{ type = 'B', port = 3 }"), "port");
    assert_eq!(wrong_in("{ type = 'B', settings = { port = [1] } }"), "[1]");
}

#[test]
fn settings_of_the_control_loop_are_read_and_errors_are_at_their_place() {
    let robot = |text: &str| format!("[robot]\nsim = 'V'\n[robot.realtime]\n{text}");
    let (project, mistakes) = read(&robot("stall = '50 ms'"));
    assert_eq!(mistakes, []);
    assert_eq!(project.robot.unwrap().realtime, [("stall".to_owned(), "50 ms".to_owned())]);
    assert_eq!(wrong(robot("stall = 100\nstal = '1 s'").leak()), ["100", "stal"]);
    let (_, mistakes) = read(&robot("stall = '1 h'"));
    assert_eq!(mistakes[0].help, "write a time from 1 ms to 10 s, such as \"100 ms\"");
}

#[test]
fn an_error_of_a_robot_type_is_reported_at_its_place() {
    assert_eq!(wrong("[robot]\ntoolbox = 'v'\nsim = 'V'"), ["'v'"]);
    assert_eq!(wrong("[robot]\ncrate = 'v'"), ["robot"]);
    assert_eq!(wrong("[robot]\nsim = 'a b'"), ["'a b'"]);
    assert_eq!(wrong("[robot]\nsim = 'a::'\nsom = 1"), ["'a::'", "som"]);
    assert_eq!(wrong("robot = 3"), ["3"]);
    let (_, mistakes) = read("[robot]\nsim = 'V'\ntoolbox = 'v'\n[toolboxes]\nw.path = 'w.afp'");
    assert_eq!(mistakes[0].help, "write 'w'");
}

#[test]
fn hidden_characters_are_reported() {
    let separator = '\u{2028}';
    assert_eq!(wrong("# a comment\u{2028}[run]\n"), [separator.to_string()]);
    assert_eq!(wrong("[run]\nworld = 'a\u{202e}b'\n"), ["\u{202e}"]);
    assert_eq!(wrong("[run]\r\nworld = 'a'\r\n"), <[&str; 0]>::default());
}

/// A robot from parts, without the last lines of its tables.
const PARTS: &str = "\
[robot]
profile = 'carbot'
realtime.stall = '50 ms'
[robot.body]
length = '24 cm'
width = '18 cm'
[robot.drive]
track = '14 cm'
wheel_diameter = '65 mm'
ticks = 1440
fastest = '50 cm/s'
";

#[test]
fn a_profile_describes_a_robot_with_defaults_and_missing_parts() {
    let (project, mistakes) = read(&format!("{PARTS}[robot.bumper]\n"));
    assert_eq!(mistakes, []);
    let robot = project.robot.unwrap();
    assert_eq!((robot.sim.as_ref(), robot.realtime.len()), (None, 1));
    let settings = robot.profile_settings().unwrap();
    let value = |name: &str| {
        settings.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    };
    assert_eq!((value("port"), value("realtime.stall")), (Some("/dev/ttyACM0"), Some("50 ms")));
    assert_eq!((value("bumper.closed"), value("button.closed")), (Some("free"), None));
    let parts = robot.profile.unwrap();
    assert_eq!(
        (parts.number("drive.track"), parts.number("drive.ticks")),
        (Some(0.14), Some(1440.0))
    );
    assert_eq!((parts.number("drive.ramp"), parts.number("drive.x")), (Some(0.15), None));
    let lacks = parts.lacks();
    assert!(lacks.contains(&"camera") && lacks.contains(&"rotator") && lacks.contains(&"buttons"));
    assert!(!lacks.contains(&"touch"));
}

#[test]
fn an_error_of_a_profile_is_reported_at_its_place() {
    assert_eq!(wrong("[robot]\nprofile = 'carbott'"), ["'carbott'"]);
    assert_eq!(wrong("[robot]\nprofile = 3"), ["3"]);
    let with = |more: &str| format!("{PARTS}{more}");
    assert_eq!(wrong(&with("trak = 3\n")), ["trak"]);
    assert_eq!(wrong(&with("ramp = '2 s'\n")), ["'2 s'"]);
    assert_eq!(wrong(&with("[robot.bumper]\nclosed = 'open'\n")), ["'open'"]);
    assert_eq!(wrong(&with("[robot.bumpr]\n")), ["bumpr"]);
    assert_eq!(wrong(&with("[robot.ultrasonic]\n")), ["ultrasonic"]);
    assert_eq!(wrong(&PARTS.replace("ticks = 1440\n", "")), ["drive"]);
    let sim = PARTS.replace("realtime.stall = '50 ms'", "sim = 'Vacuum'\nport = 7");
    assert_eq!(wrong(&sim), ["sim"]);
    // Both tables are missing.
    assert_eq!(wrong("[robot]\nprofile = 'carbot'"), ["'carbot'", "'carbot'"]);
    assert_eq!(wrong("[robot]\ntoolbox = 'v'\n[toolboxes]\nv.path = 'v.afp'"), ["robot"]);
}
