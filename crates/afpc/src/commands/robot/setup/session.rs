//! The connection of a setup: one login for the probe, the files and the script.

use std::fs;
use std::io::{self, IsTerminal, Write};
use std::os::unix::fs::DirBuilderExt;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use afp_run::{RunError, say};

use super::robots_program::version;
use crate::commands::robot::connect::{no_ssh, unreachable};

const PROBE: &str = include_str!("probe.sh");
/// The commands of `sftp`, with the folder that [`RUN`] and [`AS_ROOT`] name.
const COPY: &str = "-mkdir afp-setup\nchmod 700 afp-setup\ncd afp-setup\nput *\n";
/// The commands on the robot that run the script. The copies are removed in any case.
const RUN: &str = "sh afp-setup/setup.sh; code=$?; rm -rf afp-setup; exit $code";
const AS_ROOT: &str = "sudo sh afp-setup/setup.sh; code=$?; rm -rf afp-setup; exit $code";

/// The computer of a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    pub architecture: String,
    /// The version of glibc; `None` for another C library.
    pub libc: Option<(u32, u32)>,
    pub has_systemd: bool,
    /// Whether the robot was set up before.
    pub has_afpc: bool,
    pub root: Root,
}

/// How the user of the connection becomes root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Root {
    /// It is root.
    Direct,
    /// By `sudo`, without a password.
    Sudo,
    /// By `sudo`, with a password.
    Password,
    Never,
}

/// A login that serves several commands, and the files to copy.
pub struct Session {
    host: String,
    /// A folder of only this user, with the socket of the connection.
    folder: PathBuf,
}

impl Session {
    /// # Errors
    /// No temporary folder can be created.
    pub fn new(host: &str) -> Result<Self, RunError> {
        let folder = std::env::temp_dir().join(format!("afp-setup-{}", std::process::id()));
        let made = fs::DirBuilder::new().mode(0o700).create(&folder);
        made.map_err(RunError::file("cannot create", &folder))?;
        let session = Session { host: host.to_owned(), folder };
        let files = session.files();
        fs::create_dir(&files).map_err(RunError::file("cannot create", &files))?;
        Ok(session)
    }

    fn files(&self) -> PathBuf {
        self.folder.join("files")
    }

    /// A client of OpenSSH that uses the connection of this session.
    fn client(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        let path = format!("ControlPath={}/s", self.folder.display());
        let options = ["ControlMaster=auto", &path, "ControlPersist=60"];
        command.args(options.iter().flat_map(|option| ["-o", option]));
        command
    }

    /// Asks the computer what it is.
    ///
    /// # Errors
    /// The host cannot be reached, or is not Linux.
    pub fn probe(&mut self) -> Result<Found, RunError> {
        let mut ssh = self.client("ssh");
        ssh.args(["-T", &self.host, "sh -s"]);
        let asked = fed(&mut ssh, PROBE).map_err(|why| no_ssh("ssh", &why))?;
        let said = String::from_utf8_lossy(&asked.stderr).trim().to_owned();
        if !said.is_empty() {
            say(&said);
        }
        match read(&String::from_utf8_lossy(&asked.stdout)) {
            Some(found) => Ok(found),
            None if asked.status.success() => Err(RunError::usage(
                format!("'{}' is not a computer with Linux", self.host),
                "name the robot's computer",
            )),
            None => Err(unreachable(&self.host, &said)),
        }
    }

    /// Adds a file to copy.
    ///
    /// # Errors
    /// The temporary folder cannot be written.
    pub fn add(&self, name: &str, bytes: &[u8]) -> Result<(), RunError> {
        let path = self.files().join(name);
        fs::write(&path, bytes).map_err(RunError::file("cannot write", &path))
    }

    /// Copies the files and runs the script.
    ///
    /// # Errors
    /// The copy or the script fails.
    pub fn run(&self, root: Root) -> Result<(), RunError> {
        let mut sftp = self.client("sftp");
        sftp.args(["-q", "-b", "-", &self.host]).current_dir(self.files());
        let copied = fed(&mut sftp, COPY).map_err(|why| no_ssh("sftp", &why))?;
        if !copied.status.success() {
            let said = String::from_utf8_lossy(&copied.stderr).trim().to_owned();
            let message = format!("the files cannot be copied to '{}': {said}", self.host);
            return Err(RunError::usage(message, "see the free disk of the robot: 'df -h'"));
        }
        let mut ssh = self.client("ssh");
        // A password is asked on the terminal.
        ssh.arg(if io::stdin().is_terminal() { "-t" } else { "-T" }).arg(&self.host);
        ssh.arg(if root == Root::Direct { RUN } else { AS_ROOT });
        // Results of the script are not results of this command.
        ssh.stdout(io::stderr());
        let status = ssh.status().map_err(|why| no_ssh("ssh", &why))?;
        if !status.success() {
            let message = format!("the script did not finish on '{}'", self.host);
            let help = "the lines above show the failed command; fix the cause and run this again";
            return Err(RunError::usage(message, help));
        }
        Ok(())
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let mut ssh = self.client("ssh");
        ssh.args(["-O", "exit", &self.host]).stderr(Stdio::null()).stdout(Stdio::null());
        ssh.status().ok();
        fs::remove_dir_all(&self.folder).ok();
    }
}

/// Runs a command with a text as its input.
fn fed(command: &mut Command, text: &str) -> io::Result<Output> {
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn()?;
    if let Some(mut input) = child.stdin.take() {
        // A command that ends early says why.
        input.write_all(text.as_bytes()).ok();
    }
    child.wait_with_output()
}

/// The answers of the probe; `None` if they are not those of Linux.
fn read(out: &str) -> Option<Found> {
    let answer = |key: &str| {
        let prefix = format!("afp: {key} ");
        Some(out.lines().find_map(|line| line.strip_prefix(&*prefix))?.trim().to_owned())
    };
    if answer("system")? != "Linux" {
        return None;
    }
    let architecture = match (&*answer("machine")?, answer("bits").as_deref()) {
        // A system of 32 bit may have a kernel of 64 bit.
        ("aarch64", Some("32")) | ("armv7l", _) => "arm".to_owned(),
        ("x86_64", Some("32")) => "i686".to_owned(),
        (machine, _) => machine.to_owned(),
    };
    let libc = answer("libc").unwrap_or_default();
    let root = match &*answer("root")? {
        "yes" => Root::Direct,
        "sudo" => Root::Sudo,
        "password" => Root::Password,
        _ => Root::Never,
    };
    Some(Found {
        architecture,
        libc: libc.strip_prefix("glibc ").and_then(|it| version(it.as_bytes())),
        has_systemd: answer("systemd").is_some(),
        has_afpc: answer("afpc").is_some(),
        root,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_read_between_other_lines() {
        let said = "Welcome\nafp: system Linux\nafp: machine aarch64\nafp: bits 32\n\
                    afp: libc glibc 2.36\nafp: systemd yes\nafp: root password\n";
        let found = Found {
            architecture: "arm".to_owned(),
            libc: Some((2, 36)),
            has_systemd: true,
            has_afpc: false,
            root: Root::Password,
        };
        assert_eq!(read(said), Some(found));
        assert_eq!(read("afp: system Darwin\nafp: machine arm64\nafp: root yes\n"), None);
        assert_eq!(read(""), None);
        let musl = "afp: system Linux\nafp: machine armv6l\nafp: libc \nafp: root no\n";
        let musl = read(musl).unwrap();
        assert_eq!((&*musl.architecture, musl.libc, musl.root), ("armv6l", None, Root::Never));
    }
}
