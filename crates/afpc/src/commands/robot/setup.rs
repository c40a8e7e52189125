//! `afpc robot setup`: prepares the computer of a robot, with a fixed script that is printed first.
//!
//! One connection of the system's `ssh` serves all steps, so that a password is asked once. Files
//! are copied by `sftp`. No text of the user becomes a part of a command on the robot.

mod robots_program;
mod session;

use std::io::{self, BufRead, IsTerminal};
use std::path::{Path, PathBuf};

use afp_deploy::wire::State;
use afp_project::ProjectFile;
use afp_run::{EXIT_OK, RunError, say, warn};
use afp_session::Build;
use clap::Args;

use super::connect::{Remote, is_host};
use crate::commands::print;
use crate::no_plan::NoPlan;
use robots_program::Needs;
pub use robots_program::architecture;
use session::{Found, Root, Session};

/// Arguments of `afpc robot setup`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Host of ssh, with a user that may use sudo
    host: String,
    /// Program for the robot [default: this one]
    #[arg(long, value_name = "PROGRAM")]
    afpc: Option<PathBuf>,
    /// Create a WLAN with this name at the next boot; its password is asked
    #[arg(long, value_name = "NAME")]
    access_point: Option<String>,
    /// Run the script without a question
    #[arg(long)]
    yes: bool,
}

const SCRIPT: &str = include_str!("setup/setup.sh");
const RULES: &str = include_str!("setup/99-afp.rules");
/// The user that runs plans.
const USER: &str = "afp";

/// Sets up a robot, or upgrades it.
///
/// # Errors
/// The robot cannot be reached or used, a step fails, or nobody agrees.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let host = &arguments.host;
    if !is_host(host) {
        let help = "write 'pi@robot.local', with a user that may use sudo";
        return Err(RunError::usage(format!("'{host}' is not a host"), help).into());
    }
    let access_point = arguments.access_point.as_deref().map(access_point).transpose()?;
    let project = ProjectFile::find(Path::new("."))?;
    let mut session = Session::new(host)?;
    let found = session.probe()?;
    let program = match &arguments.afpc {
        Some(program) => program.clone(),
        None => std::env::current_exe().map_err(RunError::file("cannot find", "afpc".as_ref()))?,
    };
    let bytes = std::fs::read(&program).map_err(RunError::file("cannot read", &program))?;
    fits(&Needs::of(&bytes), &found)?;
    allows(host, &found)?;
    let user = as_user(host);
    if found.has_afpc {
        rests(&user)?;
    }
    agree(arguments)?;
    session.add("afpc", &bytes)?;
    session.add("setup.sh", SCRIPT.as_bytes())?;
    session.add("99-afp.rules", RULES.as_bytes())?;
    if let Some(access_point) = access_point {
        session.add("access-point", access_point.as_bytes())?;
    }
    if project.exists {
        for name in ["afp.toml", "calibration.toml"] {
            if let Ok(text) = std::fs::read(project.folder.join(name)) {
                session.add(name, &text)?;
            }
        }
    }
    session.run(found.root)?;
    drop(session);
    shake_hands(&user)?;
    Ok(EXIT_OK)
}

/// Refuses a program for another computer.
fn fits(needs: &Needs, found: &Found) -> Result<(), RunError> {
    let refused = |message: String, help: &str| Err(RunError::usage(message, help));
    let theirs = &*found.architecture;
    if needs.architecture != theirs {
        let message =
            format!("the robot has {theirs}, and this afpc is for {}", needs.architecture);
        return refused(message, ANOTHER);
    }
    match (needs.libc, found.libc) {
        (Some(needed), Some(libc)) if needed <= libc => Ok(()),
        (None, _) => Ok(()),
        (Some((major, minor)), None) => refused(
            format!("this afpc needs glibc {major}.{minor}, and the robot has another C library"),
            "use a system with glibc on the robot, such as Raspberry Pi OS or Debian",
        ),
        (Some(needed), Some(libc)) => {
            let text = |(major, minor)| format!("{major}.{minor}");
            refused(
                format!("this afpc needs glibc {}, and the robot has {}", text(needed), text(libc)),
                "upgrade the robot's system, or name the afpc of a wheel with '--afpc'",
            )
        }
    }
}

