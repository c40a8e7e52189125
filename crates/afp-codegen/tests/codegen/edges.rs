// inner.rs

/// The rules of the plan, for the scheduler.
#[derive(Clone, Copy, Debug)]
pub struct Rules;

impl Tables for Rules {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        PlanTable {
            start: PAUSE,
            globals: 0,
            entries: 0,
            elements: &ELEMENTS,
            supervisors: &SUPERVISORS,
            reasons: &[],
            edges: &EDGES,
            sweeps: &SWEEPS,
        }
    }
}

/// The target of each state and event.
static EDGES: [Option<Target>; 1] = [
    // pause: Elapsed -> terminate
    Some(Target::Terminate),
];

/// The elements.
static ELEMENTS: [ElementRow; 1] = [
    // actor pause: Wait
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 0, len: 1 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 0, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
];

/// The supervisors: global, local, then global with an element's own edges.
static SUPERVISORS: [SupervisorRow; 0] = [];

/// The supervisors of each active element, in polling order.
static SWEEPS: [u16; 0] = [];

// p.rs

/// The rules of the plan, for the scheduler.
#[derive(Clone, Copy, Debug)]
pub struct Rules;

impl Tables for Rules {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        PlanTable {
            start: COUNT,
            globals: 1,
            entries: 1,
            elements: &ELEMENTS,
            supervisors: &SUPERVISORS,
            reasons: &[],
            edges: &EDGES,
            sweeps: &SWEEPS,
        }
    }
}

/// The target of each state and event.
static EDGES: [Option<Target>; 9] = [
    // count: Again -> wait
    Some(Target::Element(WAIT)),
    // count: Done -> inner
    Some(Target::Element(INNER)),
    // wait: Elapsed -> count
    Some(Target::Element(COUNT)),
    // inner: OK -> wait
    Some(Target::Element(WAIT)),
    // inner: Interrupted cannot happen
    None,
    // late: TimedOut -> wait
    Some(Target::Element(WAIT)),
    // wait.first: Below -> ignore
    Some(Target::Ignore),
    // wait.first: Above -> count
    Some(Target::Element(COUNT)),
    // wait.second: TimedOut -> count
    Some(Target::Element(COUNT)),
];

/// The elements.
static ELEMENTS: [ElementRow; 3] = [
    // computation count: Count
    ElementRow {
        kind: ElementKind::Computation,
        period: Duration::ZERO,
        states: Range { first: 0, len: 2 },
        on_error: Some(Target::Terminate),
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 0, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
    // actor wait: Wait
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 2, len: 1 },
        on_error: Some(Target::Element(INNER)),
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 1, len: 2 },
        sweep: Range { first: 0, len: 3 },
        child: Child { components: 0, entries: 0 },
    },
    // subplan inner: Inner
    ElementRow {
        kind: ElementKind::SubPlan,
        period: Duration::ZERO,
        states: Range { first: 3, len: 2 },
        on_error: Some(Target::Terminate),
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 3, len: 1 },
        child: INNER_PLACE,
    },
];

/// The supervisors: global, local, then global with an element's own edges.
static SUPERVISORS: [SupervisorRow; 4] = [
    // late: CheckTimeout
    SupervisorRow {
        instance: LATE,
        timing: Timing {
            period: Duration::from_millis(10),
            deadline: Duration::from_millis(2),
            budget: Duration::from_micros(5),
        },
        slot: 0,
        events: Range { first: 5, len: 1 },
        on_miss: Some(Target::Terminate),
        wanted: Events::from_bits(0b1),
        wanted_in_look: Events::from_bits(0b1),
    },
    // wait.first: CheckValue
    SupervisorRow {
        instance: WAIT_FIRST,
        timing: Timing {
            period: Duration::from_millis(10),
            deadline: Duration::from_millis(10),
            budget: Duration::from_micros(5),
        },
        slot: 1,
        events: Range { first: 6, len: 2 },
        on_miss: None,
        wanted: Events::from_bits(0b10),
        wanted_in_look: Events::from_bits(0b10),
    },
    // wait.second: CheckTimeout
    SupervisorRow {
        instance: WAIT_SECOND,
        timing: Timing {
            period: Duration::from_millis(10),
            deadline: Duration::from_millis(1),
            budget: Duration::from_micros(5),
        },
        slot: 2,
        events: Range { first: 8, len: 1 },
        on_miss: None,
        wanted: Events::from_bits(0b1),
        wanted_in_look: Events::from_bits(0b1),
    },
    // late: CheckTimeout, where an event of it leads
    SupervisorRow {
        instance: LATE,
        timing: Timing {
            period: Duration::from_millis(10),
            deadline: Duration::from_millis(2),
            budget: Duration::from_micros(5),
        },
        slot: 0,
        events: Range { first: 5, len: 1 },
        on_miss: Some(Target::Terminate),
        wanted: Events::from_bits(0b0),
        wanted_in_look: Events::from_bits(0b0),
    },
];

/// The supervisors of each active element, in polling order.
static SWEEPS: [u16; 4] = [
    // while wait is active
    WAIT_SECOND.0,
    3,
    WAIT_FIRST.0,
    // while inner is active
    LATE.0,
];
