//! The robot over its serial line, with a stand-in at the other end.

use std::fs::File;
use std::io::{Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::thread;

use afp::core::{Invalid, Platform};
use afp::quantity::{AngularSpeed, Speed};
use afp::{Duration, Environment};
use afp_platform::{Hardware, Settings};
use afp_wire::{Received, Receiver, Sender};
use vacuum::{Nozzle, Senses, Wheels};
use vacuum_board::Board;
use vacuum_protocol::{Command, LONGEST, Report, VERSION};

#[path = "../examples/firmware.rs"]
#[allow(dead_code)]
mod firmware;

use firmware::Firmware;

/// Runs a board until it receives `Stop`, or for a while after the last message; returns it.
fn begin() -> (Board, thread::JoinHandle<Firmware>) {
    let (firmware, path) = Firmware::new().unwrap();
    opened(firmware, &path)
}

fn opened(mut firmware: Firmware, path: &str) -> (Board, thread::JoinHandle<Firmware>) {
    let far = thread::spawn(move || {
        let mut has_started = false;
        for _ in 0..500 {
            if has_started && firmware.is_stopped() || firmware.step().is_err() {
                break;
            }
            has_started |= !firmware.is_stopped();
        }
        firmware
    });
    (Board::open(&Settings::new([("port", path)])).unwrap(), far)
}

fn pass(board: &mut Board, millis: u64) {
    for _ in 0..millis / 10 {
        board.advance(board.now() + Duration::from_millis(10));
    }
}

#[test]
fn commands_and_reports_arrive() {
    let (mut board, far) = begin();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.5));
    board.suck(true);
    pass(&mut board, 400);
    let way = board.way().value.unwrap();
    assert!(way.ahead.si() > 0.01 && way.turned.si() > 0.02, "{way:?}");
    assert_eq!(board.bumper().value, Ok([false; 2]));
    assert_eq!(board.drop().value, Ok(false));
    board.emergency_stop();
    let far = far.join().unwrap();
    assert!(far.is_stopped());
}

#[test]
fn an_unread_line_blocks_nothing_and_a_stop_overtakes() {
    let (mut port, _end, path) = Firmware::port().unwrap();
    let mut says = port.try_clone().unwrap();
    let says = thread::spawn(move || {
        let mut sender = Sender::new(1, VERSION);
        for _ in 0..20 {
            thread::sleep(std::time::Duration::from_millis(10));
            says.write_all(sender.hello(&mut [0; LONGEST]).unwrap()).unwrap();
            let report = Report::default();
            says.write_all(sender.send(&report, &mut [0; LONGEST]).unwrap()).unwrap();
        }
    });
    let mut board = Board::open(&Settings::new([("port", &*path)])).unwrap();
    says.join().unwrap();
    full(&path);
    let began = std::time::Instant::now();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    pass(&mut board, 100);
    board.emergency_stop();
    assert!(began.elapsed().as_secs_f64() < 5.0, "{:?}", began.elapsed());
    // This end of a terminal may already hold some bytes.
    let (mut receiver, mut told) = (Receiver::<LONGEST>::new(VERSION), 0);
    let mut heard = None;
    while heard != Some(Ok(Received::Message { message: Command::Stop, lost: 0 })) {
        let mut part = [0; 1 << 12];
        let read = port.read(&mut part).unwrap();
        for byte in &part[..read] {
            let received = receiver.receive::<Command>(*byte, afp::Instant::ZERO);
            heard = received.map(|frame| frame.map(without_losses)).or(heard);
        }
        told += read;
        assert!(told < 20_000, "it waits behind earlier commands");
    }
}

fn without_losses(received: Received<Command>) -> Received<Command> {
    match received {
        Received::Message { message, .. } => Received::Message { message, lost: 0 },
        Received::Hello => Received::Hello,
    }
}

/// Writes bytes to a port.
fn tell(path: &str, bytes: &[u8]) {
    File::options().write(true).open(path).unwrap().write_all(bytes).unwrap();
}

/// Writes to a port until its buffer is full.
fn full(path: &str) {
    let flags = rustix::fs::OFlags::NONBLOCK.bits() as i32;
    let mut port = File::options().write(true).custom_flags(flags).open(path).unwrap();
    while port.write(&[7; LONGEST]).is_ok() {}
}

#[test]
fn an_incomplete_command_does_not_count() {
    let (mut firmware, path) = Firmware::new().unwrap();
    let mut sender = Sender::new(5, VERSION);
    let hello = sender.hello(&mut [0; LONGEST]).unwrap().to_vec();
    let drive = Command::Drive { speed: 0.2, turn: -1.0 };
    let frame = sender.send(&drive, &mut [0; LONGEST]).unwrap().to_vec();
    tell(&path, &[&hello[..], &frame[..frame.len() / 2]].concat());
    let far = thread::spawn(move || (0..10).for_each(|_| drop(firmware.step().unwrap())));
    let board = Board::open(&Settings::new([("port", &*path)])).unwrap();
    let way = board.way().value.unwrap();
    far.join().unwrap();
    assert_eq!((way.ahead.si(), way.turned.si()), (0.0, 0.0));
}

