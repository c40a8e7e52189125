// p.rs

const A: ElementId = ElementId(0);
const B: ElementId = ElementId(1);
const C: ElementId = ElementId(2);
const D: ElementId = ElementId(3);
const E: ElementId = ElementId(4);
const K: ElementId = ElementId(5);
const N: ElementId = ElementId(6);
const O: ElementId = ElementId(7);
const P: ElementId = ElementId(8);
const Q: ElementId = ElementId(9);
const R: ElementId = ElementId(10);
const S: ElementId = ElementId(11);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor n: Wait
    N(afp_std::Wait),
}

/// Inputs of `a`.
fn a_inputs(config: &Config) -> Result<std_templates::assign::Inputs<f64>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: config.f(),
    })
}

/// Outputs of `a`.
fn a_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<f64>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.number = Some(output(0, || Ok(float_to_int(value_0)?))?);
    Ok(())
}

/// Inputs of `b`.
fn b_inputs(config: &Config) -> Result<std_templates::assign::Inputs<Length>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: config.way(),
    })
}

/// Outputs of `b`.
fn b_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<Length>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.said = Some(output(0, || Ok(print_quantity(value_0.si(), "m")?))?);
    Ok(())
}

/// Inputs of `c`.
fn c_inputs(config: &Config) -> Result<std_templates::assign::Inputs<bool>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: config.flag(),
    })
}

/// Outputs of `c`.
fn c_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<bool>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.said = Some(output(0, || Ok(Text::print(value_0)?))?);
    Ok(())
}

/// Inputs of `d`.
fn d_inputs() -> Result<
    std_templates::assign::Inputs<crate::kit::templates::Side>,
    BadValue,
> {
    Ok(std_templates::assign::Inputs {
        value: crate::kit::templates::Side::Left,
    })
}

/// Outputs of `d`.
fn d_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<crate::kit::templates::Side>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.said = Some(output(0, || Ok(print_choice(value_0)?))?);
    Ok(())
}

/// Inputs of `e`.
fn e_inputs(config: &Config) -> Result<kit::area::Inputs, BadValue> {
    Ok(kit::area::Inputs {
        width: input(
            0,
            || Ok(
                Length::from_si(
                    parse_quantity(config.text(), super::units::LENGTH.iter().copied())?,
                ),
            ),
        )?,
        height: Length::from_si(1.0),
    })
}

/// Inputs of `k`.
fn k_inputs(config: &Config) -> Result<std_templates::count::Inputs, BadValue> {
    Ok(std_templates::count::Inputs {
        value: bool_to_int(config.flag()),
        limit: input(1, || Ok(parse_int(config.text())?))?,
    })
}

/// Inputs of `n`.
fn n_inputs(config: &Config) -> Result<std_templates::wait::Inputs, BadValue> {
    Ok(std_templates::wait::Inputs {
        duration: input(
            0,
            || Ok(
                Time::from_si(
                    parse_quantity(
                        config.text(),
                        super::units::DURATION.iter().copied(),
                    )?,
                ),
            ),
        )?,
    })
}

/// Inputs of `o`.
fn o_inputs(config: &Config) -> Result<std_templates::compare::Inputs<f64>, BadValue> {
    Ok(std_templates::compare::Inputs {
        left: int_to_float(config.i()),
        right: config.f(),
    })
}

/// Inputs of `p`.
fn p_inputs(config: &Config) -> Result<std_templates::assign::Inputs<Text>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: config.text.get().clone(),
    })
}

/// Outputs of `p`.
fn p_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<Text>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.number = Some(output(0, || Ok(parse_int(value_0.as_str())?))?);
    Ok(())
}

/// Inputs of `q`.
fn q_inputs() -> Result<std_templates::assign::Inputs<Text>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: input(0, || Ok(join("n", Text::print(3000000000i64)?.as_str())?))?,
    })
}

/// Outputs of `q`.
fn q_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<Text>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.said = Some(value_0);
    Ok(())
}

/// Inputs of `r`.
fn r_inputs() -> Result<std_templates::assign::Inputs<Text>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: input(0, || Ok(join("n", Text::print(i64::MIN)?.as_str())?))?,
    })
}

/// Outputs of `r`.
fn r_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<Text>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.said = Some(value_0);
    Ok(())
}

/// Inputs of `s`.
fn s_inputs(config: &Config) -> Result<std_templates::assign::Inputs<Text>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: input(0, || Ok(join(config.t(), config.first())?))?,
    })
}

/// Outputs of `s`.
fn s_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<Text>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.said = Some(value_0);
    Ok(())
}
