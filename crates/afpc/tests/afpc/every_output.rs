//! Every output of every command, to every kind of file: nothing is lost or replaced, and the exit
//! code is right.

use std::fs::{self, File, Permissions};
use std::io::Read;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::thread;

use crate::common::{Place, Said, said};

const PLAN: &str = "use carbot

plan P {
    start go

    actor go: Forward(distance = 10 cm) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> terminate }
        ForwardSuccessful -> terminate
    }
}
";

const SCENARIO: &str = "use \"p.afp\"\nscenario \"ends\" for P { expect end by OK before 8 s }\n";

/// A command that writes a file.
struct Writer {
    /// The command, with `OUT` for the file.
    command: &'static str,
    /// A name for the file.
    file: &'static str,
    /// The start of the file.
    begins: &'static [u8],
}

const fn writer(command: &'static str, file: &'static str, begins: &'static [u8]) -> Writer {
    Writer { command, file, begins }
}

const PNG: &[u8] = b"\x89PNG";
const MCAP: &[u8] = b"\x89MCAP0\r\n";

const WRITERS: &[Writer] = &[
    writer("run p.afp --log none --svg OUT", "way.svg", b"<svg"),
    writer("run p.afp --log none --svg OUT", "way.png", PNG),
    writer("run p.afp --svg none --log OUT", "run.mcap", MCAP),
    writer("run --again p.mcap --svg none --log OUT", "again.mcap", MCAP),
    writer("graph p.afp -o OUT", "plan.svg", b"<svg"),
    writer("graph p.afp -o OUT", "plan.png", PNG),
    writer("graph p.afp -o OUT", "plan.dot", b"digraph"),
    writer("graph p.afp -o OUT", "plan.json", b"{"),
    writer("graph p.afp -o OUT", "plan.scxml", b"<?xml"),
    writer("log p.mcap recover -o OUT", "saved.mcap", MCAP),
    writer("log p.mcap --svg OUT", "way.svg", b"<svg"),
    writer("log p.mcap --coverage OUT", "cover.svg", b"<svg"),
    writer("log p.mcap --sonar OUT", "sonar.svg", b"<svg"),
    writer("log p.mcap --film OUT", "film.png", PNG),
    writer("test --generate p.afp -o OUT", "made.afp", b"use \"p.afp\""),
    writer("test tests.afp --coverage -o OUT", "cover.svg", b"<svg"),
    writer("sweep p.afp --seeds 0..1 --until 1s -o OUT", "table.csv", b"run,"),
];

/// The old content, which every writer may replace.
const OLD: &str = "// Made by 'afpc test --generate'.\n";

/// Every command that prints results.
const PRINTERS: &[&str] = &[
    "check p.afp",
    "check p.afp --timing",
    "explain E0203",
    "graph p.afp",
    "graph p.afp --format png",
    "run p.afp --log none --svg none",
    "run p.afp --log none --svg none --json",
    "test tests.afp",
    "test tests.afp --json",
    "test tests.afp --coverage",
    "sweep p.afp --seeds 0..1 --until 1s --restart",
    "log p.mcap",
    "log p.mcap info",
    "log p.mcap doctor",
    "templates",
    "templates Turn",
    "completions bash",
    "--help",
];

impl Writer {
    /// The command in a place, writing there.
    fn command(&self, place: &Place, out: &str) -> Command {
        let mut command = place.command();
        let words = self.command.split(' ');
        command.args(words.map(|word| if word == "OUT" { out } else { word }));
        command
    }

    fn call(&self, place: &Place) -> Said {
        said(self.command(place, self.file).output().unwrap())
    }

    /// The command's name in a failure.
    fn name(&self) -> String {
        self.command.replace("OUT", self.file)
    }

    #[track_caller]
    fn is_whole(&self, bytes: &[u8]) {
        let begin = String::from_utf8_lossy(&bytes[..bytes.len().min(30)]);
        assert!(bytes.starts_with(self.begins), "{}: {begin:?}", self.name());
        if self.begins == MCAP {
            assert!(bytes.ends_with(MCAP), "{}: no end", self.name());
        }
    }
}

/// A place with a plan, its scenarios and the log of a run.
fn place() -> Place {
    static LOG: OnceLock<Vec<u8>> = OnceLock::new();
    let place = Place::new();
    place.write("p.afp", PLAN);
    place.write("tests.afp", SCENARIO);
    let log = LOG.get_or_init(|| {
        place.afpc("run p.afp --camera --log p.mcap --svg none").succeeds();
        place.bytes("p.mcap")
    });
    fs::write(place.path("p.mcap"), log).unwrap();
    place
}

