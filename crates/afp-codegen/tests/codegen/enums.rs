// enums.rs

/// The enum `Mood`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mood {
    /// `calm`
    #[default]
    Calm,
    /// `wild`
    Wild,
    /// `loop`
    Loop,
}

impl ::afp_core::rt::Choice for Mood {
    const NAMES: &'static [&'static str] = &["calm", "wild", "loop"];

    fn index(self) -> u16 {
        match self {
            Mood::Calm => 0,
            Mood::Wild => 1,
            Mood::Loop => 2,
        }
    }

    fn from_index(index: u16) -> ::core::option::Option<Self> {
        match index {
            0 => ::core::option::Option::Some(Mood::Calm),
            1 => ::core::option::Option::Some(Mood::Wild),
            2 => ::core::option::Option::Some(Mood::Loop),
            _ => ::core::option::Option::None,
        }
    }
}

impl ::afp_core::rt::Stored for Mood {
    fn as_value(&self) -> ::afp_core::ValueRef<'_> {
        ::afp_core::ValueRef::Choice(::afp_core::rt::Choice::index(*self))
    }
}

impl ::afp_core::rt::Any for Mood {}
impl ::afp_core::rt::Discrete for Mood {}
impl ::afp_core::rt::Writable for Mood {
    fn from_value(
        value: &::afp_core::Value,
    ) -> ::core::result::Result<Self, ::afp_core::WriteError> {
        match value {
            ::afp_core::Value::Choice(index) => {
                ::afp_core::rt::Choice::from_index(*index)
                    .ok_or(::afp_core::WriteError::Type)
            }
            _ => ::core::result::Result::Err(::afp_core::WriteError::Type),
        }
    }
}

// p.rs

const SET: ElementId = ElementId(0);
const LOG: ElementId = ElementId(1);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
}

/// Inputs of `set`.
fn set_inputs() -> Result<std_templates::assign::Inputs<super::enums::Mood>, BadValue> {
    Ok(std_templates::assign::Inputs {
        value: super::enums::Mood::Loop,
    })
}

/// Outputs of `set`.
fn set_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<super::enums::Mood>,
) -> Result<(), BadValue> {
    let std_templates::assign::State::Done { result: value_0 } = outcome;
    staged.mood = Some(value_0);
    Ok(())
}

/// Inputs of `log`.
fn log_inputs(config: &Config) -> Result<std_templates::log::Inputs<Text>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: input(0, || Ok(join("mood ", print_choice(config.mood())?.as_str())?))?,
    })
}
