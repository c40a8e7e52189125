//! Inspection of a paused run: threads, stacks and values.

use std::time::Duration as Wall;

use afp_core::trace::{ComponentId, TraceEntryId};
use afp_dsl::graph::EntryKind;
use afp_dsl::types::text::duration;
use afp_dsl::unfold::ComponentKind;

use super::launch::FLOW;
use super::stop::source;
use super::{Adapter, Answer};
use crate::program::Unit;
use crate::state::State;
use crate::watched::Watched;

/// The meaning of a variables reference: three bits of this below the component's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Group {
    Entries,
    /// The inputs of a component at its start.
    Inputs,
    Supervisors,
    /// Reports and deadlines of a supervisor.
    Timing,
    Outputs,
}

impl Group {
    const ALL: [Group; 5] =
        [Group::Entries, Group::Inputs, Group::Supervisors, Group::Timing, Group::Outputs];

    pub fn reference(self, id: ComponentId) -> u32 {
        let kind = Group::ALL.iter().position(|known| *known == self).unwrap_or(0) as u32;
        (id.0 << 3 | kind) + 1
    }

    fn of(reference: u32) -> Option<(Group, ComponentId)> {
        let number = reference.checked_sub(1)?;
        let group = Group::ALL.get((number & 7) as usize)?;
        Some((*group, ComponentId(number >> 3)))
    }
}

