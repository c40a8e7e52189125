//! The meaning of documents: projects, toolboxes and compilations. Each is recomputed only if a
//! text that it read has changed.

mod reads;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use afp_dsl::Toolboxes;
use afp_dsl::toolbox::Toolbox;
use afp_dsl::{Compiled, compile};
use afp_ide::View;
use afp_ide::edit::apply;
use afp_project::Project;
use afp_syntax::ast::Item;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::{Encoding, Source};

use crate::documents::Documents;
use crate::file_edits::FileEdits;
use crate::host::Host;
use crate::uri::BUILT_IN;

pub(crate) use reads::Reads;

pub(crate) const PROJECT: &str = "afp.toml";

/// Whether a path names a project file.
pub(crate) fn is_project(path: &str) -> bool {
    path.rsplit('/').next() == Some(PROJECT)
}

/// The toolboxes available to the files of a folder.
#[derive(Debug)]
pub(crate) struct ToolboxSet {
    pub toolboxes: Toolboxes,
    /// The folder of each of the project's toolboxes, by name, without built-in ones.
    folders: BTreeMap<String, String>,
    reads: Reads,
}

/// A compiled file.
#[derive(Debug)]
pub(crate) struct Analysis {
    pub compiled: Compiled,
    pub set: Arc<ToolboxSet>,
    /// The index of the file in its compilation.
    pub file: u16,
    reads: Reads,
}

impl Analysis {
    pub fn view(&self) -> View<'_> {
        View::new(&self.compiled, &self.set.toolboxes, self.file)
    }
}

/// The state of a server without its conversation.
pub(crate) struct Workspace {
    pub documents: Documents,
    pub host: Box<dyn Host>,
    pub encoding: Encoding,
    pub folders: Vec<String>,
    sets: BTreeMap<String, Arc<ToolboxSet>>,
    analyses: BTreeMap<String, Arc<Analysis>>,
    /// Texts by path that override the client's, for drafts.
    drafts: BTreeMap<String, String>,
}

impl Workspace {
    pub fn new(host: Box<dyn Host>) -> Workspace {
        Workspace {
            documents: Documents::default(),
            host,
            encoding: Encoding::Utf16,
            folders: Vec::new(),
            sets: BTreeMap::new(),
            analyses: BTreeMap::new(),
            drafts: BTreeMap::new(),
        }
    }

    /// Returns the text of a path: the client's, the host's, or a built-in toolbox's.
    pub fn text(&self, path: &str) -> Result<String, String> {
        let open = || self.documents.get(path).map(|document| &document.text);
        if let Some(text) = self.drafts.get(path).or_else(open) {
            return Ok(text.clone());
        }
        if let Some(name) = path.strip_prefix(BUILT_IN) {
            let name = name.trim_start_matches('/');
            let found = afp_toolboxes::ALL.iter().find(|known| known.file_name == name);
            return found
                .map(|it| it.text.to_owned())
                .ok_or_else(|| "there is no such toolbox".to_owned());
        }
        self.host.read(path)
    }

    /// Whether a file holds plans or a toolbox, by its name or else by the client's language.
    pub fn is_afp(&self, path: &str) -> bool {
        let said = || self.documents.get(path).is_some_and(|document| document.language == "afp");
        path.ends_with(".afp") || said()
    }

    /// Discards the analysis of a file.
    pub fn forget(&mut self, path: &str) {
        self.analyses.remove(path);
    }

    /// Returns the current analysis of a file; `None` if it is unreadable.
    pub fn analysis(&mut self, path: &str) -> Option<Arc<Analysis>> {
        let known = self.analyses.get(path);
        if let Some(known) =
            known.filter(|known| known.reads.hold(self) && known.set.reads.hold(self))
        {
            return Some(Arc::clone(known));
        }
        let analysis = Arc::new(self.analyse(path)?);
        self.analyses.insert(path.to_owned(), Arc::clone(&analysis));
        Some(analysis)
    }

    pub fn drafted(&mut self, path: &str, edits: &[FileEdits]) -> Option<Arc<Analysis>> {
        let edited = |file: &FileEdits| (file.path.clone(), apply(&file.text, &file.edits));
        self.drafts = edits.iter().map(edited).collect();
        let analysis = self.analyse(path);
        self.drafts.clear();
        analysis.map(Arc::new)
    }

    fn analyse(&mut self, path: &str) -> Option<Analysis> {
        let reads = RefCell::new(Reads::default());
        let text = reads.borrow_mut().text(self, path).ok()?;
        if is_toolbox(&text) {
            let set = self.toolboxes_with(path, text);
            // Adding a toolbox checks it; an empty plan file collects the diagnostics.
            let compiled = compile(&Source::new("", ""), &set.toolboxes, &no_files);
            let named = |source: &Source| source.name == path;
            let file = compiled.sources.iter().position(named)?;
            let (file, reads) = (u16::try_from(file).ok()?, reads.into_inner());
            return Some(Analysis { compiled, set, file, reads });
        }
        let set = self.toolboxes(path);
        let read = |used: &str| reads.borrow_mut().text(self, used);
        let compiled = compile(&Source::new(path, text), &set.toolboxes, &read);
        let file = u16::try_from(compiled.plan_files.start).ok()?;
        Some(Analysis { compiled, set, file, reads: reads.into_inner() })
    }