#[test]
fn a_board_that_restarts_is_reported_by_name_and_is_not_driven() {
    for stopped in [true, false] {
        let (mut firmware, path) = Firmware::new().unwrap();
        let far = thread::spawn(move || {
            (0..10).for_each(|_| drop(firmware.step().unwrap()));
            let moved = firmware.is_moving();
            firmware.restart(stopped);
            let after: Vec<_> = (0..20).flat_map(|_| firmware.step().unwrap()).collect();
            (moved, after, firmware)
        });
        let mut board = Board::open(&Settings::new([("port", &*path)])).unwrap();
        board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
        while !far.is_finished() {
            pass(&mut board, 10);
        }
        let (moved, after, firmware) = far.join().unwrap();
        assert!(moved && !firmware.is_moving() && firmware.is_stopped());
        // Commands from before the first report may still arrive; none follows the `Stop`.
        let stop =
            after.iter().position(|command| *command == Command::Stop).unwrap_or(after.len());
        assert!(
            !after[stop..].iter().any(|command| matches!(command, Command::Drive { .. })),
            "{after:?}"
        );
        assert_eq!(board.bumper().value, Err(Invalid::Restarted));
        assert_eq!(board.way().value, Err(Invalid::Restarted));
    }
}

#[test]
fn a_stop_overtakes_waiting_commands() {
    let (firmware, path) = Firmware::new().unwrap();
    let (mut board, far) = opened(firmware, &path);
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    pass(&mut board, 100);
    full(&path);
    board.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0));
    board.emergency_stop();
    assert!(!far.join().unwrap().is_moving());
}

#[test]
fn a_jump_of_time_is_not_silence() {
    let (mut board, far) = begin();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    board.advance(board.now() + Duration::from_secs(1));
    let way = board.way().value.unwrap();
    assert!(way.ahead.si() > 0.1, "{way:?}");
    board.emergency_stop();
    far.join().unwrap();
}

#[test]
fn a_plan_stops_the_motors_and_another_may_follow() {
    let (mut firmware, path) = Firmware::new().unwrap();
    let far = thread::spawn(move || {
        let all = (0..50).flat_map(|_| firmware.step().unwrap()).collect::<Vec<_>>();
        (all, firmware.is_moving())
    });
    let mut board = Board::open(&Settings::new([("port", &*path)])).unwrap();
    board.suck(true);
    pass(&mut board, 100);
    board.stop(board.now());
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    while !far.is_finished() {
        pass(&mut board, 10);
    }
    let (told, moves) = far.join().unwrap();
    let off = told.iter().position(|command| *command == Command::Suck(false));
    let drives =
        told.iter().position(|command| matches!(command, Command::Drive { speed: 0.2, .. }));
    assert!(off.is_some() && off < drives && moves, "{told:?}");
}

#[test]
fn dropping_a_robot_stops_it() {
    let (mut board, far) = begin();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    pass(&mut board, 100);
    drop(board);
    assert!(far.join().unwrap().is_stopped());
}

#[test]
fn dropped_boards_stop_listening() {
    let (mut firmware, path) = Firmware::new().unwrap();
    let far = thread::spawn(move || (0..75).for_each(|_| drop(firmware.step().unwrap())));
    let settings = Settings::new([("port", &*path)]);
    for _ in 0..8 {
        drop(Board::open(&settings).unwrap());
    }
    let mut board = Board::open(&settings).unwrap();
    for _ in 0..80 {
        pass(&mut board, 10);
        assert!(board.bumper().value.is_ok(), "another one took what the board said");
    }
    far.join().unwrap();
}

#[test]
fn a_run_after_a_stop_begins_with_start() {
    let (mut firmware, path) = Firmware::new().unwrap();
    let far = thread::spawn(move || {
        let mut stops = 0;
        for _ in 0..60 {
            let told = firmware.step().unwrap();
            stops += told.iter().filter(|command| **command == Command::Stop).count();
        }
        stops
    });
    let settings = Settings::new([("port", &*path)]);
    let mut board = Board::open(&settings).unwrap();
    board.emergency_stop();
    drop(board);
    let mut board = Board::open(&settings).unwrap();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    pass(&mut board, 200);
    let way = board.way().value.unwrap();
    assert!(way.ahead.si() > 0.005, "{way:?}");
    // The first run stops it, and so does the hello of the second one, which has no other effect.
    assert_eq!(far.join().unwrap(), 1);
}

#[test]
fn a_repeated_command_counts_once() {
    let (mut firmware, path) = Firmware::new().unwrap();
    let mut sender = Sender::new(5, VERSION);
    let mut bytes = sender.hello(&mut [0; LONGEST]).unwrap().to_vec();
    for _ in 0..2 {
        bytes.extend(sender.send(&Command::Start, &mut [0; LONGEST]).unwrap());
    }
    tell(&path, &bytes);
    thread::sleep(std::time::Duration::from_millis(100));
    assert_eq!(firmware.step().unwrap(), [Command::Start]);
}

