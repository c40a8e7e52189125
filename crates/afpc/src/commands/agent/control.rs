//! The socket between an agent and the service.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::time::Duration;

use afp_deploy::agent::{Service, Started};
use serde::{Deserialize, Serialize};

/// The longest message, in bytes.
const LONGEST: u64 = 1 << 16;

/// A request to the service.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Order {
    State,
    Restart,
    Arm(bool),
}

/// The service's answer.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Reply {
    State(Service),
    Started(Started),
    Done,
    Failed(String),
}

pub(super) fn socket(root: &Path) -> PathBuf {
    root.join("control")
}

/// Sends an order to the service and waits for its reply, at most this long.
///
/// # Errors
/// The service does not run, or does not reply.
pub(super) fn ask(root: &Path, order: Order, patience: Duration) -> Result<Reply, String> {
    let asked = || -> io::Result<Reply> {
        let mut stream = UnixStream::connect(socket(root))?;
        stream.set_read_timeout(Some(patience))?;
        write(&mut stream, &order)?;
        read(&stream)
    };
    match asked() {
        Ok(Reply::Failed(why)) => Err(why),
        Ok(reply) => Ok(reply),
        Err(why) if why.kind() == io::ErrorKind::PermissionDenied => {
            Err("this user may not use the service: log in as 'afp'".to_owned())
        }
        Err(why) => Err(format!("the service 'afp' does not answer ({why})")),
    }
}

/// Reads a message, which is a line of JSON.
///
/// # Errors
/// There is no message, or it is too long or unknown.
pub(super) fn read<M: for<'a> Deserialize<'a>>(from: impl Read) -> io::Result<M> {
    let mut line = String::new();
    BufReader::new(from.take(LONGEST)).read_line(&mut line)?;
    Ok(serde_json::from_str(&line)?)
}

/// Writes a message.
///
/// # Errors
/// The other side is gone.
pub(super) fn write(to: &mut impl Write, message: &impl Serialize) -> io::Result<()> {
    let mut line = serde_json::to_vec(message)?;
    line.push(b'\n');
    to.write_all(&line)
}
