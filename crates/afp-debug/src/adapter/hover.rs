//! Hover during a run: the value of an entry or formula, a port's last input, the start of an
//! element, a supervisor's report, the last use of an edge.

use afp_core::Instant;
use afp_core::trace::ComponentId;
use afp_dsl::unfold::ComponentKind;

use super::look::{Group, component, said};
use super::{Adapter, Answer, Refusal};
use crate::program::{Place, Program, Spot, Unit};
use crate::state::State;
use crate::watched::Watched;

struct HoverText {
    text: String,
    ty: Option<String>,
    /// A reference for [`Adapter::variables`]; 0 if there are no details.
    more: u32,
}

impl From<String> for HoverText {
    fn from(text: String) -> HoverText {
        HoverText { text, ty: None, more: 0 }
    }
}

impl Adapter<'_> {
    /// Evaluates a word during the run, in the frame if the client gives no position.
    pub(super) fn hover(
        &mut self,
        asked: &dapts::EvaluateArguments,
    ) -> Answer<dapts::EvaluateResponse> {
        let at = self.place(asked)?;
        let run = self.run()?;
        let (program, state) = (run.target.program(), run.target.state());
        let (plan, unit) = match at {
            Some(at) => {
                let all = program.around(at);
                let frame = asked.frame_id.and_then(|frame| program.unit(component(frame)));
                let is_of_frame =
                    |(plan, _): &&(ComponentId, _)| frame.is_some_and(|it| it.plan == *plan);
                let is_on = |(plan, _): &&(ComponentId, _)| state.is_on(*plan);
                // Among several uses of a plan, the frame's one comes first, and then the active
                // one.
                let inside = all.iter().find(is_of_frame).or_else(|| all.iter().find(is_on));
                *inside.or_else(|| all.first()).ok_or("the running plan does not use this text")?
            }
            None => {
                let id = asked.frame_id.map(component).unwrap_or_default();
                let unit = program.unit(id).ok_or("there is no such frame")?;
                if unit.kind == ComponentKind::Plan { (id, None) } else { (unit.plan, Some(id)) }
            }
        };
        let text = asked.expression.trim();
        let from = at.and_then(|at| program.text_from(at)).and_then(|from| from.strip_prefix(text));
        let is_bound = from.is_some_and(|behind| binds(behind.trim_start()));
        let edges = at.map_or(&[][..], |at| program.edges_at(at));
        let word = Word { program, state, plan, unit, text, is_bound, edges };
        let HoverText { text, ty, more } = word.hover_text()?;
        Ok(dapts::EvaluateResponse {
            result: text,
            ty,
            variables_reference: more,
            ..dapts::EvaluateResponse::default()
        })
    }

    /// The position of a word, if the client gives one.
    fn place(&mut self, asked: &dapts::EvaluateArguments) -> Answer<Option<Place>> {
        let path = asked.source.as_ref().and_then(|source| source.path.as_deref());
        let (Some(path), Some(line)) = (path, asked.line) else { return Ok(None) };
        let path = self.host.path(path);
        let counting = self.counting();
        let file = self.run()?.target.program().file(&path);
        let file = file.ok_or("the running plan does not use this file")?;
        let line = line.saturating_sub(counting.first_line);
        let column = asked.column.map(|column| column.saturating_sub(counting.first_column));
        Ok(Some(Place { file, line, column: column.unwrap_or(u32::MAX) }))
    }
}

/// A word inside a plan, and after the name of a component.
struct Word<'a> {
    program: &'a Program,
    state: &'a State,
    plan: ComponentId,
    unit: Option<ComponentId>,
    text: &'a str,
    /// Whether it is a port before a binding.
    is_bound: bool,
    edges: &'a [Spot],
}

