//! Icons in drawings.
//!
//! A toolbox's icon is an untrusted file. It is parsed, and the elements and attributes on the
//! lists below are written again: plain shapes with plain attributes. An icon with anything else is
//! rejected, so that a drawing never runs scripts or loads files.

use super::super::sketch::Glyph;
use afp_dsl::outline::ComponentKind;
use roxmltree::{Attribute, Document, Node};

const ELEMENTS: &[&str] =
    &["g", "path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// Attributes with numbers, path letters and separators as values.
const GEOMETRY: &[&str] = &[
    "d",
    "points",
    "x",
    "y",
    "x1",
    "x2",
    "y1",
    "y2",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "width",
    "height",
    "stroke-width",
    "stroke-dasharray",
    "stroke-dashoffset",
    "stroke-miterlimit",
    "opacity",
    "fill-opacity",
    "stroke-opacity",
];

/// Attributes with a word or a colour as their value.
const WORDS: &[&str] =
    &["fill", "stroke", "fill-rule", "clip-rule", "stroke-linecap", "stroke-linejoin", "color"];

/// The attribute that may have parentheses.
const TRANSFORM: &str = "transform";

/// Attributes of the icon's root that are left out, because they have no meaning in a symbol.
const FRAME: &[&str] = &["width", "height", "x", "y", "id", "class", "version", "role"];

/// The maximum size of an icon, in bytes.
const LONGEST: usize = 64 * 1024;
const DEEPEST: usize = 16;

/// The icon as a `symbol` element with an id; `None` if it has more than plain shapes.
pub(super) fn symbol(svg: &str, id: &str) -> Option<String> {
    let svg = svg.trim();
    // The root comes first, because only shapes are in it.
    if svg.len() > LONGEST || svg.starts_with("<?") {
        return None;
    }
    let document = Document::parse(svg).ok()?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" || document.root().children().count() > 1 {
        return None;
    }
    let view_box = root.attribute("viewBox").filter(|it| is_view_box(it))?;
    let frame = |name: &str| name == "viewBox" || FRAME.contains(&name);
    let own = root.attributes().filter(|it| !frame(it.name()));
    let own = own.map(attribute).collect::<Option<String>>()?;
    let content = content(root, 0).filter(|content| !content.is_empty())?;
    let open = format!("<symbol id=\"{id}\" viewBox=\"{view_box}\">");
    Some(format!("{open}<g{own}>{content}</g></symbol>"))
}

/// The content of an element, written again.
fn content(of: Node, depth: usize) -> Option<String> {
    let is_blank =
        |node: &Node| node.is_text() && node.text().is_some_and(|it| it.trim().is_empty());
    let shape = |node: Node| {
        // Comments, instructions and text have no name.
        let name = node.tag_name().name();
        if !ELEMENTS.contains(&name) || depth == DEEPEST {
            return None;
        }
        let attributes = node.attributes().map(attribute).collect::<Option<String>>()?;
        let inner = content(node, depth + 1)?;
        Some(match &*inner {
            "" => format!("<{name}{attributes}/>"),
            _ => format!("<{name}{attributes}>{inner}</{name}>"),
        })
    };
    of.children().filter(|node| !is_blank(node)).map(shape).collect()
}

/// A listed attribute with a plain value, written again.
fn attribute(attribute: Attribute) -> Option<String> {
    let (name, value) = (attribute.name(), attribute.value());
    let plain =
        |more: &str| value.chars().all(|each| each.is_ascii_alphanumeric() || more.contains(each));
    let fits = match name {
        name if GEOMETRY.contains(&name) => plain(" .,-+%"),
        name if WORDS.contains(&name) => plain("#-"),
        TRANSFORM => plain(" .,-+()"),
        _ => false,
    };
    fits.then(|| format!(" {name}=\"{value}\""))
}

fn is_view_box(text: &str) -> bool {
    let numbers: Option<Vec<f64>> =
        text.split_ascii_whitespace().map(|word| word.parse().ok()).collect();
    let plain = text.chars().all(|each| each.is_ascii_digit() || " .-".contains(each));
    plain
        && matches!(numbers.as_deref(), Some([_, _, width, height]) if *width > 0.0 && *height > 0.0)
}

