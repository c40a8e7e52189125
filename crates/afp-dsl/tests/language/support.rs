//! Shared parts of the tests: toolboxes, files of a folder, blessing.

use std::fs;
use std::path::{Path, PathBuf};

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::timing::{Target, check_target};
use afp_syntax::source::{Source, Sources};

/// The built-in toolboxes and those of `tests/toolboxes/`.
pub fn toolboxes() -> Toolboxes {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    for path in files("tests/toolboxes") {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        toolboxes.add(Source::new(name, read(&path)), "extra");
    }
    let found = toolboxes.diagnostics();
    assert!(found.is_empty(), "{}", found.render(toolboxes.sources(), false));
    toolboxes
}

pub const CASE: &str = "case.afp";

/// Compiles a plan file with further files after lines `// file: PATH`, or reads a toolbox. A first
/// line `// plan: NAME` selects the plan, `// target: NAME` its target, `// robot: NAME` the
/// toolbox of the project's robot, `// lacks: NAME` and `// estimates: NAME` a device of it.
pub fn compile(text: &str, toolboxes: &Toolboxes) -> Compiled {
    let (text, files) = &Texts::in_one(text);
    let source = Source::new(CASE, text);
    if text.lines().any(|line| line.starts_with("toolbox ")) && !text.contains("// as a plan") {
        let mut own = Toolboxes::default();
        own.add(source, "mine");
        let (diags, sources): (_, &Sources) = (own.diagnostics().clone(), own.sources());
        let mut compiled = Compiled::default();
        (compiled.diags, compiled.sources) = (diags, sources.clone());
        return compiled;
    }
    let said = |word| text.lines().next().and_then(|line| line.strip_prefix(word));
    let mut toolboxes = toolboxes.clone();
    said("// robot: ").iter().for_each(|name| toolboxes.set_robot(name));
    toolboxes.set_lacks(said("// lacks: ").map(str::to_owned));
    toolboxes.set_estimates(said("// estimates: ").map(str::to_owned));
    let mut compiled = afp_dsl::compile_plan(&source, &toolboxes, files, said("// plan: "));
    if let (Some(name), Some(graph)) = (said("// target: "), &compiled.graph) {
        compiled.diags.extend(check_target(graph, &Target::built_in(name).unwrap()));
        compiled.diags.sort();
        compiled.outline.attach(&compiled.diags);
        compiled.graph = compiled.graph.filter(|_| !compiled.diags.has_errors());
    }
    compiled
}

/// The file that begins at a line of a case, if any.
pub fn head(line: &str) -> Option<&str> {
    line.strip_prefix("// file: ").map(str::trim_end)
}

/// The start of a file's text in its case.
pub fn offset(case: &str, file: &str) -> usize {
    let mut at = 0;
    for line in case.split_inclusive('\n') {
        at += line.len();
        if head(line) == Some(file) {
            return at;
        }
    }
    assert_eq!(file, CASE);
    0
}

/// The `.afp` files of a folder of this crate, sorted.
pub fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut files: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "afp"))
        .collect();
    files.sort();
    files
}

pub fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

/// Compares a case with its expectation, or rewrites it with `AFP_BLESS=1`. Returns the difference.
pub fn compare(path: &Path, expected: &str, actual: &str) -> Option<String> {
    if expected == actual {
        return None;
    }
    if std::env::var_os("AFP_BLESS").is_some() {
        fs::write(path, actual).unwrap();
        return None;
    }
    Some(format!("--- {} is now\n{actual}", path.display()))
}
