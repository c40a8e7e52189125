//! An open text, and the file in which it is saved.

use std::path::PathBuf;
use std::time::Duration;
use std::{fs, io};

use crate::files::{self, Kept, Stamp};

/// The time that a change waits for further ones before it is written.
const SAVES_AFTER: Duration = Duration::from_millis(200);

/// The time between attempts to write.
const TRIES_AGAIN_AFTER: Duration = Duration::from_secs(2);

pub(super) struct Document {
    pub text: String,
    file: PathBuf,
    /// The last known content of the file, the base for merging other changes.
    kept: Kept,
    stamp: Option<Stamp>,
    /// The time since which the file is unexpectedly empty: another program may be about to fill
    /// it.
    emptied: Option<Stamp>,
    /// The time of the next write; `None` if it is saved.
    due: Option<Duration>,
    /// Another program's text that conflicts with this one. Nothing is written until a user
    /// chooses.
    theirs: Option<Kept>,
    /// The file is unreadable, so writing could lose its content.
    unreadable: bool,
}

/// The result of a check of the file.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// No change.
    Same,
    /// The room's text has changed.
    Changed,
    /// Another program has written the room's text.
    Saved,
    /// Another program has removed the file.
    Removed,
    /// The other text, which conflicts with this one.
    Conflict(String),
    /// The reason why the file is not a text. It is not overwritten.
    Unreadable(String),
}

/// The result of a write.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Saved {
    Written(Stamp),
    /// The text is empty and needs no file, so the file was removed.
    Removed,
    /// Another program wrote first, so that the file needs a check.
    Not,
}

/// The text to keep in a conflict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keep {
    Mine,
    Theirs,
    /// Both, with conflict markers.
    Both,
}

impl Document {
    /// # Errors
    /// A sentence: the file cannot be read.
    pub fn read(file: PathBuf) -> Result<Document, String> {
        let stamp = files::stamp(&file);
        let kept = files::read(&file)?;
        let text = kept.text.clone();
        Ok(Document {
            text,
            file,
            kept,
            stamp,
            emptied: None,
            due: None,
            theirs: None,
            unreadable: false,
        })
    }

    pub fn etag(&self) -> Option<&str> {
        self.kept.etag.as_deref()
    }

    /// Sets a new text, to be written soon unless the file has it.
    pub fn set(&mut self, text: String, now: Duration) {
        self.text = text;
        match self.is_as_kept() {
            true => self.due = None,
            false => _ = self.due.get_or_insert(now + SAVES_AFTER),
        }
    }

    /// Whether the file holds this text, as far as known.
    fn is_as_kept(&self) -> bool {
        let known = self.kept.etag.is_some() || self.needs_no_file();
        known && !self.unreadable && self.theirs.is_none() && self.text == self.kept.text
    }

    /// Whether an empty file would say nothing: the positions of a drawing without any.
    fn needs_no_file(&self) -> bool {
        self.text.is_empty() && self.file.extension().is_some_and(|ending| ending == "layout")
    }

    pub fn is_saved(&self) -> bool {
        self.due.is_none()
    }

    /// Whether forgetting it loses nothing; the text of a removed or unreadable file exists only
    /// here.
    pub fn is_in_file(&self) -> bool {
        let was_never_there = self.kept.etag.is_none() && self.text.is_empty();
        self.due.is_none() && (self.is_as_kept() || was_never_there)
    }

    /// Whether a user has to resolve a conflict.
    pub fn is_disputed(&self) -> bool {
        self.theirs.is_some()
    }

    /// Whether the file is unreadable.
    pub fn is_unreadable(&self) -> bool {
        self.unreadable
    }

    /// The other text of a conflict.
    pub fn theirs(&self) -> Option<&str> {
        self.theirs.as_ref().map(|theirs| theirs.text.as_str())
    }

    /// The time of the next write.
    pub fn due(&self) -> Option<Duration> {
        self.due.filter(|_| self.theirs.is_none() && !self.unreadable)
    }

