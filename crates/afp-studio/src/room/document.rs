//! A text that is open, and the file that it is saved in.

use std::path::PathBuf;
use std::time::Duration;

use crate::files::{self, Kept, Stamp};

/// How long a change waits for further ones before it is written.
const SAVES_AFTER: Duration = Duration::from_millis(200);

/// How long it takes until writing is tried again that has failed.
const TRIES_AGAIN_AFTER: Duration = Duration::from_secs(2);

pub(super) struct Document {
    pub text: String,
    file: PathBuf,
    /// What lies in the file, as far as known: what others change is merged over this.
    kept: Kept,
    stamp: Option<Stamp>,
    /// Since when the file has been empty, though it was not: somebody may be about to fill it again.
    emptied: Option<Stamp>,
    /// When it is to be written; none where it is.
    due: Option<Duration>,
    /// What somebody else has written that does not go together with this text: nothing is written before a person
    /// has chosen.
    theirs: Option<Kept>,
    /// What lies in the file cannot be read, so that nobody knows what would be written over.
    unreadable: bool,
}

/// What a look at the file has shown.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// Nothing new.
    Same,
    /// The text is another one now.
    Changed,
    /// Somebody else has written this very text.
    Saved,
    /// Somebody else has removed the file.
    Removed,
    /// Theirs, which does not go together with this text.
    Conflict(String),
    /// What lies there is no text: why. Nothing is written over it.
    Unreadable(String),
}

/// Which text of two that do not go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keep {
    Mine,
    Theirs,
    /// Both, with the marks of version control between.
    Both,
}

impl Document {
    /// # Errors
    /// The file cannot be read: a sentence.
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

    /// Another text, to be written soon, unless it is what lies in the file.
    pub fn set(&mut self, text: String, now: Duration) {
        self.text = text;
        match self.is_as_kept() {
            true => self.due = None,
            false => _ = self.due.get_or_insert(now + SAVES_AFTER),
        }
    }

    /// Whether the file holds this text, as far as known.
    fn is_as_kept(&self) -> bool {
        let known = self.kept.etag.is_some() && !self.unreadable && self.theirs.is_none();
        known && self.text == self.kept.text
    }

    pub fn is_saved(&self) -> bool {
        self.due.is_none()
    }

    /// Whether nothing is lost where this is forgotten: a file that was removed, or cannot be read, lies here alone.
    pub fn is_in_file(&self) -> bool {
        let was_never_there = self.kept.etag.is_none() && self.text.is_empty();
        self.due.is_none() && (self.is_as_kept() || was_never_there)
    }

    /// Whether somebody has to choose between this text and theirs.
    pub fn is_disputed(&self) -> bool {
        self.theirs.is_some()
    }

    /// Whether the file holds what cannot be read.
    pub fn is_unreadable(&self) -> bool {
        self.unreadable
    }

    /// Theirs, while somebody has to choose.
    pub fn theirs(&self) -> Option<&str> {
        self.theirs.as_ref().map(|theirs| theirs.text.as_str())
    }

    /// When it is to be written.
    pub fn due(&self) -> Option<Duration> {
        self.due.filter(|_| self.theirs.is_none() && !self.unreadable)
    }

    /// Looks at the file: what somebody else has written is taken over, or merged by lines.
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
        // What was in conflict no longer lies there; what lies there may be so anew.
        self.theirs = None;
        if found.etag == self.kept.etag {
            return if was_unreadable && self.due.is_none() { Look::Saved } else { Look::Same };
        }
        // The text is all that is left, and stays; the next change writes it anew.
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

    /// Whether a file has just been emptied, as most programs do before they write into it: it counts as empty once it
    /// is found so again.
    fn is_being_written(&mut self, found: &str, stamp: Option<Stamp>) -> bool {
        let news = found.is_empty() && !self.kept.text.is_empty() && self.emptied != stamp;
        self.emptied = stamp.filter(|_| found.is_empty());
        news
    }

    /// Ends a conflict; without one, nothing happens.
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

    /// Writes the text; gives the stamp of what was written, which another program may have written over since. None where it
    /// has written before, so that the file is to be looked at first.
    ///
    /// # Errors
    /// It cannot be written; it will be tried again.
    pub fn save(&mut self, now: Duration) -> Result<Option<Stamp>, String> {
        match self.kept.write(&self.file, &self.text) {
            Ok(Some((kept, stamp))) => {
                (self.kept, self.stamp, self.due) = (kept, Some(stamp), None);
                Ok(Some(stamp))
            }
            Ok(None) => {
                self.stamp = None;
                Ok(None)
            }
            Err(why) => {
                self.due = Some(now + TRIES_AGAIN_AFTER);
                Err(why)
            }
        }
    }
}