/// The new files in a place, other than journals of sweeps.
fn new_files(place: &Place) -> Vec<String> {
    let mut files = place.files();
    files.retain(|name| !["p.afp", "p.mcap", "tests.afp"].contains(&&**name));
    files.retain(|name| !name.ends_with(".journal") && !name.starts_with("target/"));
    files
}

/// A user who owns nothing.
const NOBODY: u32 = 65534;

/// Permissions do not restrict root, so another user gets the place and runs the command.
fn without_rights(place: &Place, command: &mut Command) {
    if fs::metadata(place.path("")).unwrap().uid() != 0 {
        return;
    }
    chown(place.path(""), Some(NOBODY), Some(NOBODY)).unwrap();
    for name in place.files() {
        chown(place.path(&name), Some(NOBODY), Some(NOBODY)).unwrap();
    }
    command.uid(NOBODY).gid(NOBODY);
}

#[test]
fn a_new_file_is_whole_and_the_only_one() {
    for writer in WRITERS {
        let place = place();
        writer.call(&place).succeeds();
        writer.is_whole(&place.bytes(writer.file));
        assert_eq!(new_files(&place), [writer.file], "{}", writer.name());
    }
}

#[test]
fn a_device_receives_the_bytes_and_is_not_replaced() {
    for writer in WRITERS {
        let place = place();
        symlink("/dev/null", place.path(writer.file)).unwrap();
        writer.call(&place).succeeds();
        assert!(fs::symlink_metadata(place.path(writer.file)).unwrap().is_symlink());
        assert!(!fs::metadata("/dev/null").unwrap().is_file(), "{}", writer.name());
        assert_eq!(new_files(&place), [writer.file], "{}", writer.name());
    }
}

#[test]
fn a_full_device_is_reported() {
    for writer in WRITERS {
        let place = place();
        symlink("/dev/full", place.path(writer.file)).unwrap();
        let said = writer.call(&place);
        said.fails(1, &["No space left on device", writer.file]);
        assert_eq!(said.err.matches("error:").count(), 1, "{}: {}", writer.name(), said.err);
    }
}

#[test]
fn a_pipe_gets_the_whole_output() {
    for writer in WRITERS {
        let place = place();
        let pipe = place.path(writer.file);
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reader = thread::spawn({
            let pipe = pipe.clone();
            move || {
                let mut bytes = Vec::new();
                File::open(pipe).unwrap().read_to_end(&mut bytes).unwrap();
                bytes
            }
        });
        writer.call(&place).succeeds();
        writer.is_whole(&reader.join().unwrap());
        assert_eq!(new_files(&place), [writer.file], "{}", writer.name());
    }
}

#[test]
fn a_link_is_kept_and_its_file_gets_the_new_text() {
    for writer in WRITERS {
        let place = place();
        place.write("far/old", OLD);
        fs::set_permissions(place.path("far/old"), Permissions::from_mode(0o640)).unwrap();
        symlink("far/old", place.path(writer.file)).unwrap();
        writer.call(&place).succeeds();
        assert!(fs::symlink_metadata(place.path(writer.file)).unwrap().is_symlink());
        writer.is_whole(&place.bytes("far/old"));
        assert_eq!(fs::metadata(place.path("far/old")).unwrap().mode() & 0o777, 0o640);
        let mut files = ["far/old", writer.file];
        files.sort_unstable();
        assert_eq!(new_files(&place), files, "{}", writer.name());
    }
}

#[test]
fn a_read_only_file_is_not_changed() {
    for writer in WRITERS {
        let place = place();
        place.write(writer.file, OLD);
        fs::set_permissions(place.path(writer.file), Permissions::from_mode(0o444)).unwrap();
        let mut command = writer.command(&place, writer.file);
        without_rights(&place, &mut command);
        said(command.output().unwrap()).fails(1, &["Permission denied", writer.file]);
        assert_eq!(place.read(writer.file), OLD, "{}", writer.name());
        assert_eq!(new_files(&place), [writer.file], "{}", writer.name());
        assert!(!place.exists("table.csv.journal"), "a sweep that could not be kept began");
    }
}

#[test]
fn a_file_in_a_read_only_folder_is_written() {
    for writer in WRITERS {
        let place = place();
        place.write(writer.file, OLD);
        // The results of a sweep are kept next to its table.
        let journal = format!("{}.journal", writer.file);
        if writer.command.starts_with("sweep") {
            place.write(&journal, "");
        }
        let mut command = writer.command(&place, writer.file);
        without_rights(&place, &mut command);
        fs::set_permissions(place.path(""), Permissions::from_mode(0o555)).unwrap();
        let said = said(command.output().unwrap());
        fs::set_permissions(place.path(""), Permissions::from_mode(0o755)).unwrap();
        said.succeeds();
        writer.is_whole(&place.bytes(writer.file));
    }
}

