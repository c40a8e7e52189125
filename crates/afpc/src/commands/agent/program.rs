//! The command lines that run a release.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use std::{io, thread};

use afp_deploy::manifest::{Kind, Manifest, SIMULATED};
use afp_run::RunError;

/// The longest time of a self-check.
const CHECK: Duration = Duration::from_secs(30);
/// The longest time until a robot has stopped.
const STOP: Duration = Duration::from_secs(5);
const LOOK: Duration = Duration::from_millis(5);
/// The most output of a self-check that is read, in bytes.
const LONGEST: u64 = 1 << 16;

/// The `afpc` that runs now.
///
/// # Errors
/// The system does not know it.
pub(super) fn afpc() -> Result<PathBuf, RunError> {
    std::env::current_exe().map_err(RunError::file("cannot find", "afpc".as_ref()))
}

/// The command that runs a release, without an option for the robot.
fn command(afpc: &Path, files: &Path, manifest: &Manifest) -> Command {
    let file = files.join(&manifest.file);
    let mut command = match manifest.kind {
        Kind::Built { .. } => Command::new(&file),
        Kind::Interpreted => {
            let mut command = Command::new(afpc);
            let mut plan = file.into_os_string();
            plan.push(format!(":{}", manifest.plan));
            command.arg("run").arg(plan);
            command
        }
    };
    for (name, value) in &manifest.set {
        command.arg(format!("--set={name}={value}"));
    }
    command
}

/// Runs the self-check of a release and returns the hash of its trace.
///
/// # Errors
/// The reason why the release does not run here.
pub(super) fn check(afpc: &Path, files: &Path, manifest: &Manifest) -> Result<String, String> {
    trace_of(command(afpc, files, manifest))
}

/// Runs a command with `--self-check` and returns the hash of its trace.
///
/// # Errors
/// The program cannot be started, fails, or does not end.
pub fn trace_of(mut command: Command) -> Result<String, String> {
    command.arg("--self-check");
    let (_, out, err) = finish(command, CHECK)?;
    match out.lines().find_map(|line| line.strip_prefix("trace ")) {
        Some(trace) => Ok(trace.to_owned()),
        None => Err(err),
    }
}

/// Stops the robot of a release; nothing if it is simulated.
///
/// # Errors
/// The robot cannot be reached.
pub(super) fn stop_robot(afpc: &Path, files: &Path, manifest: &Manifest) -> Result<(), String> {
    if manifest.robot == SIMULATED {
        return Ok(());
    }
    let mut command = command(afpc, files, manifest);
    command.args(["--robot", &manifest.robot, "--stop-only"]);
    match finish(command, STOP)? {
        (true, ..) => Ok(()),
        (false, _, err) => Err(err),
    }
}

/// Runs a program to its end. Returns whether it succeeded, its output and its errors.
fn finish(mut command: Command, patience: Duration) -> Result<(bool, String, String), String> {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(|why| format!("cannot start it: {why}"))?;
    if !wait(&mut child, patience).map_err(|why| why.to_string())? {
        end(&mut child);
        return Err(format!("it did not end within {} s", patience.as_secs()));
    }
    let text = |from: Option<&mut dyn Read>| {
        let mut text = Vec::new();
        if let Some(from) = from {
            from.take(LONGEST).read_to_end(&mut text).ok();
        }
        String::from_utf8_lossy(&text).trim().to_owned()
    };
    let out = text(child.stdout.as_mut().map(|it| it as &mut dyn Read));
    let err = text(child.stderr.as_mut().map(|it| it as &mut dyn Read));
    let succeeded = child.wait().is_ok_and(|status| status.success());
    Ok((succeeded, out, err))
}

/// Starts a release, which waits to be armed.
///
/// # Errors
/// The program cannot be started.
pub(super) fn start(
    (afpc, files): (&Path, &Path),
    manifest: &Manifest,
    log: &Path,
    notify: &Path,
) -> io::Result<Child> {
    let mut command = command(afpc, files, manifest);
    if manifest.robot == SIMULATED {
        command.args(["--speed", "1x"]);
    } else {
        command.args(["--robot", &manifest.robot]);
    }
    command.args(["--disarmed", "--svg", "none", "--log"]).arg(log);
    command.env("NOTIFY_SOCKET", notify).stdin(Stdio::piped()).stdout(Stdio::null());
    command.spawn()
}

/// Waits for the end of a program, at most this long. Returns whether it has ended.
///
/// # Errors
/// The system does not know the program.
pub(super) fn wait(child: &mut Child, patience: Duration) -> io::Result<bool> {
    let until = Instant::now() + patience;
    while child.try_wait()?.is_none() {
        if Instant::now() >= until {
            return Ok(false);
        }
        thread::sleep(LOOK);
    }
    Ok(true)
}

/// Asks a program to end, and ends it by force after two seconds.
pub(super) fn end(child: &mut Child) {
    let id = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw);
    if let Some(id) = id {
        rustix::process::kill_process(id, rustix::process::Signal::TERM).ok();
    }
    if !wait(child, Duration::from_secs(2)).unwrap_or(false) {
        child.kill().ok();
        child.wait().ok();
    }
}