    fn toolboxes(&mut self, path: &str) -> Arc<ToolboxSet> {
        let folder = folder(path).to_owned();
        if let Some(known) = self.sets.get(&folder).filter(|known| known.reads.hold(self)) {
            return Arc::clone(known);
        }
        let set = Arc::new(self.read_toolboxes(path, None));
        self.sets.insert(folder, Arc::clone(&set));
        set
    }

    /// Returns the toolboxes for a file that is itself a toolbox.
    fn toolboxes_with(&mut self, path: &str, text: String) -> Arc<ToolboxSet> {
        let known = self.toolboxes(path);
        let is_known = known.toolboxes.sources().iter().any(|source| source.name == path);
        if is_known { known } else { Arc::new(self.read_toolboxes(path, Some(text))) }
    }

    fn read_toolboxes(&self, path: &str, own: Option<String>) -> ToolboxSet {
        let mut reads = Reads::default();
        let mut folders = BTreeMap::new();
        let mut toolboxes = Toolboxes::default();
        for built_in in afp_toolboxes::ALL {
            let name = self.host.built_in(built_in.file_name, built_in.text);
            let name = name.unwrap_or_else(|| format!("{BUILT_IN}/{}", built_in.file_name));
            toolboxes.add(Source::new(name, built_in.text), built_in.rust_path);
        }
        let (home, project) = self.project(path, &mut reads);
        for toolbox in &project.toolboxes {
            let file = afp_dsl::files::normalised(&format!("{home}/{}", toolbox.path));
            if let Ok(text) = reads.text(self, &file) {
                folders.insert(toolbox.name.clone(), folder(&file).to_owned());
                toolboxes.add(Source::new(file, text), &toolbox.name);
            }
        }
        if let Some(name) = project.robot.as_ref().and_then(|robot| robot.toolbox.as_ref()) {
            toolboxes.set_robot(name);
        }
        if let Some(profile) = project.profile() {
            toolboxes.set_lacks(profile.lacks().into_iter().map(str::to_owned));
            toolboxes.set_estimates(profile.estimates().map(str::to_owned));
        }
        if let Some(text) = own {
            toolboxes.add(Source::new(path, text), "own");
        }
        ToolboxSet { toolboxes, folders, reads }
    }

    /// Returns the folder and the content of the nearest project file above a file.
    fn project(&self, path: &str, reads: &mut Reads) -> (String, Project) {
        let mut home = folder(path);
        loop {
            let file = format!("{home}/{PROJECT}");
            if let Ok(text) = reads.text(self, &file) {
                return (home.to_owned(), afp_project::read(&text).0);
            }
            if home.is_empty() || !path.starts_with('/') && !home.contains('/') {
                return (folder(path).to_owned(), Project::default());
            }
            home = folder(home);
        }
    }

    /// Returns the icon of a template: `icons/NAME.svg` next to a project's toolbox, or else a
    /// built-in one.
    pub fn icon(
        &self,
        set: &ToolboxSet,
        toolbox: &Toolbox,
        name: &str,
        reads: &mut Reads,
    ) -> Option<String> {
        if !afp_toolboxes::is_icon_name(name) {
            return None;
        }
        match set.folders.get(&toolbox.name) {
            Some(folder) => reads.text(self, &format!("{folder}/icons/{name}.svg")).ok(),
            None => afp_toolboxes::icon(name).map(str::to_owned),
        }
    }

    /// Returns the paths of all plan files that are open or in the workspace.
    pub fn plan_files(&self) -> Vec<String> {
        let mut paths = self.afp_files();
        paths.retain(|path| self.plan_text(path).is_some());
        paths
    }

    /// Returns the text of a file that may have plans; `None` for a toolbox without plans.
    pub fn plan_text(&self, path: &str) -> Option<String> {
        self.text(path).ok().filter(|text| !is_toolbox(text))
    }

    /// Returns the paths of all plan and toolbox files that are open or in the workspace.
    pub fn afp_files(&self) -> Vec<String> {
        let mut paths: Vec<String> =
            self.folders.iter().flat_map(|folder| self.host.plan_files(folder)).collect();
        paths.extend(self.documents.iter().map(|(path, _)| path.to_owned()));
        paths.retain(|path| self.is_afp(path));
        paths.sort();
        paths.dedup();
        paths
    }
}

fn no_files(_: &str) -> Result<String, String> {
    Err("there is no such file".to_owned())
}

/// The part of a path before the last `/`.
pub(crate) fn folder(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// Whether a text declares a toolbox and no plan.
fn is_toolbox(text: &str) -> bool {
    if !text.contains("toolbox") {
        return false;
    }
    let items = afp_syntax::parse(text, 0, &mut Diagnostics::default()).file().items();
    let declares = items.iter().any(|item| matches!(item, Item::Toolbox(_)));
    declares && !items.iter().any(|item| matches!(item, Item::Plan(_)))
}
