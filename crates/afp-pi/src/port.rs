//! A serial port. Neither reading nor writing waits.

use std::fs::File;
use std::io::{self, Read, Write};
use std::os::unix::fs::OpenOptionsExt;

use afp_platform::{open_device, release_device};
use rustix::fs::OFlags;
use rustix::io::Errno;
use rustix::termios::{OptionalActions, QueueSelector, isatty, tcflush, tcgetattr, tcsetattr};

/// The most bytes of one write.
const CHUNK: usize = 512;

/// A serial port of only this program. Bytes that it does not take at once are lost.
#[derive(Debug)]
pub(crate) struct Port {
    file: File,
    /// The byte between two messages.
    end: u8,
    /// Whether the last write was complete.
    whole: bool,
}

impl Port {
    /// Opens a port in both directions. A serial line gets the speed in baud, and does not edit or
    /// echo. `end` is the byte between two messages.
    ///
    /// # Errors
    /// The port cannot be opened or set up.
    pub(crate) fn open(path: &str, baud: u32, end: u8) -> io::Result<Self> {
        // The port must not become the controlling terminal of this process.
        let flags = (OFlags::NONBLOCK | OFlags::NOCTTY).bits() as i32;
        let file = open_device(File::options().read(true).write(true).custom_flags(flags), path)?;
        if let Err(why) = set_up(&file, baud) {
            release_device(&file);
            return Err(why);
        }
        Ok(Port { file, end, whole: false })
    }

    /// The same port, for another thread.
    pub(crate) fn copy(&self) -> Option<Self> {
        Some(Port { file: self.file.try_clone().ok()?, end: self.end, whole: false })
    }

    /// Discards everything in the output queue, so that the next message overtakes it.
    pub(crate) fn discard(&mut self) {
        // A line without a queue has nothing to discard.
        let _ = tcflush(&self.file, QueueSelector::OFlush);
        self.whole = false;
    }

    /// Writes a message with its end. If the line is broken or full, nothing is sent.
    pub(crate) fn write(&mut self, message: &[u8]) {
        let mut bytes = [self.end; CHUNK];
        // A message that was cut ends here, damaged, and does not run into the next one.
        let start = usize::from(!self.whole);
        let Some(room) = bytes.get_mut(start..start + message.len()) else { return };
        room.copy_from_slice(message);
        let all = bytes.get(..start + message.len()).unwrap_or_default();
        self.whole = matches!(self.file.write(all), Ok(written) if written == all.len());
    }

    /// Reads bytes that have arrived; 0 if there are none.
    pub(crate) fn read(&mut self, bytes: &mut [u8]) -> usize {
        self.file.read(bytes).unwrap_or_default()
    }

    /// Lets other programs open the port.
    pub(crate) fn release(&self) {
        release_device(&self.file);
    }
}

/// Sets up a serial line.
fn set_up(file: &File, baud: u32) -> io::Result<()> {
    if !isatty(file) {
        return Ok(());
    }
    match tcgetattr(file) {
        Ok(mut modes) => {
            modes.make_raw();
            modes.set_speed(baud)?;
            tcsetattr(file, OptionalActions::Now, &modes)?;
        }
        // QEMU cannot set up a line for an emulated program. The other end of a pseudo-terminal can.
        Err(Errno::NOSYS) => {}
        Err(why) => return Err(why.into()),
    }
    // Earlier messages do not count.
    Ok(tcflush(file, QueueSelector::IFlush)?)
}
