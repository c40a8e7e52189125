//! The links of an extension: a robot, and the templates for its plans.
//!
//! Python classes have no type parameters, so the robot's type ends here. All other code uses the
//! process's only [`AnyLink`].

use std::any::Any;
use std::path::Path;
use std::sync::OnceLock;

use afp::load::Registry;
use afp_core::devices::{DeviceRow, find_signal, signals};
use afp_project::{ProjectFile, RobotLink, shown};
use afp_session::{
    AnyRobot, Kind, Loader, SessionError, Simulated, World, kind, read_signal, simulated,
};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use crate::component::AnyRegistry;
use crate::errors::{error, run_error};
use crate::robot::Robot;
use crate::sensed::Sensed;

/// Registers additional templates for a plan.
pub type More<'a> = dyn Fn(&mut dyn AnyRegistry) + Sync + 'a;

/// The links of an extension, for any robot.
pub trait AnyLink: Send + Sync {
    fn kind(&self) -> &dyn AnyRobot;

    /// The path of the robot's type in a project; `None` for the Carbot.
    fn own_robot(&self) -> Option<&'static str>;

    /// The toolboxes in addition to the built-in ones.
    fn toolboxes(&self) -> &'static [&'static str];

    /// Makes a loader of plans, with the templates of the link and `more`.
    fn loader<'a>(&'a self, more: &'a More<'a>) -> Box<dyn Loader + 'a>;

    /// The robot object for components, without a simulation.
    ///
    /// # Errors
    /// Python has no memory, or the robot's default world is invalid.
    fn robot(&self, py: Python<'_>) -> PyResult<Py<Robot>>;

    /// Reads a sensor or signal of the robot by name. Ground truth is excluded unless `truth` is
    /// set.
    ///
    /// # Errors
    /// The sensor is unknown or broken.
    fn sense(&self, robot: &dyn Any, name: &str, truth: bool) -> PyResult<Sensed>;
}

/// The link of this extension.
static LINK: OnceLock<Box<dyn AnyLink>> = OnceLock::new();

pub fn link() -> &'static dyn AnyLink {
    &**LINK.get().expect("the module names its linked crates before its functions")
}

/// The devices of the robot.
pub fn devices() -> &'static [DeviceRow] {
    link().kind().devices()
}

/// Sets the link of this extension; importing the module again keeps it.
pub(crate) fn set(link: impl AnyLink + 'static) {
    let _ = LINK.set(Box::new(link));
}

/// Checks that the project around a plan's file has the robot of this process.
///
/// # Errors
/// It has a different robot, or the project file is invalid.
pub fn fits(plan: &Path) -> PyResult<()> {
    let project = ProjectFile::of_plan(plan).map_err(|why| run_error(&why.into()))?;
    let robot = project.robot().map_err(|why| run_error(&why.into()))?;
    let wanted = robot.as_ref().map(RobotLink::rust_type);
    if wanted.as_deref() == link().own_robot() {
        return Ok(());
    }
    let name = |robot: Option<&str>| robot.map_or("the Carbot".to_owned(), |it| format!("'{it}'"));
    let (wanted, here) = (name(wanted.as_deref()), name(link().own_robot()));
    let what = format!("the plan is for {wanted}, and this process has {here}");
    let folder = shown(&project.folder);
    Err(error(match robot {
        Some(_) => format!(
            "{what}\n  help: call afp.use({:?}) before anything else of the package, or set AFP_PROJECT to that folder",
            folder.display().to_string()
        ),
        None => format!("{what}\n  help: start another Python for it; a process has one robot"),
    }))
}

/// A robot's own names for sensors, in addition to its signals: the names, and a function that
/// reads one and returns `None` for other names.
type Named<R> = (&'static [&'static str], fn(&R, &str) -> Option<PyResult<Sensed>>);

/// Registers the templates for plans of a robot.
type Register<R> = Box<dyn Fn(&mut Registry<R>) + Send + Sync>;

