// round.rs

const LOOP: ElementId = ElementId(0);
const WAIT: ElementId = ElementId(1);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor wait: Wait
    Wait(afp_std::Wait),
}

/// Inputs of `loop`.
fn loop_inputs(config: &Config) -> Result<std_templates::count::Inputs, BadValue> {
    Ok(std_templates::count::Inputs {
        value: config.i(),
        limit: config.rounds(),
    })
}

/// Outputs of `loop`.
fn loop_outputs(
    staged: &mut Staged,
    outcome: std_templates::count::State,
) -> Result<(), BadValue> {
    match outcome {
        std_templates::count::State::Again { next: value_0 } => {
            staged.i = Some(value_0);
        }
        std_templates::count::State::Done { next: value_0 } => {
            staged.i = Some(value_0);
        }
    }
    Ok(())
}

/// Inputs of `wait`.
fn wait_inputs() -> Result<std_templates::wait::Inputs, BadValue> {
    Ok(std_templates::wait::Inputs {
        duration: Time::from_si(1.0),
    })
}

// outer.rs

const ROUND: ElementId = ElementId(0);
const AGAIN: ElementId = ElementId(1);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // subplan round: Round
    Round(Machine<super::round::Round>),
    // subplan again: Round
    Again(Machine<super::round::Round>),
}

/// The first ids of `round` begin.
const ROUND_PLACE: Child = Child { components: 2, entries: 2 };

/// Inputs of `round`.
fn round_inputs(config: &Config, to: &mut super::round::Config) -> Result<(), BadValue> {
    to.rounds.set(input(0, || Ok(float_to_int(config.often())?))?);
    to.label.set(input(1, || Ok(join("at ", Text::print(config.count())?.as_str())?))?);
    Ok(())
}

/// Results of `round`.
fn round_outputs(
    staged: &mut Staged,
    from: &super::round::Config,
) -> Result<(), BadValue> {
    if let Some(value) = from.done.value() {
        staged.count = Some(*value);
    }
    Ok(())
}

/// The first ids of `again` begin.
const AGAIN_PLACE: Child = Child { components: 5, entries: 6 };

/// Inputs of `again`.
fn again_inputs(to: &mut super::round::Config) -> Result<(), BadValue> {
    to.rounds.set(2);
    to.label.set(input(1, || Ok(Text::try_from("round")?))?);
    Ok(())
}
