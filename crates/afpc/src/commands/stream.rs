//! Bytes from a stream, read on a separate thread.

use std::io::{ErrorKind, Read};

/// Passes on all input until the stream ends or the receiver stops.
pub fn read(mut from: impl Read, mut arrived: impl FnMut(Vec<u8>) -> bool) {
    let mut buffer = [0; 1 << 14];
    loop {
        match from.read(&mut buffer) {
            Ok(0) => return,
            Ok(length) if !arrived(buffer[..length].to_vec()) => return,
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return,
        }
    }
}
