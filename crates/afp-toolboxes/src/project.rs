//! The toolboxes that the plans of a project may use, with the crates that implement them: those that are built
//! in, and those that `afp.toml` names.
//!
//! Command line, macros, tests and Python all ask here, so that a plan means the same to each of them. The language
//! server alone reads toolboxes otherwise, since its files are those of a client and may be half written
//! (ARCHITECTURE.md).

use std::path::Path;
use std::sync::Arc;

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::read_text_file;
use afp_dsl::graph::Graph;
use afp_dsl::toolbox::Toolbox;
use afp_project::{CrateLink, Mistake, ProjectError, ProjectFile, ToolboxFile, shown};
use afp_syntax::source::Source;

/// A project and the toolboxes that it has beyond the built-in ones.
#[derive(Debug)]
pub struct OwnToolboxes {
    pub project: ProjectFile,
    files: Vec<ToolboxFile>,
}

/// A toolbox of the project and the crate behind it.
#[derive(Clone, Debug)]
pub struct OwnToolbox {
    pub name: String,
    /// Its file, as diagnostics show it, and the file's text.
    pub source: Source,
    pub declared: Arc<Toolbox>,
    pub krate: CrateLink,
}

impl OwnToolboxes {
    /// Reads the toolbox files of a project.
    ///
    /// # Errors
    /// One of them cannot be read.
    pub fn read(project: ProjectFile) -> Result<Self, ProjectError> {
        let files = project.toolboxes()?;
        Ok(OwnToolboxes { project, files })
    }

    /// Those of the project whose `afp.toml` is nearest to a plan.
    ///
    /// # Errors
    /// The project file or one of them cannot be read, or the project file is wrong.
    pub fn of_plan(plan: &Path) -> Result<Self, ProjectError> {
        OwnToolboxes::read(ProjectFile::of_plan(plan)?)
    }

    /// The built-in toolboxes and those of the project, which take the place of built-in ones of the
    /// same name.
    ///
    /// # Errors
    /// A toolbox file is that of another toolbox than the project says.
    pub fn with_built_in(&self) -> Result<Toolboxes, ProjectError> {
        self.with_built_in_as(source, rust_path)
    }

    /// As [`OwnToolboxes::with_built_in`]; the caller says how messages show the files, and by which paths it
    /// reaches the crates.
    ///
    /// # Errors
    /// A toolbox file is that of another toolbox than the project says.
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
        match misnamed.is_empty() || toolboxes.diagnostics().has_errors() {
            true => Ok(toolboxes),
            false => Err(self.project.wrong(misnamed)),
        }
    }

    /// The files of the project's toolboxes, in its order.
    pub fn files(&self) -> &[ToolboxFile] {
        &self.files
    }

    /// Names and texts of the toolboxes.
    pub fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
        self.files.iter().map(|file| (file.toolbox.name.as_str(), file.text.as_str()))
    }

    /// The toolbox that declares the devices of the project's robot.
    fn of_robot(&self) -> Option<&String> {
        self.project.project.robot.as_ref()?.toolbox.as_ref()
    }

    /// Those that a plan uses, and that of the robot, with their crates.
    ///
    /// # Errors
    /// There is no such crate, or the robot's toolbox is wrong.
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

    /// All of them, with their crates.
    ///
    /// # Errors
    /// There is no such crate, or a toolbox is wrong.
    pub fn all(&self) -> Result<Vec<OwnToolbox>, ProjectError> {
        let known = self.with_built_in()?;
        self.linked(|name| Ok(known.get(name).cloned()))
    }

    /// Those that are wanted, with their crates.
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
    /// The text of an icon: `icons/NAME.svg` beside the file of the project's toolbox, else that of a
    /// built-in one.
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

/// Names and texts of the toolboxes of a plan of these beyond the built-in ones: of its project, or of another language.
pub fn own_toolbox_texts<'a>(
    compiled: &'a Compiled,
    graph: &'a Graph,
) -> impl Iterator<Item = (&'a str, &'a str)> {
    let built_in = |text: &str| crate::ALL.iter().any(|it| it.text == text);
    compiled.toolbox_texts(graph).filter(move |(_, text)| !built_in(text))
}

/// The path of the crate behind a toolbox. Plans can be checked before there is one; whoever needs it asks for it.
fn rust_path(file: &ToolboxFile) -> String {
    file.krate.as_ref().map_or_else(|_| file.toolbox.name.clone(), CrateLink::rust_path)
}

fn source(file: &ToolboxFile) -> Source {
    Source::new(shown(&file.path).display().to_string(), &file.text)
}

/// A file that does not say what the project calls it.
fn misnamed(file: &ToolboxFile) -> Mistake {
    let (path, name) = (shown(&file.path), &file.toolbox.name);
    Mistake {
        span: Some(file.toolbox.span.clone()),
        message: format!("'{}' does not begin with 'toolbox {name}'", path.display()),
        help: "write the name that stands behind 'toolbox' in the file".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// What is said of a project with these files of toolboxes.
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
    fn a_file_of_another_toolbox_is_told_also_where_one_of_the_name_is_there() {
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
