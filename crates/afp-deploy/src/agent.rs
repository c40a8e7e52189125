//! The robot's side of a connection.
//!
//! The agent ends with its connection. The program that runs the plan is another one, so a broken
//! connection stops nothing.

mod fits;

use std::fs::{File, TryLockError};
use std::io::{Read, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::manifest::{Entry, Manifest};
use crate::store::{Incoming, Store, StoreError};
use crate::wire::{
    Answer, GREETING, Hello, LONGEST_PART, Named, Packet, Request, State, Status, Step, WireError,
    receive, send, send_content,
};

/// Free bytes that a deploy leaves on the disk, for logs.
const SPARE: u64 = 8 << 20;

/// The parts of a robot beyond its folder of releases.
pub trait Host {
    fn hello(&self) -> Hello;

    /// Simulates the start of a release, whose files are in a folder. Returns the trace's hash.
    ///
    /// # Errors
    /// The reason why the release does not run on this robot.
    fn check(&mut self, files: &Path, manifest: &Manifest) -> Result<String, String>;

    /// The state of the program that runs releases.
    ///
    /// # Errors
    /// The reason why there is no such program.
    fn service(&mut self) -> Result<Service, String>;

    /// Stops the plan, starts the current release, and waits until it is ready. If it fails, the
    /// last confirmed release is started.
    ///
    /// # Errors
    /// The reason why no release runs.
    fn restart(&mut self) -> Result<Started, String>;

    /// Lets the plan drive, or stops it.
    ///
    /// # Errors
    /// The reason why not.
    fn arm(&mut self, arm: bool) -> Result<(), String>;
}

/// The state of the program that runs releases.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Service {
    pub state: State,
    /// The release that runs.
    pub release: Option<String>,
    /// A sentence about the last failure.
    pub trouble: Option<String>,
}

/// A release that was started.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Started {
    pub release: String,
    /// Why this is not the requested release.
    pub instead: Option<String>,
}

/// A request that is not carried out.
struct Refusal {
    message: String,
    help: String,
}

fn refusal(message: impl Into<String>, help: impl Into<String>) -> Refusal {
    Refusal { message: message.into(), help: help.into() }
}

impl From<StoreError> for Refusal {
    fn from(why: StoreError) -> Self {
        let help = "check the robot's disk: 'df' shows its space, 'dmesg' its errors";
        refusal(format!("the robot cannot store the release: {why}"), help)
    }
}

/// A deploy whose files arrive.
struct Deploy {
    manifest: Manifest,
    stop_first: bool,
    missing: Vec<String>,
    _lock: File,
}

/// The agent of one connection.
pub struct Agent<'a> {
    store: Store<'a>,
    host: &'a mut dyn Host,
    deploy: Option<Deploy>,
}

/// Whether the connection continues after a request.
type Served = Result<bool, WireError>;

impl<'a> Agent<'a> {
    pub fn new(store: Store<'a>, host: &'a mut dyn Host) -> Self {
        Agent { store, host, deploy: None }
    }

    /// Serves requests until the other side ends the connection.
    ///
    /// # Errors
    /// The other side does not follow the protocol, or the streams fail.
    pub fn serve(mut self, from: &mut dyn Read, to: &mut dyn Write) -> Result<(), WireError> {
        to.write_all(GREETING)?;
        send(to, &Answer::Hello(self.host.hello()))?;
        loop {
            match receive(from) {
                Ok(Packet::Message(request)) => {
                    if !self.answer(request, from, to)? {
                        return Ok(());
                    }
                }
                Ok(Packet::Part(_)) => return Err(WireError::Kind),
                Err(WireError::Ended) => return Ok(()),
                Err(why) => return Err(why),
            }
        }
    }

    fn answer(&mut self, request: Request, from: &mut dyn Read, to: &mut dyn Write) -> Served {
        let answered = match request {
            Request::Status => Ok(Answer::Status(self.status())),
            Request::Deploy { manifest, stop_first } => self.begin(manifest, stop_first),
            Request::Content { sha256 } => match self.content(&sha256, from)? {
                Ok(()) => return Ok(true),
                Err(refused) => {
                    // The other side is still sending: it reads this when its next write fails.
                    answer_refused(to, refused)?;
                    return Ok(false);
                }
            },
            Request::Commit => self.commit(to)?,
            Request::Rollback { stop_first } => self.rollback(stop_first, to)?,
            Request::Arm(arm) => {
                let armed = self.host.arm(arm);
                armed.map(|()| Answer::Done).map_err(|why| refusal(why, ""))
            }
            Request::Logs => Ok(Answer::Logs(self.logs())),
            Request::Log { name, from } => match self.log(&name, from, to)? {
                Ok(()) => return Ok(true),
                Err(refused) => Err(refused),
            },
        };
        match answered {
            Ok(answer) => send(to, &answer)?,
            Err(refused) => answer_refused(to, refused)?,
        }
        Ok(true)
    }

