//! Random plans: elements that are all reachable, supervisors, edges.

#[path = "plan/handler.rs"]
mod handler;

use std::fmt::Write;

use super::Channel;
use super::declared::Declared;
use super::dice::Dice;
use super::element::{Made, actor, computation, guard, sub_plan};
use super::entries::{Entries, Type};
use super::table::Table;
use handler::Handlers;

/// A finished plan for use as a sub-plan.
#[derive(Clone, Debug)]
pub struct Shape {
    pub name: String,
    pub entries: Entries,
    /// Whether an event leads to `terminate`.
    pub interruptible: bool,
    pub text: String,
}

/// A plan under construction.
struct Builder<'a> {
    number: u64,
    tables: &'a [Table],
    declared: &'a [Declared],
    pub entries: Entries,
    dice: &'a mut Dice,
    channels: &'a mut Vec<Channel>,
    elements: u64,
    /// The events of each global supervisor.
    globals: Vec<Vec<String>>,
    interruptible: bool,
    /// Whether an event leads to computations that may resume.
    resumes: bool,
    handlers: Handlers,
    text: String,
}

impl Shape {
    /// The plan with a number, which may use earlier ones, tables and computations.
    pub fn new(
        number: u64,
        (others, tables, declared): (&[Shape], &[Table], &[Declared]),
        dice: &mut Dice,
        channels: &mut Vec<Channel>,
    ) -> Self {
        let entries = Entries::new(number, dice);
        let elements = dice.between(4, 8);
        let handlers = Handlers::new(number, dice);
        let mut builder = Builder {
            number,
            tables,
            declared,
            entries,
            dice,
            channels,
            elements,
            globals: Vec::new(),
            interruptible: false,
            resumes: false,
            handlers,
            text: String::new(),
        };
        builder.write(others);
        Shape {
            name: format!("Plan{number}"),
            entries: builder.entries,
            interruptible: builder.interruptible,
            text: builder.text,
        }
    }

    pub fn entry_names(&self) -> Vec<String> {
        self.entries.list.iter().map(|entry| entry.name.clone()).collect()
    }
}

impl Builder<'_> {
    fn write(&mut self, others: &[Shape]) {
        self.text = format!("plan Plan{} {{\n    start e0\n{}", self.number, self.entries.text);
        for global in 0..self.dice.between(0, 3) {
            let events = self.guard(&format!("g{global}"), 4, "");
            self.globals.push(events);
        }
        self.map_maker();
        let mut index = 1;
        while index < self.elements {
            index += self.element(index, others);
        }
        self.write_handlers(others);
        self.text.push_str("}\n");
    }

    /// The first element writes the plan's map, before anything reads it.
    fn map_maker(&mut self) {
        let map = format!("m{}", self.number);
        let _ = writeln!(
            self.text,
            "    computation e0: MakeMap(id = 1, map => {map}) {{ Done -> e1 }}"
        );
    }

    /// Adds one element, or a loop of two, and returns the number of them.
    fn element(&mut self, index: u64, others: &[Shape]) -> u64 {
        let last = index + 1 == self.elements;
        let name = format!("p{}e{index}", self.number);
        // The outer plans begin with an inner one, so that nesting is common.
        let nests = !others.is_empty() && (index == 1 && self.number < 2 || self.dice.percent(20));
        if nests {
            let of = self.dice.between(0, others.len() as u64) as usize;
            let made = sub_plan(&others[of], &self.entries, self.dice);
            self.write_element(index, &made);
            return 1;
        }
        if !last && self.dice.percent(15) && index + 3 <= self.elements {
            return self.counting_loop(index);
        }
        if !self.tables.is_empty() && self.dice.percent(15) && index + 4 <= self.elements {
            return self.rows(index);
        }
        let made = if !last && self.dice.percent(30) {
            match !self.declared.is_empty() && self.dice.percent(30) {
                true => self.dice.pick(self.declared).used(&self.entries, self.dice),
                false => computation(&self.entries, self.tables, self.dice),
            }
        } else {
            actor(&name, &self.entries, self.dice, self.channels)
        };
        self.write_element(index, &made);
        1
    }

    fn write_element(&mut self, index: u64, made: &Made) {
        let name = format!("e{index}");
        let _ = writeln!(self.text, "    {} {name}: {} {{", made.word, made.call);
        let computes = made.word == "computation";
        if !computes {
            self.watch(&name);
        }
        for (n, state) in made.outcomes.iter().enumerate() {
            // The first state leads to the next element, so that all are reachable.
            let target = match n == 0 && index + 1 < self.elements {
                true => format!("e{}", index + 1),
                false => self.target(computes.then_some(index)),
            };
            let _ = writeln!(self.text, "        {state} -> {target}");
        }
        if self.dice.percent(if self.number == 0 { 85 } else { 50 }) {
            let target = self.target(computes.then_some(index));
            let _ = writeln!(self.text, "        Error -> {target}");
        }
        self.text.push_str("    }\n");
    }

    /// The supervisors of an element, and its reactions.
    fn watch(&mut self, name: &str) {
        for local in 0..self.dice.between(0, 3) {
            self.guard(&format!("w{local}"), 8, name);
        }
        self.reactions(name);
    }

    /// `for i in 0..limit`, without time.
    fn counting_loop(&mut self, index: u64) -> u64 {
        let int = self.dice.pick(&self.entries.changing(Type::Int));
        let float = self.dice.pick(&self.entries.changing(Type::Float));
        let (limit, step, next) = (self.dice.between(1, 5), index + 1, index + 2);
        let _ = write!(
            self.text,
            "    computation e{index}: Count(value = {int}, limit = {limit}, next => {int}) {{
        Again -> e{step}
        Done -> e{next}
    }}
    computation e{step}: Assign(value = {float} + {int}, result => {float}) -> e{index}
