//! Plans of the tests, loaded at run time.

use afp::load::{LoadedPlan, Registry};
use afp_dsl::Toolboxes;
use afp_dsl::compile_unchecked;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_syntax::source::Source;

use crate::drive::drive;
use crate::platform::Platform;
use crate::script::Script;

/// The built-in toolboxes and the test toolbox.
pub fn toolboxes() -> Toolboxes {
    let mut toolboxes = Toolboxes::default();
    for builtin in afp_toolboxes::ALL.iter().filter(|builtin| builtin.name == "std") {
        toolboxes.add(Source::new(builtin.file_name, builtin.text), builtin.rust_path);
    }
    toolboxes.add(Source::new("testing.afp", crate::TOOLBOX), "afp_tests");
    toolboxes
}

/// Compiles a plan, with the files after it, each below a line `// file: PATH`.
///
/// # Errors
/// All diagnostics as text.
pub fn graph(name: &str, text: &str) -> Result<Graph, String> {
    let (text, files) = Texts::in_one(text);
    let compiled =
        compile_unchecked(&Source::new(format!("{name}.afp"), text), &toolboxes(), &files);
    let all = compiled.render(false);
    compiled.graph.ok_or(all)
}

/// The interpreter's instance of a graph.
///
/// # Panics
/// A component of the graph is not registered.
pub fn load(graph: &Graph) -> LoadedPlan<Platform> {
    let mut registry: Registry<Platform> = Registry::new();
    afp_std::templates::register(&mut registry);
    crate::templates::register(&mut registry);
    LoadedPlan::new(graph, &registry).expect("all components are registered")
}

/// Runs a graph in the interpreter and returns its lines.
///
/// # Panics
/// As [`load`].
pub fn interpret(graph: &Graph, script: &Script) -> Vec<String> {
    drive(load(graph), script)
}
