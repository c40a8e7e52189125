//! What an extension links in: a robot, and the templates that plans for it may use.
//!
//! Classes of Python have no type parameters, so this is where the robot's type ends: everything else drives an
//! [`AnyLink`], of which a process has one.

use std::any::Any;
use std::path::Path;
use std::sync::OnceLock;

use afp::load::Registry;
use afp_core::devices::{DeviceRow, find_signal, signals};
use afp_project::{ProjectFile, RobotLink, shown};
use afp_session::{
    AnyRobot, Kind, Loader, SessionError, Simulated, World, kind, read_signal, simulated,
};
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;

use crate::component::AnyRegistry;
use crate::errors::{error, run_error};
use crate::robot::Robot;
use crate::sensed::Sensed;

/// Registers more templates for a plan.
pub type More<'a> = dyn Fn(&mut dyn AnyRegistry) + Sync + 'a;

/// What an extension links in, whatever its robot is.
pub trait AnyLink: Send + Sync {
    /// The kind of its robot.
    fn kind(&self) -> &dyn AnyRobot;

    /// The path of the robot's type, where it is one of a project; none for the Carbot.
    fn own_robot(&self) -> Option<&'static str>;

    /// The toolboxes beside the built-in ones.
    fn toolboxes(&self) -> &'static [&'static str];

    /// Loads plans, whose templates are those of the link and more.
    fn loader<'a>(&'a self, more: &'a More<'a>) -> Box<dyn Loader + 'a>;

    /// The robot as components have it, with nothing in it yet.
    ///
    /// # Errors
    /// Python has no memory; the robot's own default world cannot be built.
    fn robot(&self, py: Python<'_>) -> PyResult<Py<Robot>>;

    /// What the robot senses of that name, or what a signal of it says. What only a judge may know is left out unless
    /// `truth` is set.
    ///
    /// # Errors
    /// No such sensor, or one that is broken.
    fn sense(&self, robot: &dyn Any, name: &str, truth: bool) -> PyResult<Sensed>;
}

/// What this extension links in.
static LINK: OnceLock<Box<dyn AnyLink>> = OnceLock::new();

/// What this extension links in.
pub fn link() -> &'static dyn AnyLink {
    &**LINK.get().expect("the module says what it links before it has anything that can be called")
}

/// The devices of the robot.
pub fn devices() -> &'static [DeviceRow] {
    link().kind().devices()
}

/// Says what this extension links in; a module that is made again links the same.
pub(crate) fn set(link: impl AnyLink + 'static) {
    let _ = LINK.set(Box::new(link));
}

/// Says whether the robot of this process is that of the project around a plan's file.
///
/// # Errors
/// It is another one, or the project file is wrong.
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

/// Sensors of a robot by names of their own beside those of its signals: the names, and what one of them says; none for
/// another name.
type Named<R> = (&'static [&'static str], fn(&R, &str) -> Option<PyResult<Sensed>>);

/// What registers the templates that plans for a robot may use.
type Register<R> = Box<dyn Fn(&mut Registry<R>) + Send + Sync>;

/// A robot and its templates.
pub struct Link<R: Simulated> {
    kind: Kind<R>,
    own_robot: Option<&'static str>,
    toolboxes: &'static [&'static str],
    register: Register<R>,
    /// The text of a world for the robot that stands in while nobody may use the true one.
    nowhere: &'static str,
    named: Option<Named<R>>,
    robot: fn(Python<'_>, Robot) -> PyResult<Py<Robot>>,
}

/// A project's robot by its type: its path, the toolboxes beside the built-in ones, and what registers all templates.
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
    /// The built-in robot, with a class and names of its own.
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
            Some(_) => Err(PyAttributeError::new_err(format!(
                "'{name}' is the truth, which only a judge may know: ask the simulation for it"
            ))),
            None => {
                let own = self.named.map_or(&[][..], |(names, _)| names);
                Err(PyAttributeError::new_err(no_sensor(own, name, truth)))
            }
        }
    }
}

/// What to say of a sensor that is not there.
fn no_sensor(own: &[&str], name: &str, truth: bool) -> String {
    let known = signals(devices()).filter(|(.., row)| truth || !row.truth);
    let known = known.map(|(_, device, row)| format!("{}.{}", device.name, row.name));
    let known: Vec<_> = own.iter().map(|own| (*own).to_owned()).chain(known).collect();
    format!("the robot has no '{name}'; its sensors are: {}", known.join(", "))
}
