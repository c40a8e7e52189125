//! The toolboxes for the plans of a project, with their crates: the built-in ones, and those in
//! `afp.toml`.
//!
//! Command line, macros, tests and Python all use this module, so that a plan has the same meaning
//! in each. Only the language server reads toolboxes separately, since its files are a client's and
//! may be incomplete (ARCHITECTURE.md).

use std::path::Path;
use std::sync::Arc;

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::read_text_file;
use afp_dsl::graph::Graph;
use afp_dsl::toolbox::Toolbox;
use afp_project::{CrateLink, Mistake, ProjectError, ProjectFile, ToolboxFile, shown};
use afp_syntax::source::Source;

#[derive(Debug)]
pub struct OwnToolboxes {
    pub project: ProjectFile,
    files: Vec<ToolboxFile>,
}

#[derive(Clone, Debug)]
pub struct OwnToolbox {
    pub name: String,
    /// Its file and text, named as in diagnostics.
    pub source: Source,
    pub declared: Arc<Toolbox>,
    pub krate: CrateLink,
}

impl OwnToolboxes {
    /// Reads the toolbox files of a project.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn read(project: ProjectFile) -> Result<Self, ProjectError> {
        let files = project.toolboxes()?;
        Ok(OwnToolboxes { project, files })
    }

    /// Reads the project of a plan: the nearest `afp.toml`.
    ///
    /// # Errors
    /// The project file or a toolbox cannot be read, or the project file has errors.
    pub fn of_plan(plan: &Path) -> Result<Self, ProjectError> {
        OwnToolboxes::read(ProjectFile::of_plan(plan)?)
    }

    /// The built-in toolboxes and those of the project, which replace built-in ones with the same
    /// name.
    ///
    /// # Errors
    /// A file declares another toolbox than the project file names.
    pub fn with_built_in(&self) -> Result<Toolboxes, ProjectError> {
        self.with_built_in_as(source, rust_path)
    }

    /// Like [`OwnToolboxes::with_built_in`]; the caller determines file names in messages and paths
    /// of crates.
    ///
    /// # Errors
    /// A file declares another toolbox than the project file names.
    pub fn with_built_in_as(
        &self,
        source: impl Fn(&ToolboxFile) -> Source,
        rust_path: impl Fn(&ToolboxFile) -> String,
    ) -> Result<Toolboxes, ProjectError> {
        let mut toolboxes: Toolboxes = crate::sources().collect();
        let mut misnamed = Vec::new();
        for file in &self.files {
            let name = toolboxes.add(source(file), &rust_path(file));
            if name.as_ref() != Some(&file.toolbox.name) {
                misnamed.push(self::misnamed(file));
            }
        }
        if let Some(name) = self.of_robot() {
            toolboxes.set_robot(name);
        }
        if let Some(profile) = self.project.project.profile() {
            toolboxes.set_lacks(profile.lacks().into_iter().map(str::to_owned));
            toolboxes.set_estimates(profile.estimates().map(str::to_owned));
        }
        match misnamed.is_empty() || toolboxes.diagnostics().has_errors() {
            true => Ok(toolboxes),
            false => Err(self.project.wrong(misnamed)),
        }
    }

    /// The project's toolboxes, in order.
    pub fn files(&self) -> &[ToolboxFile] {
        &self.files
    }

    pub fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
        self.files.iter().map(|file| (file.toolbox.name.as_str(), file.text.as_str()))
    }

    /// The toolbox with the devices of the project's robot.
    fn of_robot(&self) -> Option<&String> {
        self.project.project.robot.as_ref()?.toolbox.as_ref()
    }

    /// The toolboxes of a plan and of the robot, with their crates.
    ///
    /// # Errors
    /// A crate is missing, or the robot's toolbox has errors.
    pub fn used_by(&self, graph: &Graph) -> Result<Vec<OwnToolbox>, ProjectError> {
        self.linked(|name| {
            let used = graph.toolboxes.iter().find(|toolbox| toolbox.name == name);
            match used {
                None if self.of_robot().is_some_and(|robot| robot == name) => {
                    Ok(self.with_built_in()?.get(name).cloned())
                }
                used => Ok(used.cloned()),
            }
        })
    }

    /// All toolboxes with their crates.
    ///
    /// # Errors
    /// A crate is missing, or a toolbox has errors.
    pub fn all(&self) -> Result<Vec<OwnToolbox>, ProjectError> {
        let known = self.with_built_in()?;
        self.linked(|name| Ok(known.get(name).cloned()))
    }

    fn linked(
        &self,
        wanted: impl Fn(&str) -> Result<Option<Arc<Toolbox>>, ProjectError>,
    ) -> Result<Vec<OwnToolbox>, ProjectError> {
        let (mut used, mut mistakes) = (Vec::new(), Vec::new());
        for file in &self.files {
            let name = &file.toolbox.name;
            let Some(declared) = wanted(name)? else { continue };
            match file.krate.clone() {
                Ok(krate) => {
                    let (name, source) = (name.clone(), source(file));
                    used.push(OwnToolbox { name, source, declared, krate });
                }
                Err(mistake) => mistakes.push(mistake),
            }
        }
        if mistakes.is_empty() { Ok(used) } else { Err(self.project.wrong(mistakes)) }
    }
}

