//! The possible targets of an output, and the results.

#![cfg(unix)]

use std::fs::{self, File, Permissions};
use std::io::{ErrorKind, Read, Write};
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use afp_output::{Output, check_writable, read_file, read_text_file, write_if, write_whole};
use tempfile::TempDir;

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().mode() & 0o777
}

#[test]
fn the_old_file_stays_until_the_new_file_is_complete() {
    let folder = folder();
    let path = folder.path().join("a.svg");
    fs::write(&path, "old").unwrap();
    fs::set_permissions(&path, Permissions::from_mode(0o751)).unwrap();
    let mut output = Output::create(&path).unwrap();
    output.write_all(b"new").unwrap();
    assert_eq!(text(&path), "old");
    assert_eq!(text(output.path()), "new");
    assert_eq!(mode(output.path()), 0o751, "what is private is so from the beginning");
    output.finish().unwrap();
    assert_eq!((text(&path).as_str(), mode(&path)), ("new", 0o751));
    assert_eq!(files(folder.path()), ["a.svg"]);
}

#[test]
fn a_written_file_differs_from_later_writes() {
    let folder = folder();
    let [path, other] = ["a.afp", "b.afp"].map(|name| folder.path().join(name));
    // In the place of a file, and into a file with two names.
    for _ in 0..2 {
        let written = write_if(&path, b"new", || true).unwrap().unwrap();
        let there = fs::metadata(&path).unwrap();
        let about = |data: &fs::Metadata| (data.len(), data.modified().unwrap());
        assert_eq!(about(&written), about(&there));
        let _ = fs::hard_link(&path, &other);
    }
}

#[test]
fn a_new_file_has_default_permissions() {
    let folder = folder();
    let [path, other] = ["a.svg", "b.svg"].map(|name| folder.path().join(name));
    write_whole(&path, b"new").unwrap();
    fs::write(&other, "").unwrap();
    assert_eq!((text(&path).as_str(), mode(&path)), ("new", mode(&other)));
}

#[test]
fn a_discarded_output_leaves_nothing_and_a_dropped_output_its_part() {
    let folder = folder();
    let path = folder.path().join("a.svg");
    fs::write(&path, "old").unwrap();
    let mut output = Output::create(&path).unwrap();
    output.write_all(b"new").unwrap();
    output.discard();
    assert_eq!((text(&path).as_str(), files(folder.path())), ("old", vec!["a.svg".to_owned()]));
    let mut output = Output::create(&path).unwrap();
    output.write_all(b"new").unwrap();
    drop(output);
    assert_eq!(text(&path), "old");
    assert_eq!(text(&folder.path().join("a.svg.part")), "new");
    write_whole(&path, b"n").unwrap();
    assert_eq!((text(&path).as_str(), files(folder.path())), ("n", vec!["a.svg".to_owned()]));
}

#[test]
fn the_part_of_a_dead_process_is_kept() {
    let folder = folder();
    let path = folder.path().join("run.mcap");
    for (rest, kept) in [("first", "run.2.mcap.part"), ("second", "run.3.mcap.part")] {
        let mut dead = Output::create(&path).unwrap();
        dead.write_all(rest.as_bytes()).unwrap();
        drop(dead);
        let new = Output::create(&path).unwrap();
        assert_eq!(new.path(), folder.path().join("run.mcap.part"));
        assert_eq!(new.kept(), Some(&*folder.path().join(kept)));
        assert_eq!(text(&folder.path().join(kept)), rest);
        drop(new);
    }
    assert_eq!(Output::create(&path).unwrap().kept(), None, "nothing was written");
    fs::write(folder.path().join("run.mcap.part"), "third").unwrap();
    let beside = Output::create_beside_part(&path).unwrap();
    assert_eq!(beside.path(), folder.path().join("run.4.mcap.part"));
}

#[test]
fn links_are_followed() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("far")).unwrap();
    fs::write(path("far/a.svg"), "old").unwrap();
    symlink("far/a.svg", path("near")).unwrap();
    symlink("near", path("nearer")).unwrap();
    symlink("far/not_yet.svg", path("dangling")).unwrap();
    for (link, file) in [("nearer", "far/a.svg"), ("dangling", "far/not_yet.svg")] {
        write_whole(&path(link), b"new").unwrap();
        assert!(fs::symlink_metadata(path(link)).unwrap().is_symlink());
        assert_eq!(text(&path(file)), "new");
    }
    assert_eq!(files(&path("far")), ["a.svg", "not_yet.svg"]);
    symlink("round", path("round")).unwrap();
    write_whole(&path("round"), b"new").unwrap_err();
}

