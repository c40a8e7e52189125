//! `afpc dap`: the debug adapter on standard input and output, or for clients that connect.

use std::fs;
use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use afp_debug::wire::{Frames, WireError, frame};
use afp_debug::{Adapter, Host, Launch, LogTarget, Program, SessionTarget, Target};
use afp_dsl::graph::Graph;
use afp_run::{EXIT_OK, RunError, say, world};
use clap::Args;

use crate::plan_file::{NoPlan, PlanFile};
use crate::{Linked, runner};

/// Arguments of `afpc dap`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The plan that will be debugged: needed where it has a robot or toolboxes of its project, so that they are
    /// built before an editor waits
    #[arg(value_name = "FILE[:PLAN]")]
    plan: Option<String>,
    /// Waits for an editor on this port of the machine itself, 0 for a free one, instead of standard input
    #[arg(long, value_name = "PORT")]
    port: Option<u16>,
}

/// What the help ends with.
pub const EXAMPLES: &str = "\
Examples:
  afpc dap                         an editor starts this and talks on standard input and output
  afpc dap --port 4711             waits for editors; 'launch' needs the token that is printed

'launch' takes: program, world, seed, set (values by name), until (seconds), speed (a factor), stopOnEntry; or
log, the log of a run that is over";

/// Serves clients; gives the exit code.
///
/// # Errors
/// The plan is wrong, the port is taken, what comes on standard input is not the protocol.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    if let Some(plan) = &arguments.plan {
        let file = PlanFile::read(plan)?;
        runner::become_one_for(file.compiled.graph.iter().map(|graph| (&file.own, graph)), linked)?;
    }
    match arguments.port {
        None => {
            let adapter = Adapter::new(Box::new(Simulator { linked: *linked }));
            let served = serve(adapter, std::io::stdin(), std::io::stdout());
            let failed =
                RunError::file("cannot talk to the editor over", "standard input".as_ref());
            served.map_err(|why| failed(std::io::Error::other(why)))?;
        }
        Some(port) => listen(port, linked)?,
    }
    Ok(EXIT_OK)
}

/// Serves one client after the other.
fn listen(port: u16, linked: &Linked<'_>) -> Result<(), RunError> {
    let wanted = format!("127.0.0.1:{port}");
    let failed = RunError::file("cannot listen on", wanted.as_ref());
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
    let token = token().map_err(RunError::file("cannot make", "a token".as_ref()))?;
    let port = listener.local_addr().map_or(port, |address| address.port());
    say(format!("listening on 127.0.0.1:{port}, token {token}\n"));
    for stream in listener.incoming() {
        let Ok(stream) = stream else { continue };
        let Ok(back) = stream.try_clone() else { continue };
        let _ = stream.set_nodelay(true);
        let adapter = Adapter::guarded(Box::new(Simulator { linked: *linked }), &token);
        if let Err(why) = serve(adapter, stream, back) {
            say(format!("warning: a client was sent away: {why}\n"));
        }
    }
    Ok(())
}

/// A word that nobody guesses.
fn token() -> std::io::Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|why| std::io::Error::other(why.to_string()))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Talks with a client until it says goodbye or goes away; then the robot has stopped.
///
/// # Errors
/// What arrives are no messages.
fn serve(
    mut adapter: Adapter<'_>,
    from: impl Read + Send + 'static,
    mut to: impl Write,
) -> Result<(), WireError> {
    let (sender, arrived) = channel();
    // It ends with the stream, or with the program.
    thread::spawn(move || read(from, &sender));
    let (begin, mut frames) = (Instant::now(), Frames::default());
    while !adapter.is_over() {
        let out = match wait(&arrived, adapter.due()) {
            Arrived::Bytes(bytes) => {
                frames.push(&bytes);
                answers(&mut adapter, &mut frames, begin)?
            }
            Arrived::Nothing => adapter.tick(begin.elapsed()),
            Arrived::End => return frames.finish(),
        };
        let bytes: Vec<u8> = out.iter().flat_map(|message| frame(message)).collect();
        if to.write_all(&bytes).and_then(|()| to.flush()).is_err() {
            return Ok(());
        }
    }
    Ok(())
}

