//! Plans on bare metal: their whole run time, with devices that do nothing.
//!
//! The test inspects the images instead of running them: no `panic` may be linked, because nothing
//! handles a panic on a robot.
#![no_std]

mod robot;

use core::hint::black_box;
use core::panic::PanicInfo;

use afp_core::rt::Plan;
use afp_core::trace::NoTrace;
use afp_core::{Environment, Instant, Scheduler, StillClock, Wake};

pub use robot::Robot;

/// Runs a plan to its end, stepping whenever something is due.
pub fn run<P: Plan<Robot>>(plan: P) -> ! {
    let mut robot = Robot::new();
    let mut plan = Scheduler::new(plan);
    let started = plan.start((&mut robot, &mut NoTrace, &StillClock), timer());
    let mut wake = started.unwrap_or(Wake::At(Instant::ZERO));
    while let Wake::At(due) = wake {
        let now = timer();
        if black_box(robot.stop_requested) {
            plan.request_stop();
        }
        if now >= due {
            wake = plan.step((&mut robot, &mut NoTrace, &StillClock), now);
        }
    }
    robot.emergency_stop();
    loop {
        core::hint::spin_loop();
    }
}

/// The time of a counter that the compiler knows nothing about.
fn timer() -> Instant {
    Instant::from_nanos(black_box(0))
}

/// Never linked: the gate sees to that.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
