//! The robot over its serial line, with a stand-in at the other end.

use std::thread;

use afp::core::Platform;
use afp::quantity::{AngularSpeed, Speed};
use afp::{Duration, Environment};
use afp_hardware::{Hardware, Settings};
use vacuum::{Nozzle, Senses, Wheels};
use vacuum_board::Board;

#[path = "../examples/firmware.rs"]
#[allow(dead_code)]
mod firmware;

use firmware::Firmware;

/// Runs a board until it is told to stop, or for a while after the last word; gives it back.
fn begin() -> (Board, thread::JoinHandle<Firmware>) {
    let (mut firmware, path) = Firmware::new().unwrap();
    let far = thread::spawn(move || {
        for _ in 0..500 {
            if firmware.is_stopped() || firmware.step().is_err() {
                break;
            }
        }
        firmware
    });
    (Board::open(&Settings::new([("port", &*path)])).unwrap(), far)
}

fn pass(board: &mut Board, millis: u64) {
    for _ in 0..millis / 10 {
        board.advance(board.now() + Duration::from_millis(10));
    }
}

#[test]
fn commands_go_there_and_sensors_come_back() {
    let (mut board, far) = begin();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.5));
    board.suck(true);
    pass(&mut board, 400);
    let way = board.way();
    assert!(way.ahead.si() > 0.01 && way.turned.si() > 0.02, "{way:?}");
    assert_eq!(board.bumper().value, Ok([false; 2]));
    assert_eq!(board.drop().value, Ok(false));
    board.emergency_stop();
    let far = far.join().unwrap();
    assert!(far.is_stopped());
}

#[test]
fn the_last_resort_needs_nobody_else() {
    let (board, far) = begin();
    let mut resort = board.last_resort().unwrap();
    thread::spawn(move || resort()).join().unwrap();
    assert!(far.join().unwrap().is_stopped());
}

#[test]
fn a_board_that_says_nothing_is_no_reading() {
    let (mut board, far) = begin();
    board.emergency_stop();
    drop(far.join().unwrap());
    thread::sleep(std::time::Duration::from_millis(150));
    assert!(board.bumper().value.is_err() && board.drop().value.is_err());
}

#[test]
fn what_cannot_be_opened_says_why() {
    let why = |settings: &Settings| Board::open(settings).err().unwrap();
    assert!(why(&Settings::default()).contains("'port'"));
    assert!(why(&Settings::new([("port", "/no/such/port")])).contains("/no/such/port"));
}
