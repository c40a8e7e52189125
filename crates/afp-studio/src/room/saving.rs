//! Automatic work: texts are saved, and changes by other programs are noticed.

use std::time::{Duration, Instant};

use afp_lsp::uri_of;
use serde_json::json;

use super::document::{Look, Saved};
use super::{ClientId, LOOKS_EVERY, Out, Room, disputed, notification};

/// The attempts to save a text at once, while another program writes the same file.
const TRIES: usize = 3;

/// The time between two scans: ten times the duration of the last one, since it blocks the room,
/// and at least a minimum per entry.
fn pause(entries: usize, took: Duration) -> Duration {
    Duration::from_micros(20 * entries as u64).max(took * 10)
}

impl Room {
    /// The time of the next [`Room::tick`].
    pub fn due(&self) -> Duration {
        let saves = self.documents.values().filter_map(|document| document.due());
        let due = saves.chain(self.jobs_due()).min();
        due.map_or(self.looked + LOOKS_EVERY, |due| due.min(self.looked + LOOKS_EVERY))
    }

    /// Saves due texts, and scans the folder from time to time.
    pub fn tick(&mut self, now: Duration) -> Out {
        let mut out = Vec::new();
        if self.falls.is_some_and(|falls| falls <= now) {
            out.extend(self.hand_pen(self.clients.keys().next().copied()));
        }
        if self.jobs_due().is_some_and(|due| due <= now) {
            out.extend(self.tell_jobs(now));
        }
        if now >= self.looked + LOOKS_EVERY {
            self.looked = now;
            self.end_jobs_alone(now);
            if now >= self.walked + pause(self.listed.entries, self.walking) {
                let begin = Instant::now();
                self.walked = now;
                out.extend(self.look_at_files());
                self.walking = begin.elapsed();
            }
            let open: Vec<_> = self.documents.keys().cloned().collect();
            for path in open {
                out.extend(self.look_at(&path, now));
            }
        }
        out.extend(self.save(now, |due| due <= now));
        out
    }

    /// Saves everything before the program ends.
    pub fn save_all(&mut self, now: Duration) -> Out {
        self.save(now, |_| true)
    }

    fn save(&mut self, now: Duration, wanted: impl Fn(Duration) -> bool) -> Out {
        let due = |(path, document): (&String, &super::Document)| {
            document.due().filter(|&due| wanted(due)).map(|_| path.clone())
        };
        let paths: Vec<_> = self.documents.iter().filter_map(due).collect();
        let mut out = Vec::new();
        for path in &paths {
            let is_written = (0..TRIES).any(|_| self.save_one(path, now, &wanted, &mut out));
            if !is_written {
                let why = "another program keeps writing it".to_owned();
                out.extend(self.tell_saved(path, Err(why)));
            }
        }
        if !paths.is_empty() {
            self.forget();
        }
        out
    }

    /// Saves a text that is still due, but never over another program's change; returns whether it
    /// is done.
    fn save_one(
        &mut self,
        path: &str,
        now: Duration,
        wanted: &impl Fn(Duration) -> bool,
        out: &mut Out,
    ) -> bool {
        out.extend(self.look_at(path, now));
        let Some(document) = self.documents.get_mut(path) else { return true };
        if !document.due().is_some_and(wanted) {
            return true;
        }
        let saved = match document.save(now) {
            Ok(Saved::Not) => return false,
            Ok(Saved::Removed) => Ok(()),
            Ok(Saved::Written(stamp)) => {
                // The room's own write is not reported as a change.
                self.listed.files.insert(path.to_owned(), stamp);
                Ok(())
            }
            Err(why) => Err(why),
        };
        out.extend(self.tell_saved(path, saved));
        true
    }

    /// Sends the clients of a text whether it is saved.
    pub(super) fn tell_saved(&self, path: &str, saved: Result<(), String>) -> Out {
        let Some(document) = self.documents.get(path) else { return Vec::new() };
        let uri = uri_of(path);
        let mut out = Vec::new();
        for (&id, client) in &self.clients {
            let Some((version, own)) = client.server.text(&uri) else { continue };
            let mut said = json!({ "uri": uri, "version": version, "etag": document.etag() });
            match &saved {
                Ok(()) if own != document.text => continue,
                Ok(()) => {}
                Err(why) => said["failed"] = json!(why),
            }
            out.push((id, notification("afp/saved", said)));
        }
        out
    }

    pub(super) fn tell_if_saved(&self, id: ClientId, path: &str) -> Out {
        let Some(document) = self.documents.get(path).filter(|it| it.is_saved()) else {
            return Vec::new();
        };
        let uri = uri_of(path);
        let version = self.clients.get(&id).and_then(|client| client.server.text(&uri));
        let Some((version, _)) = version.filter(|(_, own)| *own == document.text) else {
            return Vec::new();
        };
        let said = json!({ "uri": uri, "version": version, "etag": document.etag() });
        vec![(id, notification("afp/saved", said))]
    }

    /// Checks the file of an open text.
    pub(super) fn look_at(&mut self, path: &str, now: Duration) -> Out {
        let Some(document) = self.documents.get_mut(path) else { return Vec::new() };
        let was_disputed = document.is_disputed();
        let look = document.look(now);
        let is_settled = was_disputed && !document.is_disputed();
        let text = document.text.clone();
        let uri = uri_of(path);
        let mut out = match look {
            Look::Changed if is_settled => Vec::new(),
            Look::Same => Vec::new(),
            Look::Saved => self.tell_saved(path, Ok(())),
            Look::Removed => {
                let name = self.folder.name(path);
                let why = format!(
                    "another program has removed '{name}'; your next change saves it again"
                );
                self.tell_saved(path, Err(why))
            }
            Look::Changed => self.tell_all(&uri, &text),
            Look::Unreadable(why) => self.tell_saved(path, Err(why)),
            Look::Conflict(theirs) => {
                self.having(&uri).into_iter().map(|id| (id, disputed(&uri, &theirs))).collect()
            }
        };
        if is_settled {
            out.extend(self.settled(path));
        }
        out
    }

    /// Scans the tree for new and removed files, and for changes of files that plans may use.
    pub(super) fn look_at_files(&mut self) -> Out {
        let found = self.folder.list();
        let before = std::mem::replace(&mut self.listed, found);
        let found = &self.listed;
        if (&found.files, found.is_cut) == (&before.files, before.is_cut) {
            return Vec::new();
        }
        let others = !found.files.keys().eq(before.files.keys()) || found.is_cut != before.is_cut;
        let listed = json!({ "files": self.files(), "more": found.is_cut });
        let mut out = Vec::new();
        let ids: Vec<_> = self.clients.keys().copied().collect();
        for id in ids {
            let watched = notification("workspace/didChangeWatchedFiles", json!({ "changes": [] }));
            out.extend(self.forward(id, watched));
            if others {
                out.push((id, notification("afp/files", listed.clone())));
            }
        }
        out
    }

    /// Tells the clients that a conflict is resolved.
    pub(super) fn settled(&mut self, path: &str) -> Out {
        let Some(document) = self.documents.get(path) else { return Vec::new() };
        let (uri, text) = (uri_of(path), document.text.clone());
        let having = self.having(&uri).into_iter();
        having.filter_map(|id| self.tell(id, &uri, &text)).collect()
    }
}
