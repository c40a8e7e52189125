//! Icons inside the drawing.
//!
//! A toolbox's icon is a file that somebody wrote; only plain shapes are taken from it, so that a
//! drawing never runs scripts or loads anything.

use super::super::sketch::Glyph;

/// What an icon must not contain, in lower case.
const REFUSED: &[&str] =
    &["<script", "<style", "<foreignobject", "<image", "<!", "<?", "href", "url(", "javascript:"];

/// The content of an icon as a group at `(x, y)` that is `size` pixels wide; `None` when the text
/// is no SVG element with a `viewBox`, or holds more than shapes.
pub(super) fn embedded(svg: &str, (x, y): (f64, f64), size: f64) -> Option<String> {
    let svg = svg.trim();
    let lower = svg.to_ascii_lowercase();
    if REFUSED.iter().any(|word| lower.contains(word)) || has_handler(&lower) {
        return None;
    }
    let (tag, rest) = svg.strip_prefix("<svg")?.split_once('>')?;
    let content = rest.strip_suffix("</svg>")?.trim();
    let attributes = attributes(tag)?;
    let view_box = attributes.iter().find(|(name, _)| *name == "viewBox")?.1;
    let numbers: Vec<f64> =
        view_box.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let [left, top, width, height] = numbers[..] else { return None };
    let scale = size / width.max(height);
    if !scale.is_finite() || scale <= 0.0 {
        return None;
    }
    let kept = attributes.iter().filter(|(name, _)| !FRAME.contains(name));
    let kept: String = kept.map(|(name, value)| format!(" {name}=\"{value}\"")).collect();
    let (x, y) = (super::paint::number(x - left * scale), super::paint::number(y - top * scale));
    let scale = (scale * 1e4).round() / 1e4;
    Some(format!("<g transform=\"translate({x} {y}) scale({scale})\"{kept}>{content}</g>"))
}

/// Attributes of the icon's root that have no meaning on a group.
const FRAME: &[&str] = &["xmlns", "viewBox", "width", "height", "x", "y", "id", "class", "version"];

/// Whether any attribute such as `onload` is there.
fn has_handler(lower: &str) -> bool {
    lower.split_whitespace().any(|word| {
        word.starts_with("on") && word.split_once('=').is_some_and(|(name, _)| name.len() > 2)
    })
}

/// Names and values of the attributes of a tag; `None` when it is not well formed.
fn attributes(tag: &str) -> Option<Vec<(&str, &str)>> {
    let mut found = Vec::new();
    let mut rest = tag.trim();
    while !rest.is_empty() {
        let (name, after) = rest.split_once('=')?;
        let quote = after.trim_start().chars().next().filter(|mark| matches!(mark, '"' | '\''))?;
        let (value, after) = after.trim_start()[1..].split_once(quote)?;
        if value.contains(['"', '<', '&']) {
            return None;
        }
        found.push((name.trim(), value));
        rest = after.trim_start();
    }
    Some(found)
}

/// The simple pictures for elements without icon, 24 x 24 in the current colour.
pub(super) fn glyph(glyph: Glyph) -> &'static str {
    match glyph {
        Glyph::Actor => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\">",
            "<circle cx=\"12\" cy=\"12\" r=\"8\"/><path d=\"M10 8.500l6 3.500-6 3.500z\"/></svg>"
        ),
        Glyph::Computation => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\" ",
            "stroke-linecap=\"round\"><path d=\"M17 4.500c-3-1.500-4.500.500-5 4L10.500 18c-.500 ",
            "2.500-1.500 3.500-4 3\"/><path d=\"M8 11h7\"/></svg>"
        ),
        Glyph::SubPlan => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\" ",
            "stroke-linejoin=\"round\"><rect x=\"7\" y=\"3\" width=\"10\" height=\"6\" rx=\"1.5\"/>",
            "<rect x=\"2.5\" y=\"15\" width=\"8\" height=\"6\" rx=\"1.5\"/>",
            "<rect x=\"13.5\" y=\"15\" width=\"8\" height=\"6\" rx=\"1.5\"/>",
            "<path d=\"M12 9v3M6.500 15v-3h11v3\"/></svg>"
        ),
        Glyph::Supervisor => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\">",
            "<path d=\"M2 12c5-8 15-8 20 0-5 8-15 8-20 0z\"/><circle cx=\"12\" cy=\"12\" r=\"3\"/>",
            "</svg>"
        ),
        Glyph::Start => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"currentColor\" stroke=\"currentColor\" ",
            "stroke-width=\"2\" stroke-linejoin=\"round\"><path d=\"M6 4l14 8-14 8z\"/></svg>"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::{Glyph, embedded, glyph};

    #[test]
    fn icons_are_moved_and_scaled() {
        let svg = r#"<svg xmlns="x" viewBox="0 0 24 24" fill="none"><path d="M0 0h9"/></svg>"#;
        let group = embedded(svg, (10.0, 20.0), 12.0).unwrap();
        let expected = r#"<g transform="translate(10 20) scale(0.5)" fill="none">"#;
        assert_eq!(group, format!(r#"{expected}<path d="M0 0h9"/></g>"#));
    }

    #[test]
    fn built_in_icons_and_glyphs_can_be_embedded() {
        for (name, svg) in afp_toolboxes::ICONS {
            assert!(embedded(svg, (0.0, 0.0), 24.0).is_some(), "{name}");
        }
        let glyphs =
            [Glyph::Actor, Glyph::Computation, Glyph::SubPlan, Glyph::Supervisor, Glyph::Start];
        for each in glyphs {
            assert!(embedded(glyph(each), (0.0, 0.0), 24.0).is_some(), "{each:?}");
        }
    }

    #[test]
    fn icons_that_could_act_are_refused() {
        for content in [
            "<script>x</script>",
            "<path onclick=\"x\"/>",
            "<use href=\"http://x\"/>",
            "<path fill=\"url(http://x)\"/>",
            "<!-- a -->",
        ] {
            let svg = format!("<svg viewBox=\"0 0 1 1\">{content}</svg>");
            assert_eq!(embedded(&svg, (0.0, 0.0), 1.0), None, "{content}");
        }
        assert_eq!(embedded("<svg><path/></svg>", (0.0, 0.0), 1.0), None);
        assert_eq!(embedded("no picture", (0.0, 0.0), 1.0), None);
        assert_eq!(embedded("<svg viewBox=\"0 0 0 0\"></svg>", (0.0, 0.0), 1.0), None);
    }
}
