//! `afpc test --generate`: writes scenarios for a plan.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use afp_dsl::files::{normalised, read_text};
use afp_dsl::graph::{EntryKind, Graph};
use afp_dsl::scenario::Scenario;
use afp_run::{EXIT_OK, RunError, check_apart, write_whole};
use afp_session::Loader;
use afp_test::{Generated, Setting, is_generated};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use crate::commands::print;
use crate::no_plan::NoPlan;
use crate::plan_file::{PlanFile, PlanText};
use crate::{Linked, runner};

/// The duration of the run that finds when actors are active, in nanoseconds.
const RUN: u64 = 60_000_000_000;

/// Writes a file of scenarios for the first plan of each file, and prints its path.
///
/// # Errors
/// No file is given, a plan is invalid or needs values, a file cannot be written.
pub(super) fn run(
    files: &[PathBuf],
    output: Option<&Path>,
    linked: &Linked<'_>,
) -> Result<u8, NoPlan> {
    if files.is_empty() {
        let help = "afpc test --generate plans/patrol.afp";
        return Err(RunError::usage("'--generate' needs the file of a plan", help).into());
    }
    let read = files.iter().map(|file| PlanFile::read(&file.display().to_string()));
    let read = read.collect::<Result<Vec<_>, _>>()?;
    let plans = read.iter().filter_map(|file| Some((&file.own, file.compiled.graph.as_ref()?)));
    runner::become_one_for(plans, linked)?;
    for file in read {
        let (file, graph) = file.checked()?;
        has_own_plan(&file.path, &graph)?;
        let path = place(&file.path, output, files.len() > 1);
        may_be_made_anew(&path)?;
        let sources = file.compiled.plan_sources().map(|source| Path::new(&source.name));
        check_apart([&*path], sources)?;
        let mut made = generate(&file.path, graph, linked.robot)?;
        prove(&file.path, &mut made, linked.robot)?;
        let count = made.count();
        let said = match count {
            0 => format!("{}: no scenarios; nothing is written\n", file.path.display()),
            count => format!("{}: {count} scenarios\n", path.display()),
        };
        if count > 0 {
            write(&file.path, &path, &made)?;
        }
        print(&said)?;
        for why in &made.left_out {
            print(&format!("  left out: {why}\n"))?;
        }
    }
    Ok(EXIT_OK)
}

/// Rejects a file of scenarios for a plan in another file: the generated scenarios would look for
/// the plan in the first file.
fn has_own_plan(file: &Path, graph: &Graph) -> Result<(), RunError> {
    let Some(other) = &graph.main().file else { return Ok(()) };
    let other = normalised(&file.with_file_name(other).display().to_string());
    Err(RunError::usage(
        format!("'{}' does not declare a plan", file.display()),
        format!("name the file of the plan: '{other}'"),
    ))
}

/// Refuses to replace handwritten scenarios.
fn may_be_made_anew(path: &Path) -> Result<(), RunError> {
    if !path.is_file() {
        return Ok(());
    }
    let cannot = RunError::file("cannot read the scenarios", path);
    let text = read_text(path).map_err(cannot)?;
    if text.trim().is_empty() || is_generated(&text) {
        return Ok(());
    }
    Err(RunError::usage(
        format!(
            "'afpc test --generate' did not write '{}' and does not replace it",
            path.display()
        ),
        "give another name with '-o FILE'",
    ))
}

/// Runs the generated scenarios of a plan on all cores, as if they were in its folder.
fn prove(file: &Path, made: &mut Generated, robot: &dyn Loader) -> Result<(), RunError> {
    let from = file.file_name().unwrap_or_default().to_string_lossy();
    let read = |made: &Generated| {
        let path = file.with_file_name("generated.afp");
        let text = PlanText { path, text: made.text(&from), plan: None };
        Ok::<_, RunError>(text.compile()?.compiled.scenarios)
    };
    let run_one = |scenario: &Scenario| {
        let setting = Setting::find(scenario, file, robot.kind())?;
        afp_test::run(scenario, &setting, robot, None)
    };
    made.prove(read, |scenarios| scenarios.par_iter().with_max_len(1).map(run_one).collect())
}

/// Writes scenarios into the file `to`, and creates its folder.
fn write(file: &Path, to: &Path, made: &Generated) -> Result<(), RunError> {
    let folder = to.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder).map_err(RunError::file("cannot make the folder", folder))?;
    let text = made.text(&relative_path(file, to)?);
    write_whole("cannot write the scenarios", to, afp_format::format(&text).unwrap_or(text))
}

fn generate(file: &Path, graph: Graph, robot: &dyn Loader) -> Result<Generated, RunError> {
    let missing =
        |entry: &&afp_dsl::graph::Entry| entry.kind == EntryKind::In && entry.init.is_none();
    if let Some(entry) = graph.main().entries.iter().find(missing) {
        let message = format!("the 'in' entry '{}' has no default", entry.name);
        return Err(RunError::usage(message, "give it one, or write the scenarios yourself"));
    }
    let plan_file = file.display().to_string();
    let quiet = Scenario::quiet("undisturbed", Arc::new(graph), plan_file, RUN);
    let setting = Setting::find(&quiet, file, robot.kind())?;
    let devices = robot.kind().devices();
    afp_test::generate(&quiet, devices, &mut |scenario| {
        afp_test::run(scenario, &setting, robot, None)
    })
}

/// The file for a plan's scenarios: in `output`, a folder if there are several, or else
/// `tests/patrol_generated.afp` next to `patrol.afp`.
fn place(file: &Path, output: Option<&Path>, several: bool) -> PathBuf {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let name = format!("{stem}_generated.afp");
    match output {
        Some(output) if several || output.is_dir() => output.join(name),
        Some(output) => output.to_owned(),
        None => file.with_file_name("tests").join(name),
    }
}

/// The relative path from the file `to` to a plan, in the form for `use`.
fn relative_path(file: &Path, to: &Path) -> Result<String, RunError> {
    let folder = to.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let whole = |path: &Path| path.canonicalize().map_err(RunError::file("cannot find", path));
    let (file, folder) = (whole(file)?, whole(folder)?);
    let path = pathdiff::diff_paths(&file, folder).unwrap_or(file);
    Ok(path
        .components()
        .map(|part| part.as_os_str().to_string_lossy())
        .collect::<Vec<_>>()
        .join("/"))
}
