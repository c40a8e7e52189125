//! The plans that are driven: those shipped, and those of this package for what they lack.

use std::fs;
use std::path::Path;
use std::sync::OnceLock;

use afp_dsl::compile_plan;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_dsl::toolbox::Toolboxes;
use afp_syntax::source::Source;

/// Where plans are, seen from the root of the checkout; first those that AFP ships.
const SHIPPED: &str = "plans";
const FOLDERS: [&str; 2] = [SHIPPED, "tests/worlds/plans"];

/// A plan that can be driven in any room.
#[derive(Debug)]
pub struct Plan {
    /// The name of its file, without `.afp`.
    pub name: String,
    /// Whether it is one of those that AFP ships.
    pub shipped: bool,
    /// What it compiles to.
    pub graph: Graph,
}

/// Every plan, by name.
///
/// # Panics
/// A file cannot be read, or does not compile.
pub fn plans() -> &'static [Plan] {
    static PLANS: OnceLock<Vec<Plan>> = OnceLock::new();
    PLANS.get_or_init(|| {
        let mut plans: Vec<Plan> = FOLDERS.iter().flat_map(|folder| of(folder)).collect();
        plans.sort_by(|a, b| a.name.cmp(&b.name));
        plans
    })
}

/// The plan of a name.
///
/// # Panics
/// There is none.
pub fn plan(name: &str) -> &'static Plan {
    let found = plans().iter().find(|plan| plan.name == name);
    found.unwrap_or_else(|| panic!("there is no plan '{name}'"))
}

/// One plan of several in a file that AFP ships.
///
/// # Panics
/// There is none.
pub fn part(file: &str, name: &str) -> Plan {
    let (texts, others) = texts(SHIPPED);
    let text = texts.into_iter().find(|(stem, _)| stem == file);
    let (stem, text) = text.unwrap_or_else(|| panic!("there is no plan '{file}'"));
    compiled((stem, text), Some(name), &others, true)
}

/// The plans of a folder.
fn of(folder: &str) -> Vec<Plan> {
    let (texts, others) = texts(folder);
    let shipped = folder == SHIPPED;
    texts.into_iter().map(|text| compiled(text, None, &others, shipped)).collect()
}

/// The names and texts of a folder's plans, and the same for those that use each other.
fn texts(folder: &str) -> (Vec<(String, String)>, Texts) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let files = fs::read_dir(&folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display()));
    let paths = files.flatten().map(|file| file.path());
    let texts: Vec<(String, String)> = paths
        .filter(|path| path.extension().is_some_and(|end| end == "afp"))
        .map(|path| read(&path))
        .collect();
    let mut others = Texts::default();
    for (name, text) in &texts {
        others.add(&format!("{name}.afp"), text.as_str());
    }
    (texts, others)
}

/// The name of a plan's file, and its text.
fn read(path: &Path) -> (String, String) {
    let text = fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    (path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), text)
}

fn compiled(
    (name, text): (String, String),
    part: Option<&str>,
    others: &Texts,
    shipped: bool,
) -> Plan {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let source = Source::new(format!("{name}.afp"), text);
    let compiled = compile_plan(&source, &toolboxes, others, part);
    let said = compiled.render(false);
    Plan { name, shipped, graph: compiled.graph.unwrap_or_else(|| panic!("{said}")) }
}
