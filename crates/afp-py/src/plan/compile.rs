//! The texts of a plan during changes, and their compilation.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use afp_dsl::Toolboxes;
use afp_dsl::files::{Disk, Files};
use afp_dsl::{Compiled, compile_plan};
use afp_run::{RunError, write_whole};
use afp_syntax::source::Source;
use afp_toolboxes::project::OwnToolboxes;
use pyo3::prelude::*;

use crate::errors::{error, run_error};
use crate::toolbox::Toolbox;

/// The file name in diagnostics of a plan without a file.
const NAMELESS: &str = "plan.afp";

/// A plan's texts, and its toolboxes.
pub struct Workspace {
    text: String,
    path: Option<PathBuf>,
    /// The plan of the file that runs.
    name: Option<String>,
    known: Toolboxes,
    /// The revision of each Python toolbox at the time of reading.
    revisions: Vec<u64>,
    own: Option<Arc<OwnToolboxes>>,
    /// Texts of other changed files, by path.
    others: BTreeMap<String, String>,
    compiled: Option<Arc<Compiled>>,
}

impl Workspace {
    /// The toolboxes of the last compilation.
    pub fn known(&self) -> &Toolboxes {
        &self.known
    }

    /// Makes a new plan.
    pub fn new(
        text: String,
        path: Option<PathBuf>,
        name: Option<String>,
        toolboxes: &[Py<Toolbox>],
    ) -> Result<Workspace, RunError> {
        let own = path.as_deref().map(OwnToolboxes::of_plan).transpose()?;
        let revisions = revisions(toolboxes);
        let known = known(own.as_ref(), toolboxes)?;
        let (others, own) = (BTreeMap::new(), own.map(Arc::new));
        Ok(Workspace { text, path, name, known, revisions, own, others, compiled: None })
    }

    /// Reads the toolboxes again if one of them has changed.
    fn refresh(&mut self, toolboxes: &[Py<Toolbox>]) -> Result<(), RunError> {
        // Revisions come before texts, so a change in between is read again.
        let revisions = revisions(toolboxes);
        if revisions != self.revisions {
            self.known = known(self.own.as_deref(), toolboxes)?;
            (self.revisions, self.compiled) = (revisions, None);
        }
        Ok(())
    }

    /// The toolboxes of its project; `None` for a plan without a file.
    pub fn own(&self) -> Option<Arc<OwnToolboxes>> {
        self.own.clone()
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    /// The name of the plan that runs, if it was given.
    pub fn name(&self) -> Option<&String> {
        self.name.as_ref()
    }

    /// Texts of other changed files, by path.
    pub fn others(&self) -> &BTreeMap<String, String> {
        &self.others
    }

    /// Sets these texts.
    pub fn set_others(&mut self, others: BTreeMap<String, String>) {
        self.others = others;
        self.compiled = None;
    }

    pub fn path(&self) -> Option<&PathBuf> {
        self.path.as_ref()
    }

    /// The plan's file, or a name in its place.
    pub fn file(&self) -> PathBuf {
        self.path.clone().unwrap_or_else(|| NAMELESS.into())
    }

    pub fn set_text(&mut self, text: String) {
        self.text = text;
        self.compiled = None;
    }

    pub fn replace(&mut self, file: &str, text: String) {
        if file == self.file().display().to_string() {
            self.set_text(text);
        } else {
            self.others.insert(file.to_owned(), text);
            self.compiled = None;
        }
    }

    /// The compilation with the current toolboxes.
    ///
    /// # Errors
    /// A toolbox has the name of a built-in or project toolbox, but a different text.
    pub fn compiled(&mut self, toolboxes: &[Py<Toolbox>]) -> Result<Arc<Compiled>, RunError> {
        self.refresh(toolboxes)?;
        if let Some(compiled) = &self.compiled {
            return Ok(Arc::clone(compiled));
        }
        let source = Source::new(self.file().display().to_string(), &self.text);
        let read = |path: &str| match self.others.get(path) {
            Some(text) => Ok(text.clone()),
            None => Disk::default().read(path),
        };
        let compiled = compile_plan(&source, &self.known, &read, self.name.as_deref());
        let compiled = Arc::new(compiled);
        self.compiled = Some(Arc::clone(&compiled));
        Ok(compiled)
    }

    /// Writes all changes.
    pub fn save(&mut self, path: Option<PathBuf>) -> PyResult<()> {
        let path = path.or_else(|| self.path.clone());
        let path = path.ok_or_else(|| error("the plan has no file yet; give save() a path"))?;
        write(&path, &self.text)?;
        while let Some((other, text)) = self.others.pop_first() {
            if let Err(why) = write(Path::new(&other), &text) {
                self.others.insert(other, text);
                return Err(why);
            }
        }
        if self.path.as_ref() != Some(&path) {
            self.path = Some(path);
            self.compiled = None;
        }
        Ok(())
    }
}

fn revisions(toolboxes: &[Py<Toolbox>]) -> Vec<u64> {
    toolboxes.iter().map(|toolbox| toolbox.get().revision()).collect()
}

/// The toolboxes: built-in ones, the project's and Python's.
fn known(own: Option<&OwnToolboxes>, toolboxes: &[Py<Toolbox>]) -> Result<Toolboxes, RunError> {
    let mut known = match own {
        Some(own) => own.with_built_in()?,
        None => afp_toolboxes::sources().collect(),
    };
    add_all(&mut known, toolboxes)?;
    Ok(known)
}

/// Adds Python toolboxes. If the name is known, the text must be equal; the components are then in
/// Python.
fn add_all(known: &mut Toolboxes, toolboxes: &[Py<Toolbox>]) -> Result<(), RunError> {
    let mut names: Vec<String> = Vec::new();
    for (number, toolbox) in toolboxes.iter().enumerate() {
        let before = toolboxes.get(..number).unwrap_or_default();
        if before.iter().any(|other| other.is(toolbox)) {
            continue;
        }
        let source = toolbox.get().source();
        let mut alone = Toolboxes::default();
        alone.add(source.clone(), "python");
        let Some(name) = alone.iter().next().map(|toolbox| toolbox.name.clone()) else { continue };
        let is_same = known.sources().iter().any(|other| other.text == source.text);
        if names.contains(&name) {
            let what = format!("two toolboxes are called '{name}'");
            return Err(RunError::usage(what, "give one of them another name"));
        }
        if known.get(&name).is_some() && !is_same {
            let what = format!("another toolbox is called '{name}', built in or in the project");
            return Err(RunError::usage(what, "give this one another name"));
        }
        names.push(name);
        known.add(source, "python");
    }
    Ok(())
}

fn write(path: &Path, text: &str) -> PyResult<()> {
    write_whole("cannot write the plan", path, text).map_err(|why| run_error(&why))
}