enum Arrived {
    Bytes(Vec<u8>),
    Nothing,
    End,
}

/// Waits for the client, at most as long as the run can wait.
fn wait(arrived: &Receiver<Vec<u8>>, due: Option<Duration>) -> Arrived {
    let bytes = match due {
        None => arrived.recv().map_err(|_| RecvTimeoutError::Disconnected),
        Some(due) => arrived.recv_timeout(due),
    };
    match bytes {
        Ok(bytes) => Arrived::Bytes(bytes),
        Err(RecvTimeoutError::Timeout) => Arrived::Nothing,
        Err(RecvTimeoutError::Disconnected) => Arrived::End,
    }
}

/// Answers all messages that are there.
///
/// # Errors
/// What arrived are no messages.
fn answers(
    adapter: &mut Adapter<'_>,
    frames: &mut Frames,
    begin: Instant,
) -> Result<Vec<String>, WireError> {
    let mut out = Vec::new();
    while let Some(message) = frames.next_message()? {
        out.extend(adapter.handle(&message, begin.elapsed()));
    }
    Ok(out)
}

fn read(mut from: impl Read, to: &Sender<Vec<u8>>) {
    let mut buffer = [0; 1 << 14];
    loop {
        match from.read(&mut buffer) {
            Ok(0) => return,
            Ok(length) if to.send(buffer[..length].to_vec()).is_err() => return,
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return,
        }
    }
}

/// Runs plans of files on the robot that is linked in, simulated.
struct Simulator<'a> {
    linked: Linked<'a>,
}

impl<'a> Host<'a> for Simulator<'a> {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target + 'a>, String> {
        if let Some(log) = &launch.log {
            return Ok(Box::new(recorded(Path::new(log))?));
        }
        let file = PlanFile::read(&launch.program).map_err(|why| why.to_string())?;
        let shown = file.compiled.render(false);
        let graph = file.compiled.graph.clone().ok_or(shown)?;
        let linked = runner::is_linked(&file.own, &graph, &self.linked);
        if !linked.map_err(|why| why.to_string())? {
            let program = &launch.program;
            return Err(format!(
                "'{program}' needs a robot or toolboxes of its project: start 'afpc dap {program}', which builds them"
            ));
        }
        let robot = self.linked.robot;
        let asked = launch.world.as_deref().map(Path::new);
        let found = world::find(asked, &file.path, robot.kind()).map_err(|why| why.to_string())?;
        let program = program(&graph, &file);
        let launch = launch.clone();
        let make = move || {
            let session = robot.session(&graph, &*found.world, launch.seed, &[]);
            let mut session = session.map_err(|why| format!("{why}: {}", why.help()))?;
            for (name, text) in &launch.set {
                session.set(name, text).map_err(|why| format!("'{name}': {why}"))?;
            }
            Ok(session)
        };
        Ok(Box::new(SessionTarget::new(Arc::new(program), Box::new(make))?))
    }

    fn path(&self, path: &str) -> String {
        absolute(path)
    }
}

/// A run that is over.
fn recorded(path: &Path) -> Result<LogTarget, String> {
    let log = afp_log::read(path).map_err(|why| why.to_string())?;
    let file = PlanFile::of_log(&log).map_err(|why| why.to_string())?;
    let shown = file.compiled.render(false);
    let graph = file.compiled.graph.clone().ok_or(shown)?;
    LogTarget::new(Arc::new(program(&graph, &file)), log.events)
}

/// A plan with its places; texts that are not those of files go along.
fn program(graph: &Graph, file: &PlanFile) -> Program {
    let mut program = Program::new(graph, &file.compiled.sources, &absolute);
    program.keep_texts(&file.compiled.sources, &|path, text| {
        fs::read_to_string(path).is_ok_and(|known| known == text)
    });
    program
}

/// A path from the root, without links, where the file is there.
fn absolute(path: &str) -> String {
    let path = path.strip_prefix("file://").unwrap_or(path);
    fs::canonicalize(path).map_or_else(|_| path.to_owned(), |path| path.display().to_string())
}
