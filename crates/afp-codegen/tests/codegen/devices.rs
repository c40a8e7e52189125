/// The text of the toolbox file.
pub const SOURCE: &str = "";

/// The devices that the toolbox declares.
pub mod devices {
    /// Their table, and the meaning of its numbers.
    #[derive(Clone, Copy, Debug)]
    pub struct Devices;

    /// The controls that can be held down.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Control {
        /// One side of it.
        BumperLeft,
        /// One side of it.
        BumperRight,
        /// Ends the plan.
        Panel,
    }

    /// The faults, with their amounts.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Fault {
        /// A common sensor fault of `bumper`.
        Bumper(::afp_core::devices::Defect),
        /// A common sensor fault of `battery`.
        Battery(::afp_core::devices::Defect),
        /// The remaining share.
        BatteryLow {
            /// `share`: 0 to 1; 0.05 by default
            share: f64,
        },
        /// `wheels.blocked`
        WheelsBlocked,
        /// The additional speed.
        WheelsRunaway {
            /// `by`: any m/s; 0.1 by default
            by: ::afp_core::quantity::Speed,
        },
    }

    impl Fault {
        /// A common sensor fault of `bumper`.
        pub fn bumper(self) -> ::core::option::Option<::afp_core::devices::Defect> {
            match self {
                Fault::Bumper(defect) => ::core::option::Option::Some(defect),
                _ => ::core::option::Option::None,
            }
        }

        /// A common sensor fault of `battery`.
        pub fn battery(self) -> ::core::option::Option<::afp_core::devices::Defect> {
            match self {
                Fault::Battery(defect) => ::core::option::Option::Some(defect),
                _ => ::core::option::Option::None,
            }
        }

        /// The remaining share.
        pub fn battery_low(self) -> ::core::option::Option<f64> {
            match self {
                Fault::BatteryLow { share: value } => ::core::option::Option::Some(value),
                _ => ::core::option::Option::None,
            }
        }

        /// `wheels.blocked`
        pub fn wheels_blocked(self) -> ::core::option::Option<()> {
            match self {
                Fault::WheelsBlocked => ::core::option::Option::Some(()),
                _ => ::core::option::Option::None,
            }
        }

        /// The additional speed.
        pub fn wheels_runaway(
            self,
        ) -> ::core::option::Option<::afp_core::quantity::Speed> {
            match self {
                Fault::WheelsRunaway { by: value } => ::core::option::Option::Some(value),
                _ => ::core::option::Option::None,
            }
        }
    }

    impl ::afp_core::devices::Devices for Devices {
        const TABLE: &'static [::afp_core::devices::DeviceRow] = &[
            ::afp_core::devices::DeviceRow {
                name: "bumper",
                help: "the bumper in front",
                controls: &[
                    ::afp_core::devices::ControlRow {
                        name: "left",
                        help: "one side of it",
                        stops: false,
                    },
                    ::afp_core::devices::ControlRow {
                        name: "right",
                        help: "one side of it",
                        stops: false,
                    },
                ],
                faults: &[
                    ::afp_core::devices::FaultRow {
                        name: "frozen",
                        amount: ::core::option::Option::None,
                        help: "it repeats its last value as a new value",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "lost",
                        amount: ::core::option::Option::None,
                        help: "it does not answer",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "nan",
                        amount: ::core::option::Option::None,
                        help: "its values are not numbers",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "delayed",
                        amount: ::core::option::Option::Some(::afp_core::devices::AmountRow {
                            name: "time",
                            unit: "s",
                            default: 0.2,
                            from: 0.0,
                            to: 86400.0,
                        }),
                        help: "its readings arrive late by this time",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "slow",
                        amount: ::core::option::Option::Some(::afp_core::devices::AmountRow {
                            name: "time",
                            unit: "s",
                            default: 0.02,
                            from: 0.0,
                            to: 86400.0,
                        }),
                        help: "each use takes this time",
                    },
                ],
                signals: &[
                    ::afp_core::devices::SignalRow {
                        name: "left",
                        ty: ::afp_core::devices::SignalType::Bool,
                        truth: false,
                        help: "",
                    },
                    ::afp_core::devices::SignalRow {
                        name: "right",
                        ty: ::afp_core::devices::SignalType::Bool,
                        truth: false,
                        help: "",
                    },
                ],
            },
            ::afp_core::devices::DeviceRow {
                name: "battery",
                help: "the cells",
                controls: &[],
                faults: &[
                    ::afp_core::devices::FaultRow {
                        name: "frozen",
                        amount: ::core::option::Option::None,
                        help: "it repeats its last value as a new value",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "lost",
                        amount: ::core::option::Option::None,
                        help: "it does not answer",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "nan",
                        amount: ::core::option::Option::None,
                        help: "its values are not numbers",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "delayed",
                        amount: ::core::option::Option::Some(::afp_core::devices::AmountRow {
                            name: "time",
                            unit: "s",
                            default: 0.2,
                            from: 0.0,
                            to: 86400.0,
                        }),
                        help: "its readings arrive late by this time",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "slow",
                        amount: ::core::option::Option::Some(::afp_core::devices::AmountRow {
                            name: "time",
                            unit: "s",
                            default: 0.02,
                            from: 0.0,
                            to: 86400.0,
                        }),
                        help: "each use takes this time",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "low",
                        amount: ::core::option::Option::Some(::afp_core::devices::AmountRow {
                            name: "share",
                            unit: "",
                            default: 0.05,
                            from: 0.0,
                            to: 1.0,
                        }),
                        help: "the remaining share",
                    },
                ],
                signals: &[
                    ::afp_core::devices::SignalRow {
                        name: "voltage",
                        ty: ::afp_core::devices::SignalType::Float("V"),
                        truth: false,
                        help: "the voltage of the cells",
                    },
                ],
            },
            ::afp_core::devices::DeviceRow {
                name: "wheels",
                help: "",
                controls: &[],
                faults: &[
                    ::afp_core::devices::FaultRow {
                        name: "blocked",
                        amount: ::core::option::Option::None,
                        help: "",
                    },
                    ::afp_core::devices::FaultRow {
                        name: "runaway",
                        amount: ::core::option::Option::Some(::afp_core::devices::AmountRow {
                            name: "by",
                            unit: "m/s",
                            default: 0.1,
                            from: f64::NEG_INFINITY,
                            to: f64::INFINITY,
                        }),
                        help: "the additional speed",
                    },
                ],
                signals: &[],
            },
            ::afp_core::devices::DeviceRow {
                name: "panel",
                help: "",
                controls: &[
                    ::afp_core::devices::ControlRow {
                        name: "panel",
                        help: "ends the plan",
                        stops: true,
                    },
                ],
                faults: &[],
                signals: &[],
            },
            ::afp_core::devices::DeviceRow {
                name: "robot",
                help: "",
                controls: &[],
                faults: &[],
                signals: &[
                    ::afp_core::devices::SignalRow {
                        name: "pose",
                        ty: ::afp_core::devices::SignalType::Pose,
                        truth: true,
                        help: "",
                    },
                    ::afp_core::devices::SignalRow {
                        name: "contact",
                        ty: ::afp_core::devices::SignalType::Text,
                        truth: true,
                        help: "",
                    },
                    ::afp_core::devices::SignalRow {
                        name: "cleaned",
                        ty: ::afp_core::devices::SignalType::Float(""),
                        truth: true,
                        help: "",
                    },
                    ::afp_core::devices::SignalRow {
                        name: "bumper_left",
                        ty: ::afp_core::devices::SignalType::Int,
                        truth: true,
                        help: "",
                    },
                ],
            },
        ];
        type Control = Control;
        type Fault = Fault;
        fn control(
            id: ::afp_core::devices::ControlId,
        ) -> ::core::option::Option<Control> {
            match id.0 {
                0 => ::core::option::Option::Some(Control::BumperLeft),
                1 => ::core::option::Option::Some(Control::BumperRight),
                2 => ::core::option::Option::Some(Control::Panel),
                _ => ::core::option::Option::None,
            }
        }

        fn fault(
            id: ::afp_core::devices::FaultId,
            amount: ::core::option::Option<f64>,
        ) -> ::core::option::Option<Fault> {
            let amount = ::afp_core::devices::amount(Self::TABLE, id, amount)?;
            let _ = amount;
            match id.0 {
                0 => {
                    ::core::option::Option::Some(
                        Fault::Bumper(::afp_core::devices::Defect::Frozen),
                    )
                }
                1 => {
                    ::core::option::Option::Some(
                        Fault::Bumper(::afp_core::devices::Defect::Lost),
                    )
                }
                2 => {
                    ::core::option::Option::Some(
                        Fault::Bumper(::afp_core::devices::Defect::NotANumber),
                    )
                }
                3 => {
                    ::core::option::Option::Some(
                        Fault::Bumper(
                            ::afp_core::devices::Defect::Delayed(
                                ::afp_core::Duration::from_secs_f64(amount),
                            ),
                        ),
                    )
                }
                4 => {
                    ::core::option::Option::Some(
                        Fault::Bumper(
                            ::afp_core::devices::Defect::Slow(
                                ::afp_core::Duration::from_secs_f64(amount),
                            ),
                        ),
                    )
                }
                5 => {
                    ::core::option::Option::Some(
                        Fault::Battery(::afp_core::devices::Defect::Frozen),
                    )
                }
                6 => {
                    ::core::option::Option::Some(
                        Fault::Battery(::afp_core::devices::Defect::Lost),
                    )
                }
                7 => {
                    ::core::option::Option::Some(
                        Fault::Battery(::afp_core::devices::Defect::NotANumber),
                    )
                }
                8 => {
                    ::core::option::Option::Some(
                        Fault::Battery(
                            ::afp_core::devices::Defect::Delayed(
                                ::afp_core::Duration::from_secs_f64(amount),
                            ),
                        ),
                    )
                }
                9 => {
                    ::core::option::Option::Some(
                        Fault::Battery(
                            ::afp_core::devices::Defect::Slow(
                                ::afp_core::Duration::from_secs_f64(amount),
                            ),
                        ),
                    )
                }
                10 => ::core::option::Option::Some(Fault::BatteryLow { share: amount }),
                11 => ::core::option::Option::Some(Fault::WheelsBlocked),
                12 => {
                    ::core::option::Option::Some(Fault::WheelsRunaway {
                        by: ::afp_core::quantity::Speed::from_si(amount),
                    })
                }
                _ => ::core::option::Option::None,
            }
        }
    }
}

