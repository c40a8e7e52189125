//! Events whose target is already active or being entered.

use crate::support::build::{actor, guard, plan, sub_plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::World;

#[test]
fn a_lasting_global_event_does_not_restart_its_own_handler() {
    let plan = plan("p")
        .guarded(guard("battery", 10).on("Low", "home"))
        .with(actor("go").on("Done", "go"))
        .with(actor("home").on("Done", "terminate"));
    let world = World::default().says("battery", 0, 10..1000).says("home", 0, 40..41);
    let mut run = Run::started(plan, world);
    run.until(15).trace();
    run.until(40);
    assert_lines(
        &run.trace(),
        "0.020000 battery polled: Low
         0.020000 battery already there: Low -> home
         0.030000 battery polled: Low
         0.030000 battery already there: Low -> home
         0.040000 battery polled: Low
         0.040000 battery already there: Low -> home
         0.040000 home finished Done -> terminate
         0.040000 p ended OK",
    );
    assert_eq!(run.calls("interrupt"), ["10 interrupt go"]);
}

#[test]
fn a_global_event_to_the_element_being_entered_is_not_taken_in_the_look() {
    let plan = plan("p").guarded(guard("g", 10).on("E", "a")).with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default().says("g", 0, 0..1));
    assert_lines(
        &run.trace(),
        "0.000000 g started
         0.000000 g polled: E
         0.000000 g already there: E -> a
         0.000000 a started",
    );
}

#[test]
fn outputs_of_an_event_that_is_not_taken_are_not_committed() {
    let plan = plan("p")
        .var("x")
        .guarded(guard("g", 10).on("E", "a").writes("E", "x", 1))
        .with(actor("a").on("Done", "b"))
        .with(actor("b").on("Done", "b"));
    let world = World::default().says("g", 0, 0..15).says("a", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.until(10);
    assert_eq!(run.active(), Some("b"));
    assert_eq!(run.entry("x"), afp_core::Value::Unset);
}

#[test]
fn a_local_event_to_its_own_actor_restarts_it_but_not_in_the_look() {
    let plan = plan("p")
        .with(actor("dark").guarded(guard("m", 10).on("Motion", "dark")).on("Done", "terminate"));
    let mut run = Run::started(plan, World::default().says("m", 0, 0..25));
    run.until(20);
    assert_lines(
        &run.trace(),
        "0.000000 dark.m started
         0.000000 dark.m polled: Motion
         0.000000 dark.m already there: Motion -> dark
         0.000000 dark started
         0.010000 dark.m polled: Motion
         0.010000 dark.m event Motion -> dark
         0.010000 dark interrupted
         0.010000 dark.m started
         0.010000 dark.m polled: Motion
         0.010000 dark.m already there: Motion -> dark
         0.010000 dark started
         0.020000 dark.m polled: Motion
         0.020000 dark.m event Motion -> dark
         0.020000 dark interrupted
         0.020000 dark.m started
         0.020000 dark.m polled: Motion
         0.020000 dark.m already there: Motion -> dark
         0.020000 dark started",
    );
}

#[test]
fn a_sub_plan_stays_active_through_its_own_actors() {
    let recovery = plan("Recovery")
        .with(actor("turn").on("Done", "drive"))
        .with(actor("drive").on("Done", "terminate"));
    let plan = plan("p")
        .guarded(guard("battery", 10).on("Low", "recover"))
        .with(actor("go").on("Done", "go"))
        .with(sub_plan("recover", recovery).on("OK", "terminate"));
    let world = World::default().says("battery", 0, 10..1000).says("turn", 0, 30..31).says(
        "drive",
        0,
        60..61,
    );
    let mut run = Run::started(plan, world);
    run.until(60);
    assert_eq!(run.calls("interrupt"), ["10 interrupt go"]);
    assert_eq!(run.ending(), Some(afp_core::Ending::Ok));
}
