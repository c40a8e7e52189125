// p.rs

const A: ElementId = ElementId(0);
const B: ElementId = ElementId(1);
const C: ElementId = ElementId(2);
const D: ElementId = ElementId(3);
const E: ElementId = ElementId(4);
const K: ElementId = ElementId(5);
const N: ElementId = ElementId(6);
const O: ElementId = ElementId(7);
const Q: ElementId = ElementId(8);
const R: ElementId = ElementId(9);
const S: ElementId = ElementId(10);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
}

/// Inputs of `a`.
fn a_inputs(config: &Config) -> Result<std_templates::log::Inputs<i64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(0, || Ok(int_sub(int_mul(int_neg(config.i())?, 2)?, int_neg(3)?)?))?,
    })
}

/// Inputs of `b`.
fn b_inputs(config: &Config) -> Result<std_templates::log::Inputs<i64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(0, || Ok(int_rem(int_add(config.i(), 1)?, 4)?))?,
    })
}

/// Inputs of `c`.
fn c_inputs(config: &Config) -> Result<std_templates::log::Inputs<f64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: int_to_float(config.i()) / 4.0 + config.f() * (config.f() - 1.5),
    })
}

/// Inputs of `d`.
fn d_inputs(config: &Config) -> Result<std_templates::log::Inputs<f64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(0, || Ok(rem(config.f(), (config.f() + 1.0))?))?,
    })
}

/// Inputs of `e`.
fn e_inputs(config: &Config) -> Result<std_templates::log::Inputs<Time>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: Time::from_si(
            Length::from_si(2.0 * (config.way() - Length::from_si(0.1)).si()).si()
                / config.pace().si(),
        ),
    })
}

/// Inputs of `k`.
fn k_inputs(config: &Config) -> Result<std_templates::log::Inputs<f64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(
            0,
            || Ok(
                1.0
                    - config.way()
                        / divisor(
                            Length::from_si(config.pace().si() * Time::from_si(3.0).si()),
                        )?,
            ),
        )?,
    })
}

/// Inputs of `n`.
fn n_inputs(config: &Config) -> Result<std_templates::log::Inputs<Text>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(
            0,
            || Ok(
                join(
                    join(
                            join("i ", Text::print(config.i())?.as_str())?.as_str(),
                            " of ",
                        )?
                        .as_str(),
                    "4",
                )?,
            ),
        )?,
    })
}

/// Inputs of `o`.
fn o_inputs(config: &Config) -> Result<std_templates::log::Inputs<i64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(0, || Ok(int_min(int_min(config.i(), 3), int_neg(config.i())?)))?,
    })
}

/// Inputs of `q`.
fn q_inputs(config: &Config) -> Result<std_templates::log::Inputs<i64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(
            0,
            || Ok(int_add(int_clamp(config.i(), int_neg(int_abs(config.i())?)?, 5)?, 1)?),
        )?,
    })
}

/// Inputs of `r`.
fn r_inputs(config: &Config) -> Result<std_templates::log::Inputs<Length>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(
            0,
            || Ok(
                Length::from_si(
                    hypot(
                        config.way().si(),
                        max(config.way().si(), Length::from_si(2.0).si())?,
                    ),
                ) / 2.0,
            ),
        )?,
    })
}

/// Inputs of `s`.
fn s_inputs(config: &Config) -> Result<std_templates::log::Inputs<f64>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(
            0,
            || Ok(
                sin(
                    atan2(
                        Length::from_si(2.0 * config.way().si()).si(),
                        sqrt(
                            <Quantity<
                                2,
                                0,
                                0,
                                0,
                                0,
                                0,
                            >>::from_si(config.way().si() * config.way().si())
                                .si(),
                        ),
                    )?,
                ) * abs(config.f()),
            ),
        )?,
    })
}
