//! The logs on a robot: their names, and their limit.
//!
//! A name has the number of the switch to the release and the number of the run: `Patrol-12-3.mcap`.
//! The numbers order the logs, because the clock of a robot may be wrong.

use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::store::names_in;

/// The default of the most bytes of all logs together.
pub const USUAL: u64 = 1_000_000_000;

const ENDING: &str = ".mcap";

/// The folder of the logs.
pub struct Logs {
    folder: PathBuf,
}

/// The number of the switch and of the run.
type Order = (u64, u64);

impl Logs {
    pub fn of(root: &Path) -> Self {
        Logs { folder: root.join("logs") }
    }

    /// The path of the next log of a plan, after a switch.
    pub fn next(&self, plan: &str, generation: u64) -> PathBuf {
        let known = names_in(&self.folder);
        let known = known.iter().filter_map(|name| order(name));
        let last = known.filter(|(of, _)| *of == generation).map(|(_, run)| run).max();
        let run = last.map_or(1, |last| last.saturating_add(1));
        self.folder.join(format!("{plan}-{generation}-{run}{ENDING}"))
    }

    /// Removes the oldest logs until all together have at most so many bytes. The newest log, which
    /// may be in progress, stays. Files with other names stay and do not count.
    ///
    /// # Errors
    /// A log cannot be removed.
    pub fn prune(&self, most: u64) -> io::Result<()> {
        let mut logs: Vec<(Order, PathBuf, u64)> = Vec::new();
        for name in names_in(&self.folder) {
            let path = self.folder.join(&name);
            if let (Some(order), Ok(about)) = (order(&name), fs::symlink_metadata(&path))
                && about.is_file()
            {
                logs.push((order, path, about.len()));
            }
        }
        logs.sort();
        let mut all: u64 = logs.iter().fold(0, |all, log| all.saturating_add(log.2));
        logs.pop();
        for (_, path, size) in logs {
            if all <= most {
                break;
            }
            fs::remove_file(path)?;
            all = all.saturating_sub(size);
        }
        Ok(())
    }
}

/// The numbers in the name of a log.
fn order(name: &str) -> Option<Order> {
    let mut parts = name.strip_suffix(ENDING)?.rsplitn(3, '-');
    let (run, generation) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
    parts.next().map(|_| (generation, run))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_logs_are_removed_by_their_numbers_and_the_newest_stays() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("logs");
        fs::create_dir(&folder).unwrap();
        let logs = Logs::of(root.path());
        let written = [("B-9-1", 30), ("A-10-9", 30), ("A-10-10", 30), ("A-11-1", 500)];
        for (name, size) in written.into_iter().rev() {
            // The clock went back before each log.
            fs::write(folder.join(format!("{name}.mcap")), vec![0; size]).unwrap();
        }
        fs::write(folder.join("notes.txt"), [0; 100]).unwrap();
        logs.prune(590).unwrap();
        assert_eq!(names_in(&folder).len(), 5);
        logs.prune(589).unwrap();
        assert_eq!(names_in(&folder), ["A-10-10.mcap", "A-10-9.mcap", "A-11-1.mcap", "notes.txt"]);
        logs.prune(530).unwrap();
        assert_eq!(names_in(&folder), ["A-10-10.mcap", "A-11-1.mcap", "notes.txt"]);
        logs.prune(0).unwrap();
        assert_eq!(names_in(&folder), ["A-11-1.mcap", "notes.txt"]);
        assert!(logs.next("A", 11).ends_with("A-11-2.mcap"));
        assert!(logs.next("A-B", 12).ends_with("A-B-12-1.mcap"));
    }
}
