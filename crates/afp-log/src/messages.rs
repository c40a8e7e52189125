//! Where the messages of a run go: a file, clients that watch.

use std::path::PathBuf;

use afp_core::Instant;

use crate::error::LogError;

/// Who takes the messages of a run: a file, clients that watch.
pub trait Messages: Send {
    /// Opens a channel of protobuf messages: its topic, the name of its schema, the descriptors that explain it (a
    /// `FileDescriptorSet`). Gives its number.
    ///
    /// # Errors
    /// It cannot be opened.
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<u16, LogError>;

    /// Takes a message; `sequence` counts those of its channel.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn send(
        &mut self,
        channel: u16,
        sequence: u32,
        at: Instant,
        message: &[u8],
    ) -> Result<(), LogError>;

    /// What the run came to, by name.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn came(&mut self, facts: Vec<(String, String)>) -> Result<(), LogError>;

    /// What has been taken is to be seen by others.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn flush(&mut self) -> Result<(), LogError>;

    /// Nothing comes any more; `in_order` where the run is over. Gives the file and its size in bytes, where there is
    /// one.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn finish(self: Box<Self>, in_order: bool) -> Result<(PathBuf, u64), LogError>;

    /// Nothing comes any more, and nothing came of the run: of a file nothing stays.
    fn discard(self: Box<Self>) {
        // There is nobody to tell.
        let _ = self.finish(false);
    }
}
