//! The templates of the toolbox as types: ports, states and events.

afp_macros::toolbox!("carbot.afp", robot: crate::Carbot);
