//! One message as bytes: postcard, a checksum, and byte stuffing. The crates for byte stuffing can
//! panic, so a microcontroller needs this one.

use core::fmt;

use crc::{CRC_32_ISO_HDLC, Crc};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The most bytes before stuffing, so that stuffing adds one byte and the end.
const MOST: usize = 253;

const CHECKSUM: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// Content of a frame and its sender.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Frame<T> {
    /// Boot id of the sender.
    pub boot: u32,
    /// Counts the frames since that boot.
    pub sequence: u16,
    pub packet: Packet<T>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Packet<T> {
    /// Begins a connection.
    Hello {
        version: u16,
    },
    Message(T),
}

/// A message does not fit the buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLong;

impl fmt::Display for TooLong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the message is longer than a frame of the link")
    }
}

impl core::error::Error for TooLong {}

/// Writes a frame and its end into a buffer.
pub(crate) fn write<'b, T: Serialize>(
    frame: &Frame<T>,
    buffer: &'b mut [u8],
) -> Result<&'b [u8], TooLong> {
    let room = buffer.get_mut(1..).ok_or(TooLong)?;
    let written = postcard::to_slice_crc32(frame, room, CHECKSUM.digest());
    let length = written.map_err(|_| TooLong)?.len();
    stuff(buffer, length).ok_or(TooLong)
}

/// Replaces the zeros among `length` bytes, which begin at the second one, and adds the end. Each
/// zero, and the first byte, becomes the distance to the next zero.
fn stuff(buffer: &mut [u8], length: usize) -> Option<&[u8]> {
    let mut last = 0;
    for at in 1..=length {
        if *buffer.get(at)? == 0 {
            *buffer.get_mut(last)? = u8::try_from(at - last).ok()?;
            last = at;
        }
    }
    let end = length + 1;
    *buffer.get_mut(last)? = u8::try_from(end - last).ok()?;
    *buffer.get_mut(end)? = 0;
    (length <= MOST).then(|| buffer.get(..=end))?
}

/// Restores the zeros in place; returns the number of bytes, or `None` if they are damaged.
fn restore(bytes: &mut [u8]) -> Option<usize> {
    let (mut from, mut to) = (0, 0);
    while let Some(run) = bytes.get(from).copied() {
        let next = from + usize::from(run);
        if run == 0 || next > bytes.len() {
            return None;
        }
        for at in from + 1..next {
            *bytes.get_mut(to)? = *bytes.get(at)?;
            to += 1;
        }
        // The longest run is followed by another run instead of a zero.
        if run < u8::MAX && next < bytes.len() {
            *bytes.get_mut(to)? = 0;
            to += 1;
        }
        from = next;
    }
    Some(to)
}

/// Reads a frame without its end, in place; `None` if it is damaged.
pub(crate) fn read<T: DeserializeOwned>(bytes: &mut [u8]) -> Option<Frame<T>> {
    let length = restore(bytes)?;
    let (frame, rest) =
        postcard::take_from_bytes_crc32(bytes.get(..length)?, CHECKSUM.digest()).ok()?;
    rest.is_empty().then_some(frame)
}
