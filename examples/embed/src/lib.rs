//! A Rust program that embeds plans.
//!
//! It owns the platform ([`shop::Shop`]) and the time. It sets entries before and during a run,
//! reads them, subscribes to events, and is called from a template.

mod shop;

use afp::quantity::{Angle, Length};
use afp::trace::{NoTrace, Observe, Record};
use afp::{Duration, Instant, NamedPlan, Platform, Scheduler, Wake, trace::Names};
use afp_sim::{Simulation, World};

pub use shop::{Announce, Loudspeaker, Shop, templates};

afp::plan!("../../plans/wall_following.afp");
afp::plan!("plans/errands.afp");

use errands::errand::Errand;

/// Any error, for display.
pub type Error = Box<dyn std::error::Error>;

/// The results of wall following.
pub struct Followed {
    /// The last wall angle that the plan found.
    pub wall_angle: Option<Angle>,
    /// Activations of actors, as `time path`.
    pub activations: Vec<String>,
}

/// Puts the robot into a room.
///
/// # Errors
/// The room is invalid.
pub fn open(room: &str, seed: u64) -> Result<Shop, Error> {
    let robot = Simulation::new(&World::parse(room)?, seed)?;
    Ok(Shop { robot, announced: Vec::new() })
}

/// Follows the wall at a distance for some time, and then at a larger one for the same time.
///
/// # Errors
/// The distance is not a number.
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
    // A running plan accepts writes, too; the next step commits them.
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
/// The number does not fit.
pub fn fetch(shop: &mut Shop, things: i64) -> Result<Wake, Error> {
    let mut plan = Scheduler::new(Errands::new());
    plan.set(Errands::THINGS, things)?;
    drive(shop, plan)
}

/// Runs one errand: the sub-plan without its outer plan.
///
/// # Errors
/// The distance is not a number.
pub fn errand(shop: &mut Shop, way: Length) -> Result<Wake, Error> {
    let mut plan = Scheduler::new(Errand::new());
    plan.set(Errand::WAY, way)?;
    drive(shop, plan)
}

/// Drives a plan to its end, for at most two minutes.
fn drive<P: afp::Plan<Shop>>(shop: &mut Shop, mut plan: Scheduler<P>) -> Result<Wake, Error> {
    let until = shop.now() + Duration::from_secs(120);
    Ok(plan.run_until(shop, &mut NoTrace, until)?)
}