"
        );
        2
    }

    /// Reads all rows of a table, without time.
    fn rows(&mut self, index: u64) -> u64 {
        let int = self.dice.pick(&self.entries.changing(Type::Int));
        let table = self.dice.pick(self.tables);
        let made = table.reader(&int, Some(&int), &self.entries, self.dice);
        let (read, step, next) = (index + 1, index + 2, index + 3);
        let error = match self.dice.percent(50) {
            true => format!(" Error -> e{next}"),
            false => String::new(),
        };
        let _ = write!(
            self.text,
            "    computation e{index}: Assign(value = 0, result => {int}) {{ Done -> e{read} }}
    computation e{read}: {} {{ Row -> e{step} End -> e{next}{error} }}
    computation e{step}: Assign(value = {int} + 1, result => {int}) -> e{read}
",
            made.call
        );
        3
    }

    /// Two computations after an event: they resume, suspend or lead to an element.
    fn chain(&mut self) {
        let int = self.dice.pick(&self.entries.changing(Type::Int));
        let float = self.dice.pick(&self.entries.changing(Type::Float));
        let (limit, elsewhere) = (self.dice.between(1, 5), self.target(None));
        let error = self.dice.pick(&["", " Error -> resume", " Error -> terminate"]);
        let again = if self.dice.percent(50) { self.suspend() } else { None };
        let again = again.unwrap_or_else(|| "resume".to_owned());
        let _ = write!(
            self.text,
            "    computation chain: Assign(value = {float} + 1, result => {float}) {{ Done -> link{error} }}
    computation link: Count(value = {int}, limit = {limit}, next => {int}) {{
        Again -> {again}
        Done -> {elsewhere}
    }}
"
        );
    }

    /// The target of an edge; computations lead only forwards, so that they cannot loop.
    fn target(&mut self, computation: Option<u64>) -> String {
        // The outermost plan runs longer.
        if self.dice.percent(if self.number == 0 { 4 } else { 20 }) {
            return "terminate".to_owned();
        }
        if self.dice.percent(if self.number == 0 { 2 } else { 8 }) {
            return self.dice.pick(&["fail", "fail \"it is stuck\"", "fail \"it is gone\""]).into();
        }
        let least = computation.map_or(1, |index| index + 1);
        format!("e{}", self.dice.between(least, self.elements))
    }

    /// An element's reactions to global supervisors.
    fn reactions(&mut self, element: &str) {
        for (global, mut events) in self.globals.clone().into_iter().enumerate() {
            if !self.dice.percent(40) {
                continue;
            }
            events.push("DeadlineMissed".to_owned());
            let _ = write!(self.text, "        on g{global} {{");
            for event in events {
                if !self.dice.percent(60) {
                    continue;
                }
                let target = self.event_target(false);
                // It is already active.
                let itself = target.strip_prefix("suspend ").unwrap_or(&target) == element;
                let _ =
                    write!(self.text, " {event} -> {}", if itself { "ignore" } else { &target });
            }
            self.text.push_str(" }\n");
        }
    }

    /// A global supervisor, or a local one of the element `owner`; returns its events.
    fn guard(&mut self, name: &str, indent: usize, owner: &str) -> Vec<String> {
        let channel = format!("p{}{owner}{name}", self.number);
        let made = guard(&channel, &self.entries, self.dice, self.channels);
        let every = self.dice.pick(&[5, 7, 10, 15, 20]);
        let deadline = self.dice.between(1, every + 1);
        let _ = write!(self.text, "{:indent$}supervise {name}: {}", "", made.call);
        let _ = write!(self.text, " every {every} ms deadline {deadline} ms {{");
        for (n, event) in made.outcomes.iter().enumerate() {
            let target = self.event_target(n == 0);
            let _ = write!(self.text, " {event} -> {target}");
        }
        if self.dice.percent(40) {
            let target = self.event_target(false);
            let _ = write!(self.text, " DeadlineMissed -> {target}");
        }
        self.text.push_str(" }\n");
        made.outcomes.iter().map(ToString::to_string).collect()
    }

    fn event_target(&mut self, connected: bool) -> String {
        if !connected && self.dice.percent(25) {
            return "ignore".to_owned();
        }
        if let Some(target) = self.way_back(30) {
            return target;
        }
        if self.dice.percent(25)
            && let Some(target) = self.suspend()
        {
            return target;
        }
        if self.dice.percent(15) {
            let chained = self.dice.percent(60);
            self.resumes |= chained;
            return if chained { "chain" } else { "resume" }.to_owned();
        }
        let target = self.target(None);
        self.interruptible |= target == "terminate";
        target
    }
}
