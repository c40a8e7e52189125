//! `afpc lsp`: the language server over standard input and output.

use std::io::{self, Write};
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::thread;

use afp_lsp::{Message, Server, read_message};
use afp_output::frames::{Frames, WireError, frame};
use afp_run::{EXIT_OK, RunError};

use super::disk::Disk;
use super::stream::read;
use crate::no_plan::NoPlan;

pub const EXAMPLES: &str = "\
Editors start it, as docs/editors.md explains. Messages arrive on standard input and leave on
standard output.";

/// The maximum length of a message: a whole open document.
const LONGEST: usize = 1 << 26;
/// The maximum number of unread chunks.
const ARRIVALS: usize = 64;

/// Serves one client until it disconnects.
///
/// # Errors
/// The input is not a sequence of messages, or the last message is incomplete.
pub fn run() -> Result<u8, NoPlan> {
    let (sender, arrived) = sync_channel(ARRIVALS);
    // The thread ends with the stream or with the program.
    thread::spawn(move || read(io::stdin(), |bytes| sender.send(bytes).is_ok()));
    let server = Server::new(Box::new(Disk));
    let code = converse(server, &arrived, io::stdout().lock());
    let failed = RunError::file("cannot talk to the editor over", "standard input".as_ref());
    Ok(code.map_err(|why| failed(io::Error::other(why)))?)
}

/// Talks with a client and returns the exit code.
fn converse(
    mut server: Server,
    arrived: &Receiver<Vec<u8>>,
    mut to: impl Write,
) -> Result<u8, WireError> {
    let mut frames = Frames::up_to(LONGEST);
    loop {
        let heard = match frames.next_message() {
            Ok(Some(text)) => answer(&mut server, &text, &mut to),
            // Invalid UTF-8 is invalid JSON.
            Err(WireError::NoText) => answer(&mut server, "", &mut to),
            Err(why) => return Err(why),
            Ok(None) => {
                let (bytes, heard) = match arrived.try_recv() {
                    Err(TryRecvError::Empty) => {
                        let heard = send(&server.idle(), &mut to);
                        (arrived.recv().ok(), heard)
                    }
                    bytes => (bytes.ok(), Ok(())),
                };
                let Some(bytes) = bytes else { return frames.finish().map(|()| EXIT_OK) };
                frames.push(&bytes);
                heard
            }
        };
        match (server.exit_code(), heard) {
            (Some(code), _) => return Ok(code),
            // The client has closed its end.
            (None, Err(_)) => return Ok(EXIT_OK),
            (None, Ok(())) => {}
        }
    }
}

fn answer(server: &mut Server, text: &str, to: &mut impl Write) -> io::Result<()> {
    match read_message(text) {
        Ok(message) => send(&server.handle(message), to),
        Err(refusal) => to.write_all(&frame(&refusal)).and_then(|()| to.flush()),
    }
}

fn send(messages: &[Message], to: &mut impl Write) -> io::Result<()> {
    messages.iter().try_for_each(|message| message.write(to))
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use afp_lsp::NoFiles;

    use super::*;

    /// The server's output and result for some bytes of input.
    fn told(bytes: &[u8], size: usize) -> (Result<u8, WireError>, String) {
        let (sender, arrived) = channel();
        bytes.chunks(size).for_each(|piece| sender.send(piece.to_vec()).unwrap());
        drop(sender);
        let mut said = Vec::new();
        let end = converse(Server::new(Box::new(NoFiles)), &arrived, &mut said);
        (end, String::from_utf8(said).unwrap())
    }

    fn frames(messages: &[&str]) -> Vec<u8> {
        messages.iter().flat_map(|message| frame(message)).collect()
    }

    const HELLO: &str =
        r#"{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}"#;
    const SHUTDOWN: &str = r#"{"jsonrpc":"2.0","id":2,"method":"shutdown"}"#;
    const EXIT: &str = r#"{"jsonrpc":"2.0","method":"exit"}"#;

    #[test]
    fn a_malformed_message_is_refused_and_the_conversation_continues() {
        for (message, code) in [
            ("{", "-32700"),
            ("", "-32700"),
            ("\u{0}", "-32700"),
            (&"[".repeat(100_000), "-32700"),
            ("[]", "-32600"),
            ("null", "-32600"),
            (r#"{"id":7}"#, r#"-32600"#),
            (r#"{"id":1.5,"method":"shutdown"}"#, "-32600"),
            (r#"{"id":99999999999,"method":"shutdown"}"#, "-32600"),
            (r#"{"id":7,"method":7}"#, "-32600"),
            (r#"{"id":7,"method":"initialize","params":{"capabilities":{}}}"#, "-32600"),
            (r#"{"id":7,"method":"no/such"}"#, "-32601"),
            (r#"{"id":7,"method":"textDocument/hover","params":[1]}"#, "-32602"),
        ] {
            let (end, said) = told(&frames(&[HELLO, message, SHUTDOWN, EXIT]), 64);
            assert_eq!(end, Ok(0), "{message}");
            assert!(said.contains(code), "{message}: {said}");
            assert!(said.contains(r#""id":2,"result":null"#), "{message}: {said}");
        }
        let early = told(&frames(&[SHUTDOWN, EXIT]), 1000);
        assert!(early.0 == Ok(1) && early.1.contains("-32002"), "{early:?}");
        let late = told(&frames(&[HELLO, SHUTDOWN, SHUTDOWN, EXIT]), 1000);
        assert!(late.0 == Ok(0) && late.1.contains("-32600"), "{late:?}");
        let binary = [frames(&[HELLO]), b"Content-Length: 1\r\n\r\n\xff".to_vec()].concat();
        let binary = told(&[binary, frames(&[SHUTDOWN, EXIT])].concat(), 1000);
        assert!(binary.0 == Ok(0) && binary.1.contains("-32700"), "{binary:?}");
    }

    #[test]
    fn no_input_aborts_or_blocks_the_server() {
        let mut state = 1_u64;
        let mut below = |most: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % most
        };
        let open = r#"{"method":"textDocument/didOpen","params":{"textDocument":{"uri":"file:///a.afp","languageId":"afp","version":1,"text":"plan P {"}}}"#;
        let hover = r#"{"id":3,"method":"textDocument/hover","params":{"textDocument":{"uri":"file:///a.afp"},"position":{"line":0,"character":5}}}"#;
        let sound = frames(&[HELLO, open, hover, SHUTDOWN, EXIT]);
        let lengths = ["-1", "99999999999999", "99999999999999999999999", "", "1e3", "0x10", "0"];
        for _ in 0..3000 {
            let mut bytes = sound.clone();
            for _ in 0..=below(3) {
                let at = below(bytes.len());
                match below(5) {
                    0 => bytes[at] = below(256) as u8,
                    1 => bytes.truncate(at + 1),
                    2 => drop(bytes.drain(at..(at + below(40)).min(bytes.len()))),
                    3 => bytes.insert(at, b"\r\n{}[]\":,\0\xff"[below(11)]),
                    _ => {
                        let header = format!("Content-Length: {}\r\n\r\n", lengths[below(7)]);
                        bytes.splice(at..at, header.into_bytes());
                    }
                }
                if bytes.is_empty() {
                    break;
                }
            }
            // The server ends with an exit code or with the error of the stream.
            let (end, _) = told(&bytes, 1 + below(200));
            assert!(end.is_err() || end.is_ok_and(|code| code <= 1));
        }
    }
}
