//! Standard output written by a thread of its own: whoever reads slowly must not hold up a robot that moves.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::thread::{self, JoinHandle};

/// So many pieces wait at most; what comes then is lost and counted.
const WAITING: usize = 1024;

/// A writer that never waits before it is finished.
pub(super) struct BackgroundWriter {
    pieces: Option<SyncSender<Vec<u8>>>,
    writer: Option<JoinHandle<io::Result<()>>>,
    piece: Vec<u8>,
    lost: u64,
}

impl BackgroundWriter {
    /// Sets `closed` if nothing can be written any more.
    ///
    /// # Errors
    /// There is no thread for it.
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

    /// Sends what was written since the last line ended.
    fn send(&mut self) -> io::Result<()> {
        let piece = std::mem::take(&mut self.piece);
        match self.pieces.as_ref().map(|pieces| pieces.try_send(piece)) {
            Some(Ok(())) => Ok(()),
            Some(Err(TrySendError::Full(_))) => {
                self.lost += 1;
                Ok(())
            }
            // It has met an error and says which in the end.
            Some(Err(TrySendError::Disconnected(_))) | None => self.finish(),
        }
    }

    /// Waits until all is written: for when the robot stands.
    fn finish(&mut self) -> io::Result<()> {
        self.pieces = None;
        let gone = || io::Error::other("what writes standard output is gone");
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

    /// Does nothing: each line is on its way.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// What a report is written to.
pub(super) enum Out {
    /// By whoever reports.
    Here(Box<dyn Write + Send>),
    /// By a thread of its own.
    Background(BackgroundWriter),
}

impl Out {
    /// What is still to be written once nothing more comes; how many lines were lost.
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

    /// Waits for a word before it writes, and hands on what it has written.
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
    fn a_reader_who_waits_holds_nobody_up_and_loses_the_last_lines_alone() {
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
        // One line has left the queue or not when the others come.
        assert_eq!(lines + usize::try_from(lost).unwrap(), WAITING + 10);
        assert!((9..=10).contains(&lost), "{lost}");
    }

    #[test]
    fn an_error_of_the_reader_is_told() {
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

    /// Without this, a robot that has nothing more to say would drive on.
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