/// The way to a program for another processor.
const ANOTHER: &str = "name one with '--afpc PROGRAM': the wheel for the robot's processor contains \
                       it, or 'cargo build -p afpc --features pi --target TRIPLE' builds it";

/// Refuses a computer on which the script cannot work.
fn allows(host: &str, found: &Found) -> Result<(), RunError> {
    if !found.has_systemd {
        let help = "'afpc agent --serve' is the service; start it in the way of that system";
        return Err(RunError::usage(format!("'{host}' does not run systemd"), help));
    }
    match found.root {
        Root::Direct | Root::Sudo => Ok(()),
        Root::Password if io::stdin().is_terminal() => Ok(()),
        Root::Password => Err(RunError::usage(
            format!("'sudo' on '{host}' asks for a password, and there is no terminal"),
            "run this command in a terminal",
        )),
        Root::Never => Err(RunError::usage(
            format!("the user of '{host}' cannot become root: there is no 'sudo'"),
            "name a user that can, such as 'root@robot.local'",
        )),
    }
}

/// The host with the user that runs plans.
fn as_user(host: &str) -> String {
    let name = host.rsplit_once('@').map_or(host, |(_, name)| name);
    format!("{USER}@{name}")
}

/// Refuses an upgrade of a robot that may be moving.
fn rests(user: &str) -> Result<(), RunError> {
    // A robot whose agent does not answer has no plan that could be armed from here.
    let Ok(mut remote) = Remote::connect(user) else { return Ok(()) };
    let status = remote.ask(|robot| robot.status())?;
    match status.state {
        State::Armed => Err(RunError::usage(
            "the robot is armed and may be moving",
            format!("stop it first: 'afpc robot stop {user}'"),
        )),
        State::Disarmed | State::Stopped => Ok(()),
    }
}

/// Shows the script and waits for a person's yes.
fn agree(arguments: &Arguments) -> Result<(), NoPlan> {
    let host = &arguments.host;
    print(SCRIPT)?;
    if arguments.yes {
        return Ok(());
    }
    if !io::stdin().is_terminal() {
        let help = "read it, and add '--yes'";
        let message = format!("there is no terminal to agree to this script for '{host}'");
        return Err(RunError::usage(message, help).into());
    }
    say(format_args!("run this script as root on '{host}'? [y/N]"));
    match line()?.trim() {
        "y" | "Y" | "yes" => Ok(()),
        _ => Err(RunError::usage("the script was not run", "answer 'y' to run it").into()),
    }
}

/// The name of an access point and its password, as two lines.
fn access_point(name: &str) -> Result<String, RunError> {
    let is_plain = |text: &str| !text.chars().any(char::is_control) && text.trim() == text;
    if !(1..=32).contains(&name.len()) || !is_plain(name) {
        let message = format!("'{name}' cannot be the name of an access point");
        return Err(RunError::usage(message, "write 1 to 32 letters"));
    }
    say(format_args!("password of the access point '{name}':"));
    let password = line()?;
    let password = password.trim_end_matches(['\r', '\n']);
    let is_printable = password.bytes().all(|byte| (b' '..=b'~').contains(&byte));
    if !(8..=63).contains(&password.len()) || !is_printable || !is_plain(password) {
        let message = "this cannot be the password of an access point";
        return Err(RunError::usage(message, "write 8 to 63 letters and digits"));
    }
    Ok(format!("{name}\n{password}\n"))
}

fn line() -> Result<String, RunError> {
    let mut line = String::new();
    let read = io::stdin().lock().read_line(&mut line);
    read.map_err(RunError::file("cannot read", "standard input".as_ref()))?;
    Ok(line)
}

/// Connects as `afpc deploy` does, and compares the versions.
fn shake_hands(user: &str) -> Result<(), NoPlan> {
    let remote = Remote::connect(user)?;
    let (theirs, ours) = (&remote.hello().version, Build::this().to_string());
    if *theirs != ours {
        warn(&format!(
            "the robot has afpc {theirs}, and this is {ours}: it refuses plans from here"
        ));
    }
    print(&format!("ready: {user} has afpc {theirs}\n"))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_user_of_a_host_is_replaced() {
        assert_eq!(as_user("pi@robot.local"), "afp@robot.local");
        assert_eq!(as_user("robot"), "afp@robot");
    }
}
