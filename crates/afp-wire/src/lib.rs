//! The serial protocol between a robot's computer and its controller, for both ends.
//!
//! Each end has a [`Sender`] and a [`Receiver`]. Messages are any types that `serde` can write. On the wire, a message is one frame:
//!
//! | part | bytes | |
//! |---|---|---|
//! | boot id | 1 to 5 | new at each start of a program, so that a restart is noticed |
//! | sequence number | 1 to 3 | counts frames, so that lost and repeated frames are noticed |
//! | packet | | a hello with the version of the messages, or a message, as [postcard](https://postcard.jamesmunns.com/wire-format) writes it |
//! | checksum | 4 | CRC-32 (ISO-HDLC) of all bytes before it, least significant byte first |
//!
//! Consistent overhead byte stuffing (S. Cheshire and M. Baker, "Consistent overhead byte stuffing", IEEE/ACM Transactions
//! on Networking 7 (2), 1999) removes all zero bytes from a frame, and a zero byte ends it. So a receiver finds the next
//! frame after any disturbance.
//!
//! A frame has at most 253 bytes before it is stuffed.
//!
//! A connection begins with a hello from both ends. Before it, messages are rejected; so are messages of another version
//! and of another life of the other end. The receiver of commands stops its motors after [`COMMAND_TIMEOUT`] without a
//! command.
//!
//! ```
//! use afp_types::Instant;
//! use afp_wire::{Received, Receiver, Sender};
//!
//! let (mut computer, mut controller) = (Sender::new(7, 1), Receiver::<64>::new(1));
//! let mut buffer = [0; 64];
//!
//! let hello = computer.hello(&mut buffer)?;
//! let greeted = hello.iter().find_map(|byte| controller.receive::<f32>(*byte, Instant::ZERO));
//! assert_eq!(greeted, Some(Ok(Received::Hello)));
//!
//! let speed = computer.send(&0.25_f32, &mut buffer)?;
//! let command = speed.iter().find_map(|byte| controller.receive::<f32>(*byte, Instant::ZERO));
//! assert_eq!(command, Some(Ok(Received::Message { message: 0.25, lost: 0 })));
//! # Ok::<(), afp_wire::TooLong>(())
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod frame;
mod link;

use afp_types::Duration;

pub use frame::TooLong;
pub use link::{Received, Receiver, Rejected, Sender};

/// A controller stops its motors if it has received no command for this time.
pub const COMMAND_TIMEOUT: Duration = Duration::from_millis(200);
