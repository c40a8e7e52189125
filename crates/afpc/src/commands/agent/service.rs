//! `afpc agent --serve`: runs the current release, and another one on request.
//!
//! A program starts disarmed and waits for an operator or the robot's button. If a new release is not
//! ready within [`READY`], the last release that was starts again. A program that ends is started
//! again, disarmed. With `autostart`, the first program after a boot is armed.

use std::fs::{self, File};
use std::io::Write;
use std::os::unix::net::{UnixDatagram, UnixListener};
use std::path::{Path, PathBuf};
use std::process::Child;
use std::thread;
use std::time::{Duration, Instant};

use afp_deploy::agent::{Service, Started};
use afp_deploy::logs::{self, Logs};
use afp_deploy::store::{Generation, Store};
use afp_deploy::wire::State;
use afp_project::Robot;
use afp_run::{RunError, StopFlag, notify, say};

use super::control::{self, Order, Reply};
use super::program;

/// A release has this long to be ready.
const READY: Duration = Duration::from_secs(5);
/// The interval of looks at the program and the socket.
const LOOK: Duration = Duration::from_millis(10);
/// The first and the longest pause before a program that ended starts again.
const PAUSE: (Duration, Duration) = (Duration::from_millis(200), Duration::from_secs(5));
/// The states that a program reports.
const READY_STATE: &str = "READY=1";
const ARMED: &str = "STATUS=armed";
/// The interval of signs of life for systemd, whose limit in the unit is a minute.
const ALIVE: Duration = Duration::from_secs(5);
/// A program that ran this long has not failed at once.
const LONG: Duration = Duration::from_secs(10);
/// The interval at which the logs are limited during a run.
const LIMIT_LOGS: Duration = Duration::from_secs(60);
/// The number of this boot, which Linux draws.
const BOOT_ID: &str = "/proc/sys/kernel/random/boot_id";

/// A program that runs.
struct Running {
    release: String,
    child: Child,
    armed: bool,
    since: Instant,
}

struct Supervisor<'a> {
    store: &'a Store<'a>,
    afpc: PathBuf,
    /// The states that programs report, as `sd_notify` sends them.
    states: UnixDatagram,
    running: Option<Running>,
    trouble: Option<String>,
    /// The next start after an end, and the pause before it.
    again: Instant,
    pause: Duration,
    /// The ends in a row, each soon after its start.
    failures: u32,
    /// Whether the next start is the first one after a boot, and is armed.
    autostart: bool,
    logs: Logs,
    /// The most bytes of all logs.
    most: u64,
    limited: Instant,
}

/// Runs releases until the process is asked to stop.
///
/// # Errors
/// Another service uses the folder, or a socket cannot be created.
pub(super) fn serve(store: &Store<'_>, robot: Option<&Robot>) -> Result<(), RunError> {
    let root = store.root();
    let lock = root.join("service.lock");
    let file = File::create(&lock).map_err(RunError::file("cannot create", &lock))?;
    if file.try_lock().is_err() {
        let message = format!("another service runs the releases in '{}'", root.display());
        return Err(RunError::usage(message, "stop it first: 'sudo systemctl stop afp'"));
    }
    let socket = control::socket(root);
    fs::remove_file(&socket).ok();
    let bind = UnixListener::bind(&socket);
    let listener = bind.map_err(RunError::file("cannot create", &socket))?;
    let failed = |why| RunError::file("cannot create", &socket)(why);
    listener.set_nonblocking(true).map_err(failed)?;
    let path = root.join("notify");
    fs::remove_file(&path).ok();
    let states = UnixDatagram::bind(&path).map_err(RunError::file("cannot create", &path))?;
    states.set_nonblocking(true).map_err(failed)?;
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let mut supervisor = Supervisor {
        store,
        afpc: program::afpc()?,
        states,
        running: None,
        trouble: None,
        again: Instant::now(),
        pause: PAUSE.0,
        failures: 0,
        autostart: is_first_of_boot(root)
            && robot.is_some_and(|robot| robot.autostart)
            && store.current().is_some(),
        logs: Logs::of(root),
        most: robot.and_then(|robot| robot.logs).unwrap_or(logs::USUAL),
        limited: Instant::now(),
    };
    notify("READY=1");
    let mut told = Instant::now();
    while !stop.is_raised() {
        if told.elapsed() > ALIVE {
            notify("WATCHDOG=1");
            told = Instant::now();
        }
        if let Ok((stream, _)) = listener.accept() {
            supervisor.answer(stream);
        }
        supervisor.look();
        supervisor.limit_logs();
        thread::sleep(LOOK);
    }
    supervisor.stop();
    fs::remove_file(&socket).ok();
    Ok(())
}