/// The numbers of the signals of [`devices`].
pub mod signal {
    /// `bumper.left`
    pub const BUMPER_LEFT: ::afp_core::devices::SignalId = ::afp_core::devices::SignalId(
        0,
    );

    /// `bumper.right`
    pub const BUMPER_RIGHT: ::afp_core::devices::SignalId = ::afp_core::devices::SignalId(
        1,
    );

    /// The voltage of the cells.
    pub const BATTERY_VOLTAGE: ::afp_core::devices::SignalId = ::afp_core::devices::SignalId(
        2,
    );

    /// `robot.pose`
    pub const POSE: ::afp_core::devices::SignalId = ::afp_core::devices::SignalId(3);

    /// `robot.contact`
    pub const CONTACT: ::afp_core::devices::SignalId = ::afp_core::devices::SignalId(4);

    /// `robot.cleaned`
    pub const CLEANED: ::afp_core::devices::SignalId = ::afp_core::devices::SignalId(5);

    /// `robot.bumper_left`
    pub const BUMPER_LEFT_2: ::afp_core::devices::SignalId = ::afp_core::devices::SignalId(
        6,
    );
}

/// Names the Rust type of every template and object to a registry.
pub fn register<E, R>(registry: &mut R)
where
    E: ?::core::marker::Sized,
    R: ::afp_core::rt::Registry<E>,
{}
