//! Receivers of a run's messages: a file or live clients.

use std::path::PathBuf;

use afp_core::Instant;

use crate::error::LogError;

/// Receives a run's messages.
pub trait Messages: Send {
    /// Opens a channel of protobuf messages: its topic, the name of its schema, the schema's
    /// descriptors (a `FileDescriptorSet`). Returns its number.
    ///
    /// # Errors
    /// The channel cannot be opened.
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<u16, LogError>;

    /// Takes a message; `sequence` counts the messages of its channel.
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

    /// Takes the results of the run, by name.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn came(&mut self, facts: Vec<(String, String)>) -> Result<(), LogError>;

    /// Makes all messages visible to readers.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn flush(&mut self) -> Result<(), LogError>;

    /// Ends the messages; `in_order` if the run has ended. Returns the file and its size in bytes,
    /// if there is a file.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn finish(self: Box<Self>, in_order: bool) -> Result<(PathBuf, u64), LogError>;

    /// Ends the messages of a run that never started, and removes the file.
    fn discard(self: Box<Self>) {
        // There is no receiver for the error.
        let _ = self.finish(false);
    }
}