    fn status(&mut self) -> Status {
        let (service, absent) = match self.host.service() {
            Ok(service) => (service, None),
            Err(why) => (Service::default(), Some(why)),
        };
        let releases: Vec<_> =
            self.store.releases().into_iter().filter_map(|it| self.named(&it.release)).collect();
        Status {
            state: service.state,
            running: service.release.and_then(|release| self.named(&release)),
            current: releases.first().cloned(),
            releases,
            trouble: service.trouble.or(absent),
        }
    }

    fn named(&self, release: &str) -> Option<Named> {
        let plan = self.store.manifest(release).ok()?.plan;
        Some(Named { release: release.to_owned(), plan })
    }

    /// Checks everything that can be checked before a byte is written.
    fn begin(&mut self, manifest: Manifest, stop_first: bool) -> Result<Answer, Refusal> {
        self.deploy = None;
        manifest.check().map_err(|why| refusal(format!("the release is invalid: {why}"), ""))?;
        fits::fits(&self.host.hello(), &manifest)?;
        self.may_stop(stop_first)?;
        let lock = self.lock()?;
        let missing = self.store.missing(&manifest);
        let is_missing = |entry: &&Entry| missing.contains(&entry.sha256);
        let needed: u64 = manifest.files.iter().filter(is_missing).map(|entry| entry.size).sum();
        if let Some(space) = self.host.hello().space.filter(|space| *space < needed + SPARE) {
            let message = format!(
                "the robot has {} KiB of free disk, and the release needs {} KiB",
                space >> 10,
                (needed + SPARE) >> 10
            );
            return Err(refusal(message, "remove logs from the robot"));
        }
        let answer = Answer::Missing(missing.clone());
        self.deploy = Some(Deploy { manifest, stop_first, missing, _lock: lock });
        Ok(answer)
    }

    /// Refuses to stop a plan that drives, unless that is permitted.
    fn may_stop(&mut self, stop_first: bool) -> Result<(), Refusal> {
        let service = self.host.service().map_err(|why| {
            let help = "start it: 'sudo systemctl start afp', or 'afpc agent --serve'";
            refusal(format!("no plan can start on the robot: {why}"), help)
        })?;
        match service.state {
            State::Armed if !stop_first => {
                let message = "the robot is armed and may be moving";
                Err(refusal(message, "stop it first, or add '--stop-first'"))
            }
            _ => Ok(()),
        }
    }

    /// Refuses a second deploy at the same time. The lock ends with the agent.
    fn lock(&self) -> Result<File, Refusal> {
        let path = self.store.root().join("deploy.lock");
        let failed = |why: String| refusal(format!("cannot lock '{}': {why}", path.display()), "");
        let file = File::create(&path).map_err(|why| failed(why.to_string()))?;
        match file.try_lock() {
            Ok(()) => Ok(file),
            Err(TryLockError::WouldBlock) => {
                let message = "another deploy to this robot is running";
                Err(refusal(message, "try again when it has finished"))
            }
            Err(TryLockError::Error(why)) => Err(failed(why.to_string())),
        }
    }

    /// Receives the content of a file.
    fn content(
        &mut self,
        sha256: &str,
        from: &mut dyn Read,
    ) -> Result<Result<(), Refusal>, WireError> {
        let Some(deploy) = &mut self.deploy else { return Err(WireError::Kind) };
        let Some(at) = deploy.missing.iter().position(|missing| missing == sha256) else {
            return Err(WireError::Kind);
        };
        let entry = deploy.manifest.files.iter().find(|entry| entry.sha256 == sha256);
        let Some(entry) = entry else { return Err(WireError::Kind) };
        let mut incoming = match self.store.begin(entry) {
            Ok(incoming) => incoming,
            Err(why) => return Ok(Err(why.into())),
        };
        let mut left = entry.size;
        while left > 0 {
            left = match receive_part(&self.store, &mut incoming, from)? {
                Ok(left) => left,
                Err(why) => return Ok(Err(why.into())),
            };
        }
        deploy.missing.swap_remove(at);
        Ok(self.store.keep(incoming).map_err(Refusal::from))
    }

    fn commit(&mut self, to: &mut dyn Write) -> Result<Result<Answer, Refusal>, WireError> {
        let Some(deploy) = self.deploy.take().filter(|deploy| deploy.missing.is_empty()) else {
            return Err(WireError::Kind);
        };
        send(to, &Answer::Step(Step::Check))?;
        if let Err(refused) = self.checked(&deploy.manifest) {
            return Ok(Err(refused));
        }
        send(to, &Answer::Step(Step::Switch))?;
        if let Err(refused) = self.switched(&deploy) {
            return Ok(Err(refused));
        }
        self.start(&deploy.manifest.id(), to)
    }

