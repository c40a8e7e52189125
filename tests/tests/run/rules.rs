//! The rules of the run time, each with its cases.
//!
//! The numbers are those of the design's sections.

use std::collections::BTreeSet;
use std::fs;

/// Section, rule, cases.
type Rule = (&'static str, &'static str, &'static [&'static str]);

const RULES: &[Rule] = &[
    (
        "1.1",
        "the order is fixed when the plan is compiled: outer plans first, then shorter deadline, global before local, as written",
        &["order_by_deadline_then_global_then_as_written", "order_outer_plans_first"],
    ),
    (
        "1.1",
        "each supervisor is polled at most once in a step and activation",
        &["look_asks_nobody_twice"],
    ),
    ("1.1", "the first event that leads somewhere is taken", &["order_first_event_is_taken"]),
    (
        "1.1",
        "supervisors come before the actor, whose outputs are then lost",
        &["order_event_beats_the_actor_at_the_same_instant", "interrupted_actor_commits_nothing"],
    ),
    (
        "1.1",
        "the look: every global supervisor not yet asked, then its own; a taken event replaces the start",
        &[
            "look_before_the_start",
            "look_diverts_without_interrupt",
            "look_asks_a_global_supervisor_not_yet_asked",
            "look_asks_global_supervisors_first",
            "look_at_plan_start",
        ],
    ),
    (
        "6.1",
        "an edge to 'fail' ends its own plan in 'Error', for its reason, without stopping anything",
        &[
            "fail_ends_the_plan_in_error",
            "fail_by_an_event",
            "fail_by_error_deadline_and_computation",
            "fail_counts_for_livelock",
        ],
    ),
    (
        "6.2",
        "each poll is told the events that would be taken",
        &["wanted_where_an_event_leads_is_active", "wanted_in_the_look"],
    ),
    (
        "6.3",
        "an event that leads to 'resume' interrupts nothing, and what it writes is seen in the same step",
        &["resume_goes_on", "resume_then_an_interrupt", "resume_by_a_missed_deadline"],
    ),
    (
        "6.3",
        "computations that may resume run beside what is active; where they lead elsewhere it is interrupted after their commits",
        &["resume_by_computations", "resume_sub_plan", "resume_faults", "resume_livelock"],
    ),
    (
        "6.3",
        "in a look the element starts after what resumes, or not at all",
        &["resume_in_the_look"],
    ),
    ("6.4", "an actor without a state lasts until an event or a fault", &["lasting_actor"]),
    ("1.1", "a computation and 'terminate' have no look", &["look_not_for_computations"]),
    (
        "1.2",
        "a global event to the element active or being entered is not taken",
        &[
            "already_there_global",
            "already_there_in_the_look",
            "already_there_commits_nothing",
            "already_there_sub_plan",
        ],
    ),
    (
        "1.2",
        "a local event to its own actor restarts it, but not in the look",
        &["restart_by_a_local_event"],
    ),
    (
        "1.3.1",
        "a started actor is first polled one period after its start",
        &["actor_grid", "livelock_counts_in_one_step_only"],
    ),
    (
        "1.3.2",
        "every edge taken at every level counts; beyond the limit the whole run ends",
        &[
            "livelock_computations",
            "livelock_look",
            "livelock_error_edges",
            "livelock_in_a_sub_plan_ends_the_run",
            "loop_of_computations",
        ],
    ),
    (
        "1.3.4",
        "local grids begin with the step that entered the actor, global ones with the plan",
        &["release_grid_begins_with_the_activation", "release_grid_of_supervisors"],
    ),
    (
        "1.3.5",
        "a diverted actor is not interrupted and its inputs are never read",
        &["look_diverts_without_interrupt"],
    ),
    (
        "1.4",
        "a supervisor reports only events that lead somewhere, of several the first declared",
        &["ignore_hides_no_other_event", "order_first_declared_event_of_a_template"],
    ),
    (
        "1.5",
        "the verdict falls after the supervisor's own poll",
        &["deadline_kept_to_the_nanosecond", "deadline_missed_unconnected"],
    ),
    (
        "1.5",
        "'DeadlineMissed', connected, is its event in its place and commits nothing",
        &["deadline_missed_is_an_event"],
    ),
    (
        "1.5",
        "an event taken from that poll wins",
        &["deadline_missed_but_the_event_wins", "deadline_missed_after_an_event_not_taken"],
    ),
    (
        "1.5",
        "releases that passed are skipped, counted and served once",
        &[
            "deadline_releases_skipped",
            "deadline_latest_release_may_be_late_too",
            "deadline_no_verdict_without_a_poll",
        ],
    ),
    ("1.5", "the look counts but never raises it", &["deadline_not_raised_by_the_look"]),
    (
        "1.5",
        "it is an event edge and may be ignored",
        &["deadline_missed_ignored", "deadline_missed_to_terminate_is_interrupted"],
    ),
    ("1.5", "the cause is a late release or a long poll", &["deadline_cause"]),
    (
        "1.6",
        "inputs and start of an actor: stop, 'Error' edge, no interrupt",
        &[
            "fault_in_the_start_of_an_actor",
            "fault_in_an_input_formula",
            "fault_in_an_input_of_a_sub_plan",
            "fault_in_an_input_range",
        ],
    ),
    (
        "1.6",
        "poll, live input or output of an actor: interrupt once, 'Error' edge",
        &["fault_in_a_poll", "fault_in_a_live_input", "fault_in_an_output"],
    ),
    (
        "1.6",
        "anything of a local supervisor: its actor's 'Error' edge",
        &[
            "fault_in_the_start_of_a_local_supervisor",
            "fault_in_an_input_of_a_supervisor",
            "fault_in_the_look_of_a_local_supervisor",
            "fault_in_a_poll_of_a_local_supervisor",
            "fault_in_a_live_input_of_a_local_supervisor",
            "fault_in_an_output_of_a_local_supervisor",
            "fault_in_an_output_of_an_event_not_taken",
        ],
    ),
    (
        "1.6",
        "anything of a global supervisor: its plan ends in 'Error'",
        &[
            "fault_in_the_start_of_a_global_supervisor",
            "fault_in_a_poll_of_a_global_supervisor",
            "fault_of_a_global_supervisor_in_a_sub_plan",
        ],
    ),
    ("1.6", "a computation takes its 'Error' edge", &["fault_in_a_computation"]),
    (
        "1.6",
        "'Error' unconnected ends the plan, and so on outward; connected it is a state edge",
        &["fault_unconnected_ends_the_plan", "fault_to_terminate_ends_ok"],
    ),
    (
        "1.6",
        "a failed interrupt, a panic, a livelock: emergency stop, the whole run ends",
        &["fault_in_an_interrupt_ends_the_run", "panic_ends_the_run", "livelock_computations"],
    ),
    (
        "1.7",
        "the last edge decides between 'OK', 'Interrupted' and 'Error'",
        &[
            "sub_plan_ok",
            "sub_plan_interrupted",
            "sub_plan_error",
            "sub_plan_event_then_state_is_ok",
        ],
    ),
    (
        "1.7",
        "each activation starts afresh; two uses are two instances",
        &["sub_plan_starts_afresh", "sub_plan_twice_is_two_instances"],
    ),
    (
        "1.7",
        "plans of other files are sub-plans like those of the file itself; each file has names of its own",
        &["files_three"],
    ),
    (
        "1.7",
        "exactly the 'out' entries written or initialised are committed, none on 'Error' or interruption",
        &[
            "sub_plan_interrupted",
            "sub_plan_error",
            "sub_plan_interrupted_from_outside",
            "sub_plan_results_that_do_not_convert",
        ],
    ),
    (
        "1.7",
        "a sub-plan sees only its own entries; its 'in' are never live",
        &["sub_plan_inputs_are_never_live"],
    ),
    (
        "1.7",
        "a sub-plan is due when the earliest inside is; entry and interruption go through all levels",
        &[
            "sub_plan_within_sub_plans",
            "sub_plan_entry_order",
            "sub_plan_look_diverts_at_the_start",
            "sub_plan_of_computations_takes_no_time",
        ],
    ),
    (
        "1.7",
        "reading and writing one entry: inputs are read at the start",
        &["commit_reads_before_it_writes"],
    ),
    ("1.7", "after 'terminate' nothing is polled", &["after_terminate_nothing_is_polled"]),
    (
        "1.8",
        "live inputs are read before each poll, others once",
        &[
            "live_inputs_of_a_global_supervisor",
            "live_inputs_see_outside_writes",
            "live_inputs_of_an_actor",
        ],
    ),
    (
        "1.9",
        "writes from outside are one commit at the start of the next step, in order of arrival",
        &["outside_writes"],
    ),
    (
        "1.9",
        "a write that does not fit, or a full queue, is the writer's error",
        &["outside_writes_refused", "outside_writes_queue_full"],
    ),
    (
        "1.9",
        "a stop request comes first: interrupt, end 'Interrupted'",
        &[
            "outside_stop_request",
            "outside_stop_request_in_a_sub_plan",
            "outside_stop_request_in_a_sub_plan",
        ],
    ),
    (
        "1.10",
        "initial values: 'const' from 'const', 'in' defaults from 'const', the rest from both",
        &["entries_initial_values", "entries_initial_value_fails"],
    ),
    (
        "1.10",
        "without an 'in' that has no default the plan does not start",
        &["entries_input_missing"],
    ),
    (
        "1.10",
        "an output 'on' another state keeps the entry's value",
        &["commit_writes_only_the_state_reached"],
    ),
    (
        "1.11",
        "division never truncates, remainders have the sign of the dividend, left to right",
        &["formula_division_never_truncates"],
    ),
    (
        "1.11",
        "overflow, '% 0' and infinite results are faults of the reader",
        &["formula_overflow_is_a_fault"],
    ),
    (
        "1.11",
        "functions keep ints, check dimensions, and are faults where they have no value",
        &["formula_functions"],
    ),
    (
        "1.11",
        "an infinite part of a formula is a fault, although the whole would be finite",
        &["formula_infinite_parts"],
    ),
    ("1.11", "a binding that is a name alone is its port and its entry", &["bindings_alone"]),
    ("1.11", "conversions", &["formula_conversions", "formula_text_that_does_not_read"]),
    (
        "1.11",
        "literals are the doubles nearest to their decimal values",
        &["formula_literals_are_exact"],
    ),
    ("1.12", "a string of more than 64 bytes is a fault", &["formula_text_too_long"]),
    (
        "1.12",
        "objects are known by the commit that wrote them",
        &["object_is_known_by_its_commit", "object_through_a_sub_plan", "object_is_copied"],
    ),
    (
        "6.2",
        "one supervisor, and targets of the element that is active: of any kind, event by event",
        &["on_reactions_of_elements", "on_endings_and_resume", "on_deadline_missed"],
    ),
    (
        "6.2",
        "a look asks with the reactions of what is entered; a release is served once",
        &["on_in_the_look"],
    ),
    ("6.2", "the reactions of a sub-plan never reach inside", &["on_in_sub_plans"]),
    ("6.3", "'Every' reports each whole period, late ones once", &["every_period"]),
    ("6.3", "'After' reports each start once, 'Stopwatch' the time since it", &["after_once"]),
    ("6.5", "'Is' and 'Switch' choose by values that are equal or not", &["choosing"]),
    (
        "6.5",
        "a declared computation reaches the first state whose condition holds, and writes what that state assigns",
        &["declared", "declared_faults"],
    ),
    ("6.5", "'Row' reads a row of a table, or says that there is none", &["row"]),
    (
        "6.6",
        "a range holds for what is stored: outputs, initial values, inputs and results of sub-plans, outside writes",
        &[
            "range_of_outputs",
            "range_of_an_initial_value",
            "range_of_a_sub_plan",
            "range_of_outside_writes",
        ],
    ),
    (
        "6.6",
        "an 'in live' of a sub-plan is committed before each step where it changed; its fault is the element's",
        &[
            "sub_plan_live_inputs",
            "sub_plan_live_inputs_that_fail",
            "sub_plan_live_inputs_go_down",
            "sub_plan_live_object",
        ],
    ),
    (
        "1.13",
        "'any' and 'number' are one type for each instance",
        &["generic_ports", "generic_live_number"],
    ),
    ("1.15", "actors stay on their grid, missed polls are skipped", &["actor_grid"]),
    (
        "1.15",
        "a step before the last works at the last time; a second one does only what is still due",
        &["clock_went_back", "step_twice_at_one_instant"],
    ),
    (
        "1.15",
        "a step returns when to wake; waking early does nothing",
        &["wake_is_the_earliest_due"],
    ),
    ("1.16", "the order of the trace within a step", &["trace_order", "commit_is_one_operation"]),
    (
        "suspend",
        "an element continues without the time of its suspension",
        &["suspend_and_return", "suspend_a_sub_plan", "suspend_and_compute_before_return"],
    ),
    (
        "suspend",
        "timers of the element count without its pauses, timers of the plan with them",
        &["suspend_by_a_timer", "suspend_while_a_condition_lasts"],
    ),
    (
        "suspend",
        "values that are written before or during a pause are seen after it",
        &["suspend_at_most_three_times", "suspend_after_a_resume", "suspend_and_live_inputs"],
    ),
    (
        "suspend",
        "in the look nothing is called, and 'return' looks again",
        &["suspend_in_the_look"],
    ),
    (
        "suspend",
        "elsewhere the suspended element is abandoned, once",
        &["suspended_and_abandoned", "suspend_and_end_in_one_step"],
    ),
    ("suspend", "after a panic nothing is called", &["suspend_and_a_panic"]),
    (
        "hold",
        "a held element continues, or starts again if it cannot be suspended",
        &["hold_and_continue", "hold_interrupts_what_cannot_be_suspended", "hold_of_a_handler"],
    ),
    (
        "hold",
        "only events of global supervisors that end the plan are taken, and faults",
        &["hold_polls_global_supervisors", "hold_sees_an_event_after_it", "hold_and_a_fault"],
    ),
    ("hold", "a step holds before the next element of the outermost plan", &["hold_and_step"]),
    ("hold", "a failed interrupt stops everything", &["hold_with_a_failed_interrupt"]),
    (
        "2",
        "names are those of the text, whatever Rust makes of them",
        &["names_that_rust_knows_too", "names_of_generated_code"],
    ),
];

#[test]
fn every_rule_has_cases_and_every_case_a_rule() {
    let files = fs::read_dir(super::folder()).expect("the folder of cases");
    let names = files.filter_map(|entry| {
        let name = entry.ok()?.file_name().into_string().ok()?;
        name.strip_suffix(".afp").map(str::to_owned)
    });
    let present: BTreeSet<String> = names.collect();
    let named = RULES.iter().flat_map(|(_, _, cases)| *cases);
    let named: BTreeSet<String> = named.map(|case| (*case).to_owned()).collect();
    assert_eq!(named, present);
    assert!(RULES.iter().all(|(_, _, cases)| !cases.is_empty()));
}

#[test]
fn every_case_expects_a_trace() {
    if std::env::var_os("AFP_BLESS").is_some() {
        // The cases are being rewritten.
        return;
    }
    for entry in fs::read_dir(super::folder()).expect("the folder of cases").flatten() {
        let text = fs::read_to_string(entry.path()).expect("a case");
        let case = afp_tests::case::Case::parse(&text).expect("its script can be read");
        assert!(!case.trace.is_empty(), "{} expects nothing", entry.path().display());
    }
}
