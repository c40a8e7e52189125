//! Actors that are suspended end where they end without a suspension, or report that the robot was
//! moved.

use afp::quantity::{Angle, AngularSpeed, Length, Speed};
use afp::{Duration, Fault, Instant, Poll, Reading, Resumable};
use vacuum::templates::{self as t, roll, spin, spiral};
use vacuum::{Roll, Spin, Spiral, Way, Wheels};

/// Wheels that turn exactly as commanded.
#[derive(Default)]
struct Floor {
    millis: u64,
    way: Way,
    command: (f64, f64),
}

impl Wheels for Floor {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed) {
        self.command = (speed.si(), turn.si());
    }

    fn way(&self) -> Reading<Way> {
        Reading::valid(self.way, self.now())
    }
}

impl Floor {
    fn now(&self) -> Instant {
        Instant::ZERO + Duration::from_millis(self.millis)
    }

    fn tick(&mut self) {
        let (speed, turn) = self.command;
        self.millis += 10;
        self.way.ahead = self.way.ahead + Length::from_si(speed * 0.01);
        self.way.turned = self.way.turned + Angle::from_si(turn * 0.01);
    }
}

/// The end of an actor that is suspended for ten seconds after each of these polls. The robot is
/// moved meanwhile, by metres and radians.
type Run = fn(&[u32], (f64, f64)) -> Result<Way, Fault>;

macro_rules! run {
    ($actor:ident, $module:ident, $inputs:expr) => {
        |pauses, (ahead, turned)| {
            let mut floor = Floor::default();
            let now = floor.now();
            let mut actor =
                <$actor as afp::Actor<t::$actor, Floor>>::start($inputs, &mut floor, now)?;
            for poll in 0..10_000 {
                if pauses.contains(&poll) {
                    let now = floor.now();
                    Resumable::<t::$actor, Floor>::suspend(&mut actor, &mut floor, now)?;
                    for _ in 0..1000 {
                        assert_eq!(floor.command, (0.0, 0.0), "it drives");
                        floor.tick();
                    }
                    floor.way.ahead = floor.way.ahead + Length::from_si(ahead);
                    floor.way.turned = floor.way.turned + Angle::from_si(turned);
                    let (now, away) = (floor.now(), Duration::from_secs(10));
                    Resumable::<t::$actor, Floor>::resume(&mut actor, &mut floor, now, away)?;
                    assert_eq!(floor.command, (0.0, 0.0), "'resume' drives");
                }
                floor.tick();
                let now = floor.now();
                let polled = afp::Actor::<t::$actor, Floor>::poll(
                    &mut actor,
                    $module::Live {},
                    &mut floor,
                    now,
                )?;
                if let Poll::Ready(_) = polled {
                    return Ok(floor.way);
                }
            }
            panic!("it does not end")
        }
    };
}

fn runs() -> [(&'static str, Run); 3] {
    [
        (
            "Roll",
            run!(Roll, roll, {
                roll::Inputs { distance: Length::from_si(1.0), speed: Speed::from_si(0.25) }
            }),
        ),
        (
            "Spin",
            run!(Spin, spin, {
                spin::Inputs { angle: Angle::from_si(3.0), rate: AngularSpeed::from_si(1.5) }
            }),
        ),
        (
            "Spiral",
            run!(Spiral, spiral, {
                spiral::Inputs { radius: Length::from_si(0.3), speed: Speed::from_si(0.2) }
            }),
        ),
    ]
}

#[test]
fn pauses_do_not_change_the_end() {
    for (name, run) in runs() {
        let end = run(&[], (0.0, 0.0)).expect("it ends");
        let paused = run(&[1, 40, 80, 120, 160], (0.0, 0.0)).expect("it ends");
        let off = (paused.ahead - end.ahead).si().abs();
        let turned = (paused.turned - end.turned).si().to_degrees().abs();
        assert!(off < 0.02 && turned < 2.0, "{name}: {off} m, {turned} deg");
    }
}

#[test]
fn a_robot_that_was_moved_does_not_continue() {
    for (name, run) in runs() {
        for moved in [(0.3, 0.0), (0.0, 0.5)] {
            let fault = run(&[40], moved).map(|_| ()).expect_err(name);
            assert_eq!(fault.code(), "moved-away", "{name}");
        }
    }
}
