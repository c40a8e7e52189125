//! Sweeps of a checked plan: worlds are read once, and values are checked before the first run.

use std::collections::HashSet;
use std::path::Path;

use afp_core::Value;
use afp_dsl::graph::Graph;
use afp_run::options::{Failure, Press};
use afp_run::world::{self, LoadedWorld, change};
use afp_run::{RunError, hash, inputs, requests};
use afp_session::{AnySession, Loader};

use crate::grid::{Axis, Point, Row, Sweep, WorldChoice};
use crate::stimuli::{Stimuli, varies_stimuli};

/// The most runs: a sweep also keeps its outcomes in memory, some hundred bytes each.
const MOST: u64 = 10_000_000;
/// The most combinations of world values tried before the first run.
const TRIED: usize = 1000;

/// A plan and its worlds.
pub struct Setting<'a> {
    graph: &'a Graph,
    robot: &'a dyn Loader,
    worlds: Vec<LoadedWorld>,
    presses: Vec<Press>,
    failures: Vec<Failure>,
}

impl<'a> Setting<'a> {
    /// Reads the worlds, relative to the plan's `file`, checks every value, and converts the values
    /// of the sweep to SI units.
    ///
    /// # Errors
    /// Too many runs, an invalid world, a template without Rust, an unknown axis, or an invalid
    /// value.
    pub fn new(
        sweep: &mut Sweep,
        graph: &'a Graph,
        file: &Path,
        robot: &'a dyn Loader,
    ) -> Result<Self, RunError> {
        if sweep.len() > MOST {
            let message = format!("a sweep has at most {MOST} runs, not {}", sweep.len());
            return Err(RunError::usage(message, "give fewer seeds or values"));
        }
        if !sweep.worlds_by_seed {
            different_worlds(&sweep.worlds)?;
        }
        let worlds = sweep.worlds.iter().map(|room| match room {
            WorldChoice::Made(_, world) => Ok(world.clone()),
            room => world::find(room.name().map(Path::new), file, robot.kind()),
        });
        let worlds = worlds.collect::<Result<Vec<_>, _>>()?;
        let (presses, failures) = (sweep.presses.clone(), sweep.failures.clone());
        let setting = Setting { graph, robot, worlds, presses, failures };
        setting.check(sweep)?;
        Ok(setting)
    }

    fn check(&self, sweep: &mut Sweep) -> Result<(), RunError> {
        let Some(world) = self.worlds.first() else { return Ok(()) };
        let session = self.robot.session(self.graph, &*world.world, 0, &[]);
        let mut session = session.map_err(|why| world.no_session(why))?;
        requests::make(&mut *session, &sweep.presses, &sweep.failures)?;
        let worlds_by_seed = sweep.worlds_by_seed;
        for number in 0..sweep.axes.len() {
            let (before, rest) = sweep.axes.split_at_mut(number);
            let Some(axis) = rest.first_mut() else { continue };
            if before.iter().any(|other| other.name == axis.name) {
                let message = format!("'{}' is varied twice", axis.name);
                return Err(RunError::usage(message, "vary it once, with all of its values"));
            }
            let mut whole = Vec::new();
            match change::key(&axis.name) {
                Some(key) if axis.by_seed && worlds_by_seed => {
                    for (world, point) in self.worlds.iter().zip(&mut axis.points) {
                        point.si = world.si(key, &point.text)?;
                    }
                }
                Some(key) => self.check_worlds(key, &mut axis.points)?,
                None if varies_stimuli(&axis.name) => check_stimuli(axis)?,
                None => {
                    for point in &mut axis.points {
                        let value = inputs::set(&mut *session, &axis.name, &point.text)?;
                        point.si = match value {
                            Value::Float(value) => Some(value),
                            Value::Int(value) => Some(value as f64),
                            _ => None,
                        };
                        whole.extend(if let Value::Int(value) = value {
                            Some(value)
                        } else {
                            None
                        });
                    }
                }
            }
            if !axis.by_seed {
                different_values(axis, &whole)?;
            }
        }
        self.check_together(&sweep.axes)
    }

    /// Checks the values of a world's file one by one.
    fn check_worlds(&self, key: &str, points: &mut [Point]) -> Result<(), RunError> {
        for world in &self.worlds {
            for point in &mut *points {
                point.si = world.si(key, &point.text)?;
            }
        }
        Ok(())
    }

