//! Tests of the controller: motion, dead-man, restart and impossible commands.

use std::vec::Vec;

use super::*;

/// A controller on a line, and motors that turn as commanded.
struct Bench {
    controller: Controller,
    computer: Sender,
    listener: Receiver<LONGEST>,
    now: Instant,
    /// The distances of the rims, in metres.
    ways: [f32; 2],
    /// Whether the wheels are held.
    held: bool,
    power: [f32; 2],
    reports: Vec<Report>,
}

impl Bench {
    fn new() -> Self {
        Bench {
            controller: Controller::new(3),
            computer: Sender::new(7, VERSION),
            listener: Receiver::new(VERSION),
            now: Instant::ZERO,
            ways: [0.0; 2],
            held: false,
            power: [0.0; 2],
            reports: Vec::new(),
        }
    }

    fn started() -> Self {
        let mut bench = Bench::new();
        bench.hello();
        bench.send(Command::Setup(Setup::default()));
        bench.send(Command::Start);
        bench
    }

    fn hello(&mut self) {
        let mut buffer = [0; LONGEST];
        let frame = self.computer.hello(&mut buffer).unwrap();
        frame.iter().for_each(|byte| self.controller.receive(*byte, self.now));
    }

    fn send(&mut self, command: Command) {
        let mut buffer = [0; LONGEST];
        let frame = self.computer.send(&command, &mut buffer).unwrap();
        frame.iter().for_each(|byte| self.controller.receive(*byte, self.now));
    }

    fn step(&mut self) {
        self.now += STEP;
        let setup = Setup::default();
        let counts = self.ways.map(|way| (way / setup.metres_per_tick[0]) as i32);
        let inputs = Inputs { counts, bumper: true, button: true, ping: None };
        self.power = self.controller.step(&inputs, self.now).power;
        if !self.held {
            for (way, power) in self.ways.iter_mut().zip(self.power) {
                // The motors are a tenth weaker than the setup says.
                *way += power * setup.fastest * 0.01;
            }
        }
        let mut buffer = [0; 2 * LONGEST];
        for byte in self.controller.transmit(self.now, &mut buffer) {
            if let Some(Ok(Received::Message { message, .. })) =
                self.listener.receive::<Report>(*byte, self.now)
            {
                self.reports.push(message);
            }
        }
    }

    /// Steps, with a command before every second step.
    fn drive(&mut self, speed: f32, turn: f32, steps: usize) {
        for step in 0..steps {
            if step % 2 == 0 {
                self.send(Command::Drive { speed, turn });
            }
            self.step();
        }
    }

    fn report(&self) -> Report {
        *self.reports.last().unwrap()
    }
}

#[test]
fn it_drives_the_commanded_path_and_reports_it() {
    let mut bench = Bench::started();
    bench.drive(0.2, 0.0, 500);
    bench.drive(0.0, 0.0, 40);
    let report = bench.report();
    assert!((report.pose[0] - 1.0).abs() < 0.02, "{report:?}");
    assert_eq!((report.speed, report.turn, report.stopped), (0.0, 0.0, false));
    assert!(!report.bumper && !report.button);
    let steps = bench.reports.windows(2).map(|two| two[1].pose[0] - two[0].pose[0]);
    assert!(steps.fold(0.0, f64::max) < 0.012, "no report is missing");
    bench.drive(0.0, 1.0, 300);
    let [x, _, heading] = bench.report().pose;
    assert!((heading - 3.0).abs() < 0.1 && (x - 1.0).abs() < 0.05, "{heading} {x}");
}

#[test]
fn it_stops_from_top_speed_within_its_ramp() {
    let mut bench = Bench::started();
    bench.drive(9.0, 0.0, 100);
    assert!(bench.report().speed > 0.4, "{:?}", bench.report());
    bench.drive(0.0, 0.0, 16);
    assert_eq!(bench.power, [0.0; 2]);
}

#[test]
fn it_stops_by_itself_without_commands_and_waits_for_a_start() {
    let mut bench = Bench::started();
    bench.drive(0.2, 0.0, 50);
    assert_ne!(bench.power, [0.0; 2]);
    for _ in 0..=20 {
        bench.step();
    }
    assert!(bench.controller.is_stopped() && bench.power == [0.0; 2]);
    bench.drive(0.2, 0.0, 10);
    assert!(bench.power == [0.0; 2] && bench.report().stopped);
    bench.send(Command::Start);
    bench.drive(0.2, 0.0, 10);
    assert_ne!(bench.power, [0.0; 2]);
}

#[test]
fn a_stop_and_another_program_cut_the_power_at_once() {
    let mut bench = Bench::started();
    bench.drive(0.2, 0.0, 50);
    bench.send(Command::Stop);
    bench.step();
    assert_eq!(bench.power, [0.0; 2]);
    let mut bench = Bench::started();
    bench.drive(0.2, 0.0, 50);
    bench.computer = Sender::new(8, VERSION);
    bench.hello();
    bench.drive(0.2, 0.0, 2);
    assert_eq!(bench.power, [0.0; 2]);
}

#[test]
fn nothing_moves_before_hello_setup_and_start() {
    let mut bench = Bench::new();
    bench.drive(0.2, 0.0, 10);
    bench.hello();
    bench.send(Command::Start);
    bench.drive(0.2, 0.0, 10);
    bench.send(Command::Setup(Setup { track: f32::NAN, ..Setup::default() }));
    bench.send(Command::Start);
    bench.drive(0.2, 0.0, 10);
    bench.send(Command::Setup(Setup::default()));
    bench.drive(0.2, 0.0, 10);
    assert!(bench.ways == [0.0; 2] && bench.controller.is_stopped());
    bench.send(Command::Drive { speed: f32::NAN, turn: 0.0 });
    bench.send(Command::Start);
    bench.drive(0.2, 0.0, 10);
    assert!(bench.ways[0] > 0.0);
}

#[test]
fn a_held_wheel_does_not_spin_later() {
    let mut bench = Bench::started();
    bench.held = true;
    bench.drive(0.2, 0.0, 300);
    bench.held = false;
    let before = bench.ways;
    bench.drive(0.2, 0.0, 100);
    let driven = bench.ways[0] - before[0];
    assert!(driven < 0.2 + 0.03, "{driven}");
}

#[test]
fn a_ping_has_its_bearing_and_age() {
    let mut bench = Bench::started();
    bench.send(Command::Point(0.5));
    let inputs = Inputs { ping: Some(Some(1.25)), ..Inputs::default() };
    bench.now += STEP;
    bench.controller.step(&inputs, bench.now);
    (0..6).for_each(|_| bench.step());
    let ping = bench.report().ping.unwrap();
    assert_eq!((ping.distance, ping.bearing), (Some(1.25), 0.5));
    assert!((30..=60).contains(&ping.age), "{}", ping.age);
}

#[test]
fn garbage_and_broken_frames_change_nothing() {
    let mut bench = Bench::started();
    bench.drive(0.2, 0.0, 10);
    for n in 0..2000_u32 {
        let byte = (n.wrapping_mul(2_654_435_761) >> 13) as u8;
        bench.controller.receive(byte, bench.now);
    }
    bench.controller.receive(0, bench.now);
    bench.drive(0.2, 0.0, 10);
    assert!(!bench.controller.is_stopped() && bench.power[0] > 0.0);
}
