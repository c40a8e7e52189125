/// The text of the toolbox file.
pub const SOURCE: &str = "";

/// Which way round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// `left`
    #[default]
    Left,
    /// `right`
    Right,
}

impl ::afp_core::rt::Choice for Side {
    const NAMES: &'static [&'static str] = &["left", "right"];

    fn index(self) -> u16 {
        match self {
            Side::Left => 0,
            Side::Right => 1,
        }
    }

    fn from_index(index: u16) -> ::core::option::Option<Self> {
        match index {
            0 => ::core::option::Option::Some(Side::Left),
            1 => ::core::option::Option::Some(Side::Right),
            _ => ::core::option::Option::None,
        }
    }
}

impl ::afp_core::rt::Stored for Side {
    fn as_value(&self) -> ::afp_core::ValueRef<'_> {
        ::afp_core::ValueRef::Choice(::afp_core::rt::Choice::index(*self))
    }
}

impl ::afp_core::rt::Any for Side {}
impl ::afp_core::rt::Discrete for Side {}
impl ::afp_core::rt::Writable for Side {
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

/// Look for something.
#[derive(Clone, Copy, Debug)]
pub struct Seek;

impl ::afp_core::ActorTemplate for self::Seek {
    type Inputs<'a> = seek::Inputs<'a>;
    type Live<'a> = seek::Live;
    type State = seek::State;
}

/// Ports and states of [`Seek`].
pub mod seek {
    /// The inputs that are read before the start.
    #[derive(Clone, Copy)]
    pub struct Inputs<'a> {
        /// Its name.
        ///
        /// `string`
        pub name: &'a str,
        /// `Side`; Side.left if unbound
        pub side: super::Side,
        /// `Place`
        pub r#where: &'a super::super::Place,
        /// `int`; from 1 to 9; 3 if unbound
        pub tries: i64,
    }

    impl ::afp_core::rt::Ports for Inputs<'_> {
        #[inline]
        fn check(&self) -> Result<(), ::afp_core::rt::BadValue> {
            ::afp_core::rt::within_int(5, self.tries, 1, 9)?;
            Ok(())
        }

        fn each(&self, see: &mut dyn FnMut(u16, ::afp_core::ValueRef<'_>)) {
            see(0, ::afp_core::ValueRef::Text(self.name));
            see(1, ::afp_core::rt::Stored::as_value(&self.side));
            see(5, ::afp_core::rt::Stored::as_value(&self.tries));
        }
    }