impl OwnToolboxes {
    /// The text of an icon: `icons/NAME.svg` next to the project's toolbox file, or a built-in one.
    pub fn icon(&self, toolbox: &Toolbox, name: &str) -> Option<String> {
        if !crate::is_icon_name(name) {
            return None;
        }
        let own = self.files.iter().find(|file| file.toolbox.name == toolbox.name);
        if let Some(folder) = own.and_then(|file| file.path.parent()) {
            return read_text_file(&folder.join("icons").join(format!("{name}.svg"))).ok();
        }
        let built_in = crate::ALL.iter().any(|each| each.name == toolbox.name);
        built_in.then(|| crate::icon(name)).flatten().map(str::to_owned)
    }
}

/// Names and texts of the toolboxes of a plan that are not built in: from its project, or from
/// another language.
pub fn own_toolbox_texts<'a>(
    compiled: &'a Compiled,
    graph: &'a Graph,
) -> impl Iterator<Item = (&'a str, &'a str)> {
    let built_in = |text: &str| crate::ALL.iter().any(|it| it.text == text);
    compiled.toolbox_texts(graph).filter(move |(_, text)| !built_in(text))
}

/// The path of a toolbox's crate. Plans can be checked before the crate exists; an error is
/// reported when it is needed.
fn rust_path(file: &ToolboxFile) -> String {
    file.krate.as_ref().map_or_else(|_| file.toolbox.name.clone(), CrateLink::rust_path)
}

fn source(file: &ToolboxFile) -> Source {
    Source::new(shown(&file.path).display().to_string(), &file.text)
}

/// The error of a file that declares another toolbox than the project file names.
fn misnamed(file: &ToolboxFile) -> Mistake {
    let (path, name) = (shown(&file.path), &file.toolbox.name);
    Mistake {
        span: Some(file.toolbox.span.clone()),
        message: format!("'{}' does not begin with 'toolbox {name}'", path.display()),
        help: "write the name after 'toolbox' in the file".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// The errors of a project with these toolbox files.
    fn said(project: &str, files: &[(&str, &str)]) -> Option<String> {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("afp.toml"), project).unwrap();
        for (name, text) in files {
            fs::write(folder.path().join(name), text).unwrap();
        }
        let own = OwnToolboxes::read(ProjectFile::find(folder.path()).unwrap()).unwrap();
        match own.with_built_in() {
            Ok(toolboxes) => {
                assert!(!toolboxes.diagnostics().has_errors(), "{:?}", toolboxes.diagnostics());
                None
            }
            Err(error) => Some(error.to_string()),
        }
    }

    const WAIT: &str = "supervisor Late {\n    every 10 ms\n    event Due\n}\n";

    #[test]
    fn a_file_of_another_toolbox_is_reported_also_if_the_name_exists() {
        let (a, b) = (
            format!("toolbox a version \"1.0\"\n{WAIT}"),
            format!("toolbox b version \"1.0\"\n{WAIT}"),
        );
        let files = [("a.afp", a.as_str()), ("b.afp", b.as_str())];
        let two = |a: &str, b: &str| {
            format!("[toolboxes]\na = {{ path = \"{a}\" }}\nb = {{ path = \"{b}\" }}\n")
        };
        assert_eq!(said(&two("a.afp", "b.afp"), &files), None);
        let swapped = said(&two("b.afp", "a.afp"), &files).unwrap();
        assert!(swapped.contains("b.afp' does not begin with 'toolbox a'"), "{swapped}");
        assert!(swapped.contains("a.afp' does not begin with 'toolbox b'"), "{swapped}");
        let built_in = said("[toolboxes]\ncarbot = { path = \"a.afp\" }\n", &files).unwrap();
        assert!(built_in.contains("a.afp' does not begin with 'toolbox carbot'"), "{built_in}");
    }
}
