//! Breakpoints by lines, paths and entries.

use afp_dsl::graph::EntryKind;
use dapts::{BreakpointEventReason as Changed, event};

use super::stop::source;
use super::{Adapter, Answer, ClientId};
use crate::breakpoints::{At, Breakpoint, Set, Wanted};
use crate::program::Program;

impl Adapter<'_> {
    pub(super) fn set_breakpoints(
        &mut self,
        asked: dapts::SetBreakpointsArguments,
    ) -> Answer<dapts::SetBreakpointsResponse> {
        let named = asked.source.path.as_deref().unwrap_or_default();
        let path = self.host.path(named);
        let target = &self.run()?.target;
        let live = target.is_live() && target.program().file(&path).is_some();
        if live
            && path != named
            && let Some(client) = self.clients.get_mut(&self.asker)
        {
            client.paths.insert(path.clone(), named.to_owned());
        }
        let first = self.counting().first_line;
        let wanted = asked.breakpoints.unwrap_or_default().into_iter().map(|it| Wanted {
            at: At::Line(path.clone(), it.line.saturating_sub(first)),
            condition: it.condition,
            hits: it.hit_condition,
            log: it.log_message,
        });
        let breakpoints = self.set_all(Set::Lines(path.clone()), wanted.collect())?;
        Ok(dapts::SetBreakpointsResponse { breakpoints })
    }

    pub(super) fn set_functions(
        &mut self,
        asked: dapts::SetFunctionBreakpointsArguments,
    ) -> Answer<dapts::SetFunctionBreakpointsResponse> {
        let wanted = asked.breakpoints.into_iter().map(|it| Wanted {
            at: At::Path(it.name),
            condition: it.condition,
            hits: it.hit_condition,
            log: None,
        });
        let breakpoints = self.set_all(Set::Functions, wanted.collect())?;
        Ok(dapts::SetFunctionBreakpointsResponse { breakpoints })
    }

    pub(super) fn set_data(
        &mut self,
        asked: dapts::SetDataBreakpointsArguments,
    ) -> Answer<dapts::SetDataBreakpointsResponse> {
        let wanted = asked.breakpoints.into_iter().map(|it| Wanted {
            at: At::Entry(it.data_id),
            condition: it.condition,
            hits: it.hit_condition,
            log: None,
        });
        let breakpoints = self.set_all(Set::Data, wanted.collect())?;
        Ok(dapts::SetDataBreakpointsResponse { breakpoints })
    }

    /// Sets all breakpoints of a kind, with an answer for each. Other clients are informed.
    fn set_all(&mut self, set: Set, wanted: Vec<Wanted>) -> Answer<Vec<dapts::Breakpoint>> {
        let program = self.run()?.target.program().clone();
        let first = self.counting().first_line;
        let made = |wanted: Wanted| wanted.made(self.breakpoints.number(), &program);
        let all: Vec<_> = wanted.into_iter().map(made).collect();
        let told = all.iter().map(|each| shown(each, &program, first)).collect();
        let owner = self.asker;
        let before = self.breakpoints.set(owner, set, all.clone());
        self.send_breakpoints(owner, Changed::Removed, &before, &program);
        self.send_breakpoints(owner, Changed::New, &all, &program);
        Ok(told)
    }

    pub(super) fn send_breakpoints(
        &mut self,
        owner: ClientId,
        reason: Changed,
        all: &[Breakpoint],
        program: &Program,
    ) {
        let others: Vec<_> = self.attached().filter(|id| *id != owner).collect();
        for other in others {
            for each in all {
                self.send_breakpoint(other, owner, reason.clone(), each, program);
            }
        }
    }

    /// Sends a breakpoint to a client, with its owner if that is another client.
    pub(super) fn send_breakpoint(
        &mut self,
        other: ClientId,
        owner: ClientId,
        reason: Changed,
        breakpoint: &Breakpoint,
        program: &Program,
    ) {
        let first = self.counting_of(other).first_line;
        let mut breakpoint = shown(breakpoint, program, first);
        if other != owner {
            let why = breakpoint.message.map(|why| format!(": {why}")).unwrap_or_default();
            breakpoint.message = Some(format!("set by {}{why}", self.name_of(owner)));
        }
        self.event_to::<event::Breakpoint>(other, &dapts::BreakpointEvent { breakpoint, reason });
    }

    /// Locates all breakpoints in a new program, and sends moved ones to all clients.
    pub(super) fn find_breakpoints(&mut self, program: &Program) {
        let clients: Vec<_> = self.attached().collect();
        for (owner, moved) in self.breakpoints.find_in(program) {
            for client in &clients {
                self.send_breakpoint(*client, owner, Changed::Changed, &moved, program);
            }
        }
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
                description: format!("'{}' cannot be written", asked.name),
                ..dapts::DataBreakpointInfoResponse::default()
            },
        })
    }

    pub(super) fn locations(
        &mut self,
        asked: dapts::BreakpointLocationsArguments,
    ) -> Answer<dapts::BreakpointLocationsResponse> {
        let path = self.host.path(asked.source.path.as_deref().unwrap_or_default());
        let first = self.counting().first_line;
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

/// A breakpoint in the protocol's format.
fn shown(breakpoint: &Breakpoint, program: &Program, first_line: u32) -> dapts::Breakpoint {
    let id = Some(breakpoint.id);
    match &breakpoint.found {
        Ok(found) => {
            let file = breakpoint.wanted.file().and_then(|path| program.file(path));
            dapts::Breakpoint {
                id,
                verified: true,
                line: found.line.map(|line| line + first_line),
                source: file.and_then(|file| source(program, file)),
                ..dapts::Breakpoint::default()
            }
        }
        Err(why) => {
            dapts::Breakpoint { id, message: Some(why.clone()), ..dapts::Breakpoint::default() }
        }
    }
}
