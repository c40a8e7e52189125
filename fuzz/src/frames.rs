//! Bytes on a serial line.

use afp_core::Instant;
use afp_wire::{Received, Receiver, Sender};

/// The commands of a robot in frames.
type Message = (f64, Option<bool>, u8);

const LONGEST: usize = 64;

/// Damage on the line affects at most one frame, and a hello after it is received.
pub fn frames(data: &[u8]) {
    let mut receiver = Receiver::<LONGEST>::new(1);
    for byte in data {
        let _ = receiver.receive::<Message>(*byte, Instant::ZERO);
    }
    receiver.forget();
    let _ = receiver.receive::<Message>(0, Instant::ZERO);
    let mut sender = Sender::new(7, 1);
    let mut hear = |frame: &[u8]| {
        frame.iter().find_map(|byte| receiver.receive::<Message>(*byte, Instant::ZERO))
    };
    assert_eq!(hear(sender.hello(&mut [0; LONGEST]).unwrap()), Some(Ok(Received::Hello)));
    let message = (0.25, Some(true), 3);
    let heard = hear(sender.send(&message, &mut [0; LONGEST]).unwrap());
    assert_eq!(heard, Some(Ok(Received::Message { message, lost: 0 })));
}
