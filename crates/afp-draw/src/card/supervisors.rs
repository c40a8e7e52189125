//! Supervisors, on the right side of a box.

use super::super::metrics::width;
use super::super::sketch::{Anchor, Frame, Glyph, Label, Picture, Piece, Rect, Shape, Sketch};
use super::super::usage::{Class, Use, times};
use super::super::view::{Exit, Input, Output, View, name, timing};
use super::parts::{
    PORT_SIZE, ROW, STAND_OUT, chip_width, exit_height, exit_right, inflow, outflow, pill_width,
    reach_right,
};
use super::{Card, REACH, shown};
use afp_dsl::graph::Target;
use afp_dsl::outline::{Component, ComponentKind, Part};
use afp_dsl::types::text::duration;

/// Font sizes in pixels.
const NAME: f64 = 12.0;
const TEMPLATE: f64 = 10.5;

/// Distance above, between and below supervisors.
const GAP: f64 = 7.0;

/// Minimum height: icon, name and template.
const LEAST: f64 = 44.0;

/// The supervisors of one box, measured.
pub(super) struct Stack<'a> {
    rows: Vec<Row<'a>>,
    /// Width of the part with the icon and the names.
    head: f64,
    /// Width of the part with events and ports.
    ports: f64,
    /// Height of the whole; 0 without supervisors.
    pub(super) height: f64,
    /// Minimum height of the box for the first supervisor.
    pub(super) first: f64,
}

struct Row<'a> {
    supervisor: &'a Component,
    /// Its name; `on NAME` for reactions.
    name: String,
    template: String,
    usage: Option<Use>,
    events: Vec<Exit<'a>>,
    inputs: Vec<Input<'a>>,
    outputs: Vec<Output<'a>>,
}

impl<'a> Stack<'a> {
    pub(super) fn new(
        view: &View<'a>,
        supervisors: impl Iterator<Item = &'a Component>,
    ) -> Stack<'a> {
        let rows: Vec<_> = supervisors.map(|each| Row::new(view, each)).collect();
        let head = rows.iter().map(Row::head).fold(0.0, f64::max);
        let ports = rows.iter().map(Row::ports).fold(0.0, f64::max);
        let heights: f64 = rows.iter().map(|row| row.height() + GAP).sum();
        let height = if rows.is_empty() { 0.0 } else { GAP + heights };
        let first = rows.first().map_or(0.0, |row| row.height() + 2.0 * GAP);
        Stack { rows, head, ports, height, first }
    }

    /// Draws the supervisors on the right side of `rect` and widens the card.
    pub(super) fn attach(self, view: &View<'a>, card: &mut Card<'a>, rect: Rect) {
        let mut y = rect.y + GAP;
        let width = self.head + self.ports;
        for row in &self.rows {
            let own = Rect { x: rect.right(), y, width, height: row.height() };
            row.draw(view, card, own);
            card.width = card.width.max(own.right() + row.reach());
            y = own.bottom() + GAP;
        }
        card.height = card.height.max(rect.y + self.height);
        if let Some(beyond) = Some(y - GAP - rect.bottom()).filter(|beyond| *beyond > 0.0) {
            // The spine connects supervisors below the box's lower end.
            let spine = Rect {
                x: rect.right() - 1.0,
                y: rect.bottom() - 9.0,
                width: 2.0,
                height: beyond + 9.0,
            };
            card.sketch.frame(spine, Shape::Round(1.0), "spine");
            // All other parts are drawn over it.
            card.sketch.frames.rotate_right(1);
        }
    }
}

