//! Conversations with the adapter, as data: `tests/dap/*.txt` has a plan and the messages of
//! clients and adapter.
//!
//! `--> COMMAND ARGUMENTS` is a request. `tick` continues the run until it stops or ends, `tick 40`
//! passes 40 ms of real time at once, and `wait 400` passes 400 ms in steps of 100 ms. With
//! `AFP_BLESS=1` the test writes the answers, `<--`.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use afp_debug::{Adapter, Host, Launch, SessionTarget, Target};
use afp_token::Token;

use common::{Clients, Texted, compiled, session};

fn answered(case: &str) -> String {
    let (plan, talk) = case.split_once("\n---\n").expect("a plan, '---', a talk");
    let mut clients = Clients::new(Box::new(Texted(plan.to_owned())));
    for line in talk.lines().filter(|line| !line.starts_with('<')) {
        clients.told += line;
        clients.told += "\n";
        match line.split_once(' ').unwrap_or((line, "")) {
            ("-->", said) => clients.say(said),
            ("tick", "") => clients.tick(None),
            ("tick", wall) => clients.tick(Some(wall.parse().expect("milliseconds"))),
            ("wait", wall) => {
                let wall: u64 = wall.parse().expect("milliseconds");
                (0..wall / 100).for_each(|_| clients.tick(Some(100)));
            }
            ("lose", number) => clients.lose(number.parse().expect("a client")),
            (arrow, said) => {
                let number = arrow.strip_prefix('-').and_then(|rest| rest.strip_suffix('>'));
                if let Some(number) = number.and_then(|number| number.parse().ok()) {
                    clients.say_as(number, said);
                }
            }
        }
    }
    format!("{plan}\n---\n{}", clients.told)
}

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dap");
    let files = fs::read_dir(folder).expect("the folder is there");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_case_has_its_answers() {
    let mut wrong = Vec::new();
    for path in cases() {
        let case = fs::read_to_string(&path).expect("a text");
        let now = answered(&case);
        if now == case {
            continue;
        }
        if std::env::var_os("AFP_BLESS").is_some() {
            fs::write(&path, now).expect("it can be written");
        } else {
            let lines = case.lines().zip(now.lines()).find(|(was, is)| was != is);
            wrong.push(format!("{}: {lines:?}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A plan with a new text at each launch.
struct Edited(Vec<String>);

impl Host<'static> for Edited {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target>, String> {
        Texted(self.0.remove(0)).launch(launch)
    }

    fn path(&self, path: &str) -> String {
        path.to_owned()
    }
}

#[test]
fn a_restart_finds_breakpoints_in_the_new_text() {
    let plan = "use std
plan P {
    start a
    actor a: Wait(duration = 1 s) { Elapsed -> b }
    actor b: Wait(duration = 1 s) { Elapsed -> terminate }
}
";
    // One more component before the old ones, and a renamed one.
    let more =
        plan.replace("start a\n", "start c\n    actor c: Wait(duration = 1 s) { Elapsed -> a }\n");
    let more = more.replace("Elapsed -> b", "Elapsed -> d").replace("actor b", "actor d");
    let mut clients = Clients::new(Box::new(Edited(vec![plan.to_owned(), more])));
    for said in [
        r#"initialize {"adapterID":"afp"}"#,
        r#"launch {"program":"plan.afp"}"#,
        r#"setBreakpoints {"source":{"path":"plan.afp"},"breakpoints":[{"line":5}]}"#,
        r#"setFunctionBreakpoints {"breakpoints":[{"name":"b"}]}"#,
        "configurationDone",
    ] {
        clients.say(said);
    }
    clients.tick(None);
    assert!(
        clients.told.contains(r#""description":"b started at 1.000 s","hitBreakpointIds":[1,2]"#),
        "{}",
        clients.told
    );
    clients.told.clear();
    clients.say("restart");
    clients.tick(None);
    let told = &clients.told;
    assert!(told.contains(r#"{"breakpoint":{"id":2,"message":"unknown path 'b'"#), "{told}");
    assert!(
        told.contains(r#""description":"a started at 1.000 s","hitBreakpointIds":[1]"#),
        "{told}"
    );
}

#[test]
fn a_fork_repeats_requests_with_the_new_text_and_goes_to_the_same_instant() {
    let plan = "use std
plan P {
    in pause: duration = 1 s
    start a
    actor a: Wait(duration = pause) { Elapsed -> b }
    actor b: Wait(duration = 5 s) { Elapsed -> a }
}
";
    let entry = plan
        .replace("    start", "    var long: duration = 5 s\n    start")
        .replace("= 5 s)", "= long)");
    let mut clients = Clients::new(Box::new(Edited(vec![plan.to_owned(), entry])));
    for said in [
        r#"initialize {"adapterID":"afp"}"#,
        r#"launch {"program":"plan.afp","stopOnEntry":true,"set":{"pause":"2 s"}}"#,
        "configurationDone",
        r#"afp/seek {"at":4}"#,
    ] {
        clients.say(said);
    }
    clients.tick(None);
    clients.say(r#"setExpression {"expression":"pause","value":"3 s"}"#);
    clients.say(r#"afp/seek {"at":8}"#);
    clients.tick(None);
    clients.told.clear();
    clients.say("afp/fork");
    clients.tick(None);
    assert!(clients.told.contains("went to another time at 8.000 s"), "{}", clients.told);
    clients.told.clear();
    // The write at 4 s counts: 'a' began at 7 s and waits for 3 s.
    for said in [r#"evaluate {"expression":"long"}"#, r#"next {"threadId":1}"#] {
        clients.say(said);
        clients.tick(None);
    }
    let told = &clients.told;
    assert!(told.contains(r#"evaluate {"result":"5 s""#), "{told}");
    assert!(told.contains("b started at 10.000 s"), "{told}");
}

#[test]
fn breakpoints_without_a_place_are_found_again() {
    let short = "use std
plan P {
    start a
    actor a: Wait(duration = 1 s) { Elapsed -> terminate }
}
";
    let long = "use std

plan P {
    start a
    actor a: Wait(duration = 1 s) { Elapsed -> b }

    actor b: Wait(duration = 1 s) { Elapsed -> terminate }
}
";
    let texts = [short, long, short, long].map(str::to_owned).to_vec();
    let mut clients = Clients::new(Box::new(Edited(texts)));
    for said in [
        r#"initialize {"adapterID":"afp"}"#,
        r#"launch {"program":"plan.afp"}"#,
        r#"setBreakpoints {"source":{"path":"plan.afp"},"breakpoints":[{"line":6},{"line":3}]}"#,
        r#"setFunctionBreakpoints {"breakpoints":[{"name":"b"}]}"#,
    ] {
        clients.say(said);
    }
    clients.say_as(2, r#"initialize {"adapterID":"afp","clientName":"second"}"#);
    clients.say_as(2, "attach {}");
    let nothing = r#""message":"nothing happens at this line or below it","verified":false"#;
    assert!(clients.told.contains(nothing), "{}", clients.told);
    let second = r#""message":"set by client 1: nothing happens at this line or below it""#;
    assert!(clients.told.contains(second), "{}", clients.told);
    clients.say("configurationDone");
    clients.tick(None);
    for there in [true, false, true] {
        clients.told.clear();
        clients.say("restart");
        clients.tick(None);
        let told = &clients.told;
        let place = |line: u32| {
            format!(
                r#""line":{line},"source":{{"name":"plan.afp","path":"plan.afp"}},"verified":true}},"reason":"changed""#
            )
        };
        let changed =
            |id: u32, what: &str| format!(r#"event breakpoint {{"breakpoint":{{"id":{id},{what}"#);
        assert_eq!(told.contains(&changed(1, &place(7))), there, "{told}");
        assert_eq!(told.contains(&changed(1, nothing)), !there, "{told}");
        assert!(told.contains(&changed(2, &place(if there { 5 } else { 4 }))), "{told}");
        assert_eq!(told.contains(&changed(3, r#""verified":true"#)), there, "{told}");
        assert!(
            told.contains(r#""description":"a started at 0.000 s","hitBreakpointIds":[2]"#),
            "{told}"
        );
        clients.told.clear();
        clients.say("continue");
        clients.tick(None);
        let told = &clients.told;
        let held = r#""description":"b started at 1.000 s","hitBreakpointIds":[1,3]"#;
        assert_eq!(told.contains(held), there, "{told}");
    }
}

#[test]
fn breakpoints_of_one_program_do_not_stop_the_next() {
    let one = "use std
plan P {
    start a
    actor a: Wait(duration = 1 s) { Elapsed -> b }
    actor b: Wait(duration = 1 s) { Elapsed -> terminate }
}
";
    let other = "use std
plan Q {
    start first
    actor first: Wait(duration = 1 s) { Elapsed -> second }
    actor second: Wait(duration = 1 s) { Elapsed -> terminate }
}
";
    let texts = [one, other].map(str::to_owned).to_vec();
    let mut clients = Clients::new(Box::new(Edited(texts)));
    for said in [
        r#"launch {"program":"plan.afp"}"#,
        r#"setFunctionBreakpoints {"breakpoints":[{"name":"b"}]}"#,
        "configurationDone",
    ] {
        clients.say(said);
    }
    clients.tick(None);
    assert!(clients.told.contains("b started at 1.000 s"), "{}", clients.told);
    clients.say("terminate");
    clients.told.clear();
    clients.say(r#"launch {"program":"plan.afp"}"#);
    let told = &clients.told;
    assert!(told.contains(r#""message":"unknown path 'b'"#), "{told}");
    clients.say("configurationDone");
    clients.tick(None);
    let told = &clients.told;
    assert!(!told.contains("event stopped") && told.contains("Q ended OK"), "{told}");
}

#[test]
fn a_client_without_a_token_cannot_end_a_run() {
    let plan = "use std\nplan P {\n    start a\n    actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n";
    let adapter = Adapter::guarded(Box::new(Texted(plan.to_owned())), &Token::from_word("open"), 2);
    let mut clients = Clients::of(adapter);
    clients.say(r#"launch {"program":"plan.afp","token":"open","stopOnEntry":true}"#);
    clients.say("configurationDone");
    clients.say_as(2, r#"disconnect {"terminateDebuggee":true}"#);
    assert!(clients.told.ends_with("<2- disconnect\n"), "{}", clients.told);
    clients.say("threads");
    assert!(!clients.told.contains("terminated"), "{}", clients.told);
    clients.say_as(3, r#"attach {"token":"open"}"#);
    clients.say_as(3, r#"disconnect {"terminateDebuggee":true}"#);
    assert!(clients.told.contains("<-- event terminated"), "{}", clients.told);
    // An admitted client keeps its place until it leaves, even without a run.
    clients.say_as(4, r#"attach {"token":"open"}"#);
    assert!(
        clients.told.contains("2 clients are already connected: end one first"),
        "{}",
        clients.told
    );
    clients.lose(3);
    clients.say_as(4, r#"launch {"program":"plan.afp","token":"open"}"#);
    assert!(clients.told.contains("<4- event initialized"), "{}", clients.told);
}

#[test]
fn a_run_stops_between_edges_of_one_instant() {
    let plan = "use std
plan Spin {
    var left: int = 0
    start wait
    actor wait: Wait(duration = 100 ms) { Elapsed -> here }
    actor here: Wait(duration = 1 s) {
        supervise low: CheckValue(value = left, limit = 9) { Below -> there, Above -> ignore }
        Elapsed -> terminate
    }
    actor there: Wait(duration = 1 s) {
        supervise low: CheckValue(value = left, limit = 9) { Below -> here, Above -> ignore }
        Elapsed -> terminate
    }
}
";
    let mut clients = Clients::new(Box::new(Texted(plan.to_owned())));
    clients.say(r#"launch {"program":"plan.afp"}"#);
    clients.say(r#"setExceptionBreakpoints {"filters":["livelock"]}"#);
    clients.say("configurationDone");
    clients.tick(None);
    let held =
        r#"Spin fault livelock: the plan takes edge after edge without time passing at 0.100 s"#;
    assert!(clients.told.contains(held), "{}", clients.told);
    clients.told.clear();
    clients.say("stepBack");
    clients.say(r#"stackTrace {"threadId":1}"#);
    assert!(clients.told.contains(r#""name":"wait: Wait""#), "{}", clients.told);
    clients.say("continue");
    clients.tick(None);
    clients.say("continue");
    clients.tick(None);
    assert!(clients.told.contains("Spin stopped with an error after 0.1 s"), "{}", clients.told);
}

/// Runs with or without copies.
struct Copied(bool);

impl Host<'static> for Copied {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target>, String> {
        let text = fs::read_to_string(
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../../plans/wall_following.afp"),
        );
        let (graph, program) = compiled(&text.expect("the plan"), &launch.program)?;
        let launch = launch.clone();
        let target =
            SessionTarget::new(Arc::new(program), Box::new(move || session(&graph, &launch)))?;
        Ok(Box::new(if self.0 { target } else { target.never_kept() }))
    }

    fn path(&self, path: &str) -> String {
        path.to_owned()
    }
}

#[test]
fn a_run_without_copies_goes_back_from_the_start() {
    let told = [true, false].map(|kept| {
        let mut clients = Clients::new(Box::new(Copied(kept)));
        clients.say(r#"launch {"program":"plan.afp"}"#);
        clients.say(r#"setFunctionBreakpoints {"breakpoints":[{"name":"backupCollision"}]}"#);
        clients.say("configurationDone");
        clients.tick(None);
        for said in [
            r#"afp/seek {"at":25}"#,
            r#"stepBack {"threadId":1}"#,
            r#"afp/seek {"at":12.3}"#,
            r#"afp/why {"path":"backupCollision","at":3.5}"#,
            r#"reverseContinue {"threadId":1}"#,
            r#"stackTrace {"threadId":1}"#,
            r#"afp/seek {"at":14}"#,
            "terminate",
        ] {
            clients.say(said);
            clients.tick(None);
        }
        clients.told
    });
    let why = "cannot be copied: going back repeats the run from the start";
    let [kept, not] = &told;
    assert!(!kept.contains(why) && kept.contains(r#""trace":""#), "{kept}");
    let without: Vec<_> = not.lines().filter(|line| !line.contains(why)).collect();
    assert_eq!(without.len() + 1, not.lines().count(), "{not}");
    assert_eq!(kept.lines().collect::<Vec<_>>(), without);
}
