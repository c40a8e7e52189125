//! The conditions of a declared computation: a line for each state that has one, in their order.

use super::super::metrics::{shorten, width};
use super::super::sketch::{Label, Sketch};
use super::super::view::View;
use super::parts::PORT_SIZE;
use afp_dsl::outline::Component;

/// Height of a line.
const LINE: f64 = 16.0;

/// Distance from the borders of the box.
const INSET: f64 = 10.0;

/// Distance between the column of states and the column of conditions.
const GAP: f64 = 8.0;

pub(super) struct Conditions<'a> {
    lines: Vec<(&'a str, String)>,
    /// Width of the column of states.
    states: f64,
}

impl<'a> Conditions<'a> {
    pub(super) fn new(view: &View<'a>, element: &'a Component) -> Conditions<'a> {
        let lines = view.conditions(element);
        let states = lines.iter().map(|(state, _)| width(&shorten(state), PORT_SIZE, true));
        let states = states.fold(0.0, f64::max);
        Conditions { lines, states }
    }

    pub(super) fn height(&self) -> f64 {
        self.lines.len() as f64 * LINE
    }

    /// Minimum width of the box; 0 without conditions.
    pub(super) fn width(&self) -> f64 {
        let conditions = self.lines.iter().map(|(_, text)| width(&shorten(text), PORT_SIZE, false));
        conditions.map(|text| 2.0 * INSET + self.states + GAP + text).fold(0.0, f64::max)
    }

    /// Writes the lines from a corner downwards.
    pub(super) fn write(&self, sketch: &mut Sketch, (left, top): (f64, f64)) {
        for (index, (state, condition)) in self.lines.iter().enumerate() {
            let base = top + (index as f64 + 0.5) * LINE + 0.36 * PORT_SIZE;
            let x = left + INSET;
            let state = Label::new((x, base), &shorten(state), PORT_SIZE, "port");
            sketch.labels.push(Label { bold: true, ..state });
            let place = (x + self.states + GAP, base);
            sketch.labels.push(Label::new(place, &shorten(condition), PORT_SIZE, "port"));
        }
    }
}
