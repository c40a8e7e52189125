//! A process group that is ended as a whole.
//!
//! A job runs cargo, which runs compilers. If only the job ended, the compilers would continue and
//! keep its output open.

use std::io;
use std::process::{Child, Command, ExitStatus};

/// A process and its descendants.
pub(super) struct Group {
    first: Child,
    /// Whether it was asked to end.
    asked: bool,
}

impl Group {
    /// Starts a process as the leader of a new group.
    ///
    /// # Errors
    /// It cannot be started.
    pub fn start(command: &mut Command) -> io::Result<Group> {
        apart(command);
        Ok(Group { first: command.spawn()?, asked: false })
    }

    pub fn first(&mut self) -> &mut Child {
        &mut self.first
    }

    /// Asks the group to end; the second call kills it.
    pub fn end(&mut self) {
        if std::mem::replace(&mut self.asked, true) { self.kill() } else { ask(&mut self.first) }
    }

    pub fn kill(&mut self) {
        kill(&mut self.first);
    }

    /// Waits for the leader.
    ///
    /// # Errors
    /// The result is unknown.
    pub fn wait(&mut self) -> io::Result<ExitStatus> {
        self.first.wait()
    }
}

#[cfg(unix)]
fn apart(command: &mut Command) {
    std::os::unix::process::CommandExt::process_group(command, 0);
}

#[cfg(unix)]
fn ask(first: &mut Child) {
    signal(first, rustix::process::Signal::TERM);
}

#[cfg(unix)]
fn kill(first: &mut Child) {
    signal(first, rustix::process::Signal::KILL);
}

/// A group has the id of its leader, which is not reused before the wait.
#[cfg(unix)]
fn signal(first: &mut Child, signal: rustix::process::Signal) {
    // The processes may have ended already.
    let _ = rustix::process::kill_process_group(rustix::process::Pid::from_child(first), signal);
}

#[cfg(not(unix))]
fn apart(_: &mut Command) {}

#[cfg(not(unix))]
fn ask(first: &mut Child) {
    kill(first);
}

/// On Windows a separate program ends a process tree.
#[cfg(not(unix))]
fn kill(first: &mut Child) {
    let number = first.id().to_string();
    let mut taskkill = Command::new("taskkill");
    let done = taskkill.args(["/T", "/F", "/PID", &number]).output();
    if !done.is_ok_and(|done| done.status.success()) {
        // It may have ended already.
        let _ = first.kill();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::io::Read;
    use std::process::Stdio;

    use super::*;

    /// A shell with a child that shares its output, and ignores the request to end if `deaf` is
    /// set.
    fn shell(deaf: &str) -> Group {
        let script = format!("{deaf} sleep 100 & echo begun; wait; wait");
        let mut command = Command::new("sh");
        Group::start(command.args(["-c", &script]).stdout(Stdio::piped())).unwrap()
    }

    /// Reads until all holders of the output have ended.
    fn until_closed(group: &mut Group, end: impl Fn(&mut Group)) {
        let mut out = group.first().stdout.take().unwrap();
        let mut begun = [0; 6];
        out.read_exact(&mut begun).unwrap();
        end(group);
        out.read_to_end(&mut Vec::new()).unwrap();
        assert!(!group.wait().unwrap().success());
    }

    #[test]
    fn children_of_a_process_end_with_it() {
        until_closed(&mut shell(""), Group::end);
        until_closed(&mut shell(""), Group::kill);
    }

    #[test]
    fn a_second_request_kills_a_process() {
        until_closed(&mut shell("trap '' TERM;"), |group| {
            group.end();
            group.end();
        });
    }
}
