//! Whether what lies in a folder may be run: asked once for a folder, and kept outside of it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{fs, io};

use afp_project::ProjectFile;

use crate::own_folder;

/// The trust of one folder.
#[derive(Clone, Debug)]
pub(crate) struct Trust {
    root: PathBuf,
    /// Where trusted folders are kept, a line each; nowhere where there is no home.
    list: Option<PathBuf>,
    given: Trusted,
}

/// Whether a folder is trusted by now.
#[derive(Clone, Debug, Default)]
pub struct Trusted(Arc<AtomicBool>);

impl Trusted {
    /// Whether what lies in the folder may be run.
    pub fn is_given(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Trust {
    /// The trust that a folder was given before.
    pub fn of(root: &Path) -> Trust {
        Trust::kept(root, own_folder().map(|own| own.join("trusted")))
    }

    fn kept(root: &Path, list: Option<PathBuf>) -> Trust {
        let text = list.as_ref().and_then(|list| fs::read_to_string(list).ok()).unwrap_or_default();
        let given = text.lines().any(|line| Path::new(line) == root);
        let given = Trusted(Arc::new(AtomicBool::new(given)));
        Trust { root: root.to_owned(), list, given }
    }

    pub fn is_given(&self) -> bool {
        self.given.is_given()
    }

    /// What tells it to others, now and later.
    pub fn shared(&self) -> Trusted {
        self.given.clone()
    }

    /// Gives it, for good where that can be kept.
    ///
    /// # Errors
    /// It cannot be kept: a sentence. It is given all the same until the studio ends.
    pub fn give(&self) -> Result<(), String> {
        if self.given.0.swap(true, Ordering::Relaxed) {
            return Ok(());
        }
        let Some(list) = &self.list else { return Ok(()) };
        self.keep(list).map_err(|why| {
            format!(
                "the folder is trusted until the studio ends: cannot write '{}': {why}",
                list.display()
            )
        })
    }

    fn keep(&self, list: &Path) -> io::Result<()> {
        if let Some(folder) = list.parent() {
            fs::create_dir_all(folder)?;
        }
        let mut text = fs::read_to_string(list).unwrap_or_default();
        text += &format!("{}\n", self.root.display());
        afp_output::write_whole(list, text.as_bytes())
    }

    /// What of the folder would be built and run, in words: robots and toolboxes of all projects in it.
    pub fn code(&self) -> Vec<String> {
        let files = afp_project::files(&self.root).into_iter();
        let projects = files.filter(|path| path.file_name().is_some_and(|name| name == "afp.toml"));
        let inside = projects.filter_map(|path| Some(path.parent()?.to_owned()));
        // The folder may lie within a project.
        let folders: BTreeSet<_> = inside.chain([self.root.clone()]).collect();
        folders
            .iter()
            .flat_map(|folder| code_of(folder))
            .collect::<BTreeSet<_>>()
            .into_iter()
            .collect()
    }
}

/// The crates of the project that a folder belongs to; of one that cannot be read everything may be expected.
fn code_of(folder: &Path) -> Vec<String> {
    let Ok(file) = ProjectFile::find(folder) else {
        return vec![format!("what the project file of '{}' names", folder.display())];
    };
    let project = &file.project;
    let robot = project.robot.iter().map(|_| format!("the robot of '{}'", file.path().display()));
    let toolboxes = project.toolboxes.iter();
    let toolboxes =
        toolboxes.map(|it| format!("the toolbox '{}'", file.folder.join(&it.path).display()));
    robot.chain(toolboxes).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trust_is_given_to_one_folder_and_kept_outside_of_it() {
        let place = tempfile::tempdir().unwrap();
        let list = Some(place.path().join("config/afp/trusted"));
        let (one, other) = (place.path().join("one"), place.path().join("other"));
        let trust = Trust::kept(&one, list.clone());
        assert!(!trust.is_given());
        trust.give().unwrap();
        assert!(Trust::kept(&one, list.clone()).is_given());
        assert!(!Trust::kept(&other, list).is_given());
        assert!(!one.exists());
    }

    #[test]
    fn a_folder_of_plans_has_no_code() {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("plan.afp"), "plan A {}").unwrap();
        assert!(Trust::kept(place.path(), None).code().is_empty());
    }
}
