//! Drawings of plans: the paper's notation as a [`Scene`] and as SVG, GraphViz text, JSON with
//! places. Drawings read the outline, so that plans with errors are drawn too, with the errors
//! marked in their places.
//!
//! Two folders do other jobs and are independent of drawings. [`layout_file`] reads and writes the
//! file of positions. `scxml` writes the flow of action as State Chart XML. Another engine runs a
//! state chart, so this folder reads the graph.

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

/// Finds the SVG text of a template's icon in a toolbox.
pub type Icons<'a> = &'a dyn Fn(&Toolbox, &str) -> Option<String>;

/// The options of a drawing. By default, the main plan is drawn for light and dark pages, with its
/// sub-plans after it.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// The plan to draw; the main plan if `None`.
    pub plan: Option<PlanId>,
    /// The source of icons. Without it, and for unknown icons, each kind of element has a simple
    /// picture.
    pub icons: Option<Icons<'a>>,
    /// The colours of an SVG.
    pub theme: Theme,
    /// Whether an SVG or a GraphViz text includes the bodies of sub-plans.
    pub sub_plans: bool,
    /// The positions of elements, by the file of their plan ([`Span::file`]). An SVG keeps them and
    /// lays out the rest around them, and JSON includes them. May be shorter than the list of
    /// files.
    ///
    /// [`Span::file`]: afp_syntax::source::Span::file
    pub positions: &'a [Layout],
    /// Whether entries, formulas and their bindings are shown; JSON always has them.
    pub data: bool,
    /// Whether warnings and notes are marked; errors always are.
    pub warnings: bool,
    /// Elements, or the start tag, that are drawn without data, and with one tab for all their
    /// supervisors.
    pub folded: &'a [Item],
    /// The usage of each part: an SVG then shows it by colours and numbers, with a legend.
    pub usage: Option<&'a Usage>,
}

/// The colours of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// The colours of the reader's system.
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