#[test]
fn a_file_with_two_names_keeps_both() {
    let folder = folder();
    let [path, other] = ["a.afp", "b.afp"].map(|name| folder.path().join(name));
    for (old, new) in [("older and longer", "new"), ("old", "newer and longer")] {
        fs::write(&path, old).unwrap();
        let _ = fs::hard_link(&path, &other);
        let mut output = Output::create(&path).unwrap();
        output.write_all(new.as_bytes()).unwrap();
        assert_eq!(text(&other), old);
        output.finish().unwrap();
        assert_eq!((text(&path).as_str(), text(&other).as_str()), (new, new));
        assert_eq!(fs::metadata(&path).unwrap().nlink(), 2);
        assert_eq!(files(folder.path()), ["a.afp", "b.afp"]);
    }
}

#[test]
fn a_device_is_not_replaced() {
    let null = Path::new("/dev/null");
    check_writable(null).unwrap();
    write_whole(null, b"new").unwrap();
    assert!(!fs::metadata(null).unwrap().is_file());
    assert!(!Path::new("/dev/null.part").exists());
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error() {
    let full = Path::new("/dev/full");
    assert_eq!(write_whole(full, b"new").unwrap_err().kind(), ErrorKind::StorageFull);
    let folder = folder();
    let link = folder.path().join("link");
    symlink(full, &link).unwrap();
    assert_eq!(write_whole(&link, b"new").unwrap_err().kind(), ErrorKind::StorageFull);
    assert_eq!(files(folder.path()), ["link"]);
}

#[test]
fn a_pipe_is_written_into() {
    let folder = folder();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    check_writable(&pipe).unwrap();
    let reader = thread::spawn({
        let pipe = pipe.clone();
        move || {
            let mut text = String::new();
            File::open(pipe).unwrap().read_to_string(&mut text).unwrap();
            text
        }
    });
    write_whole(&pipe, b"new").unwrap();
    assert_eq!(reader.join().unwrap(), "new");
    assert_eq!(files(folder.path()), ["pipe"]);
}

#[test]
fn only_regular_files_are_read_from_folders() {
    let folder = folder();
    let path = folder.path().join("pipe");
    let made = Command::new("mkfifo").arg(&path).status().unwrap();
    assert!(made.success());
    let kind = |path: &Path| read_text_file(path).unwrap_err().kind();
    // The pipe has no writer, so opening it would block.
    assert_eq!(kind(&path), ErrorKind::InvalidInput);
    assert_eq!(kind(Path::new("/dev/zero")), ErrorKind::InvalidInput);
    assert_eq!(kind(folder.path()), ErrorKind::IsADirectory);
    assert_eq!(kind(&folder.path().join("none")), ErrorKind::NotFound);
    let file = folder.path().join("a");
    fs::write(&file, vec![b'a'; 3 << 20]).unwrap();
    assert_eq!(read_file(&file, 3 << 20).unwrap().len(), 3 << 20);
    let long = read_file(&file, 2 << 20).unwrap_err();
    assert_eq!(
        (long.kind(), long.to_string()),
        (ErrorKind::FileTooLarge, "it is longer than 2 MiB".to_owned())
    );
    fs::write(&file, [0xff]).unwrap();
    assert_eq!(kind(&file), ErrorKind::InvalidData);
}

#[test]
fn concurrent_writers_do_not_share_a_part() {
    let folder = folder();
    let path = folder.path().join("run.mcap");
    let mut one = Output::create(&path).unwrap();
    one.write_all(b"one").unwrap();
    for refused in [Output::create(&path).map(|_| ()), check_writable(&path)] {
        let why = refused.unwrap_err();
        assert_eq!(why.kind(), ErrorKind::ResourceBusy);
        assert!(why.to_string().contains("another name"), "{why}");
    }
    let mut two = Output::create_beside_part(&path).unwrap();
    two.write_all(b"two, longer").unwrap();
    assert_eq!(two.path(), folder.path().join("run.2.mcap.part"));
    two.finish().unwrap();
    assert_eq!(text(&path), "two, longer");
    one.finish().unwrap();
    assert_eq!((text(&path).as_str(), files(folder.path())), ("one", vec!["run.mcap".to_owned()]));
    assert!(Output::create(&path).is_ok());
}

#[test]
fn the_part_of_another_file_is_not_replaced() {
    let folder = folder();
    let path = folder.path().join("run.mcap");
    let mut one = Output::create(&path).unwrap();
    one.write_all(b"one").unwrap();
    let part = one.path().to_owned();
    let refused = [
        Output::create(&part).map(|_| ()),
        Output::create_beside_part(&part).map(|_| ()),
        write_whole(&part, b"two"),
        check_writable(&part),
    ];
    for why in refused {
        assert_eq!(why.unwrap_err().kind(), ErrorKind::ResourceBusy);
    }
    one.finish().unwrap();
    assert_eq!((text(&path).as_str(), files(folder.path())), ("one", vec!["run.mcap".to_owned()]));
    // The first writer finds out at the end.
    let mut two = Output::create(&part).unwrap();
    two.write_all(b"two").unwrap();
    let three = Output::create(&path).unwrap();
    assert_eq!(two.finish().unwrap_err().kind(), ErrorKind::ResourceBusy);
    three.finish().unwrap();
    assert_eq!(text(&folder.path().join("run.mcap.part.part")), "two");
}

/// The wait has an end.
#[test]
fn a_short_write_does_not_wait_for_a_long_one_without_end() {
    let folder = folder();
    let path = folder.path().join("run.mcap");
    let one = Output::create(&path).unwrap();
    let why = write_whole(&path, b"two").unwrap_err();
    assert_eq!(why.kind(), ErrorKind::ResourceBusy);
    one.finish().unwrap();
    write_whole(&path, b"two").unwrap();
    assert_eq!(text(&path), "two");
}

/// Each try waits for two seconds.
const TRIES: u32 = 15;

/// Writes a file when no other process does. Waiting writers have no queue, so others may come
/// first for long on a busy machine.
fn write_in_turn(path: &Path, bytes: &[u8]) {
    for _ in 0..TRIES {
        match write_whole(path, bytes) {
            Err(why) if why.kind() == ErrorKind::ResourceBusy => {}
            written => return written.unwrap(),
        }
    }
    panic!("others have come first {TRIES} times");
}

#[test]
fn many_concurrent_writers_each_write_a_complete_file() {
    let folder = folder();
    let path = folder.path().join("run.mcap");
    thread::scope(|scope| {
        for letter in [b'a', b'b', b'c', b'd'] {
            let path = &path;
            scope.spawn(move || {
                for length in 1..100 {
                    write_in_turn(path, &vec![letter; length * 100]);
                    let seen = fs::read(path).unwrap();
                    assert!(
                        !seen.is_empty() && seen.len().is_multiple_of(100),
                        "{} bytes",
                        seen.len()
                    );
                    assert!(seen.iter().all(|byte| *byte == seen[0]), "a mixture");
                }
            });
        }
    });
    assert_eq!(files(folder.path()), ["run.mcap"]);
}

#[test]
fn a_part_that_is_a_link_is_not_changed() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("precious"), "mine").unwrap();
    symlink("precious", path("a.svg.part")).unwrap();
    write_whole(&path("a.svg"), b"new").unwrap();
    assert_eq!((text(&path("precious")).as_str(), text(&path("a.svg")).as_str()), ("mine", "new"));
}

