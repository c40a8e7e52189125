//! Follows the walls of the room for two minutes and prints each event.

use afp::trace::{Names, Observe, Record};
use afp::{Instant, NamedPlan, Scheduler};
use toy_robot::Toy;

afp::plan!("../../plans/wall_following.afp");

fn main() {
    let plan = WallFollowing::new();
    let names = plan.names();
    let mut show = Observe(|at: Instant, record: &Record<'_>| {
        if let Record::Started { component } = record {
            println!("{:8.3} s  {}", at.as_secs_f64(), names.component(*component).path);
        }
    });
    let (mut toy, mut plan) = (Toy::new(), Scheduler::new(plan));
    let until = Instant::from_nanos(120_000_000_000);
    let wake = plan.run_until(&mut toy, &mut show, until);
    let (x, y) = toy.position;
    println!("{wake:?} at ({x:.2} m, {y:.2} m), {:.3} m from the wall", toy.right_gap());
}
