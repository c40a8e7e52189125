//! The linked parts: a project's robot, and toolboxes.

use afp_dsl::graph::Graph;
use afp_project::{CrateLink, HardwareLink, ProjectFile, RobotLink};
use afp_run::RunError;

use afp_toolboxes::project::{OwnToolbox, OwnToolboxes};

/// The linked parts of a program or extension.
pub struct Parts<'a> {
    pub(crate) project: &'a ProjectFile,
    pub(crate) robot: Option<RobotLink>,
    pub(crate) hardware: Option<HardwareLink>,
    pub(crate) toolboxes: Vec<OwnToolbox>,
}

impl<'a> Parts<'a> {
    /// The parts that some plans need; empty without plans.
    ///
    /// # Errors
    /// A robot or a toolbox without a crate, two robots, two toolboxes of one name.
    pub fn of_plans(
        plans: impl IntoIterator<Item = (&'a OwnToolboxes, &'a Graph)>,
    ) -> Result<Option<Self>, RunError> {
        let mut parts: Option<Parts<'a>> = None;
        for (own, graph) in plans {
            let (robot, toolboxes) = (own.project.robot()?, own.used_by(graph)?);
            let robot_of_first = || Parts::new(&own.project, robot.clone());
            parts.get_or_insert_with(robot_of_first).add(robot.as_ref(), toolboxes)?;
        }
        Ok(parts)
    }

    /// The parts that a plan needs on the hardware robot. A project may have no simulated robot.
    ///
    /// # Errors
    /// Those of [`Parts::of_plans`]; the project has no hardware robot, or it has no crate.
    pub fn of_plan_on_hardware(own: &'a OwnToolboxes, graph: &Graph) -> Result<Self, RunError> {
        let robot = own.project.robot_for_hardware()?;
        let mut parts = Parts::new(&own.project, robot.clone());
        parts.add(robot.as_ref(), own.used_by(graph)?)?;
        parts.hardware = own.project.hardware()?;
        match parts.hardware {
            Some(_) => Ok(parts),
            None => Err(no_hardware(&own.project)),
        }
    }

    /// The robot of a project.
    ///
    /// # Errors
    /// It has no crate.
    pub fn of_robot(project: &'a ProjectFile) -> Result<Self, RunError> {
        Ok(Parts::new(project, project.robot()?))
    }

    /// All parts of a project.
    ///
    /// # Errors
    /// A robot or a toolbox without a crate, an invalid toolbox file.
    pub fn of_project(own: &'a OwnToolboxes) -> Result<Self, RunError> {
        let robot = own.project.robot()?;
        let mut parts = Parts::new(&own.project, robot.clone());
        parts.add(robot.as_ref(), own.all()?)?;
        Ok(parts)
    }

    fn new(project: &'a ProjectFile, robot: Option<RobotLink>) -> Self {
        Parts { project, robot, hardware: None, toolboxes: Vec::new() }
    }

    /// Adds the toolboxes of a plan for a robot.
    fn add(
        &mut self,
        robot: Option<&RobotLink>,
        toolboxes: Vec<OwnToolbox>,
    ) -> Result<(), RunError> {
        if self.robot.as_ref() != robot {
            let name = |robot: Option<&RobotLink>| {
                robot.map_or("the Carbot".to_owned(), |robot| format!("'{}'", robot.rust_type()))
            };
            let (one, other) = (name(self.robot.as_ref()), name(robot));
            return Err(RunError::usage(
                format!("these plans are for two robots: {one} and {other}"),
                "run the plans of each project separately",
            ));
        }
        for toolbox in toolboxes {
            match self.toolboxes.iter().find(|known| known.name == toolbox.name) {
                None => self.toolboxes.push(toolbox),
                Some(known) if known.krate == toolbox.krate => {}
                Some(known) => return Err(two_of_one_name(known, &toolbox)),
            }
        }
        Ok(())
    }

    /// Whether there are no parts except the Carbot and the built-in toolboxes.
    pub fn is_empty(&self) -> bool {
        self.robot.is_none() && self.toolboxes.is_empty()
    }

    /// Whether a program with a robot (`None` for the Carbot), a hardware robot and toolboxes has
    /// all parts.
    pub fn are_in(&self, robot: Option<&str>, hardware: Option<&str>, toolboxes: &[&str]) -> bool {
        let itself = self.hardware.as_ref().map(HardwareLink::rust_type);
        let has_hardware = itself.is_none() || itself.as_deref() == hardware;
        let own = self.robot.as_ref().map(RobotLink::rust_type);
        let has = |own: &OwnToolbox| toolboxes.contains(&&*own.name);
        has_hardware && own.as_deref() == robot && self.toolboxes.iter().all(has)
    }

    pub(crate) fn crates(&self) -> impl Iterator<Item = &CrateLink> {
        let robot = self.robot.iter().map(|robot| &robot.krate);
        let hardware = self.hardware.iter().map(|hardware| &hardware.krate);
        self.toolboxes.iter().map(|own| &own.krate).chain(robot).chain(hardware)
    }

    /// `the toolbox 'a'`, `the robot 'b' with the toolboxes 'c' and 'd'`.
    pub fn names(&self) -> String {
        let names: Vec<_> = self.toolboxes.iter().map(|own| format!("'{}'", own.name)).collect();
        let toolboxes = match names.as_slice() {
            [] => String::new(),
            [one] => format!("the toolbox {one}"),
            _ => format!("the toolboxes {}", names.join(" and ")),
        };
        let robot = self.robot.as_ref().map(RobotLink::rust_type);
        let itself = self.hardware.as_ref().map(HardwareLink::rust_type);
        let robot = itself.or(robot).map(|name| format!("the robot '{name}'"));
        match (robot, toolboxes.is_empty()) {
            (None, _) => toolboxes,
            (Some(robot), true) => robot,
            (Some(robot), false) => format!("{robot} with {toolboxes}"),
        }
    }
}

/// The error for a plan that can only run in simulation.
pub fn no_hardware(project: &ProjectFile) -> RunError {
    match &project.project.robot {
        None => RunError::usage(
            "the project has no real robot: its plans run in simulation",
            "describe the robot's parts in afp.toml: '[robot]' with 'profile = \"carbot\"'",
        ),
        Some(robot) if robot.profile.is_some() => RunError::usage(
            "built programs cannot drive a robot with a profile",
            "use 'afpc run --robot hardware' instead",
        ),
        Some(_) => RunError::usage(
            format!(
                "'[robot]' in '{}' has no 'hardware'",
                afp_project::shown(&project.path()).display()
            ),
            "write 'hardware = { type = \"Board\", crate = { path = \"board\" } }', the Rust type that implements \
             'Hardware'",
        ),
    }
}

fn two_of_one_name(one: &OwnToolbox, other: &OwnToolbox) -> RunError {
    let (path, another) = (&one.source.name, &other.source.name);
    RunError::usage(
        format!("'{path}' and '{another}' are two toolboxes with the name '{}'", one.name),
        "one program cannot have both: run their plans separately",
    )
}