#[test]
fn a_check_changes_nothing() {
    let folder = folder();
    let path = folder.path().join("a.svg");
    check_writable(&path).unwrap();
    assert_eq!(files(folder.path()), [""; 0]);
    fs::write(&path, "old").unwrap();
    check_writable(&path).unwrap();
    assert_eq!((text(&path).as_str(), files(folder.path())), ("old", vec!["a.svg".to_owned()]));
    let kind = |path: PathBuf| check_writable(&path).unwrap_err().kind();
    assert_eq!(kind(folder.path().to_owned()), ErrorKind::IsADirectory);
    assert_eq!(kind(folder.path().join("no/folder/a.svg")), ErrorKind::NotFound);
}

/// The folder of [`a_folder_without_write_permission_is_reported`], for its second half.
const FOLDER: &str = "AFP_OUTPUT_TEST_FOLDER";

/// Permissions do not restrict root, so the second half runs as another user.
#[test]
fn a_folder_without_write_permission_is_reported() {
    if let Some(folder) = std::env::var_os(FOLDER) {
        return written_by_who_may_not(Path::new(&folder));
    }
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    for (name, permissions) in [("old", 0o644), ("fixed", 0o444)] {
        fs::write(path(name), "older and longer").unwrap();
        fs::set_permissions(path(name), Permissions::from_mode(permissions)).unwrap();
    }
    fs::set_permissions(folder.path(), Permissions::from_mode(0o555)).unwrap();
    let mut again = Command::new(std::env::current_exe().unwrap());
    again
        .args(["--exact", "a_folder_without_write_permission_is_reported"])
        .env(FOLDER, folder.path());
    if fs::metadata(folder.path()).unwrap().uid() == 0 {
        let nobody = 65534;
        for path in [folder.path(), &path("old"), &path("fixed")] {
            chown(path, Some(nobody), Some(nobody)).unwrap();
        }
        again.uid(nobody).gid(nobody);
    }
    let done = again.output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stdout));
    assert_eq!((text(&path("old")).as_str(), files(folder.path()).len()), ("new", 2));
    fs::set_permissions(folder.path(), Permissions::from_mode(0o755)).unwrap();
}