#[test]
fn a_run_in_a_folder_that_takes_no_files_names_the_options_for_none() {
    let place = Place::with_plan();
    let mut command = place.command();
    command.args(["run", "wall_following.afp", "--until", "1s"]);
    without_rights(&place, &mut command);
    fs::set_permissions(place.path(""), Permissions::from_mode(0o555)).unwrap();
    let said = said(command.output().unwrap());
    fs::set_permissions(place.path(""), Permissions::from_mode(0o755)).unwrap();
    said.fails(1, &["Permission denied", "'--log none --svg none'"]);
}

#[test]
fn a_full_disk_keeps_the_old_file() {
    for writer in WRITERS {
        let place = place();
        place.write(writer.file, OLD);
        let afpc = writer.command(&place, writer.file);
        // The file size is limited; without the signal, writing fails like on a full disk.
        let mut shell = Command::new("sh");
        shell.args(["-c", "trap '' XFSZ; ulimit -f 0; exec \"$@\"", "sh"]);
        shell.arg(afpc.get_program()).args(afpc.get_args()).current_dir(place.path(""));
        let said = said(shell.env("XDG_CACHE_HOME", place.path("cache")).output().unwrap());
        said.fails(1, &["File too large"]);
        assert_eq!(place.read(writer.file), OLD, "{}", writer.name());
    }
}

#[test]
fn two_writers_at_once_leave_a_whole_file() {
    for writer in WRITERS {
        let place = place();
        let both = [(), ()].map(|()| {
            let mut command = writer.command(&place, writer.file);
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
        });
        let both = both.map(|one| said(one.wait_with_output().unwrap()));
        for one in &both {
            match one.code {
                // A second sweep would continue the first one, so there is one sweep at a time.
                2 if writer.command.starts_with("sweep") => {
                    one.fails(2, &["another sweep is writing"])
                }
                // A log is written during the run.
                1 if writer.file.ends_with(".mcap") => {
                    one.fails(1, &["another program is writing it", "another name"])
                }
                _ => one.succeeds(),
            };
        }
        assert!(both.iter().any(|one| one.code == 0), "{}: {both:?}", writer.name());
        writer.is_whole(&place.bytes(writer.file));
        assert_eq!(new_files(&place), [writer.file], "{}", writer.name());
    }
}

#[test]
fn an_unwritable_standard_output_is_reported() {
    let place = place();
    for command in PRINTERS {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = place.command().args(command.split(' ')).stdout(full).output().unwrap();
        let said = said(output);
        assert_eq!(said.code, 1, "'{command}': {said:?}");
        let text = "cannot write to 'standard output': No space left on device";
        assert!(said.err.contains(text), "'{command}': {}", said.err);
        assert!(!said.err.contains("panicked"), "'{command}': {}", said.err);
    }
}

#[test]
fn a_closed_pipe_is_not_an_error() {
    let place = place();
    for command in PRINTERS {
        let mut child = place.command();
        child.args(command.split(' ')).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = child.spawn().unwrap();
        drop(child.stdout.take());
        let said = said(child.wait_with_output().unwrap());
        assert_eq!(said.code, 0, "'{command}': {said:?}");
        assert!(!said.err.contains("panicked"), "'{command}': {}", said.err);
    }
}

#[test]
fn a_generated_crate_goes_through_a_link_and_replaces_no_other_files() {
    let place = place();
    let build = |out: &str| {
        let mut command = place.command();
        command.args(["build", "p.afp", "-o", out]).env("CARGO", "no-such-cargo");
        command
    };
    fs::create_dir(place.path("far")).unwrap();
    symlink("far", place.path("near")).unwrap();
    said(build("near").output().unwrap()).fails(1, &["is not installed"]);
    assert!(fs::symlink_metadata(place.path("near")).unwrap().is_symlink());
    assert!(place.exists("far/src/main.rs"));
    // A file, a device and a read-only folder are not valid folders for a crate.
    for (name, why) in [("p.mcap", "Not a directory"), ("/dev/null", "Not a directory")] {
        said(build(name).output().unwrap()).fails(1, &[why]);
    }
    fs::create_dir(place.path("fixed")).unwrap();
    let mut command = build("fixed");
    without_rights(&place, &mut command);
    fs::set_permissions(place.path("fixed"), Permissions::from_mode(0o555)).unwrap();
    chown(place.path("fixed"), Some(0), Some(0)).ok();
    said(command.output().unwrap()).fails(1, &["Permission denied"]);
    assert!(fs::read_dir(place.path("fixed")).unwrap().next().is_none());
    assert!(Path::new("/dev/null").exists());
}
