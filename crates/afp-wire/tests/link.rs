//! Two ends of a line, with disturbances between them.

use afp_types::{Duration, Instant};
use afp_wire::{Received, Receiver, Rejected, Sender};
use proptest::prelude::*;
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Command {
    Drive { speed: f64, turn: f64 },
    Name(String),
    Stop,
}

type End = Receiver<64>;
type Heard = Vec<Result<Received<Command>, Rejected>>;

const START: Instant = Instant::ZERO;

fn hear(end: &mut End, bytes: &[u8]) -> Heard {
    bytes.iter().filter_map(|byte| end.receive(*byte, START)).collect()
}

fn hello(end: &mut Sender) -> Vec<u8> {
    end.hello(&mut [0; 64]).unwrap().to_vec()
}

fn send(end: &mut Sender, command: &Command) -> Vec<u8> {
    end.send(command, &mut [0; 64]).unwrap().to_vec()
}

/// Two ends after the hello of the first.
fn connected() -> (Sender, End) {
    let (mut sender, mut receiver) = (Sender::new(1, 3), End::new(3));
    assert_eq!(hear(&mut receiver, &hello(&mut sender)).last(), Some(&Ok(Received::Hello)));
    (sender, receiver)
}

fn message(message: Command, lost: u16) -> Result<Received<Command>, Rejected> {
    Ok(Received::Message { message, lost })
}

#[test]
fn a_frame_has_the_documented_bytes() {
    let (mut sender, _) = connected();
    // Boot id 1, sequence number 1, message, Stop; then the checksum, with the lengths and the end of byte stuffing.
    let bytes = send(&mut sender, &Command::Stop);
    let summed: crc32::Bytes = crc32::of(&[1, 1, 1, 2]);
    assert_eq!(bytes, [&[9, 1, 1, 1, 2], &summed[..], &[0]].concat());
}

/// The checksum, computed bit by bit.
mod crc32 {
    pub type Bytes = [u8; 4];

    pub fn of(bytes: &[u8]) -> Bytes {
        let sum = bytes.iter().fold(u32::MAX, |sum, byte| {
            (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
                let odd = sum & 1 == 1;
                (sum >> 1) ^ if odd { 0xEDB8_8320 } else { 0 }
            })
        });
        (!sum).to_le_bytes()
    }
}

#[test]
fn a_message_before_the_hello_is_rejected() {
    let (mut sender, mut receiver) = (Sender::new(1, 3), End::new(3));
    let first = hear(&mut receiver, &send(&mut sender, &Command::Stop));
    assert_eq!(first, [Err(Rejected::Stranger)]);
}

#[test]
fn another_version_is_rejected_with_its_number() {
    let (mut sender, mut receiver) = (Sender::new(1, 4), End::new(3));
    let rejected = hear(&mut receiver, &hello(&mut sender));
    assert_eq!(rejected, [Err(Rejected::Version { theirs: 4 })]);
    assert!(!receiver.is_connected());
}

#[test]
fn a_restart_is_reported_until_it_is_forgotten() {
    let (_, mut receiver) = connected();
    let mut restarted = Sender::new(9, 3);
    for frame in [hello(&mut restarted), send(&mut restarted, &Command::Stop)] {
        assert_eq!(hear(&mut receiver, &frame), [Err(Rejected::Restarted)]);
    }
    receiver.forget();
    let command = send(&mut restarted, &Command::Stop);
    assert_eq!(hear(&mut receiver, &command), [Err(Rejected::Stranger)]);
    assert_eq!(hear(&mut receiver, &hello(&mut restarted)), [Ok(Received::Hello)]);
}

#[test]
fn lost_and_repeated_frames_are_counted() {
    let (mut sender, mut receiver) = connected();
    let frames: Vec<_> = (0..4).map(|_| send(&mut sender, &Command::Stop)).collect();
    assert_eq!(hear(&mut receiver, &frames[0]), [message(Command::Stop, 0)]);
    assert_eq!(hear(&mut receiver, &frames[3]), [message(Command::Stop, 2)]);
    assert_eq!(hear(&mut receiver, &frames[2]), [Err(Rejected::Repeated)]);
    assert_eq!(hear(&mut receiver, &frames[3]), [Err(Rejected::Repeated)]);
}

#[test]
fn a_frame_that_is_longer_than_the_receiver_accepts_is_damaged() {
    let (mut sender, mut receiver) = connected();
    let mut buffer = [0; 200];
    let long = sender.send(&Command::Name("x".repeat(60)), &mut buffer).unwrap();
    assert_eq!(hear(&mut receiver, long), [Err(Rejected::Damaged)]);
    let frame = send(&mut sender, &Command::Stop);
    assert_eq!(hear(&mut receiver, &frame), [message(Command::Stop, 1)]);
}

#[test]
fn sequence_numbers_wrap_around() {
    let (mut sender, mut receiver) = connected();
    for _ in 0..70_000 {
        let frame = send(&mut sender, &Command::Stop);
        assert_eq!(hear(&mut receiver, &frame), [message(Command::Stop, 0)]);
    }
}