impl Word<'_> {
    fn hover_text(&self) -> Answer<HoverText> {
        if let Some(port) = self.port().filter(|_| self.is_bound) {
            return Ok(port);
        }
        if self.reads() {
            let formula = Watched::new(self.program, self.plan, self.text)?;
            let text = formula.shown(self.program, self.state)?;
            return Ok(HoverText { text, ty: Some(formula.ty()), more: 0 });
        }
        let found = self.port().or_else(|| self.outcome()).or_else(|| self.component());
        found.ok_or_else(|| self.nothing())
    }

    /// Whether it names an entry; other formulas are constant.
    fn reads(&self) -> bool {
        let mut entries = self.program.entries.iter().filter(|entry| entry.plan == self.plan);
        let is_part = |part: char| part.is_alphanumeric() || part == '_';
        let names: Vec<_> = self.text.split(|part| !is_part(part)).collect();
        entries.any(|entry| names.contains(&&*entry.name))
    }

    fn nothing(&self) -> Refusal {
        Refusal(format!("'{}' does not change while the plan runs", self.text))
    }

    /// The component, and the element that it watches.
    fn units(&self) -> impl Iterator<Item = (ComponentId, &Unit)> {
        let own = self.unit.and_then(|id| Some((id, self.program.unit(id)?)));
        let owner = own.and_then(|(_, unit)| unit.owner);
        own.into_iter().chain(owner.and_then(|id| Some((id, self.program.unit(id)?))))
    }

    /// The last value of the component's input.
    fn port(&self) -> Option<HoverText> {
        let id = self.unit?;
        let (_, si_unit) = self.program.unit(id)?.inputs.iter().find(|port| port.0 == self.text)?;
        let value = self.state.inputs(id).find(|(name, _)| *name == self.text);
        let value = value.map(|(_, value)| value.in_unit(si_unit).to_string());
        Some(HoverText::from(value.unwrap_or_else(|| "not read yet".to_owned())))
    }

    /// The last time of a state or event, by its own edge or the edge at that position.
    fn outcome(&self) -> Option<HoverText> {
        let here = |spot: &&Spot| self.program.plan_at(**spot) == self.plan;
        let last = match self.edges.iter().find(here) {
            Some(Spot::Reaction(id, watcher, event)) => self.state.reacted(*id, *watcher, *event),
            Some(Spot::Outcome(id, outcome)) => self.state.reached(*id, *outcome),
            _ => {
                let number = |unit: &Unit| unit.outcome(self.text);
                let mut all = self.units().filter_map(|(id, unit)| Some((id, number(unit)?)));
                let (id, number) = all.next()?;
                self.state.reached(id, number)
            }
        };
        let text =
            last.map_or("not taken yet".to_owned(), |at| format!("last taken at {}", time(at)));
        Some(HoverText::from(text))
    }

    /// The activity of an element or a supervisor.
    fn component(&self) -> Option<HoverText> {
        let same = self
            .program
            .parts()
            .filter(|(_, unit)| unit.plan == self.plan && unit.name == self.text);
        let same: Vec<_> = same.collect();
        let owners: Vec<_> = self.units().map(|(id, _)| id).collect();
        // The supervisors of an element are always visible, but two elements may have supervisors
        // with the same name.
        let is_near = |unit: &Unit| unit.owner.is_none_or(|owner| owners.contains(&owner));
        let (id, unit) = same.iter().find(|(_, unit)| is_near(unit))?;
        let is_on = self.state.is_on(*id);
        let (text, group) = match unit.kind {
            ComponentKind::Supervisor if !is_on => ("not watching".to_owned(), Group::Timing),
            ComponentKind::Supervisor => (said(self.state, *id), Group::Timing),
            _ => {
                let since = self.state.cause(*id).map(|(at, _)| time(at));
                let text = match (is_on, since) {
                    (true, Some(since)) => format!("active since {since}"),
                    (true, None) => "active".to_owned(),
                    (false, Some(since)) => format!("not active; started last at {since}"),
                    (false, None) => "not started yet".to_owned(),
                };
                // The inputs of a sub-plan are entries.
                let is_plan = unit.kind == ComponentKind::SubPlan;
                (text, if is_plan { Group::Entries } else { Group::Inputs })
            }
        };
        Some(HoverText { more: group.reference(*id), ..HoverText::from(text) })
    }
}

/// Whether a text continues with a port binding.
fn binds(behind: &str) -> bool {
    behind.strip_prefix('=').is_some_and(|rest| !rest.starts_with('='))
}

fn time(at: Instant) -> String {
    format!("{:.3} s", at.as_secs_f64())
}
