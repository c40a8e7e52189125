//! The inputs of a result, so that it is recomputed only after one of them changed.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::workspace::Workspace;

/// Texts that were read.
#[derive(Debug, Default)]
pub(crate) struct Reads(Vec<Read>);

#[derive(Debug)]
struct Read {
    path: String,
    /// The stamp of the last comparison without a difference.
    stamp: AtomicU64,
    said: u64,
}

impl Reads {
    /// Reads a text and remembers it, also if it is missing.
    ///
    /// # Errors
    /// The reason if there is no text.
    pub fn text(&mut self, workspace: &Workspace, path: &str) -> Result<String, String> {
        let text = workspace.text(path);
        self.0.push(Read {
            path: path.to_owned(),
            stamp: workspace.documents.stamp(path).into(),
            said: said(&text),
        });
        text
    }

    /// Whether all texts are unchanged, for example after a save without a change.
    pub fn hold(&self, workspace: &Workspace) -> bool {
        self.0.iter().all(|read| {
            let stamp = workspace.documents.stamp(&read.path);
            let holds = read.stamp.load(Ordering::Relaxed) == stamp
                || said(&workspace.text(&read.path)) == read.said;
            if holds {
                read.stamp.store(stamp, Ordering::Relaxed);
            }
            holds
        })
    }
}

fn said(text: &Result<String, String>) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.as_ref().ok().hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use crate::host::Host;
    use crate::workspace::Workspace;

    struct Disk(Arc<Mutex<String>>);

    impl Host for Disk {
        fn read(&self, path: &str) -> Result<String, String> {
            let text = self.0.lock().map_err(|why| why.to_string())?;
            if path == "/plans/b.afp" { Ok(text.clone()) } else { Err("none".to_owned()) }
        }

        fn plan_files(&self, _: &str) -> Vec<String> {
            Vec::new()
        }

        fn built_in(&self, _: &str, _: &str) -> Option<String> {
            None
        }
    }

    /// Previously a save compiled and drew everything again.
    #[test]
    fn an_unchanged_file_is_not_compiled_again() -> Result<(), &'static str> {
        let plan = "use std\nplan B { start rest actor rest: Wait(duration = 1 s) { Elapsed -> terminate } }\n";
        let file = Arc::new(Mutex::new(plan.to_owned()));
        let mut workspace = Workspace::new(Box::new(Disk(Arc::clone(&file))));
        let look = |workspace: &mut Workspace| {
            workspace.documents.disk_changed();
            workspace.analysis("/plans/b.afp").ok_or("nothing was read")
        };
        let first = look(&mut workspace)?;
        assert!(Arc::ptr_eq(&first, &look(&mut workspace)?));
        *file.lock().map_err(|_| "locked")? = plan.replace("1 s", "2 s");
        assert!(!Arc::ptr_eq(&first, &look(&mut workspace)?));
        Ok(())
    }
}
