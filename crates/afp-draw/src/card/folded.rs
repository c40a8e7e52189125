//! The tab of a folded box, instead of its supervisors. Their edges to elements stay, because a
//! drawing without them would show a different plan. The tab's tooltip has the rest.

use super::super::layout;
use super::super::metrics::width;
use super::super::sketch::{Frame, Label, Piece, Rect, Shape};
use super::super::view::{Exit, View, name};
use super::Card;
use super::parts::leave;
use afp_dsl::graph::Target;
use afp_dsl::outline::{Component, Part};

/// Font size of the tab in pixels, and the space on both sides of the text.
const SIZE: f64 = 11.0;
const INSET: f64 = 8.0;

/// Distance of the tab from the top of its box.
const GAP: f64 = 7.0;

/// Height with one edge, and the height of each further edge.
const LEAST: f64 = 24.0;
const EDGE: f64 = 10.0;

/// All supervisors of a folded box.
pub(super) struct Tab<'a> {
    supervisors: Vec<(&'a Component, Vec<Exit<'a>>)>,
}

impl<'a> Tab<'a> {
    pub(super) fn new(
        view: &View<'a>,
        supervisors: impl Iterator<Item = &'a Component>,
    ) -> Tab<'a> {
        let with_exits = |each: &'a Component| (each, view.exits(each));
        Tab { supervisors: supervisors.map(with_exits).collect() }
    }

    /// Minimum height of its box; 0 without supervisors.
    pub(super) fn first(&self) -> f64 {
        if self.supervisors.is_empty() { 0.0 } else { self.height() + 2.0 * GAP }
    }

    fn height(&self) -> f64 {
        LEAST + self.leading().count().saturating_sub(1) as f64 * EDGE
    }

    fn leading(&self) -> impl Iterator<Item = (&'a Component, &Exit<'a>)> {
        let all = self.supervisors.iter();
        all.flat_map(|(each, exits)| exits.iter().map(move |exit| (*each, exit))).filter(
            |(_, exit)| matches!(exit.to, Some(Target::Element(Ok(_)) | Target::Suspend(Ok(_)))),
        )
    }

    fn text(&self) -> String {
        match &self.supervisors[..] {
            [(one, _)] => name(one).to_owned(),
            all => format!("{} supervisors", all.len()),
        }
    }

    /// The description of each supervisor and the targets of its events.
    fn title(&self, view: &View<'a>) -> String {
        let mut lines = Vec::new();
        for (each, exits) in &self.supervisors {
            lines.push(format!("{}: {}", name(each), view.template_name(view.watcher(each))));
            let led =
                exits.iter().map(|it| format!("  {} -> {}", it.name, view.target_name(it.to)));
            lines.extend(led);
        }
        lines.join("\n")
    }

    /// Draws the tab on the right side of `rect` and widens the card.
    pub(super) fn attach(self, view: &View<'a>, card: &mut Card<'a>, rect: Rect) {
        if self.supervisors.is_empty() {
            return;
        }
        let text = self.text();
        let (x, y) = (rect.right(), rect.y + GAP);
        let tab =
            Rect { x, y, width: width(&text, SIZE, false) + 2.0 * INSET, height: self.height() };
        let shape = Shape::Leaning(8.0);
        let (class, title) = ("supervisor".into(), self.title(view));
        card.sketch.frames.push(Frame { rect: tab, shape, class, title });
        let place = (tab.x + INSET, tab.y + tab.height / 2.0 + 0.36 * SIZE);
        // There is no icon before the text.
        card.sketch.labels.push(Label::new(place, &text, SIZE, "name bare"));
        // The tab carries the marks of the hidden supervisors.
        let mut worst = None;
        for (each, exits) in &self.supervisors {
            let found = exits.iter().filter_map(|exit| exit.severity);
            // The worst mark comes first.
            let severity = found.chain(view.severity(each.findings.worst())).min();
            worst = worst.into_iter().chain(severity).min();
            let (item, part) = (each.item.clone(), Part::Whole);
            card.sketch.pieces.push(Piece { item, part, rect: tab, severity, tag: None });
        }
        card.sketch.mark(worst, (tab.x + 2.0, tab.y + 2.0));
        for ((each, exit), nth) in self.leading().zip(0_u16..) {
            let y = tab.y + LEAST / 2.0 + f64::from(nth) * EDGE;
            leave(card, each, layout::Exit::Right(tab.right(), y), exit);
        }
        card.width = card.width.max(tab.right());
        card.height = card.height.max(tab.bottom());
    }
}