impl Adapter<'_> {
    pub(super) fn threads(&mut self) -> Answer<dapts::ThreadsResponse> {
        let run = self.run()?;
        let program = run.target.program();
        let thread = |id: ComponentId| {
            let path = program.unit(id).map_or_else(String::new, |unit| unit.path.clone());
            dapts::Thread { id: u64::from(id.0) + 1, name: path }
        };
        let watching = run.target.state().watching();
        let threads: Vec<_> = std::iter::once(FLOW).chain(watching).map(thread).collect();
        Ok(dapts::ThreadsResponse { threads })
    }

    pub(super) fn stack_trace(
        &mut self,
        asked: dapts::StackTraceArguments,
    ) -> Answer<dapts::StackTraceResponse> {
        let client = self.counting();
        let run = self.run()?;
        let program = run.target.program();
        let thread = u32::try_from(asked.thread_id.saturating_sub(1)).unwrap_or(u32::MAX);
        let mut stack = match thread {
            0 => run.target.state().stack(),
            other => vec![ComponentId(other)],
        };
        stack.reverse();
        if stack.is_empty() {
            stack.push(FLOW);
        }
        let frame = |id: ComponentId| {
            let unit = program.unit(id)?;
            Some(dapts::StackFrame {
                id: u64::from(id.0) + 1,
                name: frame_name(unit),
                line: unit.at.line + client.first_line,
                column: unit.at.column + client.first_column,
                source: source(program, unit.at.file),
                can_restart: None,
                end_column: None,
                end_line: None,
                instruction_pointer_reference: None,
                module_id: None,
                presentation_hint: None,
            })
        };
        let frames: Vec<_> = stack.into_iter().filter_map(frame).collect();
        let total = Some(frames.len() as u64);
        let skip = usize::try_from(asked.start_frame.unwrap_or(0)).unwrap_or(usize::MAX);
        let levels = asked.levels.filter(|levels| *levels > 0).unwrap_or(u64::MAX);
        let take = usize::try_from(levels).unwrap_or(usize::MAX);
        let stack_frames = frames.into_iter().skip(skip).take(take).collect();
        Ok(dapts::StackTraceResponse { stack_frames, total_frames: total })
    }

    /// Returns the text of a file that the client does not have.
    pub(super) fn source(
        &mut self,
        asked: dapts::SourceArguments,
    ) -> Answer<dapts::SourceResponse> {
        let file = asked.source_reference.checked_sub(1);
        let program = self.run()?.target.program();
        let text = file.and_then(|file| program.text_of(file as usize));
        let content = text.ok_or("the file has its text")?.to_owned();
        Ok(dapts::SourceResponse { content, mime_type: None })
    }

    pub(super) fn scopes(
        &mut self,
        asked: dapts::ScopesArguments,
    ) -> Answer<dapts::ScopesResponse> {
        let id = component(asked.frame_id);
        let program = self.run()?.target.program().clone();
        let unit = program.unit(id).ok_or("there is no such frame")?;
        let mut groups = match unit.kind {
            ComponentKind::Plan => vec![("Entries", Group::Entries, FLOW)],
            ComponentKind::Supervisor => vec![
                ("Timing", Group::Timing, id),
                ("Inputs", Group::Inputs, id),
                ("Outputs", Group::Outputs, id),
                ("Entries", Group::Entries, unit.plan),
            ],
            ComponentKind::Actor | ComponentKind::SubPlan | ComponentKind::Computation => vec![
                ("Inputs", Group::Inputs, id),
                ("Outputs", Group::Outputs, id),
                ("Entries", Group::Entries, unit.plan),
                ("Supervisors", Group::Supervisors, id),
            ],
        };
        groups.retain(|(_, group, _)| *group != Group::Outputs || !unit.outputs.is_empty());
        let scope = |(name, group, of): (&str, Group, ComponentId)| dapts::Scope {
            name: name.to_owned(),
            variables_reference: group.reference(of),
            expensive: false,
            presentation_hint: Some(match group {
                Group::Inputs => dapts::ScopePresentationHint::Arguments,
                Group::Entries => dapts::ScopePresentationHint::Locals,
                Group::Outputs => dapts::ScopePresentationHint::ReturnValue,
                Group::Supervisors | Group::Timing => dapts::ScopePresentationHint::Registers,
            }),
            column: None,
            end_column: None,
            end_line: None,
            indexed_variables: None,
            line: None,
            named_variables: None,
            source: None,
        };
        Ok(dapts::ScopesResponse { scopes: groups.into_iter().map(scope).collect() })
    }

    pub(super) fn variables(
        &mut self,
        asked: dapts::VariablesArguments,
    ) -> Answer<dapts::VariablesResponse> {
        let (group, id) = Group::of(asked.variables_reference).ok_or("there is no such scope")?;
        let variables = match group {
            Group::Entries => self.entries_of(id)?,
            Group::Inputs => self.inputs_of(id)?,
            Group::Outputs => self.outputs_of(id)?,
            Group::Supervisors => self.supervisors_of(id)?,
            Group::Timing => self.timing_of(id)?,
        };
        Ok(dapts::VariablesResponse { variables })
    }

    fn entries_of(&mut self, plan: ComponentId) -> Answer<Vec<dapts::Variable>> {
        let run = self.run()?;
        let (program, state) = (run.target.program(), run.target.state());
        let entries = (0..).zip(&program.entries).filter(|(_, entry)| entry.plan == plan);
        let shown = entries.map(|(number, entry)| {
            let value = state.entry(TraceEntryId(number));
            let value =
                value.map_or("unset".to_owned(), |value| value.in_unit(&entry.unit).to_string());
            let fixed = entry.kind == EntryKind::Const || plan != FLOW;
            let hint = fixed.then(|| dapts::VariablePresentationHint {
                attributes: Some(vec![dapts::VariablePresentationHintAttributes::ReadOnly]),
                kind: None,
                lazy: None,
                visibility: None,
            });
            dapts::Variable {
                ty: Some(entry.ty.clone()),
                evaluate_name: Some(entry.path.clone()),
                presentation_hint: hint,
                ..variable(&entry.name, value)
            }
        });
        Ok(shown.collect())
    }

    fn inputs_of(&mut self, id: ComponentId) -> Answer<Vec<dapts::Variable>> {
        let run = self.run()?;
        let ports = run.target.program().unit(id).map_or(&[][..], |unit| &unit.inputs);
        let unit =
            |name: &str| ports.iter().find(|port| port.0 == name).map_or("", |port| &*port.1);
        let inputs = run.target.state().inputs(id);
        Ok(inputs
            .map(|(name, value)| variable(name, value.in_unit(unit(name)).to_string()))
            .collect())
    }

    /// Lists the entries that a component writes, by port; it writes ready values when it is done.
    fn outputs_of(&mut self, id: ComponentId) -> Answer<Vec<dapts::Variable>> {
        let run = self.run()?;
        let (program, state) = (run.target.program(), run.target.state());
        let outputs = program.unit(id).map_or(&[][..], |unit| &unit.outputs);
        let shown = outputs.iter().filter_map(|(port, path)| {
            let number = program.entries.iter().position(|entry| entry.path == *path)?;
            let value = state.entry(TraceEntryId(number as u32));
            let value = value.map_or("unset".to_owned(), |value| {
                value.in_unit(&program.entries[number].unit).to_string()
            });
            Some(dapts::Variable {
                evaluate_name: Some(path.clone()),
                ..variable(&format!("{port} => {path}"), value)
            })
        });
        Ok(shown.collect())
    }

    /// Lists the supervisors of an active element, with their last reports.
    fn supervisors_of(&mut self, element: ComponentId) -> Answer<Vec<dapts::Variable>> {
        let run = self.run()?;
        let (program, state) = (run.target.program(), run.target.state());
        let plan = program.unit(element).map(|unit| unit.plan);
        let concerns = |unit: &Unit| match unit.owner {
            Some(owner) => owner == element,
            None => Some(unit.plan) == plan,
        };
        let watching = state.watching().filter_map(|id| Some((id, program.unit(id)?)));
        let shown = watching.filter(|(_, unit)| concerns(unit)).map(|(id, unit)| {
            let reference = Group::Timing.reference(id);
            let said = said(state, id);
            dapts::Variable { variables_reference: reference, ..variable(&unit.name, said) }
        });
        Ok(shown.collect())
    }

    fn timing_of(&mut self, supervisor: ComponentId) -> Answer<Vec<dapts::Variable>> {
        let target = &self.run()?.target;
        let (program, state, now) = (target.program(), target.state(), target.now());
        let report = state.report(supervisor);
        let said = report.map_or("nothing yet".to_owned(), |(at, event)| {
            format!("{event} at {:.3} s", at.as_secs_f64())
        });
        let mut all = vec![variable("last report", said)];
        match state.misses(supervisor) {
            None => all.push(variable("deadlines missed", "0".to_owned())),
            Some((count, last)) => {
                let late = format!("{:.3} ms", last.lateness.as_secs_f64() * 1e3);
                all.push(variable("deadlines missed", count.to_string()));
                all.push(variable("last lateness", late));
            }
        }
        let Some(times) = program.unit(supervisor).and_then(|unit| unit.times.as_ref()) else {
            return Ok(all);
        };
        if let Some(next) = state.next_release(supervisor, times.timing.period, now) {
            all.push(variable("next release", format!("{:.3} s", next.as_secs_f64())));
        }
        all.push(variable("every", duration(times.timing.period.as_nanos())));
        all.push(variable("deadline", duration(times.timing.deadline.as_nanos())));
        all.extend(times.bound.iter().map(|bound| variable("stops within", bound.clone())));
        Ok(all)
    }

    pub(super) fn set_variable(
        &mut self,
        asked: dapts::SetVariableArguments,
    ) -> Answer<dapts::SetVariableResponse> {
        match Group::of(asked.variables_reference) {
            Some((Group::Entries, FLOW)) => {}
            _ => {
                return Err("only entries of the outermost plan can be written from outside".into());
            }
        }
        let value = self.run()?.target.set(&asked.name, asked.value.trim())?;
        Ok(dapts::SetVariableResponse { value, ..dapts::SetVariableResponse::default() })
    }

    /// Writes an entry, given as a formula.
    pub(super) fn set_expression(
        &mut self,
        asked: dapts::SetExpressionArguments,
    ) -> Answer<dapts::SetExpressionResponse> {
        let value = self.assign(asked.frame_id, asked.expression.trim(), asked.value.trim())?;
        Ok(dapts::SetExpressionResponse { value, ..dapts::SetExpressionResponse::default() })
    }

    /// Writes an entry by its name in the plan of a frame, and returns the value.
    fn assign(&mut self, frame: Option<u64>, name: &str, value: &str) -> Answer<String> {
        let plan = self.plan_of(None, frame)?;
        let run = self.run()?;
        let program = run.target.program().clone();
        let entry = program.entry(plan, name).and_then(|id| program.entries.get(id.0 as usize));
        let path = entry.map_or(name, |entry| &*entry.path);
        Ok(run.target.set(path, value)?)
    }

    /// Evaluates a formula. `name = value` writes an entry, except in watches and hovers, which
    /// clients repeat. `why PATH` is [`Adapter::why`] for clients that have only a console.
    pub(super) fn evaluate(
        &mut self,
        asked: dapts::EvaluateArguments,
        now: Wall,
    ) -> Answer<dapts::EvaluateResponse> {
        use dapts::EvaluateArgumentsContext as Context;
        if asked.context == Some(Context::Hover) {
            return self.hover(&asked);
        }
        if let Some(path) = asked.expression.trim().strip_prefix("why ") {
            let result = self.why_in_words(path.trim())?;
            return Ok(dapts::EvaluateResponse { result, ..dapts::EvaluateResponse::default() });
        }
        if let Some((name, value)) = assigned(&asked.expression) {
            if let Some(Context::Watch | Context::Clipboard | Context::Variables) = asked.context {
                return Err("an expression cannot write: use '==' to compare".into());
            }
            self.may("setExpression", now)?;
            let result = self.assign(asked.frame_id, name, value)?;
            return Ok(dapts::EvaluateResponse { result, ..dapts::EvaluateResponse::default() });
        }
        let plan = self.plan_of(None, asked.frame_id)?;
        let run = self.run()?;
        let program = run.target.program().clone();
        let watched = Watched::new(&program, plan, &asked.expression)?;
        let result = watched.shown(&program, run.target.state())?;
        let ty = Some(watched.ty());
        Ok(dapts::EvaluateResponse { result, ty, ..dapts::EvaluateResponse::default() })
    }

    pub(super) fn plan_of(
        &mut self,
        scope: Option<u32>,
        frame: Option<u64>,
    ) -> Answer<ComponentId> {
        let program = self.run()?.target.program();
        let of_scope = scope.and_then(Group::of).and_then(|(group, id)| match group {
            Group::Entries => Some(id),
            _ => program.unit(id).map(|unit| unit.plan),
        });
        let of_frame = || Some(program.unit(component(frame?))?.plan);
        Ok(of_scope.or_else(of_frame).unwrap_or(FLOW))
    }
}

