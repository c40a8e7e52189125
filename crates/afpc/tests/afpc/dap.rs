//! `afpc dap`: its end over standard input, and its messages to clients over a socket.

use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::thread;
use std::time::Duration;

use crate::common::{Place, Said, said};

mod address;

/// The output of an adapter that gets some bytes.
fn told(bytes: &[u8]) -> Said {
    told_in(&Place::new(), bytes)
}

pub fn told_in(place: &Place, bytes: &[u8]) -> Said {
    told_at(place, "", &["dap"], bytes)
}

/// The same in a folder of the place, with arguments.
fn told_at(place: &Place, folder: &str, words: &[&str], bytes: &[u8]) -> Said {
    let mut command = place.command();
    command.current_dir(place.path(folder)).args(words);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // The adapter may not read invalid input to its end.
    child.stdin.take().unwrap().write_all(bytes).ok();
    said(child.wait_with_output().unwrap())
}

pub fn framed(command: &str, arguments: &str) -> String {
    let body =
        format!(r#"{{"seq":1,"type":"request","command":"{command}","arguments":{arguments}}}"#);
    format!("Content-Length: {}\r\n\r\n{body}", body.len())
}

#[test]
fn the_adapter_ends_when_its_client_is_gone() {
    told(b"").succeeds();
    let said = told(framed("disconnect", "{}").as_bytes());
    assert!(said.succeeds().out.contains(r#""success":true"#), "{said:?}");
}

#[test]
fn the_adapter_does_not_listen_for_other_machines() {
    let said = Place::new().afpc("dap --listen 0.0.0.0:4711");
    said.fails(2, &["would not be encrypted", "'ssh -L 4711:localhost:4711 HOST'"]);
    assert!(!Place::new().afpc("dap --help").out.contains("--listen"));
}

#[test]
fn invalid_bytes_are_reported() {
    let long = format!("Content-Length: {}\r\n\r\n", 1 << 30);
    let babble = vec![b'x'; 1 << 16];
    for (bytes, why) in [
        (&b"hello\n"[..], "whose messages begin with 'Content-Length: '"),
        (b"GET / HTTP/1.1\r\n\r\n", "whose messages begin with 'Content-Length: '"),
        (&babble, "whose messages begin with 'Content-Length: '"),
        (b"Content-Length: 9\r\n\r\n{}", "ends before its length"),
        (b"Content-Length: 1\r\n\r\n\xff", "not UTF-8"),
        (long.as_bytes(), "a message of 1073741824 bytes"),
    ] {
        told(bytes).fails(1, &["cannot talk to the editor over 'standard input'", why]);
    }
}

#[test]
fn a_log_is_shown_with_the_text_that_ran() {
    let place = Place::with_plan();
    place.afpc("run wall_following.afp --until 2s --log run.mcap").succeeds();
    let talk = |reference: u32| {
        [
            framed("launch", r#"{"log":"run.mcap","stopOnEntry":true}"#),
            framed("configurationDone", "{}"),
            framed("stackTrace", r#"{"threadId":1}"#),
            framed("source", &format!(r#"{{"sourceReference":{reference}}}"#)),
            framed("disconnect", "{}"),
        ]
        .concat()
    };
    let same = told_in(&place, talk(9999).as_bytes());
    assert!(same.succeeds().out.contains(r#""name":"WallFollowing""#), "{same:?}");
    assert!(!same.out.contains("sourceReference"), "{same:?}");
    assert!(same.out.contains("the file has its text"), "{same:?}");
    place.write("wall_following.afp", "use carbot\n");
    let other = told_in(&place, talk(9999).as_bytes());
    let reference = other.out.split(r#""sourceReference":"#).nth(1).unwrap();
    let reference = reference.split(|c: char| !c.is_ascii_digit()).next().unwrap();
    let other = told_in(&place, talk(reference.parse().unwrap()).as_bytes());
    assert!(other.out.contains("plan WallFollowing {"), "{other:?}");
    place.write("run.mcap", "no log");
    let none = told_in(&place, talk(1).as_bytes());
    assert!(none.succeeds().out.contains(r#""success":false"#), "{none:?}");
}

#[test]
fn breakpoints_bind_in_the_files_of_a_log_in_every_folder() {
    let place = Place::new();
    place.write("afp.toml", "");
    let part = "use std\n\nplan Part {\n    start a\n    actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n";
    place.write("plans/parts/part.afp", part);
    let plan = "use \"parts/part.afp\"\n\nplan Whole {\n    start p\n    subplan p: Part { OK -> terminate }\n}\n";
    place.write("plans/whole.afp", plan);
    place.write("elsewhere/plans/whole.afp", "another\n");
    place.write("logs/notes", "");
    let named = place.path("plans/whole.afp").display().to_string();
    for (plan, log) in [("plans/whole.afp", "a.mcap"), (&*named, "b.mcap")] {
        place.afpc(&format!("run {plan} --svg none --log logs/{log}")).succeeds();
        let log = place.path(&format!("logs/{log}")).display().to_string();
        for folder in ["", "plans", "elsewhere"] {
            let file = |name: &str| place.path(name).canonicalize().unwrap().display().to_string();
            let set = |name: &str| {
                let at = format!(
                    r#"{{"source":{{"path":"{}"}},"breakpoints":[{{"line":5}}]}}"#,
                    file(name)
                );
                framed("setBreakpoints", &at)
            };
            let launch = framed("launch", &format!(r#"{{"log":"{log}","stopOnEntry":true}}"#));
            let (whole, part) = (set("plans/whole.afp"), set("plans/parts/part.afp"));
            let bytes = [launch, whole, part, framed("disconnect", "{}")].concat();
            let said = told_at(&place, folder, &["dap"], bytes.as_bytes());
            assert_eq!(
                said.out.matches(r#""verified":true"#).count(),
                2,
                "{folder} {plan}: {said:?}"
            );
            assert!(!said.out.contains("sourceReference"), "{folder} {plan}: {said:?}");
        }
    }
}

#[test]
fn a_folder_is_found_by_each_of_its_names() {
    let place = Place::new();
    place.write("w/plan.afp", "use std\nplan P {\n    start a\n    actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n");
    place.write("other.afp", "use std\n");
    let launch =
        |program: &str| framed("launch", &format!(r#"{{"program":"{program}"}}"#)).into_bytes();
    for (at, folder, program) in
        [("w", ".", "plan.afp"), ("", "w", "w/plan.afp"), ("w", "../w/", "plan.afp")]
    {
        let said = told_at(&place, at, &["dap", "--inside", folder], &launch(program));
        assert!(said.out.contains(r#""plan":"P""#), "{folder}: {said:?}");
    }
    let said = told_at(&place, "", &["dap", "--inside", "w"], &launch("other.afp"));
    assert!(said.out.contains("'other.afp' is outside of '"), "{said:?}");
    let said = told_at(&place, "", &["dap", "--inside", "w"], &launch("w/new.afp"));
    assert!(said.out.contains("cannot read the plan '"), "{said:?}");
    let said = told_at(&place, "", &["dap", "--inside", "nope"], b"");
    said.fails(1, &["cannot open the folder 'nope'"]);
    let said = told_at(&place, "", &["dap", "--inside", "other.afp"], b"");
    said.fails(2, &["'other.afp' is not a folder"]);
}

#[test]
fn invalid_arguments_of_a_launch_are_reported() {
    let place = Place::with_plan();
    for (start, strange) in [("[100,100,0]", true), ("[1,1,0]", false)] {
        let launch =
            format!(r#"{{"program":"wall_following.afp","start":{start},"stopOnEntry":true}}"#);
        let bytes = [framed("launch", &launch), framed("configurationDone", "{}")].concat();
        let said = told_in(&place, bytes.as_bytes());
        let warning = "warning: the robot starts outside of its world";
        assert_eq!(said.out.contains(warning), strange, "{start}: {said:?}");
    }
}

/// A client on a stream of bytes.
struct Client<R, W> {
    from: BufReader<R>,
    to: W,
    said: u32,
    /// All received bytes.
    heard: Vec<u8>,
}

impl<R: Read, W: Write> Client<R, W> {
    fn new(from: R, to: W) -> Client<R, W> {
        Client { from: BufReader::new(from), to, said: 0, heard: Vec::new() }
    }

    fn say(&mut self, command: &str, arguments: &str) {
        self.said += 1;
        let said = self.said;
        let body = format!(
            r#"{{"seq":{said},"type":"request","command":"{command}","arguments":{arguments}}}"#
        );
        write!(self.to, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
        self.to.flush().unwrap();
    }

    /// Reads messages until one contains this text.
    fn hear(&mut self, wanted: &str) -> String {
        loop {
            let mut header = String::new();
            self.from.read_line(&mut header).unwrap();
            let length: usize =
                header.trim().strip_prefix("Content-Length: ").unwrap().parse().unwrap();
            let mut rest = vec![0; 2 + length];
            self.from.read_exact(&mut rest).unwrap();
            self.heard.extend(header.bytes().chain(rest.iter().copied()));
            let message = String::from_utf8(rest).unwrap();
            if message.contains(wanted) {
                return message;
            }
        }
    }

    /// Sends a request and waits for the response.
    fn ask(&mut self, command: &str, arguments: &str) -> String {
        self.say(command, arguments);
        self.hear(r#""type":"response""#)
    }
}

/// A server for the length of a test.
struct Server(Child);

impl Drop for Server {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

impl Server {
    /// A server in a folder, its port and its token.
    fn new(place: &Place) -> (Server, u16, String) {
        let mut command = place.command();
        command.args(["dap", "--port", "0"]).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
        let (port, token) = line.trim().split_once(", token ").unwrap();
        let port = port.rsplit(':').next().unwrap().parse().unwrap();
        (Server(child), port, token.to_owned())
    }
}

fn connected(port: u16) -> Client<TcpStream, TcpStream> {
    let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
    Client::new(stream.try_clone().unwrap(), stream)
}

/// A whole session: to a breakpoint, variables, a step, a step back, the end.
fn session<R: Read, W: Write>(client: &mut Client<R, W>, token: &str) {
    client.ask("initialize", r#"{"adapterID":"afp"}"#);
    let launch = format!(r#"{{"program":"wall_following.afp","until":30,"token":"{token}"}}"#);
    client.ask("launch", &launch);
    client.ask("setFunctionBreakpoints", r#"{"breakpoints":[{"name":"backupCollision"}]}"#);
    client.ask("configurationDone", "{}");
    client.hear(r#""event":"stopped""#);
    for (command, arguments) in [
        ("threads", "{}"),
        ("stackTrace", r#"{"threadId":1}"#),
        ("scopes", r#"{"frameId":1}"#),
        ("nonsense", "{}"),
        ("next", r#"{"threadId":1}"#),
    ] {
        client.ask(command, arguments);
    }
    client.hear(r#""event":"stopped""#);
    client.ask("stepBack", r#"{"threadId":1}"#);
    client.hear(r#""event":"stopped""#);
    client.ask("terminate", "{}");
    client.hear(r#""event":"terminated""#);
    client.ask("disconnect", "{}");
}

#[test]
fn a_session_has_the_same_bytes_over_standard_output_and_a_socket() {
    let place = Place::with_plan();
    let mut command = place.command();
    command.arg("dap").stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut piped = Client::new(child.stdout.take().unwrap(), child.stdin.take().unwrap());
    session(&mut piped, "none is needed");
    assert!(child.wait().unwrap().success());
    let (_server, port, token) = Server::new(&place);
    let mut socket = connected(port);
    session(&mut socket, &token);
    assert!(piped.heard.len() > 5_000, "{} bytes", piped.heard.len());
    let [one, other] = [&piped.heard, &socket.heard].map(|it| String::from_utf8_lossy(it));
    assert!(one == other, "{one}\n---\n{other}");
}

#[test]
fn several_clients_watch_one_run_and_each_can_end_it() {
    let place = Place::with_plan();
    let (_server, port, token) = Server::new(&place);
    let mut one = connected(port);
    one.ask("initialize", r#"{"adapterID":"afp"}"#);
    let launch = format!(
        r#"{{"program":"wall_following.afp","speed":1,"stopOnEntry":true,"token":"{token}"}}"#
    );
    assert!(one.ask("launch", &launch).contains(r#""success":true"#));
    one.ask("configurationDone", "{}");
    one.hear(r#""event":"stopped""#);
    let (mut other, mut stranger) = (connected(port), connected(port));
    for client in [&mut other, &mut stranger] {
        client.ask("initialize", r#"{"adapterID":"afp"}"#);
    }
    let refused = stranger.ask("attach", r#"{"token":"guessed"}"#);
    assert!(refused.contains("'token' must be the token that 'afpc dap' printed"), "{refused}");
    for command in ["threads", "continue", "terminate", "setBreakpoints", "afp/world", "afp/role"] {
        let refused = stranger.ask(command, r#"{"threadId":1}"#);
        assert!(refused.contains("send 'launch' or 'attach' first"), "{refused}");
    }
    let attached = other.ask("attach", &format!(r#"{{"token":"{token}"}}"#));
    assert!(attached.contains(r#""plan":"WallFollowing""#), "{attached}");
    other.ask("configurationDone", "{}");
    other.hear(r#""event":"stopped""#);
    let refused = other.ask("continue", r#"{"threadId":1}"#);
    assert!(refused.contains("client 1 operates this run"), "{refused}");
    other.ask("terminate", "{}");
    for client in [&mut one, &mut other] {
        client.hear("WallFollowing was interrupted after 0.0 s");
        client.hear(r#""event":"terminated""#);
    }
    // The other clients stay connected.
    drop(other);
    assert!(one.ask("launch", &launch).contains(r#""success":true"#));
}

#[test]
fn a_busy_client_does_not_stop_the_run() {
    let place = Place::with_plan();
    let (_server, port, token) = Server::new(&place);
    let mut one = connected(port);
    let launch = format!(
        r#"{{"program":"wall_following.afp","speed":1,"until":0.5,"stopOnEntry":true,"token":"{token}"}}"#
    );
    assert!(one.ask("launch", &launch).contains(r#""success":true"#));
    one.ask("configurationDone", "{}");
    let mut other = connected(port);
    other.ask("attach", &format!(r#"{{"token":"{token}"}}"#));
    // A message that never ends.
    other.to.write_all(b"Content-Length: 30000\r\n\r\n").unwrap();
    let mut to = other.to.try_clone().unwrap();
    let talk = thread::spawn(move || {
        for _ in 0..29_999 {
            to.write_all(b"x").unwrap();
            thread::sleep(Duration::from_millis(1));
        }
    });
    one.say("continue", r#"{"threadId":1}"#);
    one.hear(r#""event":"terminated""#);
    assert!(!talk.is_finished());
}

#[test]
fn clients_without_a_token_are_rejected() {
    let place = Place::with_plan();
    let (_server, port, token) = Server::new(&place);
    let mut strangers: Vec<_> = (0..10).map(|_| connected(port)).collect();
    strangers[0].ask("initialize", r#"{"adapterID":"afp"}"#);
    let mut one = connected(port);
    let launch = format!(
        r#"{{"program":"wall_following.afp","speed":1,"stopOnEntry":true,"token":"{token}"}}"#
    );
    assert!(one.ask("launch", &launch).contains(r#""success":true"#));
    one.ask("configurationDone", "{}");
    for stranger in &mut strangers {
        let mut rest = Vec::new();
        // A disconnected client reads the end or an error.
        let why = stranger.from.read_to_end(&mut rest).map_err(|why| why.kind());
        assert!(!matches!(why, Err(ErrorKind::WouldBlock | ErrorKind::TimedOut)), "{why:?}");
    }
    assert!(one.ask("threads", "{}").contains(r#""success":true"#));
}

/// The content of `afp/ended`.
fn ended<R: Read, W: Write>(client: &mut Client<R, W>) -> serde_json::Value {
    let message = client.hear(r#""event":"afp/ended""#);
    let message: serde_json::Value = serde_json::from_str(message.trim()).unwrap();
    message["body"].clone()
}

#[test]
fn a_debugged_run_can_be_repeated_by_its_command() {
    let place = Place::with_plan();
    let (_server, port, token) = Server::new(&place);
    let mut client = connected(port);
    client.ask("initialize", r#"{"adapterID":"afp"}"#);
    let launch = format!(
        r#"{{"program":"wall_following.afp","seed":7,"set":{{"walldist":"35cm"}},"token":"{token}"}}"#
    );
    client.ask("launch", &launch);
    client.ask("setFunctionBreakpoints", r#"{"breakpoints":[{"name":"backupCollision"}]}"#);
    client.ask("configurationDone", "{}");
    client.hear(r#""event":"stopped""#);
    client.ask("afp/press", r#"{"control":"touch.touch"}"#);
    client.ask("afp/fault", r#"{"fault":"wheels.slip","amount":0.2,"seconds":2.5}"#);
    client.ask("next", r#"{"threadId":1}"#);
    client.hear(r#""event":"stopped""#);
    client.ask("stepBack", r#"{"threadId":1}"#);
    client.hear(r#""event":"stopped""#);
    client.ask("afp/seek", r#"{"at":12.34}"#);
    client.hear(r#""event":"stopped""#);
    client.say("terminate", "{}");
    let ended = ended(&mut client);
    assert_eq!(ended["by"]["client"], "client 1", "{ended}");
    let again = ended["again"].as_str().unwrap();
    let arguments = again.strip_prefix("afpc ").unwrap();
    for part in
        ["--seed 7 --set walldist=35cm --until 12.34s --press touch.touch@", "wheels.slip=0.2@"]
    {
        assert!(arguments.contains(part), "{again}");
    }
    let ran = place.afpc(&format!("{arguments} --json"));
    let summary = &ran.succeeds().last_json()["summary"];
    for key in ["trace", "contacts", "deadline_misses"] {
        assert_eq!(summary[key], ended["summary"][key], "{key}: {again}");
    }
    assert_eq!(summary["time_s"], ended["at"], "{again}");
}
