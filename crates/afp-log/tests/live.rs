//! Clients over a socket: they see the log's contents, send requests, and lose the connection if
//! they do not read.
#![cfg(feature = "live")]

#[path = "live/board.rs"]
mod board;
#[path = "live/slow.rs"]
mod slow;

use std::collections::BTreeMap;
use std::io::{ErrorKind, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant as Wall};

use afp::load::{LoadedPlan, Registry};
use afp_core::Instant;
use afp_dsl::Toolboxes;
use afp_dsl::compile_plan;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_log::live::Live;
use afp_log::{About, Recorder, SessionLog, WhenFull};
use afp_session::{AnySession, Go, Loader, Opened, Settings};
use afp_syntax::source::Source;
use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::stream::MaybeTlsStream;
use tungstenite::{Error, Message, WebSocket};

use board::Board;

const PLAN: &str = "use std

plan Blink {
    in  pause: duration = 250 ms
    var left:  int = 0
    start dark
    actor dark: Wait(duration = pause) { Elapsed -> count }
    computation count: Count(value = left, limit = 100, next => left) {
        Again -> dark
        Done  -> terminate
    }
}
";

fn graph() -> Graph {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled =
        compile_plan(&Source::new("plan.afp", PLAN), &toolboxes, &Texts::default(), None);
    compiled.graph.expect("the plan is sound")
}

fn session() -> Box<dyn AnySession> {
    let graph = graph();
    let robot = afp_sim::carbot(|_| {});
    let world = robot.kind().world(robot.kind().default_world()).expect("a world");
    robot.session(&graph, &*world, 0, &[]).expect("a session")
}

fn live(session: &dyn AnySession) -> Live {
    Live::start(([127, 0, 0, 1], 0).into(), "Blink", session).expect("a port is free")
}

#[derive(Debug)]
struct Client {
    socket: WebSocket<MaybeTlsStream<TcpStream>>,
    /// Messages of channels that came before an awaited message.
    kept: Vec<Message>,
}

/// Messages with their times in nanoseconds, by the number of the subscription.
type Channels = BTreeMap<u32, Vec<(u64, Vec<u8>)>>;

impl Client {
    fn new(address: &str) -> Result<Client, Box<Error>> {
        Client::with(address, "foxglove.sdk.v1", None)
    }

    fn with(address: &str, protocol: &str, origin: Option<&str>) -> Result<Client, Box<Error>> {
        let mut request = address.into_client_request()?;
        let headers = request.headers_mut();
        headers.insert("sec-websocket-protocol", protocol.parse().expect("a header"));
        if let Some(origin) = origin {
            headers.insert("origin", origin.parse().expect("a header"));
        }
        let (socket, _) = tungstenite::connect(request)?;
        if let MaybeTlsStream::Plain(stream) = socket.get_ref() {
            stream.set_read_timeout(Some(Duration::from_secs(10))).expect("a limit");
        }
        Ok(Client { socket, kept: Vec::new() })
    }

    fn say(&mut self, said: &Value) {
        self.socket.send(Message::text(said.to_string())).expect("it can be said");
    }

    fn call(&mut self, service: u32, payload: &str) {
        let mut bytes = vec![2];
        for number in [service, 5, 4] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(b"json");
        bytes.extend(payload.as_bytes());
        self.socket.send(Message::binary(bytes)).expect("it can be said");
    }

    fn hear(&mut self, op: &str) -> Value {
        loop {
            let message = self.socket.read().expect("an answer comes");
            let Message::Text(text) = message else {
                self.kept.push(message);
                continue;
            };
            let value: Value = serde_json::from_str(&text).expect("JSON");
            if value["op"] == op {
                return value;
            }
        }
    }

    /// Reads to the end; returns whether the server has closed properly.
    fn rest_to_close(&mut self) -> bool {
        // Reading past the library leaves half a frame, so only bytes can be checked.
        let mut rest = Vec::new();
        let MaybeTlsStream::Plain(stream) = self.socket.get_mut() else { return false };
        let _ = stream.read_to_end(&mut rest);
        rest.windows(2).rev().take(64).any(|bytes| bytes == [0x88, 0x00])
    }

    /// All messages of channels until the server closes, by the number of the subscription.
    fn rest(&mut self) -> (Channels, Vec<String>) {
        let (mut all, mut said) = (BTreeMap::<u32, Vec<_>>::new(), Vec::new());
        loop {
            let kept = (!self.kept.is_empty()).then(|| self.kept.remove(0));
            match kept.map_or_else(|| self.socket.read(), Ok) {
                Ok(Message::Binary(bytes)) if bytes[0] == 1 => {
                    let id = u32::from_le_bytes(bytes[1..5].try_into().expect("four"));
                    let at = u64::from_le_bytes(bytes[5..13].try_into().expect("eight"));
                    all.entry(id).or_default().push((at, bytes[13..].to_vec()));
                }
                Ok(Message::Text(text)) => said.push(text.to_string()),
                Ok(Message::Close(_)) | Err(_) => return (all, said),
                Ok(_) => {}
            }
        }
    }
}

