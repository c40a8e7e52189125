//! Waits, by a plan compiled in and by the same plan loaded.

use std::time;

use afp::load::{Library, Templates};
use afp::quantity::Time;
use afp::{Callbacks, Duration, Environment, Instant, Platform, Scheduler, StillClock};

// Compiles the plan into the program: the type `Patience`.
afp::plan!("examples/patience.afp");

/// A robot without devices: time passes, and nothing needs to stop.
struct Board(time::Instant);

impl Environment for Board {
    fn stop(&mut self, _: Instant) {}
    fn emergency_stop(&mut self) {}
}

impl Platform for Board {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    fn now(&self) -> Instant {
        Instant::ZERO + Duration::from_nanos(self.0.elapsed().as_nanos() as u64)
    }

    fn advance(&mut self, to: Instant) {
        std::thread::sleep(to.since(self.now()).into());
    }
}

/// Templates for this robot.
impl Templates for Board {
    fn add_to(library: &mut Library<Self>) {
        library.register(afp_std::templates::register);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut board = Board(time::Instant::now());

    // Compiled in: entries have types.
    let mut plan = Scheduler::new(Patience::new());
    plan.set(Patience::PAUSE, Time::from_si(0.02))?;
    println!("{:?}", plan.run(&mut board)?);

    // Loaded: entries have names, and so has what happens.
    let mut plan = afp::load("examples/patience.afp")?;
    plan.set_named("pause", "20 ms")?;
    let mut calls = Callbacks::new(plan.plan()).on_start("wait", |at| println!("{at} waits"))?;
    plan.run_until(&mut board, &mut calls, Instant::MAX)?;

    // The failed component and its fault, if any.
    if let Some(failure) = plan.failure() {
        println!("{}", failure.named(&afp::NamedPlan::names(plan.plan())));
    }
    Ok(())
}
