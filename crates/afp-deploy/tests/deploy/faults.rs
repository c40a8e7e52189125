//! Interruptions: after each byte that matters, after each operation of the disk, and a full disk.

use std::cell::Cell;
use std::io;
use std::path::Path;

use afp_deploy::disk::{Disk, ThisDisk};
use afp_deploy::store::Store;
use afp_deploy::wire::{Request, send, send_content};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

use crate::fake::{DISK, Limited, Robot, deploy, is_sound, over, release, session};

/// After a failure the robot runs one of these releases, completely, and a deploy succeeds again.
fn is_one_of(robot: &mut Robot, allowed: [usize; 2], place: &str) {
    assert!(is_sound(&robot.root), "{place}: the current release is not complete");
    let status = session(robot, |agent| agent.status()).unwrap();
    let (running, current) = (status.running.unwrap(), status.current.unwrap());
    let allowed_ids = allowed.map(|n| release(n).0.id());
    assert!(allowed_ids.contains(&running.release), "{place}: runs {}", running.plan);
    assert!(allowed_ids.contains(&current.release), "{place}: starts {}", current.plan);
    robot.boot();
    assert_eq!(robot.running.as_ref(), Some(&current.release), "{place}: after a loss of power");
    let [_, new] = allowed;
    assert_eq!(deploy(robot, &release(new), true).unwrap().release, allowed_ids[1], "{place}");
    assert!(is_sound(&robot.root), "{place}: after another deploy");
}

fn with_old() -> (tempfile::TempDir, Robot) {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    deploy(&mut robot, &release(1), false).unwrap();
    (folder, robot)
}

/// All bytes of a deploy, and where its packets end.
fn bytes_of_deploy() -> (Vec<u8>, Vec<usize>) {
    let new = release(2);
    let (mut bytes, mut ends) = (Vec::new(), Vec::new());
    let request = Request::Deploy { manifest: new.0.clone(), stop_first: false };
    send(&mut bytes, &request).unwrap();
    ends.push(bytes.len());
    for entry in &new.0.files {
        // The robot has the shared file.
        if entry.path.ends_with("shared.afp") {
            continue;
        }
        send(&mut bytes, &Request::Content { sha256: entry.sha256.clone() }).unwrap();
        ends.push(bytes.len());
        send_content(&mut bytes, new.content()(&entry.sha256).unwrap()).unwrap();
        ends.push(bytes.len());
    }
    send(&mut bytes, &Request::Commit).unwrap();
    ends.push(bytes.len());
    (bytes, ends)
}

#[test]
fn a_connection_that_is_cut_anywhere_leaves_one_complete_release() {
    let (bytes, mut cuts) = bytes_of_deploy();
    let mut random = Pcg32::new(46, 0);
    cuts.extend((0..200).map(|_| random.next_u32() as usize % bytes.len()));
    for cut in cuts {
        let (_folder, mut robot) = with_old();
        let done = over(
            &mut robot,
            &DISK,
            |to| Box::new(Limited { to: Some(to), left: cut }),
            |agent| {
                let new = release(2);
                agent.deploy(&new.0, &new.content(), false, &mut |_| ())
            },
        );
        assert_eq!(done.is_ok(), cut == bytes.len(), "{cut}: {done:?}");
        is_one_of(&mut robot, [1, 2], &format!("cut after {cut} bytes"));
    }
}

/// A disk that ends or fills after some operations.
struct Failing {
    left: Cell<usize>,
    /// Whether only operations that need space fail.
    full: bool,
}

impl Failing {
    fn may(&self, needs_space: bool) -> io::Result<()> {
        match self.left.get().checked_sub(1) {
            Some(left) => self.left.set(left),
            None if needs_space || !self.full => return Err(io::ErrorKind::StorageFull.into()),
            None => {}
        }
        Ok(())
    }
}

impl Disk for Failing {
    fn create_dir_all(&self, path: &Path) -> io::Result<()> {
        self.may(true)?;
        ThisDisk.create_dir_all(path)
    }

    fn append(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let may = self.may(true);
        // A write that fails may have written a part.
        let written = if may.is_ok() { bytes.len() } else { bytes.len() / 2 };
        if may.is_ok() || self.full {
            ThisDisk.append(path, &bytes[..written])?;
        }
        may
    }

    fn seal(&self, path: &Path) -> io::Result<()> {
        self.may(false)?;
        ThisDisk.seal(path)
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.may(false)?;
        ThisDisk.rename(from, to)
    }

    fn hard_link(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.may(true)?;
        ThisDisk.hard_link(from, to)
    }

    fn symlink(&self, target: &Path, at: &Path) -> io::Result<()> {
        self.may(true)?;
        ThisDisk.symlink(target, at)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        self.may(false)?;
        ThisDisk.remove(path)
    }

    fn sync_dir(&self, path: &Path) -> io::Result<()> {
        self.may(false)?;
        ThisDisk.sync_dir(path)
    }
}

/// Deploys with a disk that fails after `operations`. Returns whether the deploy succeeded.
fn with_failure(operations: usize, full: bool) -> bool {
    let (_folder, mut robot) = with_old();
    let disk = Failing { left: Cell::new(operations), full };
    let done = over(
        &mut robot,
        &disk,
        |to| Box::new(to),
        |agent| {
            let new = release(2);
            agent.deploy(&new.0, &new.content(), false, &mut |_| ())
        },
    );
    let place = format!("{} after {operations} operations", if full { "full" } else { "ended" });
    is_one_of(&mut robot, [1, 2], &place);
    done.is_ok() && disk.left.get() > 0
}

#[test]
fn an_agent_that_ends_after_any_operation_leaves_one_complete_release() {
    let all = (0..1000).find(|operations| with_failure(*operations, false));
    assert!(all.is_some_and(|all| all > 30), "{all:?}");
}

#[test]
fn a_full_disk_leaves_one_complete_release() {
    let all = (0..1000).find(|operations| with_failure(*operations, true));
    assert!(all.is_some_and(|all| all > 30), "{all:?}");
}

#[test]
fn a_rollback_that_ends_after_any_operation_leaves_one_complete_release() {
    for operations in 0..40 {
        let (_folder, mut robot) = with_old();
        deploy(&mut robot, &release(2), false).unwrap();
        let disk = Failing { left: Cell::new(operations), full: false };
        over(&mut robot, &disk, |to| Box::new(to), |agent| agent.rollback(false, &mut |_| ())).ok();
        is_one_of(&mut robot, [1, 2], &format!("rollback ended after {operations} operations"));
    }
}

#[test]
fn a_file_that_was_damaged_on_the_disk_is_sent_again() {
    let (folder, mut robot) = with_old();
    let new = release(2);
    let store = Store::open(folder.path(), &DISK).unwrap();
    let plan = &new.0.files[0];
    std::fs::write(folder.path().join("objects").join(&plan.sha256), "damaged").unwrap();
    drop(store);
    let first = deploy(&mut robot, &new, false).unwrap_err().to_string();
    assert!(first.contains("deploy again to send it again"), "{first}");
    assert_eq!(deploy(&mut robot, &new, false).unwrap().release, new.0.id());
}
