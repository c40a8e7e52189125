//! Programs that a suite needs in addition to Rust and a C linker, and the command that installs
//! them.

use std::path::Path;
use std::process::{Command, Stdio};
use std::{env, fs};

use crate::npm::npm;
use crate::python::emptied;
use crate::shell::{Failure, root, target};

/// A program that may be missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Python 3 with `venv`.
    Python,
    /// Node.js with npm.
    Node,
    /// Chromium, at `/usr/bin/chromium` or where `CHROMIUM` says.
    Chromium,
    /// `cyclictest`, which measures how late a thread wakes up.
    Cyclictest,
}

/// Prefixes of the names of these programs.
const PROGRAMS: [&str; 7] = ["python", "pip", "node", "npm", "npx", "chrom", "cyclictest"];

impl Need {
    /// Whether the program is installed.
    pub fn is_met(self) -> bool {
        let python = if cfg!(windows) { "python" } else { "python3" };
        match self {
            Need::Python => answers(Command::new(python).args(["-c", "import venv, ensurepip"])),
            Need::Node => {
                answers(Command::new("node").arg("--version")) && answers(npm().arg("--version"))
            }
            Need::Cyclictest => answers(Command::new("cyclictest").arg("--help")),
            Need::Chromium => {
                let browser = env::var_os("CHROMIUM").unwrap_or_else(|| "/usr/bin/chromium".into());
                Path::new(&browser).exists()
            }
        }
    }

    /// The name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Need::Python => "Python 3 with venv",
            Need::Node => "Node.js with npm",
            Need::Chromium => "Chromium",
            Need::Cyclictest => "cyclictest",
        }
    }

    /// The packages of the system's package manager.
    fn packages(self) -> &'static str {
        match (self, env::consts::OS) {
            (Need::Python, "windows") => "Python.Python.3.13",
            (Need::Python, "macos") => "python",
            (Need::Python, _) => "python3 python3-venv",
            (Need::Node, "windows") => "OpenJS.NodeJS.LTS",
            (Need::Node, "macos") => "node",
            (Need::Node, _) => "nodejs npm",
            (Need::Chromium, "windows") => "Hibbiki.Chromium",
            (Need::Chromium, _) => "chromium",
            (Need::Cyclictest, _) => "rt-tests",
        }
    }
}

/// The command that installs these programs.
pub fn install(needs: &[Need]) -> String {
    let manager = match env::consts::OS {
        "windows" => "winget install",
        "macos" => "brew install",
        _ => "sudo apt-get install",
    };
    let packages: Vec<_> = needs.iter().map(|need| need.packages()).collect();
    format!("{manager} {}", packages.join(" "))
}

fn answers(command: &mut Command) -> bool {
    let quiet = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

/// Hides the programs of every [`Need`] from a command: its `PATH` becomes one folder with links to
/// all other programs.
///
/// # Errors
/// The folder cannot be made.
#[cfg(unix)]
pub fn hidden_from(command: &mut Command) -> Result<&mut Command, Failure> {
    let folder = root().join(target()).join("xtask/rust-alone");
    let path = env::var_os("PATH").unwrap_or_default();
    if path == folder {
        return Ok(command);
    }
    emptied(&folder)?;
    // A folder of the path may not exist.
    let folders = env::split_paths(&path).filter_map(|folder| fs::read_dir(folder).ok());
    for entry in folders.flatten().flatten() {
        let (name, link) = (entry.file_name(), folder.join(entry.file_name()));
        let hidden = PROGRAMS.iter().any(|start| name.to_string_lossy().starts_with(start));
        // The first folder wins.
        if !hidden && !link.is_symlink() {
            std::os::unix::fs::symlink(entry.path(), link)?;
        }
    }
    Ok(command.env("PATH", folder).env("CHROMIUM", ""))
}

/// Changes nothing: other systems lack the links for such a folder.
///
/// # Errors
/// None.
#[cfg(not(unix))]
pub fn hidden_from(command: &mut Command) -> Result<&mut Command, Failure> {
    Ok(command)
}
