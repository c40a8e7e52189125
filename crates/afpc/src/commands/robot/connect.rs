//! The connection to a robot's agent, over the system's `ssh`.

use std::io::BufReader;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use afp_deploy::client::{ClientError, Connection};
use afp_run::RunError;

/// The prefix of a local command instead of a host.
const LOCAL: &str = "exec:";

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
        let mut command = command(host)?;
        let spawned = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let name = command.get_program().to_string_lossy().into_owned();
        let mut child = spawned.map_err(|why| RunError::Missing {
            message: format!("cannot start '{name}': {why}"),
            help: "install OpenSSH: 'sudo apt-get install openssh-client'".to_owned(),
        })?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(RunError::usage(format!("'{name}' has no pipes"), ""));
        };
        match Connection::new(BufReader::new(output), input) {
            Ok(connection) => Ok(Remote { host: host.to_owned(), connection, child }),
            Err(why) => {
                child.wait().ok();
                Err(error(host, why))
            }
        }
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

fn command(host: &str) -> Result<Command, RunError> {
    if let Some(local) = host.strip_prefix(LOCAL) {
        let mut words = local.split_whitespace();
        let Some(program) = words.next() else {
            return Err(RunError::usage(
                format!("'{host}' names no command"),
                "write 'exec:afpc agent'",
            ));
        };
        let mut command = Command::new(program);
        command.args(words);
        return Ok(command);
    }
    // A host must not become an option of ssh.
    if host.starts_with('-') || host.is_empty() || host.contains(char::is_whitespace) {
        return Err(RunError::usage(
            format!("'{host}' is not a host"),
            "write 'robot.local' or 'pi@robot.local'",
        ));
    }
    let mut command = Command::new("ssh");
    command.args(["-T", host, "afpc agent"]);
    Ok(command)
}

/// The error for people.
fn error(host: &str, why: ClientError) -> RunError {
    let message = why.to_string();
    match why {
        ClientError::Refused { help, .. } => {
            RunError::Usage { message, help: Some(help).filter(|help| !help.is_empty()) }
        }
        ClientError::NotAgent(said) if said.is_empty() => RunError::Missing {
            message: format!("'{host}' could not be reached, or has no 'afpc agent'"),
            help: format!("try 'ssh {host} afpc --version', and install afpc on the robot"),
        },
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
