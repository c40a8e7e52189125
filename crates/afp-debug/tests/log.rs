//! A log is debugged like its run.

mod common;

use std::sync::Arc;

use afp_core::{Duration, Instant};
use afp_debug::{Host, Launch, LogTarget, Target};
use afp_log::{About, LogData, Recorder, SessionLog, WhenFull};
use afp_session::{EventKind, Miss, Open, Request, RunEvent};
use common::{Clients, Texted, compiled, session};

/// A plan's text and the file of a log of it.
struct Recorded(String, LogData);

impl Host<'static> for Recorded {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target>, String> {
        let (_, program) = compiled(&self.0, launch.log.as_deref().unwrap_or_default())?;
        Ok(Box::new(LogTarget::new(Arc::new(program), self.1.events.clone())?))
    }

    fn path(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// Runs a plan for some seconds with a log; the bumper may be pressed.
fn recorded(text: &str, name: &str, seconds: u64, press: Option<Duration>) -> LogData {
    let (graph, _) = compiled(text, name).expect("the plan is sound");
    let mut session = session(&graph, &Launch::default()).expect("a session");
    let path = tempfile::tempdir().expect("a folder").keep().join("run.mcap");
    let names = session.owned_names();
    let recorder = Recorder::create(&path, &About::default(), names, WhenFull::Wait);
    let mut log = SessionLog::new(recorder.expect("a log"), session.devices(), Vec::new(), false);
    if let Some(after) = press {
        let button = afp_core::devices::find_control(session.devices(), "touch.touch");
        let request = Request::Press(button.expect("a button"), true);
        session.at(Instant::ZERO + after, request).expect("it can be pressed");
    }
    let end = Instant::ZERO + Duration::from_secs(seconds);
    session.run(end, &mut Open, &mut [&mut log]).expect("it starts");
    session.stop(&mut [&mut log]);
    log.finish(&*session).expect("it is written");
    let read = afp_log::read(&path).expect("it is read");
    std::fs::remove_dir_all(path.parent().expect("a folder")).expect("it is removed");
    read
}

/// Words of the plans with their lines: entries, elements, ports, supervisors, events.
const WORDS: [(u32, &str); 8] = [
    (40, "walldist"),
    (40, "searchFirstWall"),
    (12, "pause"),
    (12, "light"),
    (14, "duration"),
    (14, "left"),
    (40, "touch"),
    (16, "Elapsed"),
];

/// A client's view of a stopped run.
fn look(client: &mut Clients) -> String {
    client.told.clear();
    client.say("threads");
    client.say(r#"stackTrace {"threadId":1}"#);
    for frame in 1..40 {
        client.say(&format!(r#"scopes {{"frameId":{frame}}}"#));
    }
    for group in 1..320 {
        client.say(&format!(r#"variables {{"variablesReference":{group}}}"#));
    }
    for (line, word) in WORDS {
        let place = format!(r#""source":{{"path":"plan.afp"}},"line":{line}"#);
        client.say(&format!(r#"evaluate {{"expression":"{word}","context":"hover",{place}}}"#));
    }
    // Only a run can be changed.
    std::mem::take(&mut client.told)
}

/// The lines of the events, by time.
fn happened(told: &str) -> Vec<&str> {
    told.lines().filter(|line| line.contains(r#""category":"console""#)).collect()
}

const SHIPPED: &str = include_str!("../../../plans/wall_following.afp");

fn plans() -> [(String, &'static str, u64); 4] {
    let case = |text: &str| text.split_once("\n---\n").expect("a plan and a talk").0.to_owned();
    [
        (case(include_str!("dap/conditions.txt")), "plan.afp:Blink", 10),
        (case(include_str!("dap/nested.txt")), "plan.afp:Outer", 6),
        (case(include_str!("dap/breakpoints.txt")), "plan.afp", 8),
        (SHIPPED.to_owned(), "plan.afp", 20),
    ]
}

#[test]
fn a_log_shows_the_same_as_its_run() {
    for (text, name, seconds) in plans() {
        let log = recorded(&text, name, seconds, None);
        let mut run = Clients::new(Box::new(Texted(text.clone())));
        let mut past = Clients::new(Box::new(Recorded(text, log)));
        for (client, launch) in [
            (&mut run, format!(r#"{{"program":"{name}","until":{seconds},"stopOnEntry":true}}"#)),
            (&mut past, format!(r#"{{"log":"{name}","stopOnEntry":true}}"#)),
        ] {
            client.say(r#"initialize {"adapterID":"afp"}"#);
            client.say(&format!("launch {launch}"));
            client.say("configurationDone");
        }
        run.say(r#"afp/fault {"fault":"nothing"}"#);
        let mut stops = 0;
        loop {
            run.told.clear();
            past.told.clear();
            run.say(r#"stepIn {"threadId":1}"#);
            past.say(r#"stepIn {"threadId":1}"#);
            run.tick(None);
            past.tick(None);
            let [one, other] = [&run, &past].map(|client| happened(&client.told).join("\n"));
            if run.told.contains("event terminated") {
                assert_eq!(one, other, "{name}");
                break;
            }
            assert_eq!(one, other, "{name}");
            assert_eq!(look(&mut run), look(&mut past), "{name}");
            stops += 1;
        }
        assert!(stops > 3, "{name} stood still {stops} times only");
    }
}

#[test]
fn a_log_can_be_searched_but_not_changed() {
    let log = recorded(SHIPPED, "plan.afp", 12, Some(Duration::from_secs(3)));
    let mut past = Clients::new(Box::new(Recorded(SHIPPED.to_owned(), log)));
    past.say(r#"initialize {"adapterID":"afp"}"#);
    past.say(r#"launch {"log":"plan.afp","until":3}"#);
    assert!(
        past.told.contains("leave out 'world', 'start', 'seed', 'set' and 'until'"),
        "{}",
        past.told
    );
    past.say(r#"launch {"log":"plan.afp"}"#);
    assert!(past.told.contains(r#""supportsSetVariable":false"#), "{}", past.told);
    past.say(r#"setFunctionBreakpoints {"breakpoints":[{"name":"backupCollision"}]}"#);
    past.say("configurationDone");
    past.tick(None);
    assert!(past.told.contains("press touch.touch (from outside)"), "{}", past.told);
    let told = std::mem::take(&mut past.told);
    let stop = told.lines().find(|line| line.contains("event stopped")).expect("it stands still");
    assert!(stop.contains(r#""reason":"function breakpoint""#), "{stop}");
    let seen = look(&mut past);
    assert!(seen.contains("backupCollision: Forward"), "{seen}");
    for change in
        [r#"evaluate {"expression":"walldist = 20 cm"}"#, r#"afp/press {"control":"touch.touch"}"#]
    {
        past.told.clear();
        past.say(change);
        assert!(past.told.contains("refused"), "{}", past.told);
    }
    // An instant looks the same from every previous position.
    past.say(r#"afp/seek {"at":11.5}"#);
    past.tick(None);
    let late = look(&mut past);
    past.say(r#"afp/seek {"at":2}"#);
    assert_ne!(look(&mut past), late);
    past.say(r#"afp/seek {"at":11.5}"#);
    past.tick(None);
    assert_eq!(look(&mut past), late);
    past.say(r#"afp/seek {"at":1}"#);
    past.say(r#"continue {"threadId":1}"#);
    past.tick(None);
    assert_eq!(look(&mut past), seen, "the breakpoint holds again");
    past.say(r#"setFunctionBreakpoints {"breakpoints":[]}"#);
    past.say(r#"continue {"threadId":1}"#);
    past.tick(None);
    assert!(past.told.contains("the log ends at 12.000 s"), "{}", past.told);
    past.say(r#"reverseContinue {"threadId":1}"#);
    past.say(r#"continue {"threadId":1}"#);
    past.tick(None);
    past.told.clear();
    past.say(r#"continue {"threadId":1}"#);
    past.tick(None);
    assert!(past.told.contains("event terminated"), "{}", past.told);
}

#[test]
fn a_missed_deadline_stops_a_log_on_request() {
    let mut log = recorded(SHIPPED, "plan.afp", 5, None);
    // Simulated supervisors are never late, so the test changes the times.
    let polled = |event: &RunEvent| {
        event.kind == EventKind::Started && event.component.path.ends_with(".touch")
    };
    let place = log.events.iter().position(polled).expect("a supervisor starts");
    let miss = Miss { lateness: Duration::from_millis(3), cause: None, skipped: 1 };
    let missed = RunEvent { kind: EventKind::Missed(miss), ..log.events[place].clone() };
    log.events.insert(place + 1, missed);
    for wanted in [true, false] {
        let mut past = Clients::new(Box::new(Recorded(SHIPPED.to_owned(), log.clone())));
        past.say(r#"launch {"log":"plan.afp"}"#);
        let filters = if wanted { r#"["deadlineMissed"]"# } else { "[]" };
        past.say(&format!(r#"setExceptionBreakpoints {{"filters":{filters}}}"#));
        past.say("configurationDone");
        past.tick(None);
        let stop = past.told.lines().find(|line| line.contains("event stopped"));
        let stop = stop.expect("it stands still, at the latest in the end");
        assert_eq!(stop.contains(r#""reason":"exception""#), wanted, "{stop}");
        past.told.clear();
        past.say(r#"exceptionInfo {"threadId":1}"#);
        assert_eq!(
            past.told.contains(r#""exceptionId":"deadlineMissed""#),
            wanted,
            "{}",
            past.told
        );
        if wanted {
            let seen = look(&mut past);
            assert!(seen.contains(r#""name":"last lateness","value":"3.000 ms""#), "{seen}");
        }
    }
}

#[test]
fn an_incomplete_log_is_reported() {
    let mut log = recorded(SHIPPED, "plan.afp", 5, None);
    log.events.truncate(40);
    let mut past = Clients::new(Box::new(Recorded(SHIPPED.to_owned(), log)));
    past.say(r#"launch {"log":"plan.afp"}"#);
    past.say("configurationDone");
    past.tick(None);
    past.say(r#"continue {"threadId":1}"#);
    past.tick(None);
    assert!(past.told.contains("before the plan does"), "{}", past.told);
}

#[test]
fn events_out_of_order_are_sorted() {
    let mut log = recorded(SHIPPED, "plan.afp", 5, None);
    let mut heard = Vec::new();
    for turned in [false, true] {
        if turned {
            let half = Instant::ZERO + Duration::from_secs(2);
            let half = log.events.partition_point(|event| event.at < half);
            log.events.rotate_left(half);
        }
        let mut past = Clients::new(Box::new(Recorded(SHIPPED.to_owned(), log.clone())));
        past.say(r#"launch {"log":"plan.afp"}"#);
        past.say("configurationDone");
        past.tick(None);
        past.say(r#"afp/seek {"at":2}"#);
        past.tick(None);
        let seen = look(&mut past);
        past.say(r#"afp/why {"path":"searchFirstWall"}"#);
        heard.push(seen + &past.told);
    }
    assert_eq!(heard[0], heard[1]);
}

#[test]
fn a_log_of_another_plan_is_refused() {
    let log = recorded(SHIPPED, "plan.afp", 1, None);
    let other = plans()[1].0.clone();
    let mut past = Clients::new(Box::new(Recorded(other, log)));
    past.say(r#"launch {"log":"plan.afp:Outer"}"#);
    assert!(past.told.contains("but its plan no longer does"), "{}", past.told);
}

#[test]
fn a_log_cannot_be_changed() {
    let log = recorded(SHIPPED, "plan.afp", 1, None);
    let mut past = Clients::new(Box::new(Recorded(SHIPPED.to_owned(), log)));
    for fresh in [r#""seed":3"#, r#""until":3"#, r#""set":{"walldist":"3 cm"}"#] {
        past.told.clear();
        past.say(&format!(r#"launch {{"log":"plan.afp",{fresh}}}"#));
        assert!(past.told.contains("a log cannot be changed: leave"), "{}", past.told);
    }
    past.say(r#"launch {"log":"plan.afp","stopOnEntry":true}"#);
    past.say("configurationDone");
    for change in [
        r#"afp/press {"control":"touch.touch"}"#,
        r#"afp/fault {"fault":"ultrasonic.lost"}"#,
        r#"afp/move {"to":[1,1,0]}"#,
        r#"afp/drop {"shape":"box","to":[1,1,0]}"#,
        r#"afp/force {"path":"walldist","value":"3 cm"}"#,
        r#"setExpression {"expression":"walldist","value":"3 cm"}"#,
    ] {
        past.told.clear();
        past.say(change);
        let why = "a log cannot be changed: launch its plan instead";
        assert!(past.told.contains(why), "{change}: {}", past.told);
    }
}
