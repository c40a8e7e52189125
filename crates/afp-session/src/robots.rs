//! Kinds of simulated robots that a program links in.

use std::error::Error;
use std::marker::PhantomData;
use std::sync::Arc;

#[cfg(feature = "load")]
use afp::load::{Graph, LoadError, LoadedPlan, Registry};
use afp_core::devices::{DeviceRow, Devices};
use afp_core::rt::{NamedPlan, Plan};

#[cfg(feature = "load")]
use crate::any::AnySession;
use crate::record::Kept;
use crate::robot::{Droppable, Simulated};
use crate::session::Session;
use crate::world::{AnyWorld, World, WorldError};

/// A kind of simulated robot.
pub trait AnyRobot: Sync {
    /// Its devices.
    fn devices(&self) -> &'static [DeviceRow];

    /// Facts for logs: name and value.
    fn facts(&self) -> &'static [(&'static str, &'static str)];

    /// The names of its measures.
    fn measures(&self) -> &'static [&'static str];

    /// The shapes that can be added to its world during a run.
    fn drops(&self) -> &'static [Droppable];

    /// The text of the default world.
    fn default_world(&self) -> &'static str;

    /// The text of a world generated from a seed; `None` if that is not supported.
    fn made_up_world(&self, seed: u64) -> Option<String>;

    /// The name of the picture file of a map.
    ///
    /// # Errors
    /// The map is wrong.
    fn picture_of_map(&self, map: &str) -> Result<String, WorldError>;

    /// The text of the world that a map and its picture show.
    ///
    /// # Errors
    /// The map is wrong.
    fn text_of_map(&self, name: &str, map: &str, picture: &[u8]) -> Result<String, WorldError>;

    /// Reads a world.
    ///
    /// # Errors
    /// The first mistake, with its place.
    fn world(&self, text: &str) -> Result<Arc<dyn AnyWorld>, WorldError>;
}

/// The reason why a session cannot be created.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The plan cannot be loaded.
    #[cfg(feature = "load")]
    #[error("{0}")]
    Load(#[source] LoadError),
    /// The world cannot be built.
    #[error("{0}")]
    World(#[source] Box<dyn Error + Send + Sync>),
    /// The world belongs to another robot.
    #[error("the world is for another robot")]
    OtherWorld,
    /// The real robot cannot be reached.
    #[error("the robot cannot be reached: {0}")]
    Hardware(#[source] Box<dyn Error + Send + Sync>),
    /// The robot has no such measure, only these.
    #[error("the robot has no measure '{0}'")]
    Measure(String, &'static [&'static str]),
}

/// A kind of simulated robot, by its type.
pub struct Kind<R>(PhantomData<fn() -> R>);

/// The kind of a simulated robot.
pub const fn kind<R: Simulated>() -> Kind<R> {
    Kind(PhantomData)
}

impl<R: Simulated> AnyRobot for Kind<R> {
    fn devices(&self) -> &'static [DeviceRow] {
        <R::Devices as Devices>::TABLE
    }

    fn facts(&self) -> &'static [(&'static str, &'static str)] {
        R::FACTS
    }

    fn measures(&self) -> &'static [&'static str] {
        R::MEASURES
    }

    fn drops(&self) -> &'static [Droppable] {
        R::DROPS
    }

    fn default_world(&self) -> &'static str {
        R::World::DEFAULT
    }

    fn made_up_world(&self, seed: u64) -> Option<String> {
        R::World::made_up(seed)
    }

    fn picture_of_map(&self, map: &str) -> Result<String, WorldError> {
        R::World::picture_of_map(map)
    }

    fn text_of_map(&self, name: &str, map: &str, picture: &[u8]) -> Result<String, WorldError> {
        R::World::text_of_map(name, map, picture)
    }

    fn world(&self, text: &str) -> Result<Arc<dyn AnyWorld>, WorldError> {
        Ok(Arc::new(R::World::read(text)?))
    }
}