impl<'a> Row<'a> {
    fn new(view: &View<'a>, supervisor: &'a Component) -> Row<'a> {
        let watcher = view.watcher(supervisor);
        let reacts = supervisor.kind == ComponentKind::Reactions;
        let own = name(supervisor);
        let own = if reacts { format!("on {own}") } else { own.to_owned() };
        let mut template = view.template_name(watcher).to_owned();
        let every = supervisor.times.map(|times| times.timing.period.as_nanos());
        let usual = supervisor.template().map(|template| template.every);
        if let Some(every) = every.filter(|every| usual.is_some_and(|usual| usual != *every)) {
            template += &format!(" · every {}", duration(every));
        }
        let events = view.exits(supervisor);
        let counts = || events.iter().filter(|exit| exit.to != Some(Target::Ignore));
        let counts = || counts().filter_map(|exit| exit.count);
        let is_counted = view.count(supervisor).is_some() || reacts && counts().next().is_some();
        let usage = is_counted.then(|| {
            let sum: u64 = counts().sum();
            template += &format!(" · {}", times(sum));
            Use::with_exits(sum, counts())
        });
        Row {
            supervisor,
            name: own,
            template,
            usage,
            events,
            inputs: shown(view.inputs(supervisor)),
            outputs: view.outputs(supervisor),
        }
    }

    fn head(&self) -> f64 {
        let name = width(&self.name, NAME, true);
        36.0 + name.max(width(&self.template, TEMPLATE, false)) + 16.0
    }

    fn ports(&self) -> f64 {
        let events = self.events.iter().map(|event| chip_width(&event.text()) - STAND_OUT);
        let inputs = self.inputs.iter().map(|input| input.port);
        let names = inputs.chain(self.outputs.iter().map(|output| output.port));
        events.chain(names.map(|name| width(name, PORT_SIZE, false) + 10.0)).fold(0.0, f64::max)
    }

    fn height(&self) -> f64 {
        let events: f64 = self.events.iter().map(exit_height).sum();
        let data = self.inputs.len() + self.outputs.len();
        LEAST.max(events + data as f64 * ROW + 8.0)
    }

    /// Its reach to the right of its box.
    fn reach(&self) -> f64 {
        let texts = self.inputs.iter().map(Input::shown);
        let data = texts.chain(self.outputs.iter().map(Output::text));
        let data = data.map(|text| REACH + pill_width(text));
        data.chain(self.events.iter().map(reach_right)).fold(0.0, f64::max)
    }

    fn draw(&self, view: &View<'a>, card: &mut Card<'a>, rect: Rect) {
        let title = self.title();
        let shape = Shape::Leaning(8.0);
        let class = Class { name: self.class(), usage: self.usage };
        card.sketch.frames.push(Frame { rect, shape, class, title });
        self.heading(view, &mut card.sketch, rect);
        let severity = view.severity(self.supervisor.findings.worst());
        let item = self.supervisor.item.clone();
        card.sketch.piece(Piece { item, part: Part::Whole, rect, severity, tag: None }, 2.0);
        let single = self.events.len() == 1 && self.inputs.is_empty() && self.outputs.is_empty();
        let events: f64 = self.events.iter().map(exit_height).sum();
        let above = if single { (rect.height - events) / 2.0 } else { 4.0 };
        let mut y = rect.y + above + ROW / 2.0;
        for event in &self.events {
            exit_right(card, self.supervisor, (rect.right(), y), event);
            y += exit_height(event);
        }
        for input in &self.inputs {
            inflow(&mut card.sketch, self.supervisor, (rect.right(), y), input, Anchor::End);
            y += ROW;
        }
        for output in &self.outputs {
            outflow(&mut card.sketch, self.supervisor, (rect.right(), y), output, Anchor::End);
            y += ROW;
        }
    }

    /// Reactions are a tab with only the targets of the plan supervisor's events.
    fn class(&self) -> &'static str {
        match self.supervisor.kind {
            ComponentKind::Reactions => "reactions",
            _ => "supervisor",
        }
    }

    fn title(&self) -> String {
        let head = format!("{}: {}", self.name, self.template);
        let lines = [head, timing(self.supervisor), self.supervisor.doc.clone()];
        lines.into_iter().filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n")
    }

    fn heading(&self, view: &View<'a>, sketch: &mut Sketch<'a>, rect: Rect) {
        sketch.pictures.push(Picture {
            x: rect.x + 10.0,
            y: rect.y + 12.0,
            size: 20.0,
            class: Class { name: "supervisor", usage: self.usage },
            icon: view.icon(view.watcher(self.supervisor)),
            fallback: Glyph::Supervisor,
        });
        let place = |y| (rect.x + 38.0, rect.y + y);
        let named = Label::new(place(20.0), &self.name, NAME, "name");
        sketch.labels.push(Label { bold: true, ..named });
        sketch.labels.push(Label::new(place(34.0), &self.template, TEMPLATE, "template"));
    }
}
