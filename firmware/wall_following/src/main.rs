//! A plan on bare metal: its whole run time, with devices that do nothing.
//!
//! The test inspects the image instead of running it: no `panic` may be linked, because nothing
//! handles a panic on a robot.
#![no_std]
#![no_main]

mod robot;

use core::hint::black_box;
use core::panic::PanicInfo;

use afp_core::trace::NoTrace;
use afp_core::{Environment, Instant, Scheduler, StillClock, Wake};

use robot::Robot;

afp_macros::plan!("../../plans/wall_following.afp");

/// The entry point: runs the plan to its end, with a step when a component is due.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    let mut robot = Robot::new();
    let mut plan = Scheduler::new(WallFollowing::new());
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
