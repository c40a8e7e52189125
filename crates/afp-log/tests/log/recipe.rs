//! Recipes of runs in logs.

use afp_core::Duration;
use afp_log::robot::Pose2;
use afp_log::{About, LogData, Recorder, Signal, WhenFull, doctor, read};
use afp_session::{
    Build, Datum, Done, NameWithUnit, Put, Recipe, Report, Requested, RunEvent, Stimulus, TextFile,
};

use super::{Names1, at};

fn requests_of_each_kind() -> Vec<Stimulus> {
    let control = "touch.touch".to_owned();
    let outputs = vec![(1, Datum::Choice("#2".to_owned())), (2, Datum::Float(0.1))];
    let (component, outcome) = ("go.touch".to_owned(), "TouchSensorPressed");
    let report = |outcome: &str, ends| Report { outcome: outcome.to_owned(), ends };
    let with_unit =
        |name: &str, unit: &str| NameWithUnit { name: name.to_owned(), unit: unit.to_owned() };
    vec![
        Stimulus::Write(with_unit("side", ""), Datum::Choice("Side.right".to_owned())),
        Stimulus::Press(control.clone(), true),
        Stimulus::Press(control, false),
        Stimulus::Break(with_unit("wheels.slip", "s"), Some(0.2), Duration::MAX),
        Stimulus::Break(with_unit("wheels.slip", ""), None, Duration::from_millis(1)),
        Stimulus::Inject(component.clone(), report(outcome, false), outputs.clone()),
        Stimulus::Inject(component, report(outcome, true), outputs),
        Stimulus::Idle(None),
        Stimulus::Idle(Some("go".to_owned())),
        Stimulus::Put(Put::Robot, Pose2 { x: 0.5, y: -1.0, heading: 0.1 }),
        Stimulus::Put(Put::Thing("box 1".to_owned()), Pose2::default()),
        Stimulus::Put(Put::New("crate".to_owned()), Pose2::default()),
        Stimulus::Stop,
    ]
}

#[test]
fn a_recipe_is_read_back_unchanged() {
    let text = |name: &str, text: &str| TextFile { name: name.to_owned(), text: text.to_owned() };
    let requests = requests_of_each_kind();
    let recipe = Recipe {
        plan: "Walk".to_owned(),
        file: "plans/walk.afp".to_owned(),
        texts: ["plans/walk.afp", "zeta.afp", "toolbox/a.afp", "afp.toml"]
            .map(|it| text(it, "plan A {}"))
            .into(),
        toolboxes: vec![text("gripper", "actor Grip {}")],
        project: "[run]\n".to_owned(),
        robot: "sim".to_owned(),
        world: text("room", "name = \"room\""),
        start: Some(Pose2 { x: 0.1, y: -1.0 / 3.0, heading: 2.5 }),
        seed: u64::MAX,
        measures: vec!["wall".to_owned()],
        settings: (0..12).map(|n| (format!("side{n}"), "right\nhand=1".to_owned())).collect(),
        until: Some(at(60_000)),
        requests: requests.iter().map(|what| (at(1), what.clone())).collect(),
        build: Build { version: "0.1.0".to_owned(), commit: Some("abc".to_owned()) },
    };
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let names = Box::new(Names1);
    let mut log = Recorder::create(&path, &About::new(&recipe), names, WhenFull::Wait).unwrap();
    let become_ = [Done::Done, Done::Refused("it is gone".to_owned()), Done::NotReached];
    for (what, done) in requests.iter().zip(become_.iter().cycle()) {
        let request = Requested { at: at(1), what: what.clone(), done: done.clone() };
        log.event(RunEvent::requested(at(2), request));
    }
    let signal = Signal { device: "battery", name: "left", unit: "" };
    log.sample(at(3), signal, Datum::Float(0.5));
    log.end(at(4), vec![("trace".to_owned(), "12ab".to_owned())]);
    log.finish().unwrap();
    let log = read(&path).unwrap();
    assert!(log.has_world());
    assert_eq!(log.recipe(), recipe);
    assert_eq!(log.not_reached().count(), 4);
    assert_eq!(log.events[1].facts().request.unwrap().done, become_[1]);
    assert_eq!(log.samples["battery/left"], [(at(3), Datum::Float(0.5))]);
    assert_eq!(log.topics["/robot/battery/left"].schema, "afp.Sample");
    assert_eq!(log.end["trace"], "12ab");
    assert_eq!(doctor(&path).unwrap(), [""; 0]);
}

#[test]
fn the_settings_of_an_older_log_are_read() {
    let facts = [("set".to_owned(), "side=right\nfar=0.3 m".to_owned())].into();
    let settings = LogData { facts, ..LogData::default() }.recipe().settings;
    let expected = [("side", "right"), ("far", "0.3 m")];
    assert_eq!(settings, expected.map(|(name, value)| (name.to_owned(), value.to_owned())));
}