/// A robot and its templates.
pub struct Link<R: Simulated> {
    kind: Kind<R>,
    own_robot: Option<&'static str>,
    toolboxes: &'static [&'static str],
    register: Register<R>,
    /// The world of the stand-in robot outside of calls.
    nowhere: &'static str,
    named: Option<Named<R>>,
    robot: fn(Python<'_>, Robot) -> PyResult<Py<Robot>>,
}

/// Makes the link of a project's robot: its path, the additional toolboxes, and the registration of
/// all templates.
pub fn linked<R: Simulated>(
    robot: &'static str,
    toolboxes: &'static [&'static str],
    register: impl Fn(&mut Registry<R>) + Send + Sync + 'static,
) -> Link<R> {
    Link {
        kind: kind(),
        own_robot: Some(robot),
        toolboxes,
        register: Box::new(register),
        nowhere: R::World::DEFAULT,
        named: None,
        robot: |py, robot| Py::new(py, robot),
    }
}

#[cfg(feature = "carbot")]
impl<R: Simulated> Link<R> {
    /// Makes the link of the built-in robot, with its own class and names.
    pub(crate) fn built_in(
        toolboxes: &'static [&'static str],
        register: impl Fn(&mut Registry<R>) + Send + Sync + 'static,
        (nowhere, named): (&'static str, Named<R>),
        robot: fn(Python<'_>, Robot) -> PyResult<Py<Robot>>,
    ) -> Self {
        let linked = linked("", toolboxes, register);
        Link { own_robot: None, nowhere, named: Some(named), robot, ..linked }
    }
}

impl<R: Simulated> AnyLink for Link<R> {
    fn kind(&self) -> &dyn AnyRobot {
        &self.kind
    }

    fn own_robot(&self) -> Option<&'static str> {
        self.own_robot
    }

    fn toolboxes(&self) -> &'static [&'static str] {
        self.toolboxes
    }

    fn loader<'a>(&'a self, more: &'a More<'a>) -> Box<dyn Loader + 'a> {
        Box::new(simulated::<R, _>(move |registry| {
            (self.register)(registry);
            more(registry);
        }))
    }

    fn robot(&self, py: Python<'_>) -> PyResult<Py<Robot>> {
        let world = R::World::read(self.nowhere).map_err(|why| error(why.message))?;
        let robot = R::new(&world, 0).map_err(|why| error(SessionError::World(why.into())))?;
        let sense = |robot: &dyn Any, name: &str| link().sense(robot, name, false);
        (self.robot)(py, Robot::new(Box::new(robot), sense))
    }

    fn sense(&self, robot: &dyn Any, name: &str, truth: bool) -> PyResult<Sensed> {
        let other = || error("the robot is of another kind");
        let robot = robot.downcast_ref::<R>().ok_or_else(other)?;
        if let Some(said) = self.named.and_then(|(_, sense)| sense(robot, name)) {
            return said;
        }
        let found = name.split_once('.').and_then(|(device, signal)| {
            let id = find_signal(devices(), device, signal)?;
            signals(devices()).find(|(known, ..)| *known == id)
        });
        match found {
            Some((id, _, row)) if truth || !row.truth => {
                let mut sensed = Sensed::Nothing;
                read_signal(robot, id, &mut |sample| sensed = Sensed::of(sample));
                Ok(sensed)
            }
            Some(_) => Err(PyValueError::new_err(format!(
                "'{name}' is a true value, which components cannot read: read it from the simulation"
            ))),
            None => {
                let own = self.named.map_or(&[][..], |(names, _)| names);
                Err(PyKeyError::new_err(no_sensor(own, name, truth)))
            }
        }
    }
}

/// The error for an unknown sensor.
fn no_sensor(own: &[&str], name: &str, truth: bool) -> String {
    let known = signals(devices()).filter(|(.., row)| truth || !row.truth);
    let known = known.map(|(_, device, row)| format!("{}.{}", device.name, row.name));
    let known: Vec<_> = own.iter().map(|own| (*own).to_owned()).chain(known).collect();
    format!("the robot has no '{name}'; its sensors are: {}", known.join(", "))
}
