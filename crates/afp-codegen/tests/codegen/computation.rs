// p.rs

const AREA: ElementId = ElementId(0);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
}

/// Inputs of `area`.
fn area_inputs(config: &Config) -> Result<kit::area::Inputs, BadValue> {
    Ok(kit::area::Inputs {
        width: config.width(),
        height: Length::from_si(3.0),
    })
}

/// Outputs of `area`.
fn area_outputs(staged: &mut Staged, outcome: kit::area::State) -> Result<(), BadValue> {
    match outcome {
        kit::area::State::Small { area: value_0 } => {
            staged.size = Some(output(0, || finite(value_0))?);
        }
        kit::area::State::Large { area: value_0 } => {
            staged.size = Some(output(0, || finite(value_0))?);
        }
    }
    Ok(())
}
