//! Breakpoints by lines, paths and entries.

use afp_core::trace::ComponentId;
use afp_dsl::graph::EntryKind;

use super::stop::source;
use super::{Adapter, Answer};
use crate::breakpoints::{Breakpoint, Kind};
use crate::program::Spot;

/// A breakpoint that a client wants.
struct Wanted {
    /// Where, or why it is nowhere.
    spot: Result<Spot, String>,
    condition: Option<String>,
    hits: Option<String>,
}

impl Adapter<'_> {
    pub(super) fn set_breakpoints(
        &mut self,
        asked: dapts::SetBreakpointsArguments,
    ) -> Answer<dapts::SetBreakpointsResponse> {
        let path = self.host.path(asked.source.path.as_deref().unwrap_or_default());
        let first = self.client.first_line;
        let program = self.run()?.target.program().clone();
        let file = program.file(&path);
        let (mut all, mut told) = (Vec::new(), Vec::new());
        for wanted in asked.breakpoints.unwrap_or_default() {
            let line = wanted.line.saturating_sub(first);
            let found = file.and_then(|file| program.at_line(file, line));
            let id = self.breakpoints.number();
            let mut answer = dapts::Breakpoint { id: Some(id), ..dapts::Breakpoint::default() };
            let refused = refused(wanted.condition.as_deref())
                .or_else(|| {
                    file.is_none().then(|| "the plan that runs does not use this file".into())
                })
                .or_else(|| {
                    found.is_none().then(|| "nothing happens at this line or below it".into())
                });
            let from_hit = hit(wanted.hit_condition.as_deref());
            match (refused, from_hit, found) {
                (None, Ok(from_hit), Some((line, spots))) => {
                    answer.verified = true;
                    answer.line = Some(line + first);
                    answer.source = file.and_then(|file| source(&program, file));
                    let spots = spots.to_vec();
                    all.push(Breakpoint { id, spots, from_hit, log: wanted.log_message, hits: 0 });
                }
                (why, from_hit, _) => answer.message = why.or(from_hit.err()),
            }
            told.push(answer);
        }
        self.breakpoints.set_lines(path, all);
        Ok(dapts::SetBreakpointsResponse { breakpoints: told })
    }

    pub(super) fn set_functions(
        &mut self,
        asked: dapts::SetFunctionBreakpointsArguments,
    ) -> Answer<dapts::SetFunctionBreakpointsResponse> {
        let program = self.run()?.target.program().clone();
        let find = |name: &str| {
            program.find(name.trim()).ok_or_else(|| {
                let like = "write a path such as 'patrol.avoid' or 'patrol.avoid.touch.Pressed'";
                format!("the plan has nothing called '{name}': {like}")
            })
        };
        let wanted = asked.breakpoints.into_iter().map(|it| Wanted {
            spot: find(&it.name),
            condition: it.condition,
            hits: it.hit_condition,
        });
        let breakpoints = self.set_spots(Kind::Function, wanted.collect());
        Ok(dapts::SetFunctionBreakpointsResponse { breakpoints })
    }

    pub(super) fn set_data(
        &mut self,
        asked: dapts::SetDataBreakpointsArguments,
    ) -> Answer<dapts::SetDataBreakpointsResponse> {
        let program = self.run()?.target.program().clone();
        let find = |path: &str| {
            let found = program.entry(ComponentId(0), path).map(Spot::Commit);
            found.ok_or_else(|| format!("the plan has no entry '{path}'"))
        };
        let wanted = asked.breakpoints.into_iter();
        let wanted = wanted.map(|it| Wanted {
            spot: find(&it.data_id),
            condition: it.condition,
            hits: it.hit_condition,
        });
        let breakpoints = self.set_spots(Kind::Data, wanted.collect());
        Ok(dapts::SetDataBreakpointsResponse { breakpoints })
    }

    /// Breakpoints in place of all of a kind.
    fn set_spots(&mut self, kind: Kind, wanted: Vec<Wanted>) -> Vec<dapts::Breakpoint> {
        let (mut all, mut told) = (Vec::new(), Vec::new());
        for Wanted { spot, condition, hits } in wanted {
            let id = self.breakpoints.number();
            let mut answer = dapts::Breakpoint { id: Some(id), ..dapts::Breakpoint::default() };
            let condition = refused(condition.as_deref()).map_or(Ok(()), Err);
            match (spot, condition, hit(hits.as_deref())) {
                (Ok(spot), Ok(()), Ok(from_hit)) => {
                    answer.verified = true;
                    all.push(Breakpoint { id, spots: vec![spot], from_hit, log: None, hits: 0 });
                }
                (spot, condition, hit) => {
                    answer.message = spot.err().or(condition.err()).or(hit.err());
                }
            }
            told.push(answer);
        }
        self.breakpoints.set(kind, all);
        told
    }

    pub(super) fn data_info(
        &mut self,
        asked: dapts::DataBreakpointInfoArguments,
    ) -> Answer<dapts::DataBreakpointInfoResponse> {
        let plan = self.plan_of(asked.variables_reference, asked.frame_id)?;
        let program = self.run()?.target.program().clone();
        let found = program.entry(plan, &asked.name);
        let entry = found.and_then(|id| program.entries.get(id.0 as usize));
        Ok(match entry {
            Some(entry) if entry.kind != EntryKind::Const => dapts::DataBreakpointInfoResponse {
                access_types: Some(vec![dapts::DataBreakpointAccessType::Write]),
                can_persist: Some(true),
                data_id: Some(entry.path.clone()),
                description: format!("'{}' is written", entry.path),
            },
            _ => dapts::DataBreakpointInfoResponse {
                description: format!("'{}' is nothing that is written", asked.name),
                ..dapts::DataBreakpointInfoResponse::default()
            },
        })
    }

    pub(super) fn locations(
        &mut self,
        asked: dapts::BreakpointLocationsArguments,
    ) -> Answer<dapts::BreakpointLocationsResponse> {
        let path = self.host.path(asked.source.path.as_deref().unwrap_or_default());
        let first = self.client.first_line;
        let program = self.run()?.target.program().clone();
        let (from, to) = (asked.line, asked.end_line.unwrap_or(asked.line));
        let (from, to) = (from.saturating_sub(first), to.saturating_sub(first));
        let lines = program.file(&path).filter(|_| from <= to);
        let lines = lines.into_iter().flat_map(|file| program.lines(file, from, to));
        let at = |line| dapts::BreakpointLocation {
            line: line + first,
            column: None,
            end_column: None,
            end_line: None,
        };
        Ok(dapts::BreakpointLocationsResponse { breakpoints: lines.map(at).collect() })
    }
}

/// Why a condition cannot be kept.
fn refused(condition: Option<&str>) -> Option<String> {
    let condition = condition.filter(|text| !text.trim().is_empty())?;
    Some(format!("this release holds no run on a condition ('{condition}'): use a number of hits"))
}

/// From which hit on a breakpoint holds the run: `3`, or `>= 3`.
fn hit(text: Option<&str>) -> Result<u64, String> {
    let text = text.unwrap_or_default().trim();
    if text.is_empty() {
        return Ok(1);
    }
    let number = text.trim_start_matches(['>', '=', ' ']);
    number.parse().map_err(|_| format!("'{text}' is no number of hits: write one, such as 3"))
}
