//! Plans as SVG in the paper's notation.
//!
//! Thick arrows are flow of action, thin arrows are flow of data. A picture consists of the parts
//! of a [`Scene`] and loads nothing.

mod icon;
pub(super) mod paint;
mod style;

use super::scene::{PlanScene, Scene};
use super::{Options, Theme};
use afp_dsl::outline::Outline;
use paint::{escaped, line, number};

pub use icon::default_icon;
pub use style::{properties, sheet};

/// The main plan as an SVG picture, with its sub-plans after it by default.
///
/// Texts come from the plan and are escaped. The picture's size is in pixels and depends on the
/// plan. The same outline and options give the same text.
pub fn svg(outline: &Outline, options: &Options) -> String {
    picture(&Scene::new(outline, options, None), options.theme)
}

pub fn picture(scene: &Scene, theme: Theme) -> String {
    let (width, height) = (scene.size.0.ceil(), scene.size.1.ceil());
    let main = scene.plans.first();
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"afp-plan\" role=\"img\" \
         width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
         <title>{}</title>\n",
        escaped(main.map_or("", |plan| &plan.name))
    );
    if let Some(plan) = main.filter(|plan| !plan.doc.is_empty()) {
        line(&mut out, &format!("<desc>{}</desc>", escaped(&plan.doc)));
    }
    let sheet = style::sheet(theme, scene.legend.is_some());
    line(&mut out, &format!("<style>\n{sheet}</style>"));
    if !scene.symbols.is_empty() {
        line(&mut out, "<defs>");
        scene.symbols.iter().for_each(|symbol| line(&mut out, &symbol.svg));
        line(&mut out, "</defs>");
    }
    line(&mut out, "<rect class=\"page\" width=\"100%\" height=\"100%\"/>");
    for plan in &scene.plans {
        plan_group(&mut out, plan);
    }
    out.extend(scene.legend.iter().map(String::as_str));
    out + "</svg>\n"
}

/// Edges are below boxes.
fn plan_group(out: &mut String, plan: &PlanScene) {
    let (x, y) = (number(plan.offset.0), number(plan.offset.1));
    let item = escaped(&plan.plan.to_string());
    line(out, &format!("<g class=\"plan\" data-item=\"{item}\" transform=\"translate({x} {y})\">"));
    out.extend(plan.edges.iter().map(|edge| &*edge.svg));
    out.extend(plan.elements.iter().map(|element| &*element.svg));
    line(out, "</g>");
}