    impl<'a> ::afp_core::rt::FromArgs<'a> for Inputs<'a> {
        fn from_args(
            args: &'a dyn ::afp_core::rt::Args,
        ) -> Result<Self, ::afp_core::rt::BadValue> {
            Ok(Inputs {
                name: ::afp_core::rt::input(0, || Ok(args.text(0)?))?,
                side: ::afp_core::rt::input(
                    1,
                    || Ok(
                        ::afp_core::rt::Choice::from_index(args.choice(1)?)
                            .ok_or(::afp_core::Fault::INTERNAL)?,
                    ),
                )?,
                r#where: ::afp_core::rt::input(
                    2,
                    || Ok(
                        args
                            .object(2)?
                            .downcast_ref()
                            .ok_or(::afp_core::Fault::INTERNAL)?,
                    ),
                )?,
                tries: ::afp_core::rt::input(5, || Ok(args.int(5)?))?,
            })
        }
    }

    /// The inputs that are read again at every poll.
    #[derive(Clone, Copy, Debug)]
    pub struct Live {
        /// `speed`; from 0 m/s to 1 m/s; 0.1 m/s if unbound
        pub speed: ::afp_core::quantity::Speed,
        /// `bool`; true if unbound
        pub r#loop: bool,
    }

    impl ::afp_core::rt::Ports for Live {
        #[inline]
        fn check(&self) -> Result<(), ::afp_core::rt::BadValue> {
            ::afp_core::rt::within(
                3,
                self.speed.si(),
                ::afp_core::quantity::Speed::from_si(0.0).si(),
                ::afp_core::quantity::Speed::from_si(1.0).si(),
            )?;
            Ok(())
        }

        fn each(&self, see: &mut dyn FnMut(u16, ::afp_core::ValueRef<'_>)) {
            see(3, ::afp_core::rt::Stored::as_value(&self.speed));
            see(4, ::afp_core::rt::Stored::as_value(&self.r#loop));
        }
    }

    impl<'a> ::afp_core::rt::FromArgs<'a> for Live {
        fn from_args(
            args: &'a dyn ::afp_core::rt::Args,
        ) -> Result<Self, ::afp_core::rt::BadValue> {
            Ok(Live {
                speed: ::afp_core::rt::input(
                    3,
                    || Ok(::afp_core::quantity::Speed::from_si(args.float(3)?)),
                )?,
                r#loop: ::afp_core::rt::input(4, || Ok(args.bool(4)?))?,
            })
        }
    }

    /// The states, each with its outputs.
    #[derive(Clone)]
    pub enum State {
        /// `Found`
        Found {
            /// `Place`
            place: super::super::Place,
            /// `string`
            said: ::afp_core::Text,
        },
        /// `Lost`
        Lost {
            /// `string`
            said: ::afp_core::Text,
            /// `angle`
            turn: ::afp_core::quantity::Angle,
        },
        /// `Bored`
        Bored,
    }

    impl ::afp_core::rt::Outcome for State {
        #[inline]
        fn index(&self) -> u16 {
            match *self {
                State::Found { .. } => 0,
                State::Lost { .. } => 1,
                State::Bored => 2,
            }
        }

        fn give(self, to: &mut dyn ::afp_core::rt::Outputs) {
            match self {
                State::Found { place: value_0, said: value_1 } => {
                    to.object(0, &mut Some(value_0));
                    to.text(1, &value_1);
                }
                State::Lost { said: value_1, turn: value_2 } => {
                    to.text(1, &value_1);
                    to.float(2, value_2.si());
                }
                State::Bored => {}
            }
        }
    }
}

/// Watch any value.
#[derive(Clone, Copy, Debug)]
pub struct Watch<V>(::core::marker::PhantomData<V>);

impl<V: ::afp_core::rt::Any> ::afp_core::SupervisorTemplate for self::Watch<V> {
    type Inputs<'a> = watch::Inputs<'a>;
    type Live<'a> = watch::Live<V>;
    type Event = watch::Event<V>;
}

/// Ports and events of [`Watch`].
pub mod watch {
    /// The inputs that are read before the start.
    #[derive(Clone, Copy, Debug)]
    pub struct Inputs<'a> {
        /// `string`
        pub label: &'a str,
    }

    impl ::afp_core::rt::Ports for Inputs<'_> {
        #[inline]
        fn check(&self) -> Result<(), ::afp_core::rt::BadValue> {
            Ok(())
        }

        fn each(&self, see: &mut dyn FnMut(u16, ::afp_core::ValueRef<'_>)) {
            see(1, ::afp_core::ValueRef::Text(self.label));
        }
    }

    impl<'a> ::afp_core::rt::FromArgs<'a> for Inputs<'a> {
        fn from_args(
            args: &'a dyn ::afp_core::rt::Args,
        ) -> Result<Self, ::afp_core::rt::BadValue> {
            Ok(Inputs {
                label: ::afp_core::rt::input(1, || Ok(args.text(1)?))?,
            })
        }
    }

    /// The inputs that are read again at every poll.
    #[derive(Clone, Copy, Debug)]
    pub struct Live<V> {
        /// `any`
        pub value: V,
    }

    impl<V: ::afp_core::rt::Any> ::afp_core::rt::Ports for Live<V> {
        #[inline]
        fn check(&self) -> Result<(), ::afp_core::rt::BadValue> {
            ::afp_core::rt::within_value(
                0,
                ::afp_core::rt::Stored::as_value(&self.value),
            )?;
            Ok(())
        }

        fn each(&self, see: &mut dyn FnMut(u16, ::afp_core::ValueRef<'_>)) {
            see(0, ::afp_core::rt::Stored::as_value(&self.value));
        }
    }

    impl<'a> ::afp_core::rt::FromArgs<'a> for Live<::afp_core::Value> {
        fn from_args(
            args: &'a dyn ::afp_core::rt::Args,
        ) -> Result<Self, ::afp_core::rt::BadValue> {
            Ok(Live {
                value: ::afp_core::rt::input(0, || Ok(args.value(0)?))?,
            })
        }
    }

    /// The events, each with its outputs.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Event<V> {
        /// `Changed`
        Changed {
            /// `any`
            seen: V,
            /// `Side`
            side: super::Side,
        },
        /// `Same`
        Same {
            /// `Side`
            side: super::Side,
        },
    }

    impl<V: ::afp_core::rt::Any> ::afp_core::rt::Outcome for Event<V> {
        #[inline]
        fn index(&self) -> u16 {
            match *self {
                Event::Changed { .. } => 0,
                Event::Same { .. } => 1,
            }
        }

        fn give(self, to: &mut dyn ::afp_core::rt::Outputs) {
            match self {
                Event::Changed { seen: value_0, side: value_1 } => {
                    to.value(0, ::afp_core::rt::Stored::to_value(&value_0));
                    to.choice(1, ::afp_core::rt::Choice::index(value_1));
                }
                Event::Same { side: value_1 } => {
                    to.choice(1, ::afp_core::rt::Choice::index(value_1));
                }
            }
        }
    }
}

/// Work out an area.
#[derive(Clone, Copy, Debug)]
pub struct Area;

impl ::afp_core::ComputationTemplate for self::Area {
    type Inputs<'a> = area::Inputs;
    type State = area::State;
}

