//! The connection to a robot's agent, over the system's `ssh`.

use std::io::{BufReader, Read, Write};
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, Stdio};
use std::thread::{self, JoinHandle};

use afp_deploy::client::{ClientError, Connection};
use afp_deploy::wire::Hello;
use afp_run::RunError;

/// The prefix of a local command instead of a host.
const LOCAL: &str = "exec:";
/// The most bytes of errors that are kept.
const LONGEST: usize = 4096;

/// An agent on another machine.
pub struct Remote {
    host: String,
    connection: Connection<BufReader<ChildStdout>, ChildStdin>,
    child: Child,
}

impl Remote {
    /// Starts the agent of a host.
    ///
    /// # Errors
    /// There is no `ssh`, or the host has no agent.
    pub fn connect(host: &str) -> Result<Self, RunError> {
        let mut command = command(host, "afpc agent")?;
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let spawned = piped.spawn();
        let name = command.get_program().to_string_lossy().into_owned();
        let mut child = spawned.map_err(|why| no_ssh(&name, &why))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(RunError::usage(format!("'{name}' has no pipes"), ""));
        };
        let errors = child.stderr.take().map(shown);
        match Connection::new(BufReader::new(output), input) {
            Ok(connection) => Ok(Remote { host: host.to_owned(), connection, child }),
            Err(ClientError::NotAgent(said)) if said.is_empty() => {
                child.wait().ok();
                let said = errors.and_then(|errors| errors.join().ok()).unwrap_or_default();
                Err(unreachable(host, &said))
            }
            Err(why) => {
                child.wait().ok();
                Err(error(host, why))
            }
        }
    }

    /// The robot.
    pub fn hello(&self) -> &Hello {
        &self.connection.hello
    }

    /// Sends a request.
    ///
    /// # Errors
    /// The robot refuses the request, or the connection fails.
    pub fn ask<T>(
        &mut self,
        request: impl FnOnce(
            &mut Connection<BufReader<ChildStdout>, ChildStdin>,
        ) -> Result<T, ClientError>,
    ) -> Result<T, RunError> {
        request(&mut self.connection).map_err(|why| error(&self.host, why))
    }
}

impl Drop for Remote {
    fn drop(&mut self) {
        // The agent ends with its input, and `ssh` with the agent; neither is waited for.
        self.child.try_wait().ok();
    }
}

/// The command that starts a program of the robot, or a local command instead.
///
/// # Errors
/// The host is not a host.
pub fn command(host: &str, program: &str) -> Result<Command, RunError> {
    if let Some(local) = host.strip_prefix(LOCAL) {
        let mut words = local.split_whitespace();
        let Some(first) = words.next() else {
            return Err(RunError::usage(
                format!("'{host}' names no command"),
                format!("write 'exec:{program}'"),
            ));
        };
        let mut command = Command::new(first);
        command.args(words);
        return Ok(command);
    }
    if !is_host(host) {
        return Err(RunError::usage(
            format!("'{host}' is not a host"),
            "write 'robot.local' or 'pi@robot.local'",
        ));
    }
    let mut command = Command::new("ssh");
    command.args(["-T", host, program]);
    Ok(command)
}

/// Whether a text is a host, and cannot become an option of ssh.
pub fn is_host(text: &str) -> bool {
    !(text.is_empty()
        || text.starts_with('-')
        || text.starts_with(LOCAL)
        || text.contains(char::is_whitespace))
}

/// The error for a client that cannot be started.
pub fn no_ssh(program: &str, why: &std::io::Error) -> RunError {
    RunError::Missing {
        message: format!("cannot start '{program}': {why}"),
        help: "install OpenSSH: 'sudo apt-get install openssh-client'".to_owned(),
    }
}

/// Prints the errors of a program at once, and keeps their beginning.
pub fn shown(mut errors: ChildStderr) -> JoinHandle<String> {
    thread::spawn(move || {
        let (mut all, mut part) = (Vec::new(), [0; 1024]);
        while let Ok(read @ 1..) = errors.read(&mut part) {
            let part = part.get(..read).unwrap_or_default();
            std::io::stderr().write_all(part).ok();
            if all.len() < LONGEST {
                all.extend(part);
            }
        }
        String::from_utf8_lossy(&all).into_owned()
    })
}

/// The error for a host without an answer, from the errors that `ssh` has printed.
pub fn unreachable(host: &str, said: &str) -> RunError {
    let name = host.rsplit_once('@').map_or(host, |(_, name)| name);
    let (message, help) = if said.contains("HOST IDENTIFICATION HAS CHANGED") {
        (
            format!("the key of '{host}' has changed: it may be another computer"),
            format!("if you have installed the robot again: 'ssh-keygen -R {name}'"),
        )
    } else if said.contains("Host key verification failed") {
        (
            format!("the key of '{host}' is unknown"),
            format!("log in once and compare the key: 'ssh {host}'"),
        )
    } else if said.contains("Permission denied") {
        (
            format!("'{host}' accepts neither your key nor your password"),
            format!("copy your key to the robot: 'ssh-copy-id {host}'"),
        )
    } else if said.contains("cannot use the folder of releases") {
        (
            format!("the user of '{host}' may not change what the robot runs"),
            format!("name the user of the robot's service: 'afp@{name}'"),
        )
    } else if said.contains("lets debuggers attach") {
        (
            format!("'{host}' has no run that lets debuggers attach"),
            format!("let its plan drive: 'afpc robot arm {host}'"),
        )
    } else if said.contains("Could not resolve hostname") {
        (
            format!("the network does not know the name '{name}'"),
            "check the name, or write the robot's address: 'afp@192.168.4.1'".to_owned(),
        )
    } else if said.contains("not found") {
        (format!("'{host}' has no afpc"), format!("install it: 'afpc robot setup {host}'"))
    } else {
        (
            format!("'{host}' could not be reached, or has no 'afpc agent'"),
            format!("try 'ssh {host} afpc --version'; 'afpc robot setup' installs afpc"),
        )
    };
    RunError::Missing { message, help }
}

/// The error for people.
fn error(host: &str, why: ClientError) -> RunError {
    let message = why.to_string();
    match why {
        ClientError::Refused { help, .. } => {
            RunError::Usage { message, help: Some(help).filter(|help| !help.is_empty()) }
        }
        ClientError::NotAgent(said) => RunError::Missing {
            message: format!("{message}; it printed: {said}"),
            help: "a login without a terminal must print nothing".to_owned(),
        },
        _ => RunError::Missing {
            message,
            help: format!("'afpc robot status {host}' shows which release the robot runs"),
        },
    }
}
