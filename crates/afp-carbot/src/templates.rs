//! The toolbox's templates as types: ports, states and events.

use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};
use afp_core::{ActorTemplate, SupervisorTemplate};

macro_rules! actor {
    ($(#[$doc:meta])* $name:ident in $module:ident {
        inputs { $($input:ident: $ity:ty),* }
        states { $($state:ident $({ $($out:ident: $oty:ty),* })?),* }
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;
        #[allow(missing_docs, unused_imports)]
        pub mod $module {
            use super::*;
            #[derive(Clone, Copy, Debug)]
            pub struct Inputs { $(pub $input: $ity),* }
            #[derive(Clone, Copy, Debug)]
            pub struct Live {}
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub enum State { $($state $({ $($out: $oty),* })?),* }
        }
        impl ActorTemplate for $name {
            type Inputs<'a> = $module::Inputs;
            type Live<'a> = $module::Live;
            type State = $module::State;
        }
    };
}

macro_rules! supervisor {
    ($(#[$doc:meta])* $name:ident in $module:ident {
        inputs { $($input:ident: $ity:ty),* }
        live { $($live:ident: $lty:ty),* }
        events { $($event:ident),* }
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;
        #[allow(missing_docs, unused_imports)]
        pub mod $module {
            use super::*;
            #[derive(Clone, Copy, Debug)]
            pub struct Inputs { $(pub $input: $ity),* }
            #[derive(Clone, Copy, Debug)]
            pub struct Live { $(pub $live: $lty),* }
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub enum Event { $($event),* }
        }
        impl SupervisorTemplate for $name {
            type Inputs<'a> = $module::Inputs;
            type Live<'a> = $module::Live;
            type Event = $module::Event;
        }
    };
}

actor! {
    /// Drive straight ahead; backwards when the distance is negative.
    Forward in forward {
        inputs { distance: Length, speed: Speed }
        states { ForwardSuccessful { driven: Length } }
    }
}
actor! {
    /// Turn in place; clockwise when the angle is negative.
    Turn in turn {
        inputs { angle: Angle, speed: AngularSpeed }
        states { TurnSuccessful { turned: Angle } }
    }
}
actor! {
    /// Look around with the range sensor and fit one line to what it sees.
    SearchWall in search_wall {
        inputs { sweep: Angle, range: Length }
        states { WallFound { angle: Angle }, NoWallFound }
    }
}
actor! {
    /// Drive along a wall on the right side and keep the distance to it.
    WallForward in wall_forward {
        inputs {
            walldist: Length, lanedist: Length, gain: f64, tolerance: Length, step: Length,
            speed: Speed
        }
        states { ForwardSuccessful, LaneNotFree, WallLost }
    }
}
supervisor! {
    /// Watch the escape button.
    CheckEscapeButton in check_escape_button {
        inputs {} live {} events { EscapeButtonPressed }
    }
}
supervisor! {
    /// Watch the bumper.
    CheckTouchSensor in check_touch_sensor {
        inputs {} live {} events { TouchSensorPressed }
    }
}
supervisor! {
    /// Watch the lane ahead with the range sensor.
    CheckDrivingLane in check_driving_lane {
        inputs { clearance: Length, margin: Length, halfwidth: Length }
        live { distance: Length }
        events { LaneNotFree }
    }
}
