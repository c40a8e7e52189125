//! Requested breakpoints, and their places in a program.

use std::collections::BTreeSet;

use afp_core::trace::ComponentId;

use super::{Breakpoint, Found};
use crate::hit_count::HitCount;
use crate::program::{Program, Spot};
use crate::watched::Watched;

/// A requested breakpoint.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    pub at: At,
    pub condition: Option<String>,
    pub hits: Option<String>,
    /// A message to log instead of stopping.
    pub log: Option<String>,
}

/// A requested place.
#[derive(Clone, Debug)]
pub(crate) enum At {
    /// At a line of a file, from 0.
    Line(String, u32),
    /// At a component, state or event, by its path.
    Path(String),
    Entry(String),
}

impl At {
    /// Finds the events at the place, and its line if it has one; or the reason why it has no
    /// place.
    fn spots(&self, program: &Program) -> Result<(Vec<Spot>, Option<u32>), String> {
        match self {
            At::Line(path, line) => {
                let file = program.file(path).ok_or("the running plan does not use this file")?;
                let found = program.at_line(file, *line);
                let (line, spots) = found.ok_or("nothing happens at this line or below it")?;
                Ok((spots.to_vec(), Some(line)))
            }
            At::Path(path) => {
                let like = "write a path such as 'patrol.avoid' or 'patrol.avoid.touch.Pressed'";
                let nothing = || format!("unknown path '{path}': {like}");
                let spot = program.find(path.trim()).ok_or_else(nothing)?;
                Ok((vec![spot], None))
            }
            At::Entry(path) => {
                let found = program.entry(ComponentId(0), path).map(Spot::Commit);
                let spot = found.ok_or_else(|| format!("the plan has no entry '{path}'"))?;
                Ok((vec![spot], None))
            }
        }
    }
}

impl Wanted {
    /// Makes the numbered breakpoint for a program, with or without a place.
    pub(crate) fn made(self, id: u64, program: &Program) -> Breakpoint {
        Breakpoint { id, found: self.found(program), hits: Vec::new(), wanted: self }
    }

    /// # Errors
    /// The reason why it has no place.
    fn found(&self, program: &Program) -> Result<Found, String> {
        let (spots, line) = self.at.spots(program)?;
        let text = self.condition.as_deref().filter(|text| !text.trim().is_empty());
        let plans: BTreeSet<_> = spots.iter().map(|spot| program.plan_at(*spot)).collect();
        let condition = |text| {
            let inside = |plan| Ok((plan, Watched::condition(program, plan, text)?));
            plans.into_iter().map(inside).collect::<Result<_, String>>()
        };
        let conditions = text.map(condition).transpose()?.unwrap_or_default();
        let counted = HitCount::new(self.hits.as_deref().unwrap_or_default())?;
        Ok(Found { spots, line, counted, conditions })
    }

    /// The file of a line breakpoint.
    pub(crate) fn file(&self) -> Option<&str> {
        match &self.at {
            At::Line(path, _) => Some(path),
            At::Path(_) | At::Entry(_) => None,
        }
    }
}
