//! The toolboxes that a compilation can use.

use std::sync::Arc;

use crate::check::toolbox::read_file;
use crate::index::{Declared, Meanings};
use crate::toolbox::Toolbox;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::{Source, Sources, Span};

/// Toolboxes by name, with their texts.
///
/// The compiler reads no files: whoever calls it adds the toolboxes, built-in ones included.
#[derive(Clone, Debug, Default)]
pub struct Toolboxes {
    list: Vec<Arc<Toolbox>>,
    broken: Vec<Name>,
    robot: Option<String>,
    sources: Sources,
    diags: Diagnostics,
    meanings: Meanings,
    declared: Vec<Declared>,
}

impl Toolboxes {
    /// Reads a toolbox file and adds it. `rust_path` is the path of the crate that implements it.
    ///
    /// Its diagnostics are kept, see [`Toolboxes::diagnostics`]. A toolbox of a name that is there
    /// already takes the place of the earlier one.
    pub fn add(&mut self, source: Source, rust_path: &str) {
        let source = Arc::new(source);
        // With so many files, spans could no longer tell them apart.
        let Some(file) = self.sources.add(source.clone()) else { return };
        let read = read_file(&source, file, rust_path);
        match read.toolbox {
            Some(toolbox) => {
                self.list.retain(|known| known.name != toolbox.name);
                self.list.push(Arc::new(toolbox));
            }
            None => self.broken.extend(read.name),
        }
        self.diags.extend(read.diags);
        self.meanings.extend(read.meanings);
        self.declared.extend(read.declared);
    }

    /// The toolbox of that name; `None` when there is none or it has errors.
    pub fn get(&self, name: &str) -> Option<&Arc<Toolbox>> {
        self.list.iter().find(|toolbox| toolbox.name == name)
    }

    /// Says which toolbox declares the devices of the robot that plans run on. Scenarios know its words whatever
    /// their plans use.
    pub fn set_robot(&mut self, toolbox: &str) {
        self.robot = Some(toolbox.to_owned());
    }

    /// The toolbox that was said to declare the robot's devices.
    pub(crate) fn robot(&self) -> Option<&str> {
        self.robot.as_deref()
    }

    /// All toolboxes without errors.
    pub fn iter(&self) -> impl Iterator<Item = &Arc<Toolbox>> {
        self.list.iter()
    }

    /// What there is to say about the toolboxes themselves.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diags
    }

    /// The texts of the toolboxes; spans of [`Toolboxes::diagnostics`] belong to them.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// What the names in the toolboxes mean.
    pub(crate) fn meanings(&self) -> &Meanings {
        &self.meanings
    }

    /// What the toolboxes declare.
    pub(crate) fn declared(&self) -> &[Declared] {
        &self.declared
    }

    /// Where a toolbox that was added under that name and has errors says its name.
    pub(crate) fn broken(&self, name: &str) -> Option<Span> {
        self.broken.iter().find(|known| known.text == name).map(|known| known.span)
    }
}

/// Reads toolbox files, each given as the name of its file, its text, and the path of the crate that
/// implements it, as `afp_toolboxes::sources()` gives them.
impl<'a> FromIterator<(&'a str, &'a str, &'a str)> for Toolboxes {
    fn from_iter<I: IntoIterator<Item = (&'a str, &'a str, &'a str)>>(files: I) -> Toolboxes {
        let mut toolboxes = Toolboxes::default();
        for (name, text, rust_path) in files {
            toolboxes.add(Source::new(name, text), rust_path);
        }
        toolboxes
    }
}
