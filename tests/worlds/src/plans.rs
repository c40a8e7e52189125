//! The plans for random worlds: the shipped ones, and this package's for missing features.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use afp_dsl::Toolboxes;
use afp_dsl::compile_plan;
use afp_dsl::files::{Disk, Texts};
use afp_dsl::graph::Graph;
use afp_syntax::source::Source;

/// The folders of plans, relative to the root of the checkout; the shipped ones come first.
const SHIPPED: &str = "plans";
const FOLDERS: [&str; 2] = [SHIPPED, "tests/worlds/plans"];

/// A plan that runs in any room.
#[derive(Debug)]
pub struct Plan {
    /// The name of its file, without `.afp`.
    pub name: String,
    pub shipped: bool,
    pub graph: Graph,
}

/// Every plan, by name.
///
/// # Panics
/// A file is unreadable, or does not compile.
pub fn plans() -> &'static [Plan] {
    static PLANS: OnceLock<Vec<Plan>> = OnceLock::new();
    PLANS.get_or_init(|| {
        let mut plans: Vec<Plan> = FOLDERS.iter().flat_map(|folder| of(folder)).collect();
        plans.sort_by(|a, b| a.name.cmp(&b.name));
        plans
    })
}

/// The plan with a name.
///
/// # Panics
/// There is none.
pub fn plan(name: &str) -> &'static Plan {
    let found = plans().iter().find(|plan| plan.name == name);
    found.unwrap_or_else(|| panic!("there is no plan '{name}'"))
}

/// One plan of several in a shipped file.
///
/// # Panics
/// There is none.
pub fn part(file: &str, name: &str) -> Plan {
    let folder = folder(SHIPPED);
    compiled(&folder, &folder.join(format!("{file}.afp")), Some(name))
}

/// The first plan of a text.
///
/// # Panics
/// It does not compile.
pub fn plan_of(name: &str, text: &str) -> Plan {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile_plan(&Source::new(name, text), &toolboxes, &Texts::default(), None);
    let said = compiled.render(false);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{said}"));
    Plan { name: name.into(), shipped: false, graph }
}

fn of(name: &str) -> Vec<Plan> {
    let folder = folder(name);
    let files = fs::read_dir(&folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display()));
    let paths = files.flatten().map(|file| file.path());
    let plans = paths.filter(|path| path.extension().is_some_and(|end| end == "afp"));
    let shipped = name == SHIPPED;
    plans.map(|path| Plan { shipped, ..compiled(&folder, &path, None) }).collect()
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)
}

/// The plan of a shipped file; that of `part` if the file has several.
fn compiled(folder: &Path, path: &Path, part: Option<&str>) -> Plan {
    let text = fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let seen = path.strip_prefix(folder).unwrap_or(path).display().to_string();
    let source = Source::new(seen, text);
    let compiled = compile_plan(&source, &toolboxes, &Disk(folder.to_owned()), part);
    let said = compiled.render(false);
    Plan { name, shipped: true, graph: compiled.graph.unwrap_or_else(|| panic!("{said}")) }
}