#[test]
fn a_message_that_is_too_long_sends_nothing_and_costs_no_number() {
    let (mut sender, mut receiver) = connected();
    let long = Command::Name("x".repeat(60));
    assert!(sender.send(&long, &mut [0; 64]).is_err());
    assert!(sender.send(&Command::Stop, &mut [0; 4]).is_err());
    let frame = send(&mut sender, &Command::Stop);
    assert_eq!(hear(&mut receiver, &frame), [message(Command::Stop, 0)]);
}

#[test]
fn silence_is_measured_from_the_last_frame_that_counts() {
    let (mut sender, mut receiver) = connected();
    let (at, limit) = (|ms| START + Duration::from_millis(ms), Duration::from_millis(200));
    assert!(!receiver.is_silent(at(200), limit));
    assert!(receiver.is_silent(at(201), limit));
    for byte in send(&mut sender, &Command::Stop) {
        let _ = receiver.receive::<Command>(byte, at(150));
    }
    let _ = receiver.receive::<Command>(7, at(300));
    let _ = receiver.receive::<Command>(0, at(300));
    assert!(!receiver.is_silent(at(350), limit) && receiver.is_silent(at(351), limit));
    assert!(End::new(3).is_silent(START, limit), "never heard");
}

/// Byte stuffing with zeros at every place, up to the longest frame.
#[test]
fn frames_of_every_length_arrive_and_longer_frames_are_refused() {
    for length in 0..400 {
        for zero in [0, 1, 7, 400] {
            let mut sender = Sender::new(1, 3);
            let mut receiver = Receiver::<512>::new(3);
            let mut buffer = [0; 512];
            for byte in sender.hello(&mut buffer).unwrap() {
                let _ = receiver.receive::<Vec<u8>>(*byte, START);
            }
            let bytes: Vec<u8> = (0..length)
                .map(|at: usize| u8::from(zero == 0 || !at.is_multiple_of(zero)))
                .collect();
            let Ok(frame) = sender.send(&bytes, &mut buffer) else {
                assert!(length > 240, "{length}");
                continue;
            };
            assert!(frame.len() <= 255 && !frame[..frame.len() - 1].contains(&0));
            let heard = frame.iter().filter_map(|byte| receiver.receive::<Vec<u8>>(*byte, START));
            let expected = Ok(Received::Message { message: bytes.clone(), lost: 0 });
            assert_eq!(heard.collect::<Vec<_>>(), [expected]);
        }
    }
}

fn command() -> impl Strategy<Value = Command> {
    prop_oneof![
        (any::<f64>(), any::<f64>()).prop_filter_map("NaN equals nothing", |(speed, turn)| {
            (!speed.is_nan() && !turn.is_nan()).then_some(Command::Drive { speed, turn })
        }),
        "[a-z]{0,20}".prop_map(Command::Name),
        Just(Command::Stop),
    ]
}

proptest! {
    #[test]
    fn each_command_arrives_unchanged(commands in prop::collection::vec(command(), 1..20)) {
        let (mut sender, mut receiver) = connected();
        let line: Vec<u8> =
            commands.iter().flat_map(|command| send(&mut sender, command)).collect();
        let expected: Heard = commands.into_iter().map(|command| message(command, 0)).collect();
        prop_assert_eq!(hear(&mut receiver, &line), expected);
    }

    /// One changed, lost or added byte costs at most the two frames that it touches, and the number of lost frames is right.
    #[test]
    fn a_disturbance_loses_only_its_frames(
        commands in prop::collection::vec(command(), 4..8),
        place in any::<prop::sample::Index>(),
        byte in any::<u8>(),
        how in 0..3,
    ) {
        let (mut sender, mut receiver) = connected();
        let mut line: Vec<u8> =
            commands.iter().flat_map(|command| send(&mut sender, command)).collect();
        let at = place.index(line.len());
        match how {
            0 => line[at] = byte,
            1 => drop(line.remove(at)),
            _ => line.insert(at, byte),
        }
        let mut next = 0;
        for heard in hear(&mut receiver, &line) {
            match heard {
                Ok(Received::Message { message, lost }) => {
                    next += usize::from(lost);
                    prop_assert_eq!(&message, &commands[next]);
                    next += 1;
                }
                other => prop_assert_eq!(other, Err(Rejected::Damaged)),
            }
        }
        prop_assert!(next + 2 >= commands.len());
    }

    #[test]
    fn random_bytes_are_not_a_message(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let (mut sender, mut receiver) = connected();
        for heard in hear(&mut receiver, &bytes) {
            prop_assert_eq!(heard, Err(Rejected::Damaged));
        }
        // An end clears the rest, and the line works again.
        hear(&mut receiver, &[0]);
        let frame = send(&mut sender, &Command::Stop);
        prop_assert_eq!(hear(&mut receiver, &frame), [message(Command::Stop, 0)]);
    }
}
