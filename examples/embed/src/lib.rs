//! A foreign Rust program that embeds plans.
//!
//! It owns the platform ([`shop::Shop`]) and the time. It sets entries before a plan starts and
//! while it runs, reads them, subscribes to what happens, and is called back from a template.

mod shop;

use afp::quantity::{Angle, Length};
use afp::trace::{NoTrace, Observe, Record};
use afp::{Duration, Instant, NamedPlan, Platform, Scheduler, Wake, trace::Names};
use afp_sim::{Simulation, World};

pub use shop::{Announce, Loudspeaker, Shop, templates};

afp::plan!("../../plans/wall_following.afp");
afp::plan!("plans/errands.afp");

use errands::errand::Errand;

/// An error of any part, for people.
pub type Error = Box<dyn std::error::Error>;

/// What following the wall told.
pub struct Followed {
    /// The last angle to a wall that the plan found.
    pub wall_angle: Option<Angle>,
    /// Activations of actors, as `time path`.
    pub activations: Vec<String>,
}

/// Puts the robot into a room.
///
/// # Errors
/// A room that cannot be.
pub fn open(room: &str, seed: u64) -> Result<Shop, Error> {
    let robot = Simulation::new(&World::parse(room)?, seed)?;
    Ok(Shop { robot, announced: Vec::new() })
}

/// Follows the wall at a distance for some time, then farther away for as long again.
///
/// # Errors
/// A distance that is no number.
pub fn follow(
    shop: &mut Shop,
    walldist: Length,
    farther: Length,
    seconds: u64,
) -> Result<Followed, Error> {
    let plan = WallFollowing::new();
    let names = plan.names();
    let mut activations = Vec::new();
    let mut subscriber = Observe(|at: Instant, record: &Record<'_>| {
        if let Record::Started { component } = record {
            let path = names.component(*component).path;
            activations.push(format!("{:.3} {path}", at.as_secs_f64()));
        }
    });
    let half = Duration::from_secs(seconds);
    let mut plan = Scheduler::new(plan);
    plan.set(WallFollowing::WALLDIST, walldist)?;
    let middle = shop.now() + half;
    plan.run_until(shop, &mut subscriber, middle)?;
    // A running plan is written to in the same way; the next step commits it.
    plan.set(WallFollowing::WALLDIST, farther)?;
    plan.run_until(shop, &mut subscriber, middle + half)?;
    let wall_angle = plan.plan().wallangle();
    plan.request_stop();
    plan.run_until(shop, &mut NoTrace, middle + half)?;
    Ok(Followed { wall_angle, activations })
}

/// Fetches things: a plan with a sub-plan, whose last actor calls the shop.
///
/// # Errors
/// A number that does not fit.
pub fn fetch(shop: &mut Shop, things: i64) -> Result<Wake, Error> {
    let mut plan = Scheduler::new(Errands::new());
    plan.set(Errands::THINGS, things)?;
    drive(shop, plan)
}

/// One errand alone: the sub-plan started by itself.
///
/// # Errors
/// A way that is no number.
pub fn errand(shop: &mut Shop, way: Length) -> Result<Wake, Error> {
    let mut plan = Scheduler::new(Errand::new());
    plan.set(Errand::WAY, way)?;
    drive(shop, plan)
}

/// Drives a plan to its end, at most two minutes from now on.
fn drive<P: afp::Plan<Shop>>(shop: &mut Shop, mut plan: Scheduler<P>) -> Result<Wake, Error> {
    let until = shop.now() + Duration::from_secs(120);
    Ok(plan.run_until(shop, &mut NoTrace, until)?)
}
