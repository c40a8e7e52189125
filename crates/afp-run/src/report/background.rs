//! Writes standard output on a separate thread: a slow reader must not delay a moving robot.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::thread::{self, JoinHandle};

/// The capacity of the queue; beyond it, pieces are lost and counted.
const WAITING: usize = 1024;

/// A writer that blocks only in `finish`.
pub(super) struct BackgroundWriter {
    pieces: Option<SyncSender<Vec<u8>>>,
    writer: Option<JoinHandle<io::Result<()>>>,
    piece: Vec<u8>,
    lost: u64,
}

impl BackgroundWriter {
    /// Sets `closed` if the output fails.
    ///
    /// # Errors
    /// The thread cannot be created.
    pub(super) fn new(out: Box<dyn Write + Send>, closed: Arc<AtomicBool>) -> io::Result<Self> {
        let (pieces, waiting) = sync_channel(WAITING);
        let thread = thread::Builder::new().name("afp-report".into());
        let writer = thread.spawn(move || {
            let written = write_all(out, &waiting);
            closed.fetch_or(written.is_err(), Ordering::Relaxed);
            written
        })?;
        Ok(BackgroundWriter {
            pieces: Some(pieces),
            writer: Some(writer),
            piece: Vec::new(),
            lost: 0,
        })
    }

    /// Sends the text since the last line end.
    fn send(&mut self) -> io::Result<()> {
        let piece = std::mem::take(&mut self.piece);
        match self.pieces.as_ref().map(|pieces| pieces.try_send(piece)) {
            Some(Ok(())) => Ok(()),
            Some(Err(TrySendError::Full(_))) => {
                self.lost += 1;
                Ok(())
            }
            // The thread has failed and now returns its error.
            Some(Err(TrySendError::Disconnected(_))) | None => self.finish(),
        }
    }

    /// Waits until all text is written. Called when the robot has stopped.
    fn finish(&mut self) -> io::Result<()> {
        self.pieces = None;
        let gone = || io::Error::other("the thread that writes standard output has ended");
        match self.writer.take() {
            Some(writer) => writer.join().map_err(|_| gone())?,
            None => Err(gone()),
        }
    }
}

impl Write for BackgroundWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.piece.extend_from_slice(bytes);
        if self.piece.ends_with(b"\n") {
            self.send()?;
        }
        Ok(bytes.len())
    }

    /// Does nothing: each line is sent at once.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The output of a report.
pub(super) enum Out {
    /// Written on the thread of the report.
    Here(Box<dyn Write + Send>),
    /// Written on a separate thread.
    Background(BackgroundWriter),
}

impl Out {
    /// Writes the remaining text; returns the number of lost lines.
    pub(super) fn finish(self) -> io::Result<u64> {
        match self {
            Out::Here(mut out) => out.flush().map(|()| 0),
            Out::Background(mut writer) => {
                let written = writer.finish();
                written.map(|()| writer.lost)
            }
        }
    }
}

impl Write for Out {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Out::Here(out) => out.write(bytes),
            Out::Background(writer) => writer.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Out::Here(out) => out.flush(),
            Out::Background(writer) => writer.flush(),
        }
    }
}

fn write_all(mut out: Box<dyn Write + Send>, pieces: &Receiver<Vec<u8>>) -> io::Result<()> {
    for piece in pieces {
        out.write_all(&piece)?;
        out.flush()?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Sender, channel};
    use std::time::Duration;

    use super::*;

    /// Waits for a message before each write, and passes the text on.
    struct Slow(Receiver<()>, Sender<Vec<u8>>);

    impl Write for Slow {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let _ = self.0.recv();
            self.1.send(bytes.to_vec()).map_err(|_| io::ErrorKind::BrokenPipe)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_waiting_reader_does_not_block_and_loses_only_the_last_lines() {
        let (go, word) = channel();
        let (out, written) = channel();
        let mut writer = BackgroundWriter::new(Box::new(Slow(word, out)), Arc::default()).unwrap();
        for line in 0..WAITING + 10 {
            writeln!(writer, "{line}").unwrap();
        }
        assert_eq!(written.recv_timeout(Duration::from_millis(1)).ok(), None, "nothing is written");
        drop(go);
        let lost = Out::Background(writer).finish().unwrap();
        let text: Vec<u8> = written.iter().flatten().collect();
        let lines = String::from_utf8(text).unwrap().lines().count();
        // The first line may or may not have left the queue when the others come.
        assert_eq!(lines + usize::try_from(lost).unwrap(), WAITING + 10);
        assert!((9..=10).contains(&lost), "{lost}");
    }

    #[test]
    fn an_error_of_the_reader_is_reported() {
        let (out, written) = channel();
        drop(written);
        let slow = Box::new(Slow(channel().1, out));
        let mut writer = BackgroundWriter::new(slow, Arc::default()).unwrap();
        let told = (0..1000).find_map(|_| {
            std::thread::sleep(Duration::from_millis(1));
            writeln!(writer, "line").err()
        });
        assert_eq!(told.map(|error| error.kind()), Some(io::ErrorKind::BrokenPipe));
    }

    /// Without this, a robot without further output would drive on.
    #[test]
    fn an_error_is_noticed_without_another_line() {
        let (out, written) = channel();
        drop(written);
        let closed: Arc<AtomicBool> = Arc::default();
        let slow = Box::new(Slow(channel().1, out));
        let mut writer = BackgroundWriter::new(slow, closed.clone()).unwrap();
        writeln!(writer, "line").unwrap();
        let deadline = std::time::Instant::now() + Duration::from_secs(60);
        while !closed.load(Ordering::Relaxed) {
            assert!(std::time::Instant::now() < deadline, "nobody notices");
            std::thread::sleep(Duration::from_millis(1));
        }
        let error = Out::Background(writer).finish().unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::BrokenPipe);
    }
}
