//! Trust: whether code of a folder may run. The user is asked once per folder, and the answer is
//! stored outside it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{fs, io};

use afp_project::ProjectFile;

use crate::own_folder;

#[derive(Clone, Debug)]
pub(crate) struct Trust {
    root: PathBuf,
    /// The file with trusted folders, a line each; `None` without a home directory.
    list: Option<PathBuf>,
    given: Trusted,
}

/// Whether a folder is trusted at this time.
#[derive(Clone, Debug, Default)]
pub struct Trusted(Arc<AtomicBool>);

impl Trusted {
    /// Whether code of the folder may run.
    pub fn is_given(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Trust {
    /// The stored trust of a folder.
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

    /// A shared view of it, now and later.
    pub fn shared(&self) -> Trusted {
        self.given.clone()
    }

    /// Grants the trust, permanently if it can be stored.
    ///
    /// # Errors
    /// A sentence: it cannot be stored. It still holds until the studio ends.
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

    /// Describes the code to build and run: robot and toolboxes of a file's project, or by default
    /// of all projects whose scenarios 'afpc test' may run in the folder.
    pub fn code(&self, file: Option<&Path>) -> Vec<String> {
        if let Some(home) = file.and_then(Path::parent) {
            return code_of(home);
        }
        // The folder may be inside a project, which then owns the scenarios.
        let home = ProjectFile::find(&self.root).map_or(self.root.clone(), |file| file.folder);
        let files = afp_project::all_files(&home).unwrap_or_else(|_| afp_project::files(&home));
        let inside = files.iter().filter_map(|path| Some(path.parent()?.to_owned()));
        let folders: BTreeSet<_> = inside.chain([self.root.clone()]).collect();
        let code = folders.iter().flat_map(|folder| code_of(folder));
        code.collect::<BTreeSet<_>>().into_iter().collect()
    }
}

/// The crates of a folder's project; an unreadable project may contain any code.
fn code_of(folder: &Path) -> Vec<String> {
    let Ok(file) = ProjectFile::find(folder) else {
        return vec![format!("the code in the project of '{}'", folder.display())];
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
    fn trust_is_per_folder_and_stored_outside_it() {
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
        assert!(Trust::kept(place.path(), None).code(None).is_empty());
    }

    /// Skipped folders may still contain projects.
    #[test]
    fn the_code_of_a_file_is_its_projects_code() {
        let place = tempfile::tempdir().unwrap();
        let deep = "a/".repeat(20);
        for folder in [".parts", "target/x", "node_modules", deep.trim_end_matches('/')] {
            let folder = place.path().join(folder);
            fs::create_dir_all(&folder).unwrap();
            fs::write(
                folder.join("afp.toml"),
                "[toolboxes]\nt = { path = 't.afp', crate = 'c' }\n",
            )
            .unwrap();
            let trust = Trust::kept(place.path(), None);
            assert!(trust.code(Some(&folder.join("b.afp")))[0].contains("t.afp"), "{folder:?}");
            assert!(trust.code(Some(&place.path().join("a.afp"))).is_empty(), "{folder:?}");
        }
    }

    #[test]
    fn a_folder_within_a_project_has_the_code_of_the_project() {
        let place = tempfile::tempdir().unwrap();
        let (inner, other) = (place.path().join("plans"), place.path().join("tests/x"));
        for folder in [&inner, &other] {
            fs::create_dir_all(folder).unwrap();
        }
        fs::write(place.path().join("afp.toml"), "").unwrap();
        fs::write(other.join("afp.toml"), "[robot]\ncrate = \"x\"\n").unwrap();
        let code = Trust::kept(&inner, None).code(None);
        assert!(code.len() == 1 && code[0].contains("tests"), "{code:?}");
    }
}