/// The last report of a supervisor.
pub(super) fn said(state: &State, supervisor: ComponentId) -> String {
    let report = state.report(supervisor);
    report.map_or("clear".to_owned(), |(at, event)| format!("{event} at {:.3} s", at.as_secs_f64()))
}

/// The two sides of an assignment; `None` for a comparison.
fn assigned(text: &str) -> Option<(&str, &str)> {
    let (name, value) = text.split_once('=')?;
    let compares = name.ends_with(['!', '<', '>']) || value.starts_with('=');
    (!compares).then(|| (name.trim(), value.trim()))
}

pub(super) fn component(frame: u64) -> ComponentId {
    ComponentId(u32::try_from(frame.saturating_sub(1)).unwrap_or(u32::MAX))
}

fn frame_name(unit: &Unit) -> String {
    match unit.kind {
        ComponentKind::Plan => unit.path.clone(),
        _ => format!("{}: {}", unit.path, unit.template),
    }
}

fn variable(name: &str, value: String) -> dapts::Variable {
    dapts::Variable {
        name: name.to_owned(),
        value,
        variables_reference: 0,
        declaration_location_reference: None,
        evaluate_name: None,
        indexed_variables: None,
        memory_reference: None,
        named_variables: None,
        presentation_hint: None,
        ty: None,
        value_location_reference: None,
    }
}
