//! Breakpoints by lines, paths and entries.

use afp_core::trace::ComponentId;
use afp_dsl::graph::EntryKind;

use super::stop::source;
use super::{Adapter, Answer};
use crate::breakpoints::{Breakpoint, Kind};
use crate::program::{Program, Spot};
use crate::watched::Watched;

/// A breakpoint that a client wants.
struct Wanted {
    /// Where, or why it is nowhere.
    spots: Result<Vec<Spot>, String>,
    condition: Option<String>,
    hits: Option<String>,
    log: Option<String>,
}

impl Wanted {
    /// The breakpoint of that number.
    fn made(self, id: u64, program: &Program) -> Result<Breakpoint, String> {
        let spots = self.spots?;
        let plan = spots.first().map_or(ComponentId(0), |spot| program.plan_at(*spot));
        let text = self.condition.filter(|text| !text.trim().is_empty());
        let condition = text.map(|text| Watched::condition(program, plan, &text)).transpose()?;
        let from_hit = hit(self.hits.as_deref())?;
        Ok(Breakpoint { id, spots, condition, from_hit, log: self.log, hits: 0 })
    }
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
        let wanted = asked.breakpoints.unwrap_or_default().into_iter().map(|it| {
            let found = file.map(|file| program.at_line(file, it.line.saturating_sub(first)));
            let spots = match found {
                None => Err("the plan that runs does not use this file".to_owned()),
                Some(None) => Err("nothing happens at this line or below it".to_owned()),
                Some(Some((_, spots))) => Ok(spots.to_vec()),
            };
            let line = found.flatten().map(|(line, _)| line + first);
            let (condition, hits, log) = (it.condition, it.hit_condition, it.log_message);
            (Wanted { spots, condition, hits, log }, line)
        });
        let (wanted, lines): (Vec<_>, Vec<_>) = wanted.unzip();
        let (all, mut told) = self.made(wanted, &program);
        for (answer, line) in told.iter_mut().zip(lines).filter(|(answer, _)| answer.verified) {
            answer.line = line;
            answer.source = file.and_then(|file| source(&program, file));
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
            let found = program.find(name.trim()).map(|spot| vec![spot]);
            found.ok_or_else(|| {
                let like = "write a path such as 'patrol.avoid' or 'patrol.avoid.touch.Pressed'";
                format!("the plan has nothing called '{name}': {like}")
            })
        };
        let wanted = asked.breakpoints.into_iter().map(|it| Wanted {
            spots: find(&it.name),
            condition: it.condition,
            hits: it.hit_condition,
            log: None,
        });
        let (all, breakpoints) = self.made(wanted.collect(), &program);
        self.breakpoints.set(Kind::Function, all);
        Ok(dapts::SetFunctionBreakpointsResponse { breakpoints })
    }

    pub(super) fn set_data(
        &mut self,
        asked: dapts::SetDataBreakpointsArguments,
    ) -> Answer<dapts::SetDataBreakpointsResponse> {
        let program = self.run()?.target.program().clone();
        let find = |path: &str| {
            let found = program.entry(ComponentId(0), path).map(|id| vec![Spot::Commit(id)]);
            found.ok_or_else(|| format!("the plan has no entry '{path}'"))
        };
        let wanted = asked.breakpoints.into_iter().map(|it| Wanted {
            spots: find(&it.data_id),
            condition: it.condition,
            hits: it.hit_condition,
            log: None,
        });
        let (all, breakpoints) = self.made(wanted.collect(), &program);
        self.breakpoints.set(Kind::Data, all);
        Ok(dapts::SetDataBreakpointsResponse { breakpoints })
    }

    /// The breakpoints that can be, and an answer for each that is wanted.
    fn made(
        &mut self,
        wanted: Vec<Wanted>,
        program: &Program,
    ) -> (Vec<Breakpoint>, Vec<dapts::Breakpoint>) {
        let (mut all, mut told) = (Vec::new(), Vec::new());
        for wanted in wanted {
            let id = self.breakpoints.number();
            let mut answer = dapts::Breakpoint { id: Some(id), ..dapts::Breakpoint::default() };
            match wanted.made(id, program) {
                Ok(breakpoint) => {
                    answer.verified = true;
                    all.push(breakpoint);
                }
                Err(why) => answer.message = Some(why),
            }
            told.push(answer);
        }
        (all, told)
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

/// From which hit on a breakpoint holds the run: `3`, or `>= 3`.
fn hit(text: Option<&str>) -> Result<u64, String> {
    let text = text.unwrap_or_default().trim();
    if text.is_empty() {
        return Ok(1);
    }
    let number = text.trim_start_matches(['>', '=', ' ']);
    number.parse().map_err(|_| format!("'{text}' is no number of hits: write one, such as 3"))
}