/// Ports and states of [`Area`].
pub mod area {
    /// The inputs that are read before the start.
    #[derive(Clone, Copy, Debug)]
    pub struct Inputs {
        /// `length`
        pub width: ::afp_core::quantity::Length,
        /// `length`
        pub height: ::afp_core::quantity::Length,
    }

    impl ::afp_core::rt::Ports for Inputs {
        #[inline]
        fn check(&self) -> Result<(), ::afp_core::rt::BadValue> {
            ::afp_core::rt::within_value(
                0,
                ::afp_core::rt::Stored::as_value(&self.width),
            )?;
            ::afp_core::rt::within_value(
                1,
                ::afp_core::rt::Stored::as_value(&self.height),
            )?;
            Ok(())
        }

        fn each(&self, see: &mut dyn FnMut(u16, ::afp_core::ValueRef<'_>)) {
            see(0, ::afp_core::rt::Stored::as_value(&self.width));
            see(1, ::afp_core::rt::Stored::as_value(&self.height));
        }
    }

    impl<'a> ::afp_core::rt::FromArgs<'a> for Inputs {
        fn from_args(
            args: &'a dyn ::afp_core::rt::Args,
        ) -> Result<Self, ::afp_core::rt::BadValue> {
            Ok(Inputs {
                width: ::afp_core::rt::input(
                    0,
                    || Ok(::afp_core::quantity::Length::from_si(args.float(0)?)),
                )?,
                height: ::afp_core::rt::input(
                    1,
                    || Ok(::afp_core::quantity::Length::from_si(args.float(1)?)),
                )?,
            })
        }
    }

    /// The states, each with its outputs.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum State {
        /// `Small`
        Small {
            /// `length^2`
            area: ::afp_core::quantity::Quantity<2, 0, 0, 0, 0, 0>,
        },
        /// `Large`
        Large {
            /// `length^2`
            area: ::afp_core::quantity::Quantity<2, 0, 0, 0, 0, 0>,
        },
    }

    impl ::afp_core::rt::Outcome for State {
        #[inline]
        fn index(&self) -> u16 {
            match *self {
                State::Small { .. } => 0,
                State::Large { .. } => 1,
            }
        }

        fn give(self, to: &mut dyn ::afp_core::rt::Outputs) {
            match self {
                State::Small { area: value_0 } => {
                    to.float(0, value_0.si());
                }
                State::Large { area: value_0 } => {
                    to.float(0, value_0.si());
                }
            }
        }
    }
}

/// Say where this is.
#[derive(Clone, Copy, Debug)]
pub struct Here;

impl ::afp_core::ComputationTemplate for self::Here {
    type Inputs<'a> = here::Inputs;
    type State = here::State;
}

/// Ports and states of [`Here`].
pub mod here {
    /// The inputs that are read before the start.
    #[derive(Clone, Copy, Debug)]
    pub struct Inputs {}
    impl ::afp_core::rt::Ports for Inputs {
        #[inline]
        fn check(&self) -> Result<(), ::afp_core::rt::BadValue> {
            Ok(())
        }

        fn each(&self, _: &mut dyn FnMut(u16, ::afp_core::ValueRef<'_>)) {}
    }

    impl<'a> ::afp_core::rt::FromArgs<'a> for Inputs {
        fn from_args(
            _: &'a dyn ::afp_core::rt::Args,
        ) -> Result<Self, ::afp_core::rt::BadValue> {
            Ok(Inputs {})
        }
    }

    /// The states, each with its outputs.
    #[derive(Clone)]
    pub enum State {
        /// `Done`
        Done {
            /// `Place`
            place: super::super::Place,
        },
    }

    impl ::afp_core::rt::Outcome for State {
        #[inline]
        fn index(&self) -> u16 {
            match *self {
                State::Done { .. } => 0,
            }
        }

        fn give(self, to: &mut dyn ::afp_core::rt::Outputs) {
            match self {
                State::Done { place: value_0 } => {
                    to.object(0, &mut Some(value_0));
                }
            }
        }
    }
}

/// Names the Rust type of every template and object to a registry.
pub fn register<E, R>(registry: &mut R)
where
    E: ?::core::marker::Sized,
    R: ::afp_core::rt::Registry<E>,
    super::Seek: ::afp_core::Actor<self::Seek, E>,
    super::Watch<
        ::afp_core::Value,
    >: ::afp_core::Supervisor<self::Watch<::afp_core::Value>, E>,
{
    registry.actor::<self::Seek, super::Seek>("kit", "Seek");
    registry
        .supervisor::<
            self::Watch<::afp_core::Value>,
            super::Watch<::afp_core::Value>,
        >("kit", "Watch");
    registry.computation::<self::Area, super::Area>("kit", "Area");
    registry.computation::<self::Here, super::Here>("kit", "Here");
    registry.object::<super::Place>("kit", "Place");
}
