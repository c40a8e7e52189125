//! Sub-plans.

use afp_core::trace::{Ending, EntryKind};
use afp_core::{Fault, Value, Wake};

use crate::support::build::{Builder, ElementSpec, actor, computation, guard, plan, sub_plan};
use crate::support::ms;
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, SCRIPTED, World};

/// Two actors, a global supervisor; `gap` is set by the first, `side` by the second actor.
fn avoid() -> Builder {
    plan("Avoid")
        .entry("size", EntryKind::In, Value::Unset)
        .entry("gap", EntryKind::Out, Value::Unset)
        .entry("side", EntryKind::Out, Value::Unset)
        .guarded(guard("stuck", 20).on("E", "terminate"))
        .with(actor("turn").reads("size").on("Done", "pass").writes("Done", "gap", 1))
        .with(
            actor("pass")
                .guarded(guard("bump", 10).on("E", "turn"))
                .on("Done", "terminate")
                .writes("Done", "side", 2),
        )
}

fn inside(element: ElementSpec) -> Builder {
    plan("p")
        .entry("gap", EntryKind::Var, Value::Int(0))
        .entry("side", EntryKind::Var, Value::Int(0))
        .entry("size", EntryKind::Var, Value::Int(3))
        .guarded(guard("escape", 50).on("Pressed", "terminate"))
        .with(element.input("size", "size").output("gap", "gap").output("side", "side"))
        .with(actor("ok").on("Done", "ok"))
        .with(actor("cut").on("Done", "cut"))
        .with(actor("failed").on("Done", "failed"))
}

fn connected() -> Builder {
    inside(sub_plan("s", avoid()).on("OK", "ok").on("Interrupted", "cut").on_error("failed"))
}

fn after(world: World, end: u64) -> Run {
    let mut run = Run::started(connected(), world);
    run.until(end);
    run
}

#[test]
fn a_state_that_leads_to_terminate_is_ok_and_commits_the_results() {
    let mut run =
        Run::started(connected(), World::default().says("turn", 0, 10..11).says("pass", 0, 20..21));
    run.trace();
    run.until(20);
    assert_lines(
        &run.story(),
        "0.010000 s.turn finished Done -> pass
         0.010000 s.turn commits s.gap: unset -> 1
         0.010000 s.pass.bump started
         0.010000 s.pass started
         0.020000 s.pass finished Done -> terminate
         0.020000 s.pass commits s.side: unset -> 2
         0.020000 s ended OK
         0.020000 s finished OK -> ok
         0.020000 s commits gap: 0 -> 1
         0.020000 s commits side: 0 -> 2
         0.020000 ok started",
    );
    assert_eq!(run.calls("interrupt"), [""; 0]);
}

#[test]
fn an_event_that_leads_to_terminate_is_interrupted_and_commits_the_written_values() {
    let world = World::default().says("turn", 0, 10..11).says("stuck", 0, 20..21);
    let run = after(world, 20);
    assert_eq!(run.active(), Some("cut"));
    assert_eq!((run.entry("gap"), run.entry("side")), (Value::Int(1), Value::Int(0)));
    assert_eq!(run.calls("interrupt"), ["20 interrupt pass"]);
}

#[test]
fn an_unhandled_fault_is_error_and_commits_nothing() {
    let world = World::default().says("turn", 0, 10..11).fails("pass", Phase::Poll, 20..21);
    let mut run = Run::started(connected(), world);
    run.until(10).trace();
    run.until(20);
    assert_eq!((run.active(), run.entry("gap")), (Some("failed"), Value::Int(0)));
    assert_lines(
        &run.story(),
        "0.020000 s.pass fault scripted: as the script says
         0.020000 s.pass interrupted
         0.020000 s ended Error(scripted)
         0.020000 s fault scripted: as the script says -> failed
         0.020000 failed started",
    );
    assert_eq!(run.calls("interrupt"), ["20 interrupt pass"]);
}

#[test]
fn an_unconnected_error_ends_the_outer_plan_too() {
    let plan = inside(sub_plan("s", avoid()).on("OK", "ok").on("Interrupted", "cut"));
    let mut run = Run::started(plan, World::default().fails("turn", Phase::Poll, 10..11));
    run.step(10);
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_eq!(run.emergency_stops(), 0);
}

