// p.rs

const NEAR: SupervisorId = SupervisorId(0);
const ANY: SupervisorId = SupervisorId(1);
const WAIT_SLOW: SupervisorId = SupervisorId(2);

/// The supervisors, each while it watches.
#[derive(Clone, Default)]
struct Supervisors {
    // global supervisor near: CheckValue
    near: Option<afp_std::CheckValue<Length>>,
    // global supervisor any: Watch
    any: Option<crate::kit::Watch<Text>>,
    // local supervisor wait.slow: CheckTimeout
    wait_slow: Option<afp_std::CheckTimeout>,
}

/// Live inputs of `near`.
fn near_live(
    config: &Config,
) -> Result<std_templates::check_value::Live<Length>, BadValue> {
    Ok(std_templates::check_value::Live {
        value: config.dist(),
        limit: Length::from_si(0.1),
    })
}

/// Inputs of `any`.
fn any_inputs<'a>() -> Result<kit::watch::Inputs<'a>, BadValue> {
    Ok(kit::watch::Inputs {
        label: "mood",
    })
}

/// Live inputs of `any`.
fn any_live(config: &Config) -> Result<kit::watch::Live<Text>, BadValue> {
    Ok(kit::watch::Live {
        value: config.mood.get().clone(),
    })
}

/// Outputs of `any`.
fn any_outputs(
    staged: &mut Staged,
    outcome: kit::watch::Event<Text>,
) -> Result<(), BadValue> {
    match outcome {
        kit::watch::Event::Changed { seen: value_0, side: value_1 } => {
            staged.mood = Some(value_0);
            staged.side = Some(value_1);
        }
        kit::watch::Event::Same { side: value_1 } => {
            staged.side = Some(value_1);
        }
    }
    Ok(())
}

/// Inputs of `wait.slow`.
fn wait_slow_inputs() -> Result<std_templates::check_timeout::Inputs, BadValue> {
    Ok(std_templates::check_timeout::Inputs {
        duration: Time::from_si(0.1),
    })
}
