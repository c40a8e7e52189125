//! One message as bytes: postcard, a checksum, and byte stuffing.

use core::fmt;

use crc::{CRC_32_ISO_HDLC, Crc};
use postcard::ser_flavors::crc::CrcModifier;
use postcard::ser_flavors::{Cobs, Slice};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

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
    let stuffed = Cobs::try_new(Slice::new(buffer)).map_err(|_| TooLong)?;
    let summed = CrcModifier::new(stuffed, CHECKSUM.digest());
    let written = postcard::serialize_with_flavor(frame, summed).map_err(|_| TooLong)?;
    Ok(written)
}

/// Reads a frame without its end, in place; `None` if it is damaged.
pub(crate) fn read<T: DeserializeOwned>(bytes: &mut [u8]) -> Option<Frame<T>> {
    let length = cobs::decode_in_place(bytes).ok()?;
    let (frame, rest) =
        postcard::take_from_bytes_crc32(bytes.get(..length)?, CHECKSUM.digest()).ok()?;
    rest.is_empty().then_some(frame)
}