fn written_by_who_may_not(folder: &Path) {
    check_writable(&folder.join("old")).unwrap();
    let mut output = Output::create(&folder.join("old")).unwrap();
    output.write_all(b"half").unwrap();
    let part = output.path().to_owned();
    assert_eq!((text(&folder.join("old")).as_str(), mode(&part)), ("older and longer", 0o600));
    output.discard();
    assert_eq!(text(&folder.join("old")), "older and longer");
    assert!(!part.exists());
    write_whole(&folder.join("old"), b"new").unwrap();
    for path in ["fixed", "not_there"].map(|name| folder.join(name)) {
        for done in [check_writable(&path), write_whole(&path, b"new")] {
            assert_eq!(done.unwrap_err().kind(), ErrorKind::PermissionDenied);
        }
    }
}

/// Set while [`a_disk_that_gets_full_leaves_a_file_with_two_names`] runs its second half.
#[cfg(target_os = "linux")]
const FULL: &str = "AFP_OUTPUT_TEST_FULL";

/// A file size limit imitates a full disk. It applies to a whole process, so the test starts
/// another one.
#[test]
#[cfg(target_os = "linux")]
fn a_disk_that_gets_full_leaves_a_file_with_two_names() {
    if std::env::var_os(FULL).is_some() {
        return written_where_nothing_grows();
    }
    // Without this, a signal ends the process at the limit.
    let mut again = Command::new("sh");
    again.args(["-c", "trap '' XFSZ; exec \"$@\"", "sh"]).arg(std::env::current_exe().unwrap());
    again.args(["--exact", "a_disk_that_gets_full_leaves_a_file_with_two_names"]).env(FULL, "");
    let done = again.output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stdout));
}

#[cfg(target_os = "linux")]
fn written_where_nothing_grows() {
    let folder = folder();
    let [path, other] = ["a.afp", "b.afp"].map(|name| folder.path().join(name));
    fs::write(&path, "old").unwrap();
    fs::hard_link(&path, &other).unwrap();
    let mut output = Output::create(&path).unwrap();
    output.write_all(&[b'n'; 1 << 16]).unwrap();
    let part = output.path().to_owned();
    let of_this = format!("--pid={}", std::process::id());
    assert!(Command::new("prlimit").args([&*of_this, "--fsize=4096"]).status().unwrap().success());
    assert_eq!(output.finish().unwrap_err().kind(), ErrorKind::FileTooLarge);
    assert_eq!((text(&path).as_str(), text(&part).len()), ("old", 1 << 16));
}

#[test]
fn an_empty_name_is_refused() {
    for made in [check_writable(Path::new("")), write_whole(Path::new(""), b"new")] {
        assert_eq!(made.unwrap_err().kind(), std::io::ErrorKind::NotFound);
    }
    assert!(!Path::new(".part").exists());
}