#[test]
fn a_failing_start_inside_is_the_sub_plans_error() {
    let run = after(World::default().fails("turn", Phase::Start, 0..1), 0);
    assert_eq!(run.active(), Some("failed"));
    assert_eq!(run.calls("stop"), ["0 stop"]);
}

#[test]
fn results_that_do_not_convert_are_the_sub_plans_fault() {
    let inner = plan("Inner")
        .entry("gap", EntryKind::Out, Value::Unset)
        .with(actor("turn").on("Done", "terminate").writes("Done", "gap", 666));
    let plan = plan("p")
        .entry("gap", EntryKind::Var, Value::Int(0))
        .with(sub_plan("s", inner).on("OK", "ok").on_error("failed").output("gap", "gap"))
        .with(actor("ok").on("Done", "ok"))
        .with(actor("failed").on("Done", "failed"));
    let mut run = Run::started(plan, World::default().says("turn", 0, 10..11));
    run.trace();
    run.step(10);
    assert_eq!((run.active(), run.entry("gap")), (Some("failed"), Value::Int(0)));
    let fault = format!("0.010000 s fault conversion: {} -> failed", Fault::CONVERSION);
    assert!(run.trace().contains(&fault));
}

#[test]
fn an_outer_event_interrupts_the_inner_element_without_a_commit() {
    let world = World::default().says("turn", 0, 10..11).says("escape", 0, 50..51);
    let mut run = Run::started(connected(), world);
    run.until(49).trace();
    run.step(50);
    assert_lines(
        &run.trace(),
        "0.050000 escape polled: Pressed
         0.050000 escape event Pressed -> terminate
         0.050000 s.pass interrupted
         0.050000 s interrupted
         0.050000 p ended Interrupted",
    );
    assert_eq!((run.entry("gap"), run.calls("interrupt").len()), (Value::Int(0), 1));
}

#[test]
fn outer_plans_are_polled_first_for_all_deadlines() {
    let mut run = after(World::default().says("turn", 0, 10..11), 99);
    run.trace();
    run.step(100);
    assert_lines(
        &run.trace(),
        "0.100000 escape polled: clear
         0.100000 s.pass.bump polled: clear
         0.100000 s.stuck polled: clear",
    );
}

#[test]
fn entry_is_outer_look_first_then_inner_start_then_inner_look() {
    let mut run = Run::started(
        inside(
            sub_plan("s", avoid())
                .guarded(guard("local", 10).on("E", "ok"))
                .on("OK", "ok")
                .on("Interrupted", "cut"),
        ),
        World::default(),
    );
    assert_lines(
        &run.trace(),
        "0.000000 p commits gap: unset -> 0
         0.000000 p commits side: unset -> 0
         0.000000 p commits size: unset -> 3
         0.000000 escape started
         0.000000 s.local started
         0.000000 escape polled: clear
         0.000000 s.local polled: clear
         0.000000 s started
         0.000000 s commits s.size: unset -> 3
         0.000000 s.stuck started
         0.000000 s.stuck polled: clear
         0.000000 s.turn started",
    );
    assert_eq!(run.wake, Wake::At(ms(10)));
}

#[test]
fn each_activation_starts_from_the_beginning() {
    let inner = plan("Inner")
        .entry("n", EntryKind::Out, Value::Unset)
        .with(actor("work").on("One", "terminate").on("Two", "terminate").writes("One", "n", 1));
    let plan = plan("p")
        .entry("n", EntryKind::Var, Value::Int(0))
        .with(sub_plan("s", inner).on("OK", "reset").output("n", "n"))
        .with(computation("reset").on("Done", "s").writes("Done", "n", 9));
    let world = World::default().says("work", 0, 10..11).says("work", 1, 20..21);
    let mut run = Run::started(plan, world);
    run.until(10);
    assert_eq!(run.entry("n"), Value::Int(9));
    run.trace();
    run.until(20);
    // The second activation writes nothing, so the outer plan commits nothing.
    assert!(!run.trace().iter().any(|line| line.starts_with("0.020000 s commits")));
}

