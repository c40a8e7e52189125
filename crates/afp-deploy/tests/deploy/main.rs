//! Whole deploys over byte streams, with interruptions at any place.

mod fake;
mod faults;
mod refused;

use std::collections::BTreeSet;

use afp_deploy::client::{Progress, Ran};
use afp_deploy::store::{KEPT, Store};
use afp_deploy::wire::{State, Step};
use fake::{DISK, Robot, deploy, is_sound, release, session};

#[test]
fn a_deploy_sends_only_changed_files_and_starts_the_release() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    let (first, second) = (release(1), release(2));
    let mut steps = Vec::new();
    let ran = session(&mut robot, |agent| {
        agent.deploy(&first.0, &first.content(), false, &mut |step| steps.push(step))
    });
    let id = first.0.id();
    assert_eq!(ran.unwrap(), Ran { release: id.clone(), plan: "Patrol1".into(), instead: None });
    let expected = [
        Progress::Differs { files: 3, bytes: first.0.size().unwrap() },
        Progress::Step(Step::Check),
        Progress::Step(Step::Switch),
        Progress::Step(Step::Start),
    ];
    assert_eq!(steps, expected);
    // The second release shares a file with the first one.
    let mut differs = Vec::new();
    session(&mut robot, |agent| {
        agent.deploy(&second.0, &second.content(), false, &mut |step| differs.push(step))
    })
    .unwrap();
    assert!(matches!(differs[0], Progress::Differs { files: 2, .. }), "{differs:?}");
    // The same release again changes nothing and restarts nothing.
    let restarts = robot.restarts;
    assert_eq!(deploy(&mut robot, &second, false).unwrap().release, second.0.id());
    assert_eq!(robot.restarts, restarts);
    let status = session(&mut robot, |agent| agent.status()).unwrap();
    assert_eq!(status.state, State::Disarmed);
    assert_eq!(status.running.unwrap().release, second.0.id());
    let names: Vec<_> = status.releases.iter().map(|it| it.plan.as_str()).collect();
    assert_eq!(names, ["Patrol2", "Patrol1"]);
}

#[test]
fn a_rollback_of_a_rollback_is_the_release_before_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    for n in 1..=3 {
        deploy(&mut robot, &release(n), false).unwrap();
    }
    let mut back = || {
        let ran = session(&mut robot, |agent| agent.rollback(false, &mut |_| ()));
        ran.unwrap().plan
    };
    assert_eq!([back(), back(), back()], ["Patrol2", "Patrol3", "Patrol2"]);
    assert!(is_sound(folder.path()));
}

#[test]
fn only_three_releases_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    for n in 1..=6 {
        deploy(&mut robot, &release(n), false).unwrap();
    }
    let store = Store::open(folder.path(), &DISK).unwrap();
    let kept: Vec<_> = store.releases().into_iter().map(|it| it.release).collect();
    assert_eq!(kept, [6, 5, 4].map(|n| release(n).0.id()));
    let names = |name: &str| afp_deploy::store::names_in(&folder.path().join(name));
    assert_eq!((names("releases").len(), names("generations").len()), (KEPT, KEPT));
    let hashes = [6, 5, 4].map(release).into_iter().flat_map(|it| it.0.files);
    let hashes: BTreeSet<_> = hashes.map(|entry| entry.sha256).collect();
    assert_eq!(names("objects"), hashes.into_iter().collect::<Vec<_>>());
}

#[test]
fn a_release_that_does_not_start_is_replaced_by_the_one_before() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    deploy(&mut robot, &release(1), false).unwrap();
    robot.broken = Some(release(2).0.id());
    let ran = deploy(&mut robot, &release(2), false).unwrap();
    assert_eq!((ran.plan.as_str(), ran.instead.is_some()), ("Patrol1", true));
    let status = session(&mut robot, |agent| agent.status()).unwrap();
    assert_eq!(status.current.unwrap().plan, "Patrol1");
    assert_eq!(status.releases.len(), 1, "a rollback does not return to the failed release");
    assert!(is_sound(folder.path()));
}

#[test]
fn a_release_that_the_service_replaces_by_itself_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    deploy(&mut robot, &release(1), false).unwrap();
    (robot.broken, robot.eager) = (Some(release(2).0.id()), true);
    let ran = deploy(&mut robot, &release(2), false).unwrap();
    let why = format!("release {} did not start", release(2).0.id());
    assert_eq!((ran.plan.as_str(), ran.instead), ("Patrol1", Some(why)));
}

#[test]
fn logs_are_fetched_in_two_pieces() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    deploy(&mut robot, &release(1), false).unwrap();
    let log: Vec<u8> = (0..100_000_u32).flat_map(u32::to_le_bytes).collect();
    std::fs::write(folder.path().join("logs/a.mcap"), &log).unwrap();
    let listed = session(&mut robot, |agent| agent.logs()).unwrap();
    assert_eq!(listed, [("a.mcap".to_owned(), log.len() as u64)]);
    let mut fetched = log[..12_345].to_vec();
    session(&mut robot, |agent| agent.log("a.mcap", 12_345, &mut fetched)).unwrap();
    assert!(fetched == log);
    for name in ["b.mcap", "../afp.toml", ""] {
        let refused = session(&mut robot, |agent| agent.log(name, 0, &mut Vec::new()));
        assert!(refused.unwrap_err().to_string().contains("the robot has no log"));
    }
}