/// The default icon of a kind, as a whole `svg`.
pub fn default_icon(kind: ComponentKind) -> &'static str {
    glyph(Glyph::of(kind))
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
        // An octagon, a triangle and a disc: the shape has the meaning of the colour.
        Glyph::Error => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"currentColor\">",
            "<path fill-rule=\"evenodd\" d=\"M7 1h10l6 6v10l-6 6H7l-6-6V7zM10.500 ",
            "5v8.500h3V5zM10.500 16v3h3v-3z\"/></svg>"
        ),
        Glyph::Warning => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"currentColor\">",
            "<path fill-rule=\"evenodd\" d=\"M12 1l11.500 21H.500zM10.500 8v7h3V8zM10.500 ",
            "17v2.500h3V17z\"/></svg>"
        ),
        Glyph::Note => concat!(
            "<svg viewBox=\"0 0 24 24\" fill=\"currentColor\">",
            "<path fill-rule=\"evenodd\" d=\"M12 1a11 11 0 100 22a11 11 0 000-22zM10.500 ",
            "10v8.500h3V10zM10.500 5v3h3V5z\"/></svg>"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::{Glyph, glyph, symbol};

    fn within(content: &str) -> Option<String> {
        symbol(&format!("<svg viewBox=\"0 0 24 24\">{content}</svg>"), "i")
    }

    #[test]
    fn shapes_are_written_again() {
        let svg = "<svg xmlns=\"x\" viewBox=\"0 0 24 24\" fill='none'>\n  <path\td = \"M0 0h9\" />\
                   <g transform=\"rotate(5)\"><circle r=\"2\"/></g></svg>\n";
        let expected = "<symbol id=\"i\" viewBox=\"0 0 24 24\"><g fill=\"none\"><path d=\"M0 0h9\"/>\
                        <g transform=\"rotate(5)\"><circle r=\"2\"/></g></g></symbol>";
        assert_eq!(symbol(svg, "i").as_deref(), Some(expected));
    }

    #[test]
    fn built_in_icons_and_glyphs_are_valid() {
        for (name, svg) in afp_toolboxes::ICONS {
            assert!(symbol(svg, "i").is_some(), "{name}");
        }
        for each in [
            Glyph::Actor,
            Glyph::Computation,
            Glyph::SubPlan,
            Glyph::Supervisor,
            Glyph::Start,
            Glyph::Error,
            Glyph::Warning,
            Glyph::Note,
        ] {
            assert!(symbol(glyph(each), "i").is_some(), "{each:?}");
        }
    }

    #[test]
    fn icons_with_other_elements_are_refused() {
        for content in [
            "<script>x</script>",
            "<SCRIPT/>",
            "<animate/onbegin=alert(1)>",
            "<animate attributeName=\"x\" onbegin=\"alert(1)\"/>",
            "<set/>",
            "<path onclick=\"x\"/>",
            "<path/onclick=\"x\"/>",
            "<path ONCLICK=\"x\"/>",
            "<path d=\"M0 0\" style=\"fill:red\"/>",
            "<use href=\"http://x\"/>",
            "<use xlink:href=\"#x\"/>",
            "<a href=\"javascript:x\"><path/></a>",
            "<image href=\"x\"/>",
            "<foreignObject><p/></foreignObject>",
            "<path fill=\"url(http://x)\"/>",
            "<path fill=\"u&#114;l(x)\"/>",
            "<path fill=\"red;x\"/>",
            "<path transform=\"url(#x)&\"/>",
            "<path id=\"x\"/>",
            "<path class=\"x\"/>",
            "<path d=\"M0 0\" d=\"M1 1\"/>",
            "<path d=M0/>",
            "<path d/>",
            "<path d=\"",
            "<style>*{}</style>",
            "<!-- a -->",
            "<![CDATA[a]]>",
            "<?php x?>",
            "<!DOCTYPE x>",
            "&lt;",
            "text",
            "<g>",
            "</g>",
            "<g></path>",
            "</svg><script/>",
            "<svg viewBox=\"0 0 1 1\"></svg>",
        ] {
            assert_eq!(within(content), None, "{content}");
        }
        for svg in [
            "<svg><path/></svg>",
            "<svg viewBox=\"0 0 0 0\"></svg>",
            "<svg viewBox=\"0 0 1 1 1\"></svg>",
            "<svg viewBox=\"0 0 1 NaN\"></svg>",
            "<svg viewBox=\"0 0 1 1\" onload=\"x\"></svg>",
            "<svg viewBox=\"0 0 1 1\"/>",
            "<svg viewBox=\"0 0 1 1\">",
            "<?xml version=\"1.0\"?><svg viewBox=\"0 0 1 1\"></svg>",
            "no picture",
            "",
        ] {
            assert_eq!(symbol(svg, "i"), None, "{svg}");
        }
        assert_eq!(within(&"<g>".repeat(1000)), None);
        assert_eq!(within(&"<path/>".repeat(20_000)), None);
    }
}