#[test]
fn a_global_supervisor_inside_ends_with_its_plan() {
    let mut run = after(World::default().says("turn", 0, 10..11).says("pass", 0, 20..21), 20);
    run.world.calls.clear();
    run.until(45);
    assert!(!run.world.calls.iter().any(|call| call.ends_with("stuck")));
}

#[test]
fn a_global_supervisor_that_fails_inside_is_only_its_plans_error() {
    let run = after(World::default().fails("stuck", Phase::Poll, 20..21), 20);
    assert_eq!(run.active(), Some("failed"));
    assert_eq!(run.calls("interrupt"), ["20 interrupt turn"]);
}

#[test]
fn a_failed_interrupt_inside_ends_the_whole_run() {
    let world = World::default().says("stuck", 0, 20..21).fails("turn", Phase::Interrupt, 20..21);
    let run = after(world, 20);
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_eq!((run.emergency_stops(), run.calls("interrupt").len()), (1, 1));
}

#[test]
fn a_failed_interrupt_from_an_outer_event_ends_the_whole_run() {
    let world = World::default().says("escape", 0, 50..51).fails("turn", Phase::Interrupt, 50..51);
    let run = after(world, 50);
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_eq!((run.emergency_stops(), run.calls("interrupt").len()), (1, 1));
}

#[test]
fn a_sub_plan_of_computations_takes_no_time() {
    let inner = plan("Inner").with(computation("c").on("Done", "terminate"));
    let plan = plan("p").with(sub_plan("s", inner).on("OK", "a")).with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default());
    assert_lines(
        &run.trace(),
        "0.000000 s started
         0.000000 s.c finished Done -> terminate
         0.000000 s ended OK
         0.000000 s finished OK -> a
         0.000000 a started",
    );
}

#[test]
fn a_sub_plan_is_due_at_the_earliest_instant_inside() {
    let inner =
        plan("Inner").with(actor("a").every(7).guarded(guard("g", 3).on("E", "a")).on("Done", "a"));
    let plan = plan("p")
        .guarded(guard("outer", 100).on("E", "terminate"))
        .with(sub_plan("s", inner).on("OK", "s"));
    let mut run = Run::started(plan, World::default());
    let mut wakes = Vec::new();
    while run.wake != Wake::At(ms(18)) {
        wakes.push(run.wake);
        run.until(match run.wake {
            Wake::At(at) => at.as_nanos() / 1_000_000,
            Wake::Ended(_) | Wake::NotStarted => break,
        });
    }
    assert_eq!(wakes, [3, 6, 7, 9, 12, 14, 15].map(|at| Wake::At(ms(at))));
}

#[test]
fn interrupts_run_from_the_inside_out_through_all_levels() {
    let innermost = plan("C").with(actor("work").on("Done", "terminate"));
    let middle = plan("B").with(sub_plan("c", innermost).on("OK", "terminate"));
    let plan = plan("A")
        .guarded(guard("stop", 10).on("E", "terminate"))
        .with(sub_plan("b", middle).on("OK", "terminate"));
    let mut run = Run::started(plan, World::default().says("stop", 0, 10..11));
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 stop polled: E
         0.010000 stop event E -> terminate
         0.010000 b.c.work interrupted
         0.010000 b.c interrupted
         0.010000 b interrupted
         0.010000 A ended Interrupted",
    );
}

#[test]
fn a_sub_plan_that_cannot_be_initialised_shows_its_fault_once() {
    let broken = plan("Broken").broken("x").with(actor("a").on("Done", "a"));
    let element = sub_plan("s", broken).on("OK", "ok").on_error("ok");
    let mut run =
        Run::started(plan("p").with(element).with(actor("ok").on("Done", "ok")), World::default());
    assert_lines(
        &run.trace(),
        "0.000000 s started
         0.000000 s ended Error(arithmetic)
         0.000000 s fault arithmetic: a formula overflowed, divided by zero, or has no finite value -> ok
         0.000000 ok started",
    );
}
