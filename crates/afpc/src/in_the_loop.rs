//! Scenarios with the real driver: the simulator is behind the protocol of the robot's controller, on
//! a pseudo-terminal, in real time.

mod controllers;
mod line;
mod plant;

use afp::load::{Graph, LoadedPlan, Registry};
use afp_pi::{JsonLine, Line, SerialRobot, WireLine};
use afp_project::ProfileRobot;
use afp_run::RunError;
use afp_session::{
    AnyRobot, AnySession, AnyWorld, Kind, Loader, Session, SessionError, Settings, kind,
};
use afp_sim::{Simulation, World};

use controllers::{Controller, Json, Wire};
use line::Looped;
use plant::Plant;

/// A loader of robots with a profile whose driver talks to a simulator.
pub struct InTheLoop {
    kind: Kind<Simulation>,
    robot: ProfileRobot,
}

/// The loader for a project's robot.
///
/// # Errors
/// The project's robot has no profile, or one without a driver.
pub fn loader(robot: Option<&ProfileRobot>) -> Result<InTheLoop, RunError> {
    match robot {
        Some(robot) if [WireLine::PROFILE, JsonLine::PROFILE].contains(&robot.name) => {
            Ok(InTheLoop { kind: kind::<Simulation>(), robot: robot.clone() })
        }
        Some(robot) => {
            let message = format!("a robot with the profile '{}' has no driver here", robot.name);
            Err(RunError::usage(message, "leave out '--in-the-loop'"))
        }
        None => {
            let help = "'afpc new mycar --profile carbot' creates such a project";
            Err(RunError::usage("'--in-the-loop' needs a robot with a profile", help))
        }
    }
}

impl Loader for InTheLoop {
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
        if let Some(name) = measures.first() {
            return Err(SessionError::Measure((*name).to_owned(), &[]));
        }
        let world = world.as_any().downcast_ref::<World>().ok_or(SessionError::OtherWorld)?;
        let simulation =
            Simulation::new(world, seed).map_err(|why| SessionError::World(why.into()))?;
        let mut session = match self.robot.name {
            JsonLine::PROFILE => self.looped::<JsonLine, Json>(plan, simulation),
            _ => self.looped::<WireLine, Wire>(plan, simulation),
        }?;
        // A plan without such an input draws no numbers.
        let _ = session.set("seed", &seed.to_string());
        Ok(session)
    }
}

impl InTheLoop {
    fn looped<L: Line, C: Controller>(
        &self,
        plan: &Graph,
        simulation: Simulation,
    ) -> Result<Box<dyn AnySession>, SessionError> {
        let mut registry = Registry::new();
        afp_std::templates::register(&mut registry);
        afp_carbot::register!(&mut registry, SerialRobot<Looped<L>>);
        let plan = LoadedPlan::new(plan, &registry).map_err(SessionError::Load)?;
        let values = self.robot.values.iter().map(|(name, value)| (&**name, &**value));
        let settings = Settings::new(values);
        let robot = SerialRobot::with_line(&settings, |setup| {
            let (plant, port) =
                Plant::start::<C>(simulation, setup).map_err(|why| why.to_string())?;
            let own = self.robot.values.iter().map(|(name, value)| (&**name, &**value));
            let at_port = Settings::new(own.chain([("port", &*port)]));
            let line = L::open(&at_port, setup).map_err(|why| why.to_string())?;
            Ok(Looped { line, plant, lacks: self.robot.lacks() })
        });
        let robot = robot.map_err(SessionError::Hardware)?;
        Ok(Box::new(Session::loaded(plan, robot)))
    }
}

#[cfg(test)]
mod tests;
