//! Who is asked first, and who wins.

use crate::support::build::{actor, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::World;

#[test]
fn shorter_deadline_first_then_global_then_as_written() {
    let plan = plan("p")
        .guarded(guard("g20", 20).on("E", "terminate"))
        .guarded(guard("g10", 10).on("E", "terminate"))
        .with(
            actor("a")
                .guarded(guard("l10", 10).on("E", "terminate"))
                .guarded(guard("l5", 20).deadline(5).on("E", "terminate"))
                .on("Done", "a"),
        );
    let mut run = Run::started(plan, World::default());
    run.trace();
    run.step(20);
    assert_lines(
        &run.trace(),
        "0.020000 a.l5 polled: clear
         0.020000 g10 polled: clear
         0.020000 a.l10 polled: clear
         0.020000 g20 polled: clear",
    );
}
