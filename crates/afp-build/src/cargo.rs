//! Calls cargo, finds its artifacts, and shows its errors at useful places.

mod blame;
mod message;

use std::env;
use std::ffi::{OsStr, OsString};
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use afp_excerpt::{Report, Severity};
use afp_run::{RunError, say};
use serde_json::Value;

use crate::NotBuilt;

pub use blame::{Blame, Generated};
use message::Message;

pub struct Job<'a> {
    /// The folder of the crate.
    pub folder: &'a Path,
    /// The folder for cargo's settings and toolchain, with absolute paths in everything else; the
    /// current folder if `None`.
    pub caller: Option<&'a Path>,
    /// Cargo's target folder unless the environment sets it; below the crate's folder if `None`.
    pub target: Option<&'a Path>,
    /// The toolchain for another machine.
    pub toolchain: Option<&'a Toolchain>,
    /// The wanted artifact.
    pub artifact: Artifact,
    /// The source of errors.
    pub blame: Blame<'a>,
    /// The error if cargo is missing.
    pub no_cargo: RunError,
    /// The receiver of diagnostics as objects; standard error, as readable text, if `None`.
    pub tools: Option<Tools<'a>>,
}

/// A receiver of objects.
pub type Tools<'a> = &'a dyn Fn(&Value) -> Result<(), RunError>;

/// The toolchain for another machine.
#[derive(Debug)]
pub struct Toolchain {
    /// The target triple.
    pub triple: &'static str,
    /// Environment variables for cargo and the compilers.
    pub environment: Vec<(String, OsString)>,
}

/// The wanted artifact of a crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Artifact {
    /// Its binary, if it has one.
    Program,
    /// Its library as a Python extension.
    Extension,
}

/// The result of cargo.
#[derive(Debug, Default)]
pub struct Built {
    /// The wanted artifact, if the crate has one.
    pub artifact: Option<PathBuf>,
    /// The manifests of all its packages on this machine.
    pub manifests: Vec<PathBuf>,
}

/// Variables for pyo3 to build an extension for any Python without calling one.
const FOR_ANY_PYTHON: [(&str, &str); 2] =
    [("PYO3_NO_PYTHON", "1"), ("PYO3_BUILD_EXTENSION_MODULE", "1")];

/// Builds a crate.
///
/// # Errors
/// Cargo is missing or fails; the reason was reported.
pub fn build(job: Job<'_>) -> Result<Built, NotBuilt> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = command(&cargo, &job);
    let started = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
    let mut child = started.map_err(|error| match error.kind() {
        ErrorKind::NotFound => job.no_cargo,
        _ => RunError::file("cannot start", cargo.as_ref())(error),
    })?;
    let (mut built, mut messages) = (Built::default(), Vec::new());
    if let Some(out) = child.stdout.take() {
        let lines = BufReader::new(out).lines().map_while(Result::ok);
        for line in lines.filter_map(|line| serde_json::from_str::<Value>(&line).ok()) {
            built.artifact = job.artifact.path(&line).or(built.artifact);
            built.manifests.extend(manifest(&line));
            messages.extend(Message::read(&line));
        }
    }
    let status = child.wait().map_err(RunError::file("cannot wait for", cargo.as_ref()))?;
    // Reported at the end, so that cargo's progress and the errors do not mix.
    messages.retain(|message| job.blame.concerns(message));
    let reader = Reader { blame: &job.blame, tools: job.tools };
    reader.tell(job.folder, &messages, status.success())?;
    let first = || messages.iter().find(|message| message.is_error).map(Message::line);
    if status.success() { Ok(built) } else { Err(NotBuilt::Told { first: first() }) }
}