    /// Checks the file: another program's change is taken over, or merged by lines.
    pub fn look(&mut self, now: Duration) -> Look {
        let stamp = files::stamp(&self.file);
        if self.stamp == stamp && !self.unreadable && !stamp.is_some_and(files::is_fresh) {
            return Look::Same;
        }
        let found = match files::read(&self.file) {
            Ok(found) => found,
            Err(_) if self.unreadable => return Look::Same,
            Err(why) => {
                self.unreadable = true;
                return Look::Unreadable(why);
            }
        };
        let was_unreadable = std::mem::take(&mut self.unreadable);
        if found.etag.is_some() && self.is_being_written(&found.text, stamp) {
            self.due = self.due.map(|_| now + SAVES_AFTER);
            return Look::Same;
        }
        self.stamp = stamp;
        if self.theirs.as_ref().is_some_and(|theirs| theirs.etag == found.etag) {
            return Look::Same;
        }
        // The old conflict is gone; the new content may conflict again.
        self.theirs = None;
        if found.etag == self.kept.etag {
            return if was_unreadable && self.due.is_none() { Look::Saved } else { Look::Same };
        }
        // This is the only copy, so it stays; the next change writes it.
        if found.etag.is_none() {
            self.kept.etag = None;
            return if self.due.is_none() { Look::Removed } else { Look::Same };
        }
        if self.text == found.text {
            (self.due, self.kept) = (None, found);
            return Look::Saved;
        }
        if self.due.is_none() {
            self.text.clone_from(&found.text);
            self.kept = found;
            return Look::Changed;
        }
        match diffy::merge(&self.kept.text, &self.text, &found.text) {
            Ok(both) => {
                (self.text, self.kept, self.due) = (both, found, Some(now));
                Look::Changed
            }
            Err(_) => {
                let text = found.text.clone();
                self.theirs = Some(found);
                Look::Conflict(text)
            }
        }
    }

    /// Whether a file has just been emptied, as most programs do before writing. It counts as empty
    /// if the next check finds it empty, too.
    fn is_being_written(&mut self, found: &str, stamp: Option<Stamp>) -> bool {
        let news = found.is_empty() && !self.kept.text.is_empty() && self.emptied != stamp;
        self.emptied = stamp.filter(|_| found.is_empty());
        news
    }

    /// Ends a conflict, if there is one.
    pub fn choose(&mut self, keep: Keep, now: Duration) {
        let Some(theirs) = self.theirs.take() else { return };
        match keep {
            Keep::Mine => {}
            Keep::Theirs => self.text.clone_from(&theirs.text),
            Keep::Both => {
                let merged = diffy::merge(&self.kept.text, &self.text, &theirs.text);
                self.text = merged.unwrap_or_else(|marked| marked);
            }
        }
        (self.kept, self.due) = (theirs, Some(now));
    }

    /// Writes the text, although another program may write afterwards.
    ///
    /// # Errors
    /// It cannot be written; another attempt follows.
    pub fn save(&mut self, now: Duration) -> Result<Saved, String> {
        let written = match self.needs_no_file() {
            true => self.remove(),
            false => self.kept.write(&self.file, &self.text),
        };
        match written {
            Ok(Some((kept, stamp))) => {
                (self.kept, self.stamp, self.due) = (kept, Some(stamp), None);
                Ok(Saved::Written(stamp))
            }
            Ok(None) if self.due.is_none() => Ok(Saved::Removed),
            Ok(None) => {
                self.stamp = None;
                Ok(Saved::Not)
            }
            Err(why) => {
                self.due = Some(now + TRIES_AGAIN_AFTER);
                Err(why)
            }
        }
    }

    /// Removes the file, if it is as known; the text is then saved.
    fn remove(&mut self) -> Result<Option<(Kept, Stamp)>, String> {
        if files::read(&self.file).is_ok_and(|now| now.etag == self.kept.etag) {
            match fs::remove_file(&self.file) {
                Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(why.to_string()),
                _ => (self.kept, self.stamp, self.due) = (Kept::default(), None, None),
            }
        }
        Ok(None)
    }
}
