//! The image of the paper's plan.
#![no_std]
#![no_main]

afp_macros::plan!("../../plans/wall_following.afp");

/// The entry point.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    firmware_wall_following::run(WallFollowing::new())
}
