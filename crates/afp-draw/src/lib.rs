//! Drawings of plans: the paper's notation as a [`Scene`] and as SVG, GraphViz text, JSON with
//! places. Drawings read the outline, so that plans with errors are drawn too, with errors marked
//! in their places.
//!
//! Two folders do other jobs and know nothing of drawings. [`layout_file`] reads and writes the file
//! of positions. `scxml` writes the flow of action as State Chart XML; another engine runs a state
//! chart, so it reads the graph.

mod arrange;
mod card;
mod dot;
pub mod formula;
mod json;
mod layout;
pub mod layout_file;
mod legend;
mod metrics;
mod names;
mod polyline;
mod router;
mod scene;
mod scxml;
mod sketch;
mod svg;
mod usage;
mod view;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

use std::fmt;

use crate::layout_file::Layout;
use afp_dsl::outline::PlanId;
use afp_dsl::toolbox::Toolbox;
use afp_syntax::item::Item;

pub use dot::dot;
pub use json::json;
pub use names::free_names;
pub use polyline::Point;
pub use scene::{Boxes, EdgeScene, ElementScene, PieceScene, PlanScene, Scene};
pub use scxml::scxml;
pub use sketch::Rect;
pub use svg::paint::Symbol;
pub use svg::{default_icon, picture, properties, sheet, svg};
pub use usage::{Count, PlanUsage, Reaction, Usage};

/// Finds the SVG text of an icon that a template of a toolbox names.
pub type Icons<'a> = &'a dyn Fn(&Toolbox, &str) -> Option<String>;

/// What a drawing can use besides the outline. The default draws the main plan for light and dark
/// pages, with its sub-plans after it.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// The plan to be drawn; without one the main plan.
    pub plan: Option<PlanId>,
    /// Where icons come from; without one, and for icons that it does not know, each kind of
    /// element has a simple picture of its own.
    pub icons: Option<Icons<'a>>,
    /// The colours of an SVG.
    pub theme: Theme,
    /// Whether an SVG or a GraphViz text shows the bodies of sub-plans too.
    pub sub_plans: bool,
    /// Where elements have been placed, by the file of their plan ([`Span::file`]): an SVG keeps
    /// those places and lays out the rest around them, JSON names them. May be shorter than the
    /// list of files.
    ///
    /// [`Span::file`]: afp_syntax::source::Span::file
    pub positions: &'a [Layout],
    /// Whether entries, formulas and what they are bound to are shown; JSON always has them.
    pub data: bool,
    /// Whether warnings and notes are marked where they belong, too; errors always are.
    pub warnings: bool,
    /// Elements, or the start tag, that are drawn without what they read and write, and with one tab for all their
    /// supervisors.
    pub folded: &'a [Item],
    /// How often each part was used: an SVG then shows that by colours and numbers, with a legend.
    pub usage: Option<&'a Usage>,
}

/// The colours of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// Those of the reader's system.
    #[default]
    Auto,
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options {
            plan: None,
            icons: None,
            positions: &[],
            theme: Theme::Auto,
            sub_plans: true,
            data: true,
            warnings: false,
            folded: &[],
            usage: None,
        }
    }
}

impl fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Options")
            .field("plan", &self.plan)
            .field("theme", &self.theme)
            .finish_non_exhaustive()
    }
}
