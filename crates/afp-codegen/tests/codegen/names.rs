// config.rs

const LOOP: ElementId = ElementId(0);
const ACTIVE: ElementId = ElementId(1);
const SELF: ElementId = ElementId(2);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor self_: Wait
    Self_(afp_std::Wait),
}

/// Inputs of `loop`.
fn loop_inputs(config: &Config) -> Result<std_templates::assign::Inputs<i64>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: config.r#type(),
    })
}

/// Outputs of `loop`.
fn loop_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<i64>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.staged = Some(value_0);
    Ok(())
}

/// Inputs of `active`.
fn active_inputs(
    config: &Config,
) -> Result<std_templates::assign::Inputs<i64>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: config.staged(),
    })
}

/// Outputs of `active`.
fn active_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<i64>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.r#type = Some(value_0);
    Ok(())
}

/// Inputs of `self_`.
fn self_inputs() -> Result<std_templates::wait::Inputs, BadValue> {
    Ok(std_templates::wait::Inputs {
        duration: Time::from_si(1.0),
    })
}

/// The names of the ids of a trace.
pub static NAMES: NameTable = NameTable {
    components: &[
        ComponentRow::new("Config", ComponentKind::Plan, "Config", &[], "", &[]),
        ComponentRow::new(
                "loop",
                ComponentKind::Computation,
                "Assign",
                &[("Done", "active")],
                "",
                &[PortRow::new("value", "").at("names.afp", 9, 38)],
            )
            .writing(
                &[PortRow::new("result", "").at("names.afp", 9, 54).into(0, "staged")],
            ),
        ComponentRow::new(
                "active",
                ComponentKind::Computation,
                "Assign",
                &[("Done", "self_")],
                "",
                &[PortRow::new("value", "").at("names.afp", 10, 40)],
            )
            .writing(
                &[PortRow::new("result", "").at("names.afp", 10, 58).into(0, "type")],
            ),
        ComponentRow::new(
            "self_",
            ComponentKind::Actor,
            "Wait",
            &[("Elapsed", "terminate")],
            "",
            &[PortRow::new("duration", "s").within(0.0, 3600.0).at("names.afp", 11, 34)],
        ),
    ],
    entries: &[
        EntryRow::new("staged", EntryKind::Var, "int", "", &[]).at("names.afp", 7, 23),
        EntryRow::new("type", EntryKind::Var, "int", "", &[]).at("names.afp", 8, 23),
    ],
};

impl NamedPlan for Config_2 {
    type Names = NameTable;

    fn names(&self) -> NameTable {
        NAMES
    }

    fn units(&self, _: u16) -> impl Iterator<Item = Unit<'_>> {
        let units: &[Unit<'static>] = &[];
        units.iter().copied()
    }
}
