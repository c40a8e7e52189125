//! Every program is valid, has the length in its page, and passes its scenarios.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use afp::load::Registry;
use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::toolbox::Toolbox;
use afp_session::simulated;
use afp_syntax::source::Source;
use afp_test::{Setting, run};
use peers::StandIn;

/// The files of a folder in this example, by name.
fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = std::fs::read_dir(&folder).unwrap();
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|end| end == "afp"));
    files.sort();
    files
}

fn source(path: &Path) -> Source {
    Source::new(path.display().to_string(), std::fs::read_to_string(path).unwrap())
}

/// All toolboxes, and those of the example.
fn toolboxes() -> (Toolboxes, Vec<Arc<Toolbox>>) {
    let mut all: Toolboxes = afp_toolboxes::sources().collect();
    let paths = files("toolboxes");
    for path in &paths {
        all.add(source(path), "peers");
    }
    let found = all.diagnostics();
    assert!(found.is_empty(), "{}", found.render(all.sources(), false));
    let name = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
    let own = paths.iter().map(|path| all.get(&name(path)).unwrap().clone()).collect();
    (all, own)
}

fn compile(path: &Path, toolboxes: &Toolboxes) -> Compiled {
    let read = |_: &str| Err::<String, _>("no other file is used".to_owned());
    afp_dsl::compile(&source(path), toolboxes, &read)
}

#[test]
fn every_program_compiles_without_diagnostics() {
    let (toolboxes, _) = toolboxes();
    let programs = files("plans");
    assert!(programs.len() >= 22, "{} programs", programs.len());
    let said: String = programs
        .iter()
        .map(|path| compile(path, &toolboxes))
        .filter_map(|compiled| (!compiled.diags.is_empty()).then(|| compiled.render(false)))
        .collect();
    assert!(said.is_empty(), "{said}");
}

#[test]
fn every_file_is_in_canonical_form() {
    for path in files("plans").into_iter().chain(files("toolboxes")) {
        let source = source(&path);
        let canonical = afp_format::format(&source.text).unwrap();
        if std::env::var_os("AFP_BLESS").is_some() {
            std::fs::write(&path, canonical).unwrap();
        } else {
            assert_eq!(source.text, canonical, "{}", path.display());
        }
    }
}

#[test]
fn every_program_does_what_its_scenarios_say() {
    let (toolboxes, own) = toolboxes();
    let robot = simulated::<StandIn, _>(|registry: &mut Registry<StandIn>| {
        afp_std::templates::register(registry);
        own.iter().for_each(|toolbox| peers::register(toolbox, registry));
    });
    let (mut tried, mut failed) = (0, String::new());
    for path in files("plans") {
        let compiled = compile(&path, &toolboxes);
        assert!(!compiled.scenarios.is_empty(), "{}: no scenario", path.display());
        for scenario in &compiled.scenarios {
            tried += 1;
            let setting = Setting::find(scenario, &path, afp_session::Loader::kind(&robot));
            let verdict = run(scenario, &setting.unwrap(), &robot, None).unwrap();
            if !verdict.passed() {
                let report = verdict.report();
                failed += &format!("==== {} of {}\n{report}\n", scenario.name, path.display());
            }
        }
    }
    assert!(tried >= 44, "{tried} scenarios");
    assert!(failed.is_empty(), "{failed}");
}
