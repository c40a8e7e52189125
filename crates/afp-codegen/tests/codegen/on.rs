// p.rs

/// The rules of the plan, for the scheduler.
#[derive(Clone, Copy, Debug)]
pub struct Rules;

impl Tables for Rules {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        PlanTable {
            start: WAIT,
            globals: 1,
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
static EDGES: [Option<Target>; 4] = [
    // wait: Elapsed -> terminate
    Some(Target::Terminate),
    // rest: Elapsed -> wait
    Some(Target::Element(WAIT)),
    // tick: Due -> ignore
    Some(Target::Ignore),
    // tick, with an element's own edge: Due -> rest
    Some(Target::Element(REST)),
];

/// The elements.
static ELEMENTS: [ElementRow; 2] = [
    // actor wait: Wait
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 0, len: 1 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 0, len: 1 },
        child: Child { components: 0, entries: 0 },
    },
    // actor rest: Wait
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 1, len: 1 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 1, len: 1 },
        child: Child { components: 0, entries: 0 },
    },
];

/// The supervisors: global, local, then global with an element's own edges.
static SUPERVISORS: [SupervisorRow; 2] = [
    // tick: Every
    SupervisorRow {
        instance: TICK,
        timing: Timing {
            period: Duration::from_millis(10),
            deadline: Duration::from_millis(10),
            budget: Duration::from_micros(5),
        },
        slot: 0,
        events: Range { first: 2, len: 1 },
        on_miss: None,
        wanted: Events::from_bits(0b0),
        wanted_in_look: Events::from_bits(0b0),
    },
    // tick: Every, with an element's own edge
    SupervisorRow {
        instance: TICK,
        timing: Timing {
            period: Duration::from_millis(10),
            deadline: Duration::from_millis(10),
            budget: Duration::from_micros(5),
        },
        slot: 0,
        events: Range { first: 3, len: 1 },
        on_miss: Some(Target::Terminate),
        wanted: Events::from_bits(0b1),
        wanted_in_look: Events::from_bits(0b1),
    },
];

/// The supervisors of each active element, in polling order.
static SWEEPS: [u16; 2] = [
    // while wait is active
    1,
    // while rest is active
    TICK.0,
];

/// The names of the ids of a trace.
pub static NAMES: NameTable = NameTable {
    components: &[
        ComponentRow::new("P", ComponentKind::Plan, "P", &[], "", &[]),
        ComponentRow::new(
                "wait",
                ComponentKind::Actor,
                "Wait",
                &[("Elapsed", "terminate")],
                "",
                &[PortRow::new("duration", "s").within(0.0, 3600.0).at("on.afp", 8, 33)],
            )
            .reacting(
                &[
                    Reaction::new(ComponentId(3), Some(0), "rest"),
                    Reaction::new(ComponentId(3), None, "terminate"),
                ],
            ),
        ComponentRow::new(
            "rest",
            ComponentKind::Actor,
            "Wait",
            &[("Elapsed", "wait")],
            "",
            &[PortRow::new("duration", "s").within(0.0, 3600.0).at("on.afp", 12, 33)],
        ),
        ComponentRow::new(
            "tick",
            ComponentKind::Supervisor,
            "Every",
            &[("Due", "ignore")],
            "",
            &[PortRow::new("period", "s").within(0.001, 3600.0).at("on.afp", 7, 36)],
        ),
    ],
    entries: &[],
};

impl NamedPlan for P {
    type Names = NameTable;

    fn names(&self) -> NameTable {
        NAMES
    }

    fn units(&self, _: u16) -> impl Iterator<Item = Unit<'_>> {
        let units: &[Unit<'static>] = &[];
        units.iter().copied()
    }
}