#[test]
fn start_is_repeated_until_the_board_obeys() {
    let (mut port, _end, path) = Firmware::port().unwrap();
    let mut line = port.try_clone().unwrap();
    let far = thread::spawn(move || {
        let (mut sender, mut receiver) =
            (Sender::new(1, VERSION), Receiver::<LONGEST>::new(VERSION));
        let (mut starts, mut byte) = (0, [0]);
        while line.read(&mut byte).is_ok_and(|read| read == 1) {
            let heard = receiver.receive::<Command>(byte[0], afp::Instant::ZERO);
            match heard {
                Some(Ok(Received::Hello)) => {
                    port.write_all(sender.hello(&mut [0; LONGEST]).unwrap()).unwrap();
                }
                Some(Ok(Received::Message { message, .. })) => {
                    starts += u32::from(message == Command::Start);
                    // It obeys only the third one.
                    let report = Report { stopped: starts < 3, ..Report::default() };
                    port.write_all(sender.send(&report, &mut [0; LONGEST]).unwrap()).unwrap();
                    if message == Command::Stop {
                        break;
                    }
                }
                _ => {}
            }
        }
        starts
    });
    let mut board = Board::open(&Settings::new([("port", &*path)])).unwrap();
    board.emergency_stop();
    assert!(far.join().unwrap() >= 3);
}

#[test]
fn a_board_must_start_and_have_the_right_version() {
    for (version, text) in [(VERSION, "start"), (VERSION + 1, "version")] {
        let (mut port, _end, path) = Firmware::port().unwrap();
        let far = thread::spawn(move || {
            let mut sender = Sender::new(1, version);
            (0..70).for_each(|_| {
                thread::sleep(std::time::Duration::from_millis(20));
                port.write_all(sender.hello(&mut [0; LONGEST]).unwrap()).unwrap();
                let stopped = Report { stopped: true, ..Report::default() };
                port.write_all(sender.send(&stopped, &mut [0; LONGEST]).unwrap()).unwrap();
            });
        });
        let why = Board::open(&Settings::new([("port", &*path)])).err().unwrap().to_string();
        assert!(why.contains(text), "{why}");
        far.join().unwrap();
    }
}

#[test]
fn a_board_that_has_stopped_by_itself_obeys_after_the_next_start() {
    let (mut firmware, path) = Firmware::new().unwrap();
    let far = thread::spawn(move || {
        let mut moved = Vec::new();
        for _ in 0..60 {
            firmware.step().unwrap();
            moved.push(firmware.is_moving());
        }
        moved
    });
    let settings = Settings::new([("port", &*path)]);
    let mut board = Board::open(&settings).unwrap();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    pass(&mut board, 100);
    // The program is held up.
    thread::sleep(std::time::Duration::from_millis(400));
    pass(&mut board, 200);
    assert_eq!(board.bumper().value, Err(Invalid::NoAnswer));
    drop(board);
    let mut board = Board::open(&settings).unwrap();
    assert!(board.bumper().value.is_ok());
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    pass(&mut board, 100);
    while !far.is_finished() {
        pass(&mut board, 10);
    }
    let moved = far.join().unwrap();
    let changes = moved.windows(2).filter(|pair| pair[0] != pair[1]).count();
    // It drives, stops by itself, and drives again with the second program.
    assert_eq!((changes, moved.last()), (3, Some(&true)), "{moved:?}");
}

#[test]
fn the_last_resort_works_by_itself() {
    let (board, far) = begin();
    thread::spawn(board.last_resort().unwrap()).join().unwrap();
    assert!(far.join().unwrap().is_stopped());
}

#[test]
fn a_silent_board_gives_no_reading() {
    let (mut board, far) = begin();
    board.emergency_stop();
    drop(far.join().unwrap());
    thread::sleep(std::time::Duration::from_millis(150));
    assert!(board.bumper().value.is_err() && board.drop().value.is_err());
}

#[test]
fn a_board_without_a_reply_line_stops() {
    let (mut firmware, path) = Firmware::new().unwrap();
    let far = thread::spawn(move || {
        for _ in 0..20 {
            firmware.step().unwrap();
        }
        let moved = firmware.is_moving();
        firmware.mute();
        for _ in 0..20 {
            firmware.step().unwrap();
        }
        (moved, firmware)
    });
    let mut board = Board::open(&Settings::new([("port", &*path)])).unwrap();
    board.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0));
    board.suck(true);
    while !far.is_finished() {
        pass(&mut board, 10);
    }
    let (moved, firmware) = far.join().unwrap();
    assert!(moved && !firmware.is_moving());
    assert!(board.bumper().value.is_err());
}

#[test]
fn a_failed_open_is_explained() {
    let why = |settings: &Settings| Board::open(settings).err().unwrap().to_string();
    assert!(why(&Settings::default()).contains("'port'"));
    assert!(why(&Settings::new([("port", "/no/such/port")])).contains("/no/such/port"));
    assert!(why(&Settings::new([("port", "/dev/null"), ("baud", "9600")])).contains("38400"));
    let (firmware, port) = Firmware::new().unwrap();
    let (board, far) = opened(firmware, &port);
    let other = why(&Settings::new([("port", &*port)]));
    assert!(other.contains("has it open"), "{other}");
    drop(board);
    far.join().unwrap();
}
