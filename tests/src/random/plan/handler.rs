//! Handlers of a random plan, and the edges that suspend and return.

use std::fmt::Write;

use super::{Builder, Shape};
use crate::random::dice::Dice;
use crate::random::element::{actor, sub_plan};
use crate::random::entries::Type;

/// The handlers of a plan; those that no event names are not written.
#[derive(Debug)]
pub struct Handlers {
    /// Whether an event names it.
    named: Vec<bool>,
    /// Whether a handler is being written.
    open: bool,
    /// Whether a handler leads to computations that may return.
    chained: bool,
}

impl Handlers {
    pub fn new(plan: u64, dice: &mut Dice) -> Self {
        let count = if dice.percent(10) { 0 } else { dice.between(u64::from(plan == 0), 4) };
        Handlers { named: vec![false; count as usize], open: false, chained: false }
    }
}

impl Builder<'_> {
    /// `suspend` and a handler, if the plan has any.
    pub fn suspend(&mut self) -> Option<String> {
        let count = self.handlers.named.len() as u64;
        let handler = (count > 0).then(|| self.dice.between(0, count) as usize)?;
        self.handlers.named[handler] = true;
        Some(format!("suspend h{handler}"))
    }

    /// With that chance in percent, the target of a handler that returns, at once or perhaps.
    pub fn way_back(&mut self, chance: u64) -> Option<String> {
        if !self.handlers.open || !self.dice.percent(chance) {
            return None;
        }
        let chained = self.dice.percent(25);
        self.handlers.chained |= chained;
        Some(if chained { "back" } else { "return" }.to_owned())
    }

    /// Writes all handlers that an event names, and the computations of events.
    pub fn write_handlers(&mut self, others: &[Shape]) {
        let mut written = vec![false; self.handlers.named.len()];
        let mut chain = false;
        self.handlers.open = true;
        loop {
            if self.resumes && !chain {
                chain = true;
                self.handlers.open = false;
                self.chain();
                self.handlers.open = true;
            }
            let next = (0..written.len()).find(|at| self.handlers.named[*at] && !written[*at]);
            let Some(next) = next else { break };
            written[next] = true;
            self.write_handler(next, others);
        }
        if self.handlers.chained {
            self.back();
        }
    }

    fn write_handler(&mut self, number: usize, others: &[Shape]) {
        let name = format!("h{number}");
        let made = if !others.is_empty() && self.dice.percent(30) {
            let of = self.dice.between(0, others.len() as u64) as usize;
            sub_plan(&others[of], &self.entries, self.dice)
        } else {
            let channel = format!("p{}{name}", self.number);
            actor(&channel, &self.entries, self.dice, self.channels)
        };
        let _ = writeln!(self.text, "    {} {name}: {} {{", made.word, made.call);
        self.watch(&name);
        for state in made.outcomes {
            let target = self.way_back(70).unwrap_or_else(|| self.target(None));
            let _ = writeln!(self.text, "        {state} -> {target}");
        }
        if self.dice.percent(60) {
            let target = self.way_back(50).unwrap_or_else(|| self.target(None));
            let _ = writeln!(self.text, "        Error -> {target}");
        }
        self.text.push_str("    }\n");
    }

    /// Two computations after a handler: they return or lead to an element.
    fn back(&mut self) {
        let int = self.dice.pick(&self.entries.changing(Type::Int));
        let float = self.dice.pick(&self.entries.changing(Type::Float));
        let (limit, elsewhere) = (self.dice.between(1, 5), self.target(None));
        let error = self.dice.pick(&["", " Error -> return", " Error -> terminate"]);
        let _ = write!(
            self.text,
            "    computation back: Assign(value = {float} + 1, result => {float}) {{ Done -> home{error} }}
    computation home: Count(value = {int}, limit = {limit}, next => {int}) {{
        Again -> return
        Done -> {elsewhere}
    }}
"
        );
    }
}