impl<P, R> Session<P, R, Kept>
where
    P: NamedPlan + Plan<R>,
    R: Simulated,
{
    /// A plan on a robot at its start in a world, judged by measures. An input `seed: int` of the
    /// plan gets the seed.
    ///
    /// # Errors
    /// The world belongs to another robot or cannot be built; the robot has no such measure.
    pub fn in_world(
        plan: P,
        world: &dyn AnyWorld,
        seed: u64,
        measures: &[&str],
    ) -> Result<Self, SessionError> {
        Session::new(plan, robot_in(world, seed)?).prepared(seed, measures)
    }

    /// Writes the seed to the plan's input `seed: int`, if it accepts the value, and adds measures.
    fn prepared(mut self, seed: u64, measures: &[&str]) -> Result<Self, SessionError> {
        self.write_seed(seed);
        for name in measures {
            let unknown = || SessionError::Measure((*name).to_owned(), R::MEASURES);
            self.add_measure(R::measure(name).ok_or_else(unknown)?);
        }
        Ok(self)
    }
}

/// A robot at its start in a world.
fn robot_in<R: Simulated>(world: &dyn AnyWorld, seed: u64) -> Result<R, SessionError> {
    let world = world.as_any().downcast_ref::<R::World>().ok_or(SessionError::OtherWorld)?;
    R::new(world, seed).map_err(|why| SessionError::World(why.into()))
}

/// A kind of simulated robot on which plans can be loaded.
#[cfg(feature = "load")]
pub trait Loader: Sync {
    /// The kind, with its devices and worlds.
    fn kind(&self) -> &dyn AnyRobot;

    /// A session of the main plan of a graph on a robot at its start in a world, judged by
    /// measures. An input `seed: int` of the plan gets the seed.
    ///
    /// # Errors
    /// A template is unknown to this program or does not work on the robot; the world belongs to
    /// another robot or cannot be built; the robot has no such measure.
    fn session(
        &self,
        plan: &Graph,
        world: &dyn AnyWorld,
        seed: u64,
        measures: &[&str],
    ) -> Result<Box<dyn AnySession>, SessionError>;
}

/// A kind of simulated robot with the templates for its plans.
#[cfg(feature = "load")]
struct Simulator<R, F> {
    kind: Kind<R>,
    register: F,
}

/// A kind of simulated robot. `register` registers the templates for its plans.
#[cfg(feature = "load")]
pub const fn simulated<R: Simulated, F: Fn(&mut Registry<R>) + Sync>(register: F) -> impl Loader {
    Simulator { kind: kind::<R>(), register }
}

#[cfg(feature = "load")]
impl<R: Simulated, F: Fn(&mut Registry<R>) + Sync> Loader for Simulator<R, F> {
    fn kind(&self) -> &dyn AnyRobot {
        &self.kind
    }

    fn session(
        &self,
        plan: &Graph,
        world: &dyn AnyWorld,
        seed: u64,
        measures: &[&str],
    ) -> Result<Box<dyn AnySession>, SessionError> {
        let mut registry = Registry::new();
        (self.register)(&mut registry);
        let plan = LoadedPlan::new(plan, &registry).map_err(SessionError::Load)?;
        let robot = robot_in::<R>(world, seed)?;
        Ok(Box::new(Session::loaded(plan, robot).prepared(seed, measures)?))
    }
}

impl SessionError {
    /// A hint for the error.
    pub fn help(&self) -> String {
        match self {
            #[cfg(feature = "load")]
            SessionError::Load(LoadError::Unsupported { .. }) => {
                "implement the traits for the robot, or use templates that it supports".to_owned()
            }
            #[cfg(feature = "load")]
            SessionError::Load(_) => "the toolbox file does not match its Rust crate".to_owned(),
            SessionError::World(_) | SessionError::OtherWorld => "check the world file".to_owned(),
            SessionError::Hardware(_) => {
                "check the robot's power and cable, and its settings in '[robot]' of afp.toml"
                    .to_owned()
            }
            SessionError::Measure(_, []) => "this robot has no measures".to_owned(),
            SessionError::Measure(_, known) => format!("this robot has {}", known.join(", ")),
        }
    }
}
