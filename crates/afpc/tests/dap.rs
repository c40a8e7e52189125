//! `afpc dap` over standard input: how it ends.

mod common;

use std::io::Write;
use std::process::Stdio;

use common::{Place, Said, said};

/// The adapter is told some bytes and nothing more.
fn told(bytes: &[u8]) -> Said {
    told_in(&Place::new(), bytes)
}

fn told_in(place: &Place, bytes: &[u8]) -> Said {
    let mut command = place.command();
    command.arg("dap").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // Who is not understood may not be read to the end.
    child.stdin.take().unwrap().write_all(bytes).ok();
    said(child.wait_with_output().unwrap())
}

fn framed(command: &str, arguments: &str) -> String {
    let body =
        format!(r#"{{"seq":1,"type":"request","command":"{command}","arguments":{arguments}}}"#);
    format!("Content-Length: {}\r\n\r\n{body}", body.len())
}

#[test]
fn a_client_that_is_gone_ends_the_adapter() {
    told(b"").succeeds();
    let said = told(framed("disconnect", "{}").as_bytes());
    assert!(said.succeeds().out.contains(r#""success":true"#), "{said:?}");
}

#[test]
fn bytes_that_are_no_protocol_are_said_to_be_none() {
    let long = format!("Content-Length: {}\r\n\r\n", 1 << 30);
    let babble = vec![b'x'; 1 << 16];
    for (bytes, why) in [
        (&b"hello\n"[..], "whose messages begin with 'Content-Length: '"),
        (b"GET / HTTP/1.1\r\n\r\n", "whose messages begin with 'Content-Length: '"),
        (&babble, "whose messages begin with 'Content-Length: '"),
        (b"Content-Length: 9\r\n\r\n{}", "ends before its length"),
        (b"Content-Length: 1\r\n\r\n\xff", "no UTF-8"),
        (long.as_bytes(), "a message of 1073741824 bytes"),
    ] {
        told(bytes).fails(1, &["cannot talk to the editor over 'standard input'", why]);
    }
}

#[test]
fn a_log_is_looked_at_with_the_text_that_ran() {
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
    assert!(same.out.contains("its text is that of the file"), "{same:?}");
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