    /// Checks the release with the robot's own project file.
    fn checked(&mut self, manifest: &Manifest) -> Result<(), Refusal> {
        let files = self.store.stage(manifest)?;
        let trace = self.host.check(&files, manifest).map_err(|why| {
            refusal(format!("the plan does not run on the robot: {why}"), "the old release stays")
        })?;
        match trace == manifest.trace {
            true => Ok(()),
            false => {
                let message = format!(
                    "the first second on the robot has the trace {trace}, and here {}",
                    manifest.trace
                );
                Err(refusal(message, "give both the same 'afp.toml' and build of afp"))
            }
        }
    }

    fn switched(&mut self, deploy: &Deploy) -> Result<(), Refusal> {
        self.may_stop(deploy.stop_first)?;
        let current = self.store.current();
        if current.is_none_or(|current| current.release != deploy.manifest.id()) {
            self.store.publish(&deploy.manifest)?;
        }
        Ok(())
    }

    fn rollback(
        &mut self,
        stop_first: bool,
        to: &mut dyn Write,
    ) -> Result<Result<Answer, Refusal>, WireError> {
        let switched = self.may_stop(stop_first).and_then(|()| self.lock()).and_then(|lock| {
            let none = || refusal("the robot has no release before this one", "deploy a plan");
            let before = self.store.before().ok_or_else(none)?;
            self.store.switch(&before.release)?;
            Ok((lock, before.release))
        });
        match switched {
            Ok((_lock, requested)) => self.start(&requested, to),
            Err(refused) => Ok(Err(refused)),
        }
    }

    /// Starts the current release, unless it runs already.
    fn start(
        &mut self,
        requested: &str,
        to: &mut dyn Write,
    ) -> Result<Result<Answer, Refusal>, WireError> {
        let running = self.host.service().ok().and_then(|service| service.release);
        let current = self.store.current();
        let started = match current.filter(|current| running.as_ref() == Some(&current.release)) {
            Some(current) => Started { release: current.release, instead: None },
            None => {
                send(to, &Answer::Step(Step::Start))?;
                match self.host.restart() {
                    Ok(started) => started,
                    Err(why) => {
                        let message =
                            format!("the release is on the robot, but does not run: {why}");
                        let help = "'afpc robot status' shows the state of the robot";
                        return Ok(Err(refusal(message, help)));
                    }
                }
            }
        };
        // Too many releases are no reason to call a deploy a failure.
        self.store.prune().ok();
        let plan = self.named(&started.release).map(|named| named.plan).unwrap_or_default();
        let Started { release, mut instead } = started;
        if release != requested && instead.is_none() {
            // The service had noticed the switch by itself.
            let trouble = self.host.service().ok().and_then(|service| service.trouble);
            instead = trouble.or_else(|| Some(format!("release {requested} did not start")));
        }
        Ok(Ok(Answer::Runs { release, plan, instead }))
    }

    fn logs(&self) -> Vec<(String, u64)> {
        let folder = self.store.root().join("logs");
        let size = |name: &String| std::fs::metadata(folder.join(name)).map_or(0, |it| it.len());
        let names = crate::store::names_in(&folder).into_iter();
        names.map(|name| (name.clone(), size(&name))).collect()
    }

    /// Sends a log from a byte on.
    fn log(
        &self,
        name: &str,
        from: u64,
        to: &mut dyn Write,
    ) -> Result<Result<(), Refusal>, WireError> {
        // Only names of the list, so that no path is made of another text.
        let Some((name, size)) = self.logs().into_iter().find(|(known, _)| known == name) else {
            return Ok(Err(refusal(
                format!("the robot has no log '{name}'"),
                "'afpc robot logs' lists them",
            )));
        };
        let path = self.store.root().join("logs").join(name);
        let cannot = |why| refusal(format!("cannot read the log: {why}"), "");
        let mut file = match File::open(path) {
            Ok(file) => file,
            Err(why) => return Ok(Err(cannot(why))),
        };
        if let Err(why) = std::io::Seek::seek(&mut file, std::io::SeekFrom::Start(from)) {
            return Ok(Err(cannot(why)));
        }
        let mut left = size.saturating_sub(from);
        send(to, &Answer::Content { size: left })?;
        let mut part = vec![0; LONGEST_PART];
        while left > 0 {
            let most = usize::try_from(left).unwrap_or(LONGEST_PART).min(LONGEST_PART);
            let room = part.get_mut(..most).unwrap_or_default();
            // A log that became shorter ends the connection, so that the other side notices.
            file.read_exact(room)?;
            send_content(to, room)?;
            left -= most as u64;
        }
        Ok(Ok(()))
    }
}

/// Receives a part of a file. Returns the number of bytes that are still to come.
fn receive_part(
    store: &Store<'_>,
    incoming: &mut Incoming,
    from: &mut dyn Read,
) -> Result<Result<u64, StoreError>, WireError> {
    match receive::<Request>(from)? {
        Packet::Part(part) if !part.is_empty() => Ok(store.part(incoming, &part)),
        _ => Err(WireError::Kind),
    }
}

fn answer_refused(to: &mut dyn Write, refused: Refusal) -> std::io::Result<()> {
    let Refusal { message, help } = refused;
    send(to, &Answer::Refused { message, help })
}