/// The command that builds a crate.
fn command(cargo: &OsStr, job: &Job<'_>) -> Command {
    let mut command = Command::new(cargo);
    command.args(["build", "--release", "--message-format=json-diagnostic-rendered-ansi"]);
    command.arg("--manifest-path").arg(job.folder.join("Cargo.toml"));
    if let Some(caller) = job.caller {
        command.current_dir(caller);
    }
    // Cargo would resolve a relative folder in the environment from the caller's folder.
    let is_said = env::var_os("CARGO_TARGET_DIR").is_some() && job.caller.is_none();
    if let (Some(target), false) = (job.target, is_said) {
        command.arg("--target-dir").arg(target);
    }
    if let Some(toolchain) = job.toolchain {
        command.args(["--target", toolchain.triple]);
        command.envs(toolchain.environment.iter().map(|(name, value)| (name, value)));
    }
    if job.artifact == Artifact::Extension {
        command.envs(FOR_ANY_PYTHON);
    }
    command
}

/// The manifest of a cargo message's package, if it is on this machine: other packages never
/// change.
fn manifest(line: &Value) -> Option<PathBuf> {
    let is_here = line.get("package_id")?.as_str()?.contains("path+file:");
    is_here.then_some(PathBuf::from(line.get("manifest_path")?.as_str()?))
}

/// The reader of the compiler's messages.
struct Reader<'a> {
    blame: &'a Blame<'a>,
    tools: Option<Tools<'a>>,
}

impl Reader<'_> {
    /// Reports the compiler's messages about a crate, and a failed build.
    fn tell(&self, folder: &Path, messages: &[Message], is_built: bool) -> Result<(), RunError> {
        let failed = format!("cargo could not build the crate in '{}'", folder.display());
        let Some(tools) = self.tools else {
            messages.iter().for_each(|message| self.blame.tell(message));
            if !is_built {
                say(format_args!("error: {failed}"));
            }
            return Ok(());
        };
        for message in messages {
            tools(&self.blame.json(message))?;
            // The messages' excerpts are useful, too.
            say(&message.rendered);
        }
        // Otherwise cargo has already printed the reason on standard error.
        if !is_built && !messages.iter().any(|message| message.is_error) {
            let (severity, help) = (Severity::Error, "see cargo's messages on standard error");
            let report = Report { severity, code: "", message: &failed, help, marks: Vec::new() };
            tools(&report.json())?;
        }
        Ok(())
    }
}

impl Artifact {
    /// The path of the artifact in a message of cargo.
    fn path(self, line: &Value) -> Option<PathBuf> {
        match self {
            Artifact::Program => line.get("executable")?.as_str().map(PathBuf::from),
            Artifact::Extension => {
                let kinds = line.get("target")?.get("crate_types")?.as_array()?;
                if !kinds.iter().any(|kind| kind == "cdylib") {
                    return None;
                }
                let files = line.get("filenames")?.as_array()?;
                files.iter().filter_map(Value::as_str).map(PathBuf::from).find(|file| {
                    let ending = file.extension().and_then(|ending| ending.to_str());
                    matches!(ending, Some("so" | "dylib" | "dll"))
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_manifests_of_local_packages_are_returned() {
        for (id, here) in [
            ("path+file:///p/box#0.1.0", true),
            ("box 0.1.0 (path+file:///p/box)", true),
            ("registry+https://github.com/rust-lang/crates.io-index#box@0.1.0", false),
        ] {
            let line = json!({ "package_id": id, "manifest_path": "/p/box/Cargo.toml" });
            assert_eq!(manifest(&line), here.then(|| PathBuf::from("/p/box/Cargo.toml")), "{id}");
        }
        assert_eq!(manifest(&json!({ "reason": "build-finished" })), None);
    }

    #[test]
    fn artifacts_are_found_in_cargos_messages() {
        let library = json!({ "reason": "compiler-artifact", "executable": null,
            "target": { "crate_types": ["cdylib"] },
            "filenames": ["/t/libx.so", "/t/libx.rlib"] });
        let program = json!({ "reason": "compiler-artifact", "executable": "/t/x",
            "target": { "crate_types": ["bin"] }, "filenames": ["/t/x"] });
        let end = json!({ "reason": "build-finished" });
        for (line, a_program, an_extension) in [
            (&library, None, Some("/t/libx.so")),
            (&program, Some("/t/x"), None),
            (&end, None, None),
        ] {
            assert_eq!(Artifact::Program.path(line), a_program.map(PathBuf::from));
            assert_eq!(Artifact::Extension.path(line), an_extension.map(PathBuf::from));
        }
    }
}
