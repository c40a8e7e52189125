//! The templates of the toolbox as types: ports, states and events.

use crate::devices::{
    Battery, ColorSensor, FlowCamera, InfraredSensor, Localisation, PathPlanner, Signals,
};

afp_macros::toolbox!("carbot.afp",
    robot: crate::Carbot + Battery + ColorSensor + FlowCamera + InfraredSensor + Localisation + PathPlanner + Signals
);
