//! The Unix sockets of runs on this machine.

use std::fs::{self, Permissions};
use std::io;
use std::os::unix::fs::{DirBuilderExt, PermissionsExt};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};

use afp_run::RunError;

/// The folder of sockets in a folder for runtime files.
const FOLDER: &str = "afp";
/// The folder of the robot's service.
const SERVICE: &str = "/run/afp";
/// The end of a socket's name.
const EXTENSION: &str = "sock";

/// The path of the socket of a new run.
pub fn new_path(plan: &str) -> PathBuf {
    let folder = folders().next().unwrap_or_else(std::env::temp_dir);
    folder.join(format!("{plan}-{}.{EXTENSION}", std::process::id()))
}

/// The folders of sockets; new ones are in the first.
fn folders() -> impl Iterator<Item = PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    // systemd lists several folders with colons.
    let service = variable("RUNTIME_DIRECTORY").and_then(|all| std::env::split_paths(&all).next());
    let user = variable("XDG_RUNTIME_DIR").map(|folder| Path::new(&folder).join(FOLDER));
    let uid = rustix::process::getuid().as_raw();
    let other = std::env::temp_dir().join(format!("{FOLDER}-{uid}"));
    let known = Path::new(SERVICE).is_dir().then(|| PathBuf::from(SERVICE));
    service.into_iter().chain(user).chain([other]).chain(known)
}

/// Listens on a new socket for the users of its group.
pub fn listen(path: &Path) -> io::Result<UnixListener> {
    if let Some(folder) = path.parent() {
        fs::DirBuilder::new().recursive(true).mode(0o750).create(folder)?;
    }
    // A run with this number that was killed.
    let _ = fs::remove_file(path);
    let listener = UnixListener::bind(path)?;
    fs::set_permissions(path, Permissions::from_mode(0o660))?;
    Ok(listener)
}

/// Connects to a socket.
///
/// # Errors
/// Nothing listens there.
pub fn connect(path: &Path) -> Result<UnixStream, RunError> {
    UnixStream::connect(path).map_err(RunError::file("cannot attach to", path))
}

/// Connects to the only run of this machine.
///
/// # Errors
/// There is no run, or there are several.
pub fn connect_to_only() -> Result<UnixStream, RunError> {
    let sockets = folders().filter_map(|folder| fs::read_dir(folder).ok());
    let sockets = sockets.flat_map(|all| all.flatten().map(|entry| entry.path()));
    let sockets = sockets.filter(|path| path.extension().is_some_and(|it| it == EXTENSION));
    // Sockets of killed runs do not answer.
    let connected = sockets.filter_map(|path| Some((UnixStream::connect(&path).ok()?, path)));
    let mut all: Vec<_> = connected.collect();
    all.dedup_by(|a, b| a.1 == b.1);
    match all.len() {
        1 => Ok(all.remove(0).0),
        0 => Err(RunError::usage(
            "no run on this machine lets debuggers attach",
            "'afpc run PLAN --robot hardware' does, and a simulated run with '--attach'",
        )),
        _ => {
            let names: Vec<_> = all.iter().map(|(_, path)| path.display().to_string()).collect();
            let help = format!("name one: afpc attach {}", names.join(", afpc attach "));
            Err(RunError::usage("several runs let debuggers attach", help))
        }
    }
}