fn service(client: &mut Client, name: &str) -> u32 {
    let said = client.hear("advertiseServices");
    let services = said["services"].as_array().expect("a list").iter();
    let found = services.into_iter().find(|service| service["name"] == name);
    found.unwrap_or_else(|| panic!("no {name} in {said}"))["id"].as_u64().expect("a number") as u32
}

/// The messages of each topic of a log, with their times.
fn logged(path: &Path) -> BTreeMap<String, Vec<(u64, Vec<u8>)>> {
    let file = std::fs::read(path).expect("the log");
    let mut logged = BTreeMap::<String, Vec<_>>::new();
    for message in mcap::MessageStream::new(&file).expect("a log") {
        let message = message.expect("a message");
        let of_topic = logged.entry(message.channel.topic.clone()).or_default();
        of_topic.push((message.log_time, message.data.to_vec()));
    }
    logged
}

#[test]
fn clients_see_the_contents_of_the_log() {
    let mut session = session();
    let live = live(&*session);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (names, devices) = (session.owned_names(), session.devices());
    let recorder = Recorder::create(&path, &About::default(), names, WhenFull::Wait);
    let mut log = SessionLog::new(recorder.expect("a log"), devices, Vec::new(), false);
    let sent = Recorder::stream(live.messages(), session.owned_names());
    let mut sent = SessionLog::new(sent.expect("a stream"), devices, Vec::new(), false);

    let mut client = Client::new(&live.addresses()[1]).expect("it is let in");
    assert_eq!(client.hear("serverInfo")["name"], "Blink");
    let advertised = client.hear("advertise");
    let channels: BTreeMap<_, _> = advertised["channels"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|channel| (channel["topic"].as_str().expect("a topic").to_owned(), &channel["id"]))
        .collect();
    let topics = ["/plan/events", "/plan/configuration", "/plan/table", "/tf", "/robot/pose"];
    for (number, topic) in topics.iter().enumerate() {
        let subscription = json!({"id": 100 + number, "channelId": channels[*topic]});
        client.say(&json!({"op": "subscribe", "subscriptions": [subscription]}));
    }
    client.say(&json!({"op": "subscribeParameterUpdates", "parameterNames": []}));
    client.say(&json!({"op": "getParameters", "parameterNames": ["pause", "left"], "id": "all"}));
    let before = client.hear("parameterValues");
    assert_eq!(before["parameters"], json!([{"name": "left"}, {"name": "pause"}]));

    let listener = thread::spawn(move || client.rest());
    let mut gate = |_, _| {
        thread::sleep(Duration::from_micros(300));
        Go::On
    };
    let end = Instant::ZERO + afp_core::Duration::from_secs(3);
    session.run(end, &mut gate, &mut [&mut log, &mut sent]).expect("it starts");
    log.finish(&*session).expect("it is written");
    sent.finish(&*session).expect("it is sent");
    live.finish();
    let (seen, said) = listener.join().expect("the client");
    let changed: Vec<_> = said.iter().filter(|text| text.contains("parameterValues")).collect();
    assert!(changed.first().is_some_and(|text| text.contains(r#""value":"250 ms""#)), "{said:?}");
    assert!(changed.last().is_some_and(|text| text.contains(r#""name":"left""#)), "{said:?}");

    let logged = logged(&path);
    for (number, topic) in (100..).zip(topics) {
        assert_eq!(seen.get(&number), logged.get(topic), "{topic}");
    }
}

#[test]
fn entries_are_written_and_services_called_between_two_steps() {
    let mut session = session();
    let live = live(&*session);
    let [operator, watcher] = live.addresses();
    let mut client = Client::new(&operator).expect("it is let in");
    let press = service(&mut client, "press/touch.touch");
    let mut other = Client::new(&watcher).expect("it is let in");
    let stop = service(&mut other, "stop");
    let run = |session: &mut dyn AnySession, until: u64| {
        let limit = Wall::now() + Duration::from_secs(10);
        while !live.is_asked() && Wall::now() < limit {
            thread::sleep(Duration::from_millis(1));
        }
        let now = session.now();
        live.serve(session, now);
        let end = Instant::ZERO + afp_core::Duration::from_millis(until);
        session.run(end, &mut afp_session::Open, &mut []).expect("it starts");
    };

    let set = |name: &str, value: Value| json!({"op": "setParameters", "parameters": [{"name": name, "value": value}], "id": "x"});
    other.say(&set("pause", json!("1 s")));
    assert!(other.hear("status")["message"].as_str().expect("a text").contains("for watching"));
    other.call(press, "{}");
    assert!(other.hear("serviceCallFailure")["message"].to_string().contains("for watching"));
    assert!(!live.is_asked());

    client.say(&set("pause", json!("1 s")));
    run(&mut *session, 100);
    let written = json!([{"name": "pause", "value": "1 s"}]);
    assert_eq!(client.hear("parameterValues")["parameters"], written, "as it is from now on");
    client.say(&set("pause", json!(3)));
    run(&mut *session, 200);
    let why = client.hear("status")["message"].to_string();
    assert!(why.contains("'pause=3': not a duration (help: write the unit: 'pause=3s')"), "{why}");
    assert_eq!(client.hear("parameterValues")["parameters"][0]["name"], "pause");
    client.say(&set("nobody", json!(3)));
    run(&mut *session, 300);
    let why = client.hear("status")["message"].to_string();
    assert!(
        why.contains("the plan has no entry 'nobody' (help: entries that can be set: "),
        "{why}"
    );
    client.call(press, r#"{"held":"yes"}"#);
    assert!(client.hear("serviceCallFailure")["message"].to_string().contains("true or false"));
    client.call(press, "{}");
    run(&mut *session, 400);
    client.call(99, "{}");
    assert!(client.hear("serviceCallFailure")["message"].to_string().contains("no such service"));
    other.call(stop, "");
    run(&mut *session, 500);
    assert!(session.ending().is_some(), "anybody may stop");
    let millis = |at: Instant| at.as_nanos() / 1_000_000;
    let asked: Vec<_> = session.requests().iter().map(|(at, _)| millis(*at)).collect();
    assert_eq!(asked, [0, 300, 400], "written, pressed for a while, stopped");
    live.finish();
}

#[test]
fn a_real_robot_has_no_buttons_and_faults() {
    let mut registry = Registry::new();
    afp_std::templates::register(&mut registry);
    let plan = LoadedPlan::new(&graph(), &registry).expect("it needs no devices");
    let opened = Opened::new::<_, Board>(plan, &Settings::default()).expect("it is there");
    let live = live(&*opened.session);
    let mut client = Client::new(&live.addresses()[0]).expect("it is let in");
    let services = client.hear("advertiseServices")["services"].take();
    let names: Vec<_> = services.as_array().expect("a list").iter().map(|it| &it["name"]).collect();
    assert_eq!(names, ["stop"]);
    live.finish();
}

#[test]
fn clients_without_a_token_are_rejected() {
    let session = session();
    let live = live(&*session);
    let [operator, _] = live.addresses();
    let (bare, _) = operator.split_once('?').expect("a token");
    let refused =
        |address: &str, protocol: &str, origin| match Client::with(address, protocol, origin)
            .err()
            .map(|why| *why)
        {
            Some(Error::Http(response)) => response.status().as_u16(),
            other => panic!("{other:?}"),
        };
    let name = "foxglove.websocket.v1";
    assert_eq!(refused(bare, name, None), 401);
    assert_eq!(refused(&format!("{bare}?token=0"), name, None), 401);
    assert_eq!(refused(&operator, name, Some("https://evil.example")), 403);
    assert_eq!(refused(&operator, "chat", None), 400);
    assert!(Client::with(&operator, name, Some("https://app.foxglove.dev")).is_ok());
    let many: Vec<_> = (0..8).map_while(|_| Client::new(&operator).ok()).collect();
    assert_eq!(refused(&operator, name, None), 503, "{} were let in", many.len());
    live.finish();
}

#[test]
fn clients_without_a_token_do_not_count() {
    let session = session();
    let live = live(&*session);
    let [operator, watcher] = live.addresses();
    let port: u16 = operator
        .rsplit_once(':')
        .and_then(|(_, rest)| rest.split_once('/'))
        .and_then(|(port, _)| port.parse().ok())
        .expect("a port");
    let stranger = || TcpStream::connect(("127.0.0.1", port)).expect("the port is open");
    // A client that always sends data, and never enough.
    let mut slow = stranger();
    let begun = Wall::now();
    let gone = thread::spawn(move || {
        while begun.elapsed() < Duration::from_secs(15) && slow.write_all(b"G").is_ok() {
            thread::sleep(Duration::from_millis(200));
        }
        begun.elapsed()
    });
    let _many: Vec<_> = (0..12).map(|_| stranger()).collect();
    let clients: Vec<_> = (0..8).map(|n| Client::new([&operator, &watcher][n % 2])).collect();
    assert!(clients.iter().all(Result::is_ok), "{clients:?}");
    drop(clients);
    let took = gone.join().expect("the slow one");
    assert!(took < Duration::from_secs(8), "it was there for {took:?}");
    let more: Vec<_> = (0..60).map(|_| stranger()).collect();
    assert!(Client::new(&watcher).is_ok(), "who comes last is heard");
    let stays = |stranger: &TcpStream| {
        stranger.set_read_timeout(Some(Duration::from_millis(20))).expect("a time");
        stranger.peek(&mut [0]).is_err_and(|error| error.kind() == ErrorKind::WouldBlock)
    };
    let stay = more.iter().filter(|stranger| stays(stranger)).count();
    assert!((8..=16).contains(&stay), "{stay} of 60 stay");
    let begun = Wall::now();
    live.finish();
    assert!(begun.elapsed() < Duration::from_secs(1), "nobody is waited for");
}

#[test]
fn clients_get_the_parameters_of_their_subscriptions() {
    let mut session = session();
    let live = live(&*session);
    let sent = Recorder::stream(live.messages(), session.owned_names()).expect("a stream");
    let mut sent = SessionLog::new(sent, session.devices(), Vec::new(), false);
    // Requests in sequence, beginning with a subscription, and the resulting messages.
    let cases: [(&[&[&str]], &[&str]); 7] = [
        (&[&["left"], &["left"]], &[]),
        (&[&["left"], &["pause"]], &["left"]),
        (&[&["left"], &["left"], &["pause"]], &["pause"]),
        (&[&["left"], &[], &[]], &["left", "pause"]),
        (&[&[], &["left"]], &["pause"]),
        (&[&[], &[]], &[]),
        (&[&["nobody", "pause"]], &["pause"]),
    ];
    let clients = cases.map(|(said, told)| {
        let mut client = Client::new(&live.addresses()[1]).expect("it is let in");
        for (turn, names) in said.iter().enumerate() {
            let op = ["subscribeParameterUpdates", "unsubscribeParameterUpdates"][turn % 2];
            client.say(&json!({"op": op, "parameterNames": names}));
        }
        client.say(&json!({"op": "getParameters", "parameterNames": ["nobody"], "id": "there"}));
        assert_eq!(client.hear("parameterValues")["parameters"], json!([]));
        (client, said, told)
    });
    let end = Instant::ZERO + afp_core::Duration::from_secs(1);
    session.run(end, &mut afp_session::Open, &mut [&mut sent]).expect("it starts");
    sent.finish(&*session).expect("it is sent");
    live.finish();
    for (mut client, said, told) in clients {
        let (_, heard) = client.rest();
        let heard =
            |name: &str| heard.iter().any(|text| text.contains(&format!("\"name\":\"{name}\"")));
        let names: Vec<_> = ["left", "pause"].into_iter().filter(|name| heard(name)).collect();
        assert_eq!(names, told, "{said:?}");
    }
}

#[test]
fn a_client_that_does_not_read_loses_messages_then_the_connection_without_delay() {
    let session = session();
    let live = live(&*session);
    let mut to = live.messages();
    let channel = to.open("/big", "x.Big", &[]).expect("a channel");
    let wanted = json!({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": channel}]});
    let mut lazy = Client::new(&live.addresses()[0]).expect("it is let in");
    let mut busy = Client::new(&live.addresses()[1]).expect("it is let in");
    for client in [&mut lazy, &mut busy] {
        client.say(&wanted);
        client.say(&json!({"op": "getParameters", "parameterNames": [], "id": "there"}));
        client.hear("parameterValues");
    }
    let reader = thread::spawn(move || busy.rest());
    let message = vec![7; 1 << 16];
    let mut longest = Duration::ZERO;
    let begun = Wall::now();
    let mut sent = 0;
    while live.clients() > 1 && begun.elapsed() < Duration::from_secs(15) {
        let one = Wall::now();
        to.send(channel, sent, Instant::from_nanos(sent.into()), &message).expect("it is taken");
        longest = longest.max(one.elapsed());
        sent += 1;
        thread::sleep(Duration::from_millis(2));
    }
    assert_eq!(live.clients(), 1, "the lazy one is gone, the busy one is there");
    assert!(longest < Duration::from_secs(1), "{longest:?} for one message");
    live.finish();
    let (seen, _) = reader.join().expect("the client");
    let last = seen[&1].last().expect("messages").0;
    assert_eq!(last, u64::from(sent - 1), "the busy one got the last message");
}