    /// Checks combinations of values of a world's file: a world may be valid with some of them
    /// only.
    fn check_together(&self, axes: &[Axis]) -> Result<(), RunError> {
        let of_world = axes.iter().filter_map(|axis| Some((change::key(&axis.name)?, axis)));
        let of_world: Vec<_> = of_world.collect();
        let lengths = of_world.iter().map(|(_, axis)| axis.points.len());
        let all = lengths.fold(1_usize, usize::saturating_mul).min(TRIED);
        for world in self.worlds.iter().filter(|_| !of_world.is_empty()) {
            let tried = (0..all).map(|number| {
                let mut rest = number;
                let changes = of_world.iter().filter_map(|(key, axis)| {
                    let point = axis.points.get(rest % axis.points.len().max(1))?;
                    rest /= axis.points.len().max(1);
                    Some((*key, point.text.as_str()))
                });
                world.with(&changes.collect::<Vec<_>>(), self.robot.kind())
            });
            // A single valid combination is enough.
            let mut first = None;
            for tried in tried {
                match tried {
                    Ok(_) => {
                        first = None;
                        break;
                    }
                    Err(error) => first = first.or(Some(error)),
                }
            }
            first.map_or(Ok(()), Err)?;
        }
        Ok(())
    }

    /// Returns the world of a run, with the values of its row.
    ///
    /// # Errors
    /// The values make the world invalid.
    pub fn world(&self, row: &Row<'_>) -> Result<LoadedWorld, RunError> {
        let world = self.worlds.get(row.world_number);
        let world = world.ok_or_else(|| RunError::usage("there is no such world", "name one"))?;
        let changes = row
            .values
            .iter()
            .filter_map(|(name, point)| Some((change::key(name)?, point.text.as_str())));
        let changes: Vec<_> = changes.collect();
        match changes.is_empty() {
            true => Ok(world.clone()),
            false => world.with(&changes, self.robot.kind()),
        }
    }

    /// Makes the session of a run, with all measures of the robot.
    ///
    /// # Errors
    /// The values make the world invalid.
    pub fn make(&self, row: &Row<'_>) -> Result<Box<dyn AnySession>, RunError> {
        let world = self.world(row)?;
        let measures = self.robot.kind().measures();
        let session = self.robot.session(self.graph, &*world.world, row.seed, measures);
        let mut session = session.map_err(|why| world.no_session(why))?;
        let entry = |name: &str| change::key(name).is_none() && !varies_stimuli(name);
        for (name, point) in row.values.iter().filter(|(name, _)| entry(name)) {
            inputs::set(&mut *session, name, &point.text)?;
        }
        requests::make(&mut *session, &self.presses, &self.failures)?;
        let varied = row.stimuli();
        requests::make(&mut *session, &varied.presses, &varied.failures)?;
        Ok(session)
    }

    /// The hash of all worlds' texts, and of the start pose that overrides theirs.
    pub fn hash(&self) -> String {
        let world = |world: &LoadedWorld| {
            let start = world.start.map(|start| format!("{start:?}")).unwrap_or_default();
            format!("{}\0{start}", world.text)
        };
        hash(&self.worlds.iter().map(world).collect::<String>())
    }
}

/// Rejects a repeated world, which would repeat its runs.
fn different_worlds(worlds: &[WorldChoice]) -> Result<(), RunError> {
    let mut known = HashSet::new();
    let names = worlds.iter().filter(|world| matches!(world, WorldChoice::Named(_)));
    let mut names = names.filter_map(WorldChoice::name).map(Path::new);
    let twice = names
        .find(|name| !known.insert(name.canonicalize().unwrap_or_else(|_| (*name).to_owned())));
    twice.map_or(Ok(()), |name| {
        let message = format!("the world '{}' is given twice", name.display());
        Err(RunError::usage(message, "name each world once"))
    })
}

/// Checks the syntax of stimuli; their instants are the numbers of the axis.
fn check_stimuli(axis: &mut Axis) -> Result<(), RunError> {
    for point in &mut axis.points {
        let mut stimuli = Stimuli::default();
        let read = stimuli.add(&axis.name, &point.text);
        read.map_err(|why| RunError::usage(why, "give a control or fault, and its time"))?;
        point.si = stimuli.instant();
    }
    Ok(())
}

/// Rejects a repeated value, also in a different unit; `whole` has the values of an integer axis.
fn different_values(axis: &Axis, whole: &[i64]) -> Result<(), RunError> {
    let mut known = HashSet::new();
    let stimuli = varies_stimuli(&axis.name);
    let value = |(number, point): &(usize, &Point)| match (whole.get(*number), point.si) {
        (Some(whole), _) => whole.to_string(),
        // Different faults may begin at the same instant.
        _ if stimuli => point.text.clone(),
        // Both zeros are one value.
        (None, Some(si)) => (si + 0.0).to_bits().to_string(),
        (None, None) => point.text.clone(),
    };
    let twice = axis.points.iter().enumerate().find(|point| !known.insert(value(point)));
    twice.map_or(Ok(()), |(_, point)| {
        let message = format!("'{}={}' is given twice", axis.name, point.text);
        Err(RunError::usage(message, "give each value once"))
    })
}
