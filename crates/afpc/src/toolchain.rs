//! Tools for cross-compiling: Rust's standard library for the machine, and a C compiler as the
//! linker. If tools are missing, one message names the commands that install them.

mod machine;

use std::env;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use afp_build::cargo::Toolchain;
use afp_run::{RunError, write_whole};

use machine::Linux;
pub use machine::Machine;

/// The C compiler and linker.
enum Linker {
    /// Cargo's default: this machine is of that kind, or the environment names a linker.
    Known,
    /// A cross compiler of the system.
    Gcc(String),
    /// Zig, a compiler for every machine.
    Zig(&'static [&'static str]),
}

/// The ways to call zig: installed directly, or by pip.
const ZIGS: [&[&str]; 2] = [&["zig"], &["python3", "-m", "ziglang"]];

/// Finds the tools for a machine; `folder` is for wrapper scripts.
///
/// # Errors
/// A tool is missing, or the folder cannot be written.
pub fn find(machine: &'static Linux, folder: &Path) -> Result<Toolchain, RunError> {
    let (library, linker) = (has_library(machine), find_linker(machine));
    let (true, Some(linker)) = (library, &linker) else {
        return Err(missing(machine, library, linker.is_some()));
    };
    let environment = match linker {
        Linker::Known => Vec::new(),
        Linker::Gcc(gcc) => vec![(linker_variable(machine), gcc.into())],
        Linker::Zig(zig) => zig_environment(machine, zig, folder)?,
    };
    Ok(Toolchain { triple: machine.triple, environment })
}

/// Whether cargo's compiler has the standard library for a machine. If there is no compiler, cargo
/// reports it.
fn has_library(machine: &Linux) -> bool {
    let folder = answer(&rustc(), &["--print", "target-libdir", "--target", machine.triple]);
    folder.is_none_or(|folder| Path::new(&folder).is_dir())
}

fn find_linker(machine: &Linux) -> Option<Linker> {
    let host = answer(&rustc(), &["-vV"]).unwrap_or_default();
    let is_host = host.lines().any(|line| line.strip_prefix("host: ") == Some(machine.triple));
    if is_host || env::var_os(linker_variable(machine)).is_some() {
        return Some(Linker::Known);
    }
    let gcc = format!("{}-gcc", machine.gnu);
    // If the output is only the name, the compiler has no C library.
    let start = answer(gcc.as_ref(), &["-print-file-name=crt1.o"]);
    if start.is_some_and(|path| Path::new(&path).is_absolute()) {
        return Some(Linker::Gcc(gcc));
    }
    // A shell script calls zig.
    let zig = ZIGS.into_iter().filter(|_| cfg!(unix)).find(|zig| {
        let arguments: Vec<_> = zig[1..].iter().copied().chain(["version"]).collect();
        answer(zig[0].as_ref(), &arguments).is_some()
    });
    zig.map(Linker::Zig)
}

/// The variable that names cargo's linker.
fn linker_variable(machine: &Linux) -> String {
    format!("CARGO_TARGET_{}_LINKER", machine.triple.to_uppercase().replace('-', "_"))
}

/// Scripts that call zig for a machine, and the variables that name them.
fn zig_environment(
    machine: &Linux,
    zig: &[&str],
    folder: &Path,
) -> Result<Vec<(String, OsString)>, RunError> {
    let folder = folder.join(machine.triple);
    fs::create_dir_all(&folder).map_err(RunError::file("cannot make the folder", &folder))?;
    let zig = zig.join(" ");
    // Zig does not understand Rust's target names.
    let compile = format!(
        "for word do\n    shift\n    case $word in\n    --target=*) ;;\n    *) set -- \"$@\" \"$word\" ;;\n    \
         esac\ndone\nexec {zig} cc -target {} \"$@\"\n",
        machine.gnu
    );
    let compiler = script(&folder, "cc", &compile)?;
    let archiver = script(&folder, "ar", &format!("exec {zig} ar \"$@\"\n"))?;
    let suffix = machine.triple.replace('-', "_");
    Ok(vec![
        (linker_variable(machine), compiler.clone().into()),
        (format!("CC_{suffix}"), compiler.into()),
        (format!("AR_{suffix}"), archiver.into()),
    ])
}

/// Writes a shell script and returns its absolute path.
fn script(folder: &Path, name: &str, text: &str) -> Result<PathBuf, RunError> {
    let path = folder.join(name);
    let text = format!("#!/bin/sh\n{text}");
    // A new modification time would relink everything.
    if fs::read_to_string(&path).is_ok_and(|old| old == text) {
        return absolute(&path);
    }
    write_whole("cannot write", &path, &text)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755))
            .map_err(RunError::file("cannot make executable", &path))?;
    }
    absolute(&path)
}

fn absolute(path: &Path) -> Result<PathBuf, RunError> {
    std::path::absolute(path).map_err(RunError::file("cannot find", path))
}

/// Lists the missing tools and the command that installs them.
fn missing(machine: &Linux, library: bool, linker: bool) -> RunError {
    let Linux { name, triple, packages: [compiler, c_library], .. } = machine;
    let (mut things, mut commands) = (Vec::new(), Vec::new());
    if !library {
        things.push("Rust's standard library for the target");
        commands.push(format!("rustup target add {triple}"));
    }
    if !linker {
        things.push("a C compiler and linker for the target");
        commands.push(match (is_there("apt-get"), is_there("sudo")) {
            (true, true) => format!("sudo apt-get install -y {compiler} {c_library}"),
            (true, false) => format!("apt-get install -y {compiler} {c_library}"),
            (false, _) => "python3 -m pip install ziglang".to_owned(),
        });
    }
    let command = commands.join(" && ");
    let help = match library || is_there("rustup") {
        true => format!("run '{command}', then the same command again"),
        false => format!("install Rust from https://rustup.rs, then run '{command}'"),
    };
    let message = format!("cannot build for {name}: {} missing", are(&things));
    RunError::Missing { message, help }
}

/// `a is`, `a and b are`.
fn are(things: &[&str]) -> String {
    let verb = if things.len() == 1 { "is" } else { "are" };
    format!("{} {verb}", things.join(" and "))
}

/// The compiler that cargo calls.
fn rustc() -> OsString {
    env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

/// The output of a program; empty if the program is missing or fails.
fn answer(program: &OsStr, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new(program);
    let output = command.args(arguments).stdin(Stdio::null()).stderr(Stdio::null()).output();
    let output = output.ok().filter(|output| output.status.success())?;
    Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Whether a program of that name exists.
fn is_there(name: &str) -> bool {
    let paths = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&paths).any(|folder| folder.join(name).is_file())
}
