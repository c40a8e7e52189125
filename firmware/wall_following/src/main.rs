//! The image of the plan of the paper.
#![no_std]
#![no_main]

afp_macros::plan!("../../plans/wall_following.afp");

/// Where the image starts.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    firmware_wall_following::run(WallFollowing::new())
}
