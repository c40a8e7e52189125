//! The actors of the toolbox, a file each.

/// Stops the drive on interruption.
macro_rules! halts_when_interrupted {
    () => {
        fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
            env.halt(now);
            Ok(())
        }
    };
}

/// Stops the drive on suspension.
macro_rules! halts_when_suspended {
    () => {
        fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
            env.halt(now);
            Ok(())
        }
    };
}

mod approach_infrared;
mod choose_view;
mod curve;
mod drive;
mod drive_to;
mod find_object;
mod follow_object;
mod follow_path;
mod forward;
mod hold;
mod learn_object;
mod look_around;
#[cfg(test)]
mod resuming;
mod retrace;
mod search_wall;
mod signal;
mod stop;
mod turn;
mod turn_to_infrared;
mod wall_forward;

pub use approach_infrared::ApproachInfrared;
pub use choose_view::ChooseView;
pub use curve::Curve;
pub use drive::Drive;
pub use drive_to::DriveTo;
pub use find_object::FindObject;
pub use follow_object::FollowObject;
pub use follow_path::FollowPath;
pub use forward::Forward;
pub use hold::Hold;
pub use learn_object::LearnObject;
pub use look_around::LookAround;
pub use retrace::Retrace;
pub use search_wall::SearchWall;
pub use signal::Signal;
pub use stop::Stop;
pub use turn::Turn;
pub use turn_to_infrared::TurnToInfrared;
pub use wall_forward::WallForward;
