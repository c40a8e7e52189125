//! A robot whose programs are a variable, and connections to its agent.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::thread;

use afp_deploy::agent::{Agent, Host, Service, Started};
use afp_deploy::client::{ClientError, Connection, Ran};
use afp_deploy::disk::{Disk, ThisDisk};
use afp_deploy::manifest::{Entry, Kind, Manifest};
use afp_deploy::sha256;
use afp_deploy::store::Store;
use afp_deploy::wire::{Calibration, Hello, State};

pub const DISK: ThisDisk = ThisDisk;

/// A robot with a folder.
pub struct Robot {
    pub root: PathBuf,
    pub hello: Hello,
    pub state: State,
    /// The release that runs.
    pub running: Option<String>,
    /// The release that does not start.
    pub broken: Option<String>,
    pub restarts: u32,
    /// Whether the service notices a switch by itself.
    pub eager: bool,
    /// Whether the service answers.
    pub serves: bool,
    /// The trace of every self-check.
    pub trace: Result<String, String>,
}

impl Robot {
    pub fn new(root: &Path) -> Robot {
        Robot {
            root: root.to_owned(),
            hello: Hello {
                version: "1".to_owned(),
                architecture: "aarch64".to_owned(),
                model: "carbot".to_owned(),
                space: Some(1 << 30),
                calibration: Calibration::Unneeded,
            },
            state: State::Stopped,
            running: None,
            broken: None,
            restarts: 0,
            eager: false,
            serves: true,
            trace: Ok("00ff".to_owned()),
        }
    }

    /// Starts what the folder names, as after a loss of power.
    pub fn boot(&mut self) {
        self.running = None;
        let store = Store::open(&self.root, &DISK).unwrap();
        if store.current().is_some() {
            self.restart().unwrap();
        }
    }
}

impl Host for Robot {
    fn hello(&self) -> Hello {
        self.hello.clone()
    }

    fn check(&mut self, files: &Path, manifest: &Manifest) -> Result<String, String> {
        assert!(files.join(&manifest.file).is_file());
        self.trace.clone()
    }

    fn service(&mut self) -> Result<Service, String> {
        let store = Store::open(&self.root, &DISK).map_err(|why| why.to_string())?;
        let current = store.current().map(|current| current.release);
        if self.eager && current != self.running {
            self.restart()?;
        }
        match self.serves {
            true => Ok(Service { state: self.state, release: self.running.clone(), trouble: None }),
            false => Err("it does not answer".to_owned()),
        }
    }

    fn restart(&mut self) -> Result<Started, String> {
        self.restarts += 1;
        let store = Store::open(&self.root, &DISK).map_err(|why| why.to_string())?;
        let current = store.current().ok_or("no release")?.release;
        let mut started = Started { release: current, instead: None };
        if self.broken.as_ref() == Some(&started.release) {
            let good = store.fall_back().map_err(|why| why.to_string())?.ok_or("none before")?;
            started = Started { release: good.release, instead: Some("it hangs".to_owned()) };
        }
        store.confirm().map_err(|why| why.to_string())?;
        self.running = Some(started.release.clone());
        self.state = State::Disarmed;
        Ok(started)
    }

    fn arm(&mut self, arm: bool) -> Result<(), String> {
        self.state = if arm { State::Armed } else { State::Disarmed };
        Ok(())
    }
}

/// A release and its contents.
#[derive(Clone)]
pub struct Release(pub Manifest, BTreeMap<String, Vec<u8>>);

impl Release {
    pub fn content<'a>(&'a self) -> impl Fn(&str) -> Option<&'a [u8]> + 'a {
        |sha256| self.1.get(sha256).map(Vec::as_slice)
    }
}

/// The `n`th release: a plan, a large file, and a file that all releases share.
pub fn release(n: usize) -> Release {
    let large = vec![n as u8; 40_000 + n];
    let files = [
        ("plan.afp", format!("plan Patrol{n} {{}}").into_bytes()),
        ("parts/large.afp", large),
        ("parts/deep/shared.afp", b"enum Side { left right }".to_vec()),
    ];
    let mut contents = BTreeMap::new();
    let files = files.map(|(path, content)| {
        let entry =
            Entry { path: path.to_owned(), size: content.len() as u64, sha256: sha256(&content) };
        contents.insert(entry.sha256.clone(), content);
        entry
    });
    let manifest = Manifest {
        plan: format!("Patrol{n}"),
        file: "plan.afp".to_owned(),
        kind: Kind::Interpreted,
        model: "carbot".to_owned(),
        robot: "sim".to_owned(),
        set: Vec::new(),
        calibration: None,
        trace: "00ff".to_owned(),
        files: files.into(),
    };
    Release(manifest, contents)
}

type Client = Connection<io::PipeReader, Box<dyn Write>>;

/// Serves a client of an agent over pipes.
pub fn session<T>(
    robot: &mut Robot,
    client: impl FnOnce(&mut Client) -> Result<T, ClientError> + Send,
) -> Result<T, ClientError>
where
    T: Send,
{
    over(robot, &DISK, |to| Box::new(to), client)
}

/// The same with another disk, and a pipe to the agent that may break.
pub fn over<T: Send>(
    robot: &mut Robot,
    disk: &dyn Disk,
    pipe: impl FnOnce(io::PipeWriter) -> Box<dyn Write> + Send,
    client: impl FnOnce(&mut Client) -> Result<T, ClientError> + Send,
) -> Result<T, ClientError> {
    let (mut from, to) = io::pipe().unwrap();
    let (answers, mut answer) = io::pipe().unwrap();
    thread::scope(|scope| {
        let asking = scope.spawn(move || client(&mut Connection::new(answers, pipe(to))?));
        let root = robot.root.clone();
        if let Ok(store) = Store::open(&root, disk) {
            // A connection that ends early is the matter of these tests.
            Agent::new(store, robot).serve(&mut from, &mut answer).ok();
        }
        drop((from, answer));
        asking.join().unwrap()
    })
}

pub fn deploy(robot: &mut Robot, release: &Release, first: bool) -> Result<Ran, ClientError> {
    session(robot, |agent| agent.deploy(&release.0, &release.content(), first, &mut |_| ()))
}

/// Whether the folder names a release that is complete.
pub fn is_sound(root: &Path) -> bool {
    let store = Store::open(root, &DISK).unwrap();
    store.current().is_some_and(|current| store.is_intact(&current.release))
}

/// A connection that is cut after some bytes.
pub struct Limited<W> {
    /// `None` after the cut.
    pub to: Option<W>,
    pub left: usize,
}

impl<W: Write> Write for Limited<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let bytes = &bytes[..bytes.len().min(self.left)];
        let Some(to) = self.to.as_mut().filter(|_| !bytes.is_empty()) else {
            self.to = None;
            return Err(io::ErrorKind::BrokenPipe.into());
        };
        let written = to.write(bytes)?;
        self.left -= written;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.as_mut().map_or(Ok(()), W::flush)
    }
}
