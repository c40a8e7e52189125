//! The image of a plan that suspends the plan of the paper.
#![no_std]
#![no_main]

afp_macros::plan!("paused.afp");

/// Where the image starts.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    firmware_wall_following::run(Paused::new())
}
