//! Values and outcomes that a client forces for a while.

use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant};
use afp_session::{EventKind, OUTSIDE};
use serde::Deserialize;
use serde_json::{Value, json};

use super::{Adapter, Answer, Refusal, Run};
use crate::program::Spot;
use crate::target::Happened;

/// The default and the maximum duration of a force, in seconds.
const USUALLY: f64 = 10.0;
const AT_MOST: f64 = 600.0;

#[derive(Deserialize)]
pub(super) struct Wanted {
    /// An entry of the outermost plan, or a state or event:
    /// `patrol.avoid.touch.TouchSensorPressed`.
    path: String,
    /// The value of the entry with its unit.
    value: Option<String>,
    seconds: Option<f64>,
}

#[derive(Deserialize)]
pub(super) struct Release {
    /// The path to release; the default is all.
    path: Option<String>,
}

/// A forced value or outcome.
#[derive(Clone, Debug)]
pub(super) struct Force {
    path: String,
    what: What,
    until: Instant,
}

#[derive(Clone, Debug)]
enum What {
    /// The value of an entry.
    Value(String),
    /// An outcome that a component reports at each poll.
    Outcome { component: ComponentId, name: String },
}

impl Adapter<'_> {
    /// Forces an entry or an outcome, and returns all forces.
    pub(super) fn force(&mut self, wanted: Wanted) -> Answer<Value> {
        let seconds = wanted.seconds.unwrap_or(USUALLY);
        if !(seconds > 0.0 && seconds <= AT_MOST) {
            return Err(Refusal(format!("'seconds' is a number above 0, at most {AT_MOST}")));
        }
        let run = self.run()?;
        let until = run.target.now() + Duration::from_secs_f64(seconds);
        let path = wanted.path.trim().to_owned();
        let what = match wanted.value {
            Some(value) => {
                run.target.set(&path, value.trim())?;
                What::Value(value)
            }
            None => {
                let what = run.outcome(&path)?;
                run.fire(&what)?;
                what
            }
        };
        run.forces.retain(|known| known.path != path);
        run.forces.push(Force { path, what, until });
        self.say_forced()
    }

    /// Releases forces and returns the remaining ones. Entries keep their values.
    pub(super) fn release(&mut self, release: Release) -> Answer<Value> {
        let run = self.run()?;
        let stays = |force: &Force| release.path.as_ref().is_some_and(|path| *path != force.path);
        run.forces.retain(stays);
        self.say_forced()
    }

    fn say_forced(&mut self) -> Answer<Value> {
        let forced = self.run()?.forced();
        self.send_state();
        Ok(json!({"forced": forced}))
    }
}

impl Run<'_> {
    /// All forces with their end times.
    pub(super) fn forced(&self) -> Vec<Value> {
        let shown = |force: &Force| {
            let mut shown = json!({"path": force.path, "until": force.until.as_secs_f64()});
            if let What::Value(value) = &force.what {
                shown["value"] = json!(value);
            }
            shown
        };
        self.forces.iter().map(shown).collect()
    }

    /// Finds the state or event of a path.
    fn outcome(&self, path: &str) -> Result<What, String> {
        let program = self.target.program();
        match program.find(path) {
            Some(Spot::Outcome(component, _)) => {
                let name = path.rsplit('.').next().unwrap_or(path).to_owned();
                Ok(What::Outcome { component, name })
            }
            _ if self.target.program().entry(ComponentId(0), path).is_some() => {
                Err(format!("'{path}' is an entry: give its 'value'"))
            }
            _ => Err(format!(
                "'{path}' is not a state or event: write a path such as 'patrol.avoid.touch.TouchSensorPressed'"
            )),
        }
    }

    /// Makes a component report the forced outcome, now or when it starts.
    fn fire(&mut self, what: &What) -> Result<(), String> {
        let What::Outcome { component, name } = what else { return Ok(()) };
        let waits = !self.target.state().is_on(*component) && !self.target.is_recorded();
        if waits { Ok(()) } else { self.target.fire(*component, name) }
    }

    /// Applies forces again after a step, and removes expired ones.
    pub(super) fn keep_forces(&mut self, happened: &[Happened]) {
        if self.forces.is_empty() {
            return;
        }
        let now = self.target.now();
        self.forces.retain(|force| force.until > now);
        for force in self.forces.clone() {
            let again = happened.iter().any(|what| {
                let event = &what.event;
                match &force.what {
                    What::Value(_) => {
                        matches!(&event.kind, EventKind::Committed { entry, .. } if *entry == force.path)
                            && event.component.id != OUTSIDE
                    }
                    What::Outcome { component, .. } => {
                        event.component.id == *component
                            && matches!(
                                event.kind,
                                EventKind::Started | EventKind::AlreadyThere(_) | EventKind::Event(_)
                            )
                    }
                }
            });
            if again {
                // If the sub-plan has ended, the next step tries again.
                let _ = match &force.what {
                    What::Value(value) => self.target.set(&force.path, value.trim()).map(|_| ()),
                    outcome => self.fire(outcome),
                };
            }
        }
    }
}
