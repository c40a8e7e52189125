//! Bytes and commands for the controller of a drive, and bytes of controllers.

use afp_core::Instant;
use afp_drive::{Command, Controller, Inputs, LONGEST, Report, STEP, Setup, VERSION};
use afp_pi::Reports;
use afp_wire::{COMMAND_TIMEOUT, Receiver, Sender};

/// The motors' power is always valid, and zero after silence.
pub fn controller(data: &[u8]) {
    let mut controller = Controller::new(1);
    let mut now = Instant::ZERO;
    data.iter().for_each(|byte| controller.receive(*byte, now));
    controller.receive(0, now);
    let mut computer = Sender::new(7, VERSION);
    let mut buffer = [0; LONGEST];
    for byte in computer.hello(&mut buffer).unwrap() {
        controller.receive(*byte, now);
    }
    let mut step = |controller: &mut Controller, counts| {
        now += STEP;
        let ping = Some(Some(counts as f32));
        let inputs = Inputs { counts: [counts, counts / 3], ping, ..Inputs::default() };
        let power = controller.step(&inputs, now).power;
        assert!(power.iter().all(|it| (-1.0..=1.0).contains(it)), "{power:?}");
        controller.transmit(now, &mut [0; 2 * LONGEST]);
        (power, now)
    };
    let mut now = Instant::ZERO;
    for chunk in data.chunks_exact(9) {
        let frame = computer.send(&command(chunk), &mut buffer).unwrap();
        frame.iter().for_each(|byte| controller.receive(*byte, now));
        now = step(&mut controller, i32::from_le_bytes(four(&chunk[5..]))).1;
    }
    let steps = COMMAND_TIMEOUT.as_nanos() / STEP.as_nanos() + 1;
    let last = (0..steps).map(|_| step(&mut controller, 0).0).last();
    assert_eq!(last, Some([0.0; 2]));
}

/// Every report of a UGV's bytes is possible, and the next whole line is a report, unless a counter
/// has jumped. A second controller may send the same bytes.
pub fn ugv(data: &[u8]) {
    let mut reports = Reports::new(&Setup::default());
    let mut receiver = Receiver::<LONGEST>::new(VERSION);
    for byte in data {
        assert!(reports.take(*byte).is_none_or(|report| report.is_possible()));
        let _ = receiver.receive::<Report>(*byte, Instant::ZERO);
    }
    let mut last = None;
    for byte in b"\n{\"T\":1001,\"L\":0.1,\"R\":0.1,\"odl\":1,\"odr\":1}\n" {
        last = reports.take(*byte);
    }
    assert!(last.is_some_and(|report| report.speed == 0.1) || reports.has_restarted());
}

/// A command, possible or not.
fn command(chunk: &[u8]) -> Command {
    let [a, b] = [&chunk[1..], &chunk[5..]].map(|bytes| f32::from_le_bytes(four(bytes)));
    match chunk[0] % 6 {
        0 => Command::Setup(Setup { track: a, metres_per_tick: [b, a], ..Setup::default() }),
        1 => Command::Setup(Setup { fastest: a, ramp: b, ..Setup::default() }),
        2 => Command::Drive { speed: a, turn: b },
        3 => Command::Point(a),
        4 => Command::Start,
        _ => Command::Stop,
    }
}

fn four(bytes: &[u8]) -> [u8; 4] {
    [bytes[0], bytes[1], bytes[2], bytes[3]]
}