/// Whether no service has used the folder since the last boot of this computer. A computer that
/// cannot tell counts as already booted, so that nothing is armed.
fn is_first_of_boot(root: &Path) -> bool {
    let Ok(boot) = fs::read_to_string(BOOT_ID) else { return false };
    let path = root.join("boot");
    let is_known = fs::read_to_string(&path).is_ok_and(|known| known == boot);
    !is_known && fs::write(&path, boot).is_ok()
}

impl Supervisor<'_> {
    fn answer(&mut self, mut stream: std::os::unix::net::UnixStream) {
        stream.set_nonblocking(false).ok();
        // A client that sends nothing must not hold up the service.
        stream.set_read_timeout(Some(Duration::from_secs(1))).ok();
        let Ok(order) = control::read(&stream) else { return };
        let reply = self.obey(order).unwrap_or_else(Reply::Failed);
        // The order is carried out even if nobody waits for the reply.
        control::write(&mut stream, &reply).ok();
    }

    fn obey(&mut self, order: Order) -> Result<Reply, String> {
        self.look();
        match order {
            Order::State => Ok(Reply::State(self.state())),
            Order::Restart => self.restart().map(Reply::Started),
            Order::Arm(true) => self.arm().map(|()| Reply::Done),
            Order::Arm(false) => match self.running.as_ref().is_some_and(|it| it.armed) {
                true => self.restart().map(|_| Reply::Done),
                false => Ok(Reply::Done),
            },
        }
    }

    fn state(&self) -> Service {
        let state = match &self.running {
            None => State::Stopped,
            Some(Running { armed: false, .. }) => State::Disarmed,
            Some(Running { armed: true, .. }) => State::Armed,
        };
        let release = self.running.as_ref().map(|running| running.release.clone());
        Service { state, release, trouble: self.trouble.clone() }
    }

    /// Notices what the program reports and its end, and starts a release if none runs.
    fn look(&mut self) {
        while let Some(said) = self.said() {
            if let Some(running) = self.running.as_mut().filter(|_| said == ARMED) {
                running.armed = true;
            }
        }
        if let Some(running) = &mut self.running
            && let Ok(Some(status)) = running.child.try_wait()
        {
            let (armed, is_long) = (running.armed, running.since.elapsed() > LONG);
            self.failures = if is_long { 1 } else { self.failures.saturating_add(1) };
            if !status.success() {
                let armed = if armed { " while it was armed" } else { "" };
                let mut trouble = format!("release {} ended{armed}: {status}", running.release);
                if self.failures > 1 {
                    trouble.push_str(&format!(", {} times in a row", self.failures));
                }
                self.trouble = Some(trouble);
            }
            self.pause = if is_long { PAUSE.0 } else { PAUSE.1.min(self.pause * 2) };
            self.again = Instant::now() + self.pause;
            self.running = None;
        }
        if self.running.is_none() && Instant::now() >= self.again && self.store.current().is_some()
        {
            let autostart = std::mem::take(&mut self.autostart);
            if let Err(why) = self.start_or_fall_back() {
                self.pause = PAUSE.1.min(self.pause * 2);
                self.again = Instant::now() + self.pause;
                say(format_args!("error: {why}"));
                self.trouble = Some(why);
            } else if autostart && let Err(why) = self.arm() {
                self.trouble = Some(why);
            }
        }
    }

    fn limit_logs(&mut self) {
        if self.limited.elapsed() > LIMIT_LOGS {
            self.limited = Instant::now();
            self.prune_logs();
        }
    }

    fn prune_logs(&mut self) {
        if let Err(why) = self.logs.prune(self.most) {
            self.trouble = Some(format!("cannot remove an old log: {why}"));
        }
    }

    fn restart(&mut self) -> Result<Started, String> {
        self.stop();
        self.trouble = None;
        self.failures = 0;
        // Somebody is here, and decides.
        self.autostart = false;
        let started = self.start_or_fall_back();
        if let Err(why) = &started {
            self.trouble = Some(why.clone());
            self.again = Instant::now() + PAUSE.1;
        }
        started
    }

    fn stop(&mut self) {
        if let Some(mut running) = self.running.take() {
            program::end(&mut running.child);
        }
    }

    fn start_or_fall_back(&mut self) -> Result<Started, String> {
        let current = self.store.current().ok_or("the robot has no release")?;
        let Err(why) = self.start(&current) else {
            return Ok(Started { release: current.release, instead: None });
        };
        let why = format!("release {} did not start: {why}", current.release);
        let good = self.store.fall_back().map_err(|more| format!("{why}; {more}"))?;
        let good = good.ok_or_else(|| why.clone())?;
        self.start(&good).map_err(|more| format!("{why}; nor did {}: {more}", good.release))?;
        self.trouble = Some(why.clone());
        Ok(Started { release: good.release, instead: Some(why) })
    }

    /// Starts a release and waits until it is ready.
    fn start(&mut self, generation: &Generation) -> Result<(), String> {
        let Generation { release, number } = generation;
        let manifest = self.store.manifest(release).map_err(|why| why.to_string())?;
        let files = self.store.files(release);
        program::stop_robot(&self.afpc, &files, &manifest)?;
        while self.said().is_some() {}
        self.prune_logs();
        let log = self.logs.next(&manifest.plan, *number);
        let notify = self.store.root().join("notify");
        let started = program::start((&self.afpc, &files), &manifest, &log, &notify);
        let mut child = started.map_err(|why| format!("cannot start it: {why}"))?;
        let until = Instant::now() + READY;
        while self.said().as_deref() != Some(READY_STATE) {
            let ended = child.try_wait().map_err(|why| why.to_string())?;
            if let Some(status) = ended {
                return Err(format!("it ended before it was ready ({status})"));
            }
            if Instant::now() >= until {
                program::end(&mut child);
                return Err(format!("it was not ready within {} s", READY.as_secs()));
            }
            thread::sleep(LOOK);
        }
        self.store.confirm().map_err(|why| why.to_string())?;
        let since = Instant::now();
        self.running = Some(Running { release: release.clone(), child, armed: false, since });
        Ok(())
    }

    /// The next state that a program reports.
    fn said(&self) -> Option<String> {
        let mut said = [0; 64];
        let count = self.states.recv(&mut said).ok()?;
        Some(String::from_utf8_lossy(said.get(..count)?).into_owned())
    }

    fn arm(&mut self) -> Result<(), String> {
        let trouble = self.trouble.clone();
        let Some(running) = &mut self.running else {
            return Err(trouble.unwrap_or_else(|| "no plan runs on the robot".to_owned()));
        };
        if running.armed {
            return Ok(());
        }
        let sent = running.child.stdin.as_mut().map(|input| input.write_all(b"arm\n"));
        match sent {
            Some(Ok(())) => {
                running.armed = true;
                Ok(())
            }
            _ => Err("the plan does not listen".to_owned()),
        }
    }
}
