//! The Python package: its wheel and its tests; a log and a table, read with public readers.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shell::{
    Failure, cargo, output, program, quickly_built, root, run as run_command, target,
};

/// The packages for building, testing and reading, as pip names them.
const PACKAGES: [&str; 17] = [
    "gymnasium==1.4.0",
    "hypothesis==6.170.15",
    "matplotlib==3.11.2",
    "maturin==1.16.0",
    "mcap-protobuf-support==0.6.0",
    "mcap==1.6.0",
    "minari==0.5.4",
    "mypy==2.4.1",
    "numpy==2.4.6",
    "optuna==5.0.0",
    "pandas==3.1.1",
    "polars==2.1.0",
    "pyarrow==26.0.1",
    "pytest-xdist==3.8.0",
    "pytest==9.2.0",
    "scipy==1.17.1",
    "typing-extensions>=4.13",
];

/// More packages for the long tests.
const LONG: [&str; 7] = [
    "ipykernel==7.4.0",
    "moviepy==2.2.1",
    "nbclient==0.11.0",
    "pyright==1.1.414",
    "ray==2.60.0",
    "stable-baselines3==2.9.0",
    "uv==0.13.9",
];

/// The Pythons in which programs end in the middle of something.
const PYTHONS: [&str; 4] = ["3.10", "3.11", "3.12", "3.13"];

/// Duration of the nightly stress test, seconds.
const STRESSED: &str = "600";

/// Random steps of the nightly run in random rooms with random faults.
const RANDOM_STEPS: &str = "1000000";

/// Simulations after which the memory use must be unchanged.
const SIMULATIONS: &str = "10000";

/// The number of programs that end in the middle of something.
const EXITS: &str = "1000";

/// Builds the package as for users, installs it, and runs its tests: pytest with the
/// documentation's examples, the types, and the stubs against the package.
///
/// # Errors
/// No Python, no network for the packages, or a failing test.
pub fn run() -> Result<(), Failure> {
    let (python, afpc) = installed()?;
    read_a_log(&python, &afpc)?;
    read_a_sweep(&python, &afpc)?;
    // On all cores, each file on one core.
    let tests = ["-m", "pytest", "--quiet", "-n", "auto", "--dist", "loadfile", "--durations=5"];
    let mut tests = at_package(&python, &tests);
    tests.args(["--doctest-modules", "--pyargs", "tests", "afp"]);
    // Builds for a project use the folder of the other slow tests.
    run_command(quickly_built(&mut tests).env("AFPC", afpc))?;
    run_command(&mut at_package(&python, &["-m", "mypy"]))?;
    run_command(&mut at_package(&python, &["-m", "mypy.stubtest", "afp._afp"]))?;
    sdist(&python, &wheels("sdist")?)
}

/// A project's robot in Python: builds an extension and a runner.
///
/// # Errors
/// As [`run`].
pub fn robot() -> Result<(), Failure> {
    let (python, afpc) = installed()?;
    let mut test = at_package(&python, &["-m", "pytest", "--quiet", "tests/test_robot.py"]);
    run_command(quickly_built(&mut test).env("AFPC", afpc).env("AFP_ROBOT", "1"))
}

/// A Python with the package built by the `dev` profile, and the command line.
fn installed() -> Result<(PathBuf, PathBuf), Failure> {
    let python = environment("python", &PACKAGES)?;
    run_command(cargo().args(["build", "--quiet", "--package", "afpc", "--features", "full"]))?;
    let afpc = target().join("debug").join(format!("afpc{}", std::env::consts::EXE_SUFFIX));
    install(&python, "dev")?;
    Ok((python, afpc))
}

/// The long tests: limits of the optimised package, the stress test, a million random steps in its
/// environments, the notebooks, a sweep on a cluster, and a build from the source distribution
/// only.
///
/// # Errors
/// A limit is exceeded, a notebook fails, or the source distribution is incomplete.
pub fn long() -> Result<(), Failure> {
    let packages: Vec<_> = PACKAGES.into_iter().chain(LONG).collect();
    let python = environment("python", &packages)?;
    run_command(cargo().args(["build", "--quiet", "--release", "--package", "afpc"]))?;
    let afpc = target().join("release").join(format!("afpc{}", std::env::consts::EXE_SUFFIX));
    install(&python, "release")?;
    run_command(at_package(&python, &["bench.py", "--check"]).env("AFPC", afpc))?;
    let stress = ["-m", "pytest", "--quiet", "-s", "tests/test_stress.py"];
    let mut stress = at_package(&python, &stress);
    run_command(stress.env("AFP_STRESS", STRESSED).env("AFP_SIMULATIONS", SIMULATIONS))?;
    PYTHONS.iter().try_for_each(|version| exits(&python, version))?;
    // Pyright, stable-baselines3 and a writer of videos are large.
    let large = ["test_types.py", "test_gym_sb3.py", "test_gym_moments.py"];
    let large = large.map(|file| format!("tests/{file}"));
    let mut more = at_package(&python, &["-m", "pytest", "--quiet"]);
    run_command(more.args(large).env("AFP_PYRIGHT", "1"))?;
    let random = ["-m", "pytest", "--quiet", "tests/test_gym.py", "-k", "nothing_raises"];
    run_command(at_package(&python, &random).env("AFP_GYM_STEPS", RANDOM_STEPS))?;
    run_command(&mut at_package(&python, &["notebooks/execute.py"]))?;
    let cluster = ["-m", "pytest", "--quiet", "tests/test_cluster.py"];
    run_command(at_package(&python, &cluster).env("AFP_RAY", "1"))?;
    let folder = wheels("sdist")?;
    sdist(&python, &folder)?;
    let pip = ["-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir"];
    let mut built = at_package(&python, &pip);
    built.arg(wheels("from-sdist")?).arg(only(&folder, "gz")?);
    // A missing file is also missing without optimisation.
    built.env("MATURIN_PEP517_ARGS", "--profile dev");
    run_command(built.env("CARGO_TARGET_DIR", target().join("xtask/sdist-target")))
}

