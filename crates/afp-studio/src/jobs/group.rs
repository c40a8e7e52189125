//! A process with everything that it starts, which is ended as one.
//!
//! A job runs cargo, which runs compilers: ended alone, it would leave them at work, and its output open.

use std::io;
use std::process::{Child, Command, ExitStatus};

/// A process, and those below it.
pub(super) struct Group {
    first: Child,
    /// Whether it was asked to end.
    asked: bool,
}

impl Group {
    /// Starts a process as the first one of a group.
    ///
    /// # Errors
    /// It cannot be started.
    pub fn start(command: &mut Command) -> io::Result<Group> {
        apart(command);
        Ok(Group { first: command.spawn()?, asked: false })
    }

    /// The process that was started.
    pub fn first(&mut self) -> &mut Child {
        &mut self.first
    }

    /// Asks all of them to end; whoever asks again ends them.
    pub fn end(&mut self) {
        if std::mem::replace(&mut self.asked, true) { self.kill() } else { ask(&mut self.first) }
    }

    pub fn kill(&mut self) {
        kill(&mut self.first);
    }

    /// Waits for the first one.
    ///
    /// # Errors
    /// Nobody knows how it ended.
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

/// The number of a group is that of its first process, and nobody else's before that was waited for.
#[cfg(unix)]
fn signal(first: &mut Child, signal: rustix::process::Signal) {
    // They may have ended by themselves.
    let _ = rustix::process::kill_process_group(rustix::process::Pid::from_child(first), signal);
}

#[cfg(not(unix))]
fn apart(_: &mut Command) {}

#[cfg(not(unix))]
fn ask(first: &mut Child) {
    kill(first);
}

/// Windows ends a process with those below it by a program of its own.
#[cfg(not(unix))]
fn kill(first: &mut Child) {
    let number = first.id().to_string();
    let mut taskkill = Command::new("taskkill");
    let done = taskkill.args(["/T", "/F", "/PID", &number]).output();
    if !done.is_ok_and(|done| done.status.success()) {
        // It may have ended by itself.
        let _ = first.kill();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::io::Read;
    use std::process::Stdio;

    use super::*;

    /// A shell with a process below it that has the same output and ignores being asked, where `deaf` says so.
    fn shell(deaf: &str) -> Group {
        let script = format!("{deaf} sleep 100 & echo begun; wait; wait");
        let mut command = Command::new("sh");
        Group::start(command.args(["-c", &script]).stdout(Stdio::piped())).unwrap()
    }

    /// Reads until all who have the output are gone.
    fn until_closed(group: &mut Group, end: impl Fn(&mut Group)) {
        let mut out = group.first().stdout.take().unwrap();
        let mut begun = [0; 6];
        out.read_exact(&mut begun).unwrap();
        end(group);
        out.read_to_end(&mut Vec::new()).unwrap();
        assert!(!group.wait().unwrap().success());
    }

    #[test]
    fn what_a_process_started_ends_with_it() {
        until_closed(&mut shell(""), Group::end);
        until_closed(&mut shell(""), Group::kill);
    }

    #[test]
    fn who_does_not_end_when_asked_is_ended_the_second_time() {
        until_closed(&mut shell("trap '' TERM;"), |group| {
            group.end();
            group.end();
        });
    }
}
