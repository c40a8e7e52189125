//! Clients that read slowly.

use std::io::Read;
use std::thread;
use std::time::{Duration, Instant as Wall};

use afp_core::Instant;
use serde_json::json;
use tungstenite::stream::MaybeTlsStream;

use super::{Client, live, service, session};

#[test]
fn requests_of_slow_clients_are_handled() {
    let mut session = session();
    let live = live(&*session);
    let mut to = live.messages();
    let channel = to.open("/big", "x.Big", &[]).expect("a channel");
    let mut client = Client::new(&live.addresses()[1]).expect("it is let in");
    let stop = service(&mut client, "stop");
    client.say(&json!({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": channel}]}));
    client.say(&json!({"op": "getParameters", "parameterNames": [], "id": "there"}));
    client.hear("parameterValues");
    // The client reads a quarter of the data.
    let message = vec![7; 1 << 16];
    let begun = Wall::now();
    let mut asked = None;
    for sent in 0.. {
        to.send(channel, sent, Instant::from_nanos(sent.into()), &message).expect("it is taken");
        if begun.elapsed() > Duration::from_secs(2) && asked.is_none() {
            client.call(stop, "");
            asked = Some(Wall::now());
        }
        let MaybeTlsStream::Plain(stream) = client.socket.get_mut() else { panic!("no TLS") };
        stream.read_exact(&mut [0; 1 << 14]).expect("there is more");
        if live.is_asked() || asked.is_some_and(|at| at.elapsed() > Duration::from_secs(10)) {
            break;
        }
        thread::sleep(Duration::from_millis(5));
    }
    let waited = asked.expect("it was asked").elapsed();
    assert!(waited < Duration::from_secs(3), "{waited:?}");
    let now = session.now();
    live.serve(&mut *session, now);
    assert_eq!(live.clients(), 1, "it is slow, and there");
    let reader = thread::spawn(move || client.rest_to_close());
    live.finish();
    assert!(reader.join().expect("the client"), "it is told that the run is over");
}