/// Ends programs in the middle of something on one Python, which uv finds or installs.
fn exits(python: &Path, version: &str) -> Result<(), Failure> {
    let folder = target().join("xtask").join(format!("python-{version}"));
    let venv = ["-m", "uv", "venv", "--quiet", "--clear", "--python", version];
    run_command(program(python).args(venv).arg(&folder))?;
    let there = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let wheel = only(&target().join("xtask/wheels/release"), "whl")?;
    let pip = ["-m", "uv", "pip", "install", "--quiet", "gymnasium==1.4.0", "pytest==9.2.0"];
    run_command(program(python).args(pip).arg(wheel).arg("--python").arg(&there))?;
    let exits = ["-m", "pytest", "--quiet", "-s", "tests/test_exits.py"];
    run_command(at_package(&there, &exits).env("AFP_EXITS", EXITS))
}

pub fn at_package(python: &Path, arguments: &[&str]) -> Command {
    let mut command = program(python);
    command.args(arguments).current_dir(root().join("python")).env("CARGO_TARGET_DIR", target());
    command
}

/// Makes the source distribution through pip: maturin alone looks for a crate in the package's
/// folder, where cargo finds none.
///
/// # Errors
/// A required file is missing.
pub fn sdist(python: &Path, folder: &Path) -> Result<(), Failure> {
    let sdist = ["-m", "maturin", "pep517", "write-sdist", "--sdist-directory"];
    run_command(at_package(python, &sdist).arg(folder))
}

fn install(python: &Path, profile: &str) -> Result<(), Failure> {
    let folder = wheels(profile)?;
    // Not in pyproject.toml: the lock of a source distribution names crates that are not in it.
    let build = ["-m", "maturin", "build", "--locked", "--quiet", "--profile", profile, "--out"];
    run_command(at_package(python, &build).arg(&folder))?;
    let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"];
    let wheel = only(&folder, "whl")?;
    run_command(program(python).args(pip).arg("--force-reinstall").arg(wheel))
}

fn wheels(name: &str) -> Result<PathBuf, Failure> {
    emptied(&target().join("xtask/wheels").join(name))
}

/// Empties a folder, or creates it.
///
/// # Errors
/// It cannot be removed or created.
pub fn emptied(folder: &Path) -> Result<PathBuf, Failure> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    fs::create_dir_all(folder)?;
    Ok(folder.to_owned())
}

/// The only file with this extension in a folder.
///
/// # Errors
/// There is none.
pub fn only(folder: &Path, ending: &str) -> Result<PathBuf, Failure> {
    let files = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let files: Vec<PathBuf> = files.collect::<Result<_, _>>()?;
    let found = files.into_iter().find(|file| file.extension().is_some_and(|has| has == ending));
    found.ok_or_else(|| format!("nothing was built in {}", folder.display()).into())
}

/// Records a run and reads its log with public readers.
fn read_a_log(python: &Path, afpc: &Path) -> Result<(), Failure> {
    let log = target().join("xtask/wall_following.mcap");
    let drive = ["run", "plans/wall_following.afp", "--until", "20s", "--svg", "none", "--json"];
    output(program(afpc).args(drive).arg("--log").arg(&log))?;
    run_command(program(python).arg(root().join("tests/python/read_log.py")).arg(log))
}

/// Runs a sweep and reads its table.
fn read_a_sweep(python: &Path, afpc: &Path) -> Result<(), Failure> {
    let table = target().join("xtask/sweep");
    let sweep = ["sweep", "plans/wall_following.afp"];
    let worlds = ["--world", "worlds/wall_following.toml", "--world", "random:0..3"];
    let grid = ["--vary", "walldist=30cm,40cm", "--until", "21s", "--restart", "-o"];
    // The '/' makes it a folder, with one table per kind.
    let there = format!("{}/", table.display());
    output(program(afpc).args(sweep).args(worlds).args(grid).arg(there))?;
    run_command(program(python).arg(root().join("tests/python/read_sweep.py")).arg(table))
}

/// A Python with the packages, created once under target/ in a folder with this name.
///
/// # Errors
/// No Python, or no network for the packages.
pub fn environment(name: &str, packages: &[&str]) -> Result<PathBuf, Failure> {
    let folder = target().join("xtask").join(name);
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let done = folder.join("packages.txt");
    let installed = fs::read_to_string(&done).unwrap_or_default();
    let installed: Vec<_> = installed.lines().collect();
    if packages.iter().all(|package| installed.contains(package)) {
        return Ok(python);
    }
    let system = if cfg!(windows) { "python" } else { "python3" };
    run_command(program(system).args(["-m", "venv", "--clear"]).arg(&folder)).map_err(|why| {
        Failure(format!("{}\nhelp: install Python 3 with its venv module (python3-venv)", why.0))
    })?;
    let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    run_command(program(&python).args(pip).args(packages))?;
    fs::write(done, packages.join("\n"))?;
    Ok(python)
}
