//! Writes the parts of a scene as SVG elements.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Write};

use super::super::Icons;
use super::super::sketch::{Anchor, Arrow, Frame, Label, Picture, Rect, Shape, Sketch, Tip};
use super::super::usage::Class;
use super::icon;
use crate::polyline::{Point, direction, distance, shortened};
use afp_dsl::outline::Part;
use afp_syntax::item::Item;

/// Radius of the corners of thick arrows.
const BEND: f64 = 7.0;

/// The relative shortening of a rounded corner, per radius.
const CUT: f64 = 0.376_775;

/// Length and half width of arrow tips, thick and thin.
const THICK_TIP: (f64, f64) = (10.0, 5.5);
const THIN_TIP: (f64, f64) = (7.0, 3.2);

/// The content of a group: a sketch with the ids of its icons. Groups with equal content are equal.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Content {
    frames: Vec<Frame>,
    labels: Vec<Label>,
    icons: Vec<IconUse>,
    arrows: Vec<Arrow>,
}

/// An icon at its place.
#[derive(Clone, Debug, PartialEq)]
struct IconUse {
    id: String,
    x: f64,
    y: f64,
    size: f64,
    class: Class,
}

/// An icon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its id in fragments.
    pub id: String,
    /// A `symbol` element.
    pub svg: String,
}

/// Paints parts and records their icons.
pub(in super::super) struct Painter<'a> {
    icons: Option<Icons<'a>>,
    /// The id of each requested icon; `None` for an unusable one.
    known: BTreeMap<(String, String), Option<String>>,
    symbols: Vec<Symbol>,
}

impl<'a> Painter<'a> {
    pub(in super::super) fn new(icons: Option<Icons<'a>>) -> Painter<'a> {
        Painter { icons, known: BTreeMap::new(), symbols: Vec::new() }
    }

    /// The used icons.
    pub(in super::super) fn symbols(self) -> Vec<Symbol> {
        self.symbols
    }

    /// The content of a group; records its icons.
    pub(in super::super) fn content(&mut self, sketch: Sketch) -> Content {
        let Sketch { frames, labels, pictures, arrows, .. } = sketch;
        let icons = pictures.iter().filter_map(|picture| self.icon_use(picture)).collect();
        Content { frames, labels, icons, arrows }
    }

    fn icon_use(&mut self, picture: &Picture) -> Option<IconUse> {
        let own = picture.icon.and_then(|(toolbox, name)| {
            let find = self.icons?;
            let key = (toolbox.name.clone(), name.to_owned());
            self.id(key, || find(toolbox, name))
        });
        let key = || (String::new(), format!("{:?}", picture.fallback).to_ascii_lowercase());
        let id =
            own.or_else(|| self.id(key(), || Some(icon::glyph(picture.fallback).to_owned())))?;
        let Picture { x, y, size, class, .. } = *picture;
        Some(IconUse { id, x, y, size, class })
    }

    /// The id of an icon, which is read on first use.
    fn id(
        &mut self,
        key: (String, String),
        read: impl FnOnce() -> Option<String>,
    ) -> Option<String> {
        if let Some(known) = self.known.get(&key) {
            return known.clone();
        }
        let symbol = read().and_then(|svg| {
            let id = symbol_id(&key, &svg);
            Some(Symbol { svg: icon::symbol(&svg, &id)?, id })
        });
        let id = symbol.as_ref().map(|symbol| symbol.id.clone());
        let fresh = symbol.filter(|new| self.symbols.iter().all(|known| known.id != new.id));
        self.symbols.extend(fresh);
        self.known.insert(key, id.clone());
        id
    }
}

/// An element with all its parts, as a group at its place.
pub(in super::super) fn element(item: &Item, content: &Content, at: Point) -> String {
    group(&format!("element\" data-item=\"{}", escaped(&item.to_string())), content, at)
}

/// A drawing as a group of a class, moved.
pub(in super::super) fn group(class: &str, content: &Content, (x, y): Point) -> String {
    let (x, y) = (number(x), number(y));
    let mut out = format!("<g class=\"{class}\" transform=\"translate({x} {y})\">\n");
    content.arrows.iter().for_each(|arrow| paint_arrow(&mut out, arrow));
    content.frames.iter().for_each(|frame| paint_frame(&mut out, frame));
    content.labels.iter().for_each(|label| paint_label(&mut out, label));
    content.icons.iter().for_each(|icon| paint_icon(&mut out, icon));
    out + "</g>\n"
}

/// An edge as a group.
pub(in super::super) fn edge(item: &Item, part: &Part, arrow: &Arrow) -> String {
    let exit = match part {
        Part::Exit { name, .. } => name.as_str(),
        _ => "start",
    };
    let (item, exit) = (escaped(&item.to_string()), escaped(exit));
    let mut out = format!("<g class=\"edge\" data-item=\"{item}\" data-exit=\"{exit}\">\n");
    paint_arrow(&mut out, arrow);
    out + "</g>\n"
}

/// An id that is only the same for the same icon, so that several pictures can share a page.
fn symbol_id((toolbox, name): &(String, String), svg: &str) -> String {
    // FNV-1a.
    let add = |hash: u32, byte: u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    let hash = svg.bytes().fold(0x811c_9dc5, add);
    let plain: String =
        format!("{toolbox}-{name}").chars().filter(|each| is_plain(*each)).collect();
    format!("afp-{}-{hash:08x}", plain.trim_start_matches('-'))
}

fn is_plain(character: char) -> bool {
    character.is_ascii_alphanumeric() || matches!(character, '-' | '_')
}

/// A coordinate with one decimal, without trailing zeros.
pub(super) fn number(value: f64) -> impl Display {
    Tenths::of(value)
}

/// Whether two places have the same text.
pub(in super::super) fn alike(one: Point, other: Point) -> bool {
    let written = |(x, y): Point| (Tenths::of(x), Tenths::of(y));
    written(one) == written(other)
}

/// A number in tenths. A drawing has thousands of them, and this writes whole numbers several times
/// as fast.
#[derive(PartialEq)]
struct Tenths(f64);

impl Tenths {
    fn of(value: f64) -> Tenths {
        Tenths((value * 10.0).round())
    }
}

impl Display for Tenths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tenths(tenths) = *self;
        if tenths.abs() > 1e15 || tenths.is_nan() {
            return write!(f, "{}", tenths / 10.0);
        }
        let sign = if tenths < 0.0 { "-" } else { "" };
        let tenths = tenths.abs() as u64;
        match (tenths / 10, tenths % 10) {
            (whole, 0) => write!(f, "{sign}{whole}"),
            (whole, tenth) => write!(f, "{sign}{whole}.{tenth}"),
        }
    }
}

pub(super) fn line(out: &mut String, text: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{text}");
}

fn paint_icon(out: &mut String, icon: &IconUse) {
    let IconUse { id, class, .. } = icon;
    let (x, y, size) = (number(icon.x), number(icon.y), number(icon.size));
    line(
        out,
        &format!(
            "<use class=\"icon {class}\" href=\"#{id}\" x=\"{x}\" y=\"{y}\" \
             width=\"{size}\" height=\"{size}\"/>"
        ),
    );
}

fn paint_frame(out: &mut String, frame: &Frame) {
    let title = if frame.title.is_empty() {
        String::new()
    } else {
        format!("<title>{}</title>", escaped(&frame.title))
    };
    let class = frame.class;
    let tail = |title: &str, name: &str| {
        if title.is_empty() { "/>".to_owned() } else { format!(">{title}</{name}>") }
    };
    match frame.shape {
        Shape::Round(radius) | Shape::Double(radius) => {
            let rect = rect_attributes(&frame.rect, radius);
            let dashes =
                if class.name.ends_with("handler") { " stroke-dasharray=\"6 3\"" } else { "" };
            let rect = format!("{rect}{dashes}");
            line(out, &format!("<rect class=\"box {class}\" {rect}{}", tail(&title, "rect")));
        }
        Shape::Leaning(radius) => {
            let path = leaning_path(&frame.rect, radius);
            let tail = tail(&title, "path");
            line(out, &format!("<path class=\"box {class}\" d=\"{path}\"{tail}"));
        }
        Shape::Cut(cut) => {
            let path = cut_path(&frame.rect, cut);
            let tail = tail(&title, "path");
            line(out, &format!("<path class=\"box {class}\" d=\"{path}\"{tail}"));
        }
    }
    if let Shape::Double(radius) = frame.shape {
        let Rect { x, y, width, height } = frame.rect;
        let inner = Rect { x: x + 4.0, y: y + 4.0, width: width - 8.0, height: height - 8.0 };
        let rect = rect_attributes(&inner, radius - 3.0);
        line(out, &format!("<rect class=\"inner {class}\" {rect}/>"));
    }
}

fn rect_attributes(rect: &Rect, radius: f64) -> String {
    format!(
        "x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"",
        number(rect.x),
        number(rect.y),
        number(rect.width),
        number(rect.height),
        number(radius)
    )
}

fn leaning_path(rect: &Rect, radius: f64) -> String {
    let (along, down, r) =
        (number(rect.width - radius), number(rect.height - 2.0 * radius), number(radius));
    let (x, y) = (number(rect.x), number(rect.y));
    format!("M{x} {y}h{along}q{r} 0 {r} {r}v{down}q0 {r} -{r} {r}h-{along}z")
}

fn cut_path(rect: &Rect, cut: f64) -> String {
    let (along, down, c) =
        (number(rect.width - 2.0 * cut), number(rect.height - 2.0 * cut), number(cut));
    let (x, y) = (number(rect.x + cut), number(rect.y));
    format!("M{x} {y}h{along}l{c} {c}v{down}l-{c} {c}h-{along}l-{c} -{c}v-{down}z")
}

fn paint_label(out: &mut String, label: &Label) {
    let anchor = match label.anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let bold = if label.bold { " bold" } else { "" };
    let (x, y, class) = (number(label.x), number(label.y), label.class);
    let (size, text) = (number(label.size), escaped(&label.text));
    line(
        out,
        &format!(
            "<text class=\"{class}{bold}\" x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{anchor}>{text}</text>"
        ),
    );
}

fn paint_arrow(out: &mut String, arrow: &Arrow) {
    let [.., before, end] = arrow.points[..] else { return };
    if arrow.tip == Tip::Ring {
        return paint_ring(out, arrow, before, end);
    }
    let (length, half) = match arrow.tip {
        Tip::Hook => (0.0, 0.0),
        _ if arrow.is_flow() => THICK_TIP,
        _ => THIN_TIP,
    };
    let (dx, dy) = direction(before, end);
    let neck = (end.0 - dx * length, end.1 - dy * length);
    let mut points = arrow.points.clone();
    if let Some(last) = points.last_mut() {
        // The line ends inside the tip, so that no seam is visible.
        *last = (neck.0 + dx, neck.1 + dy);
    }
    let path = bent_path(&points);
    let class = arrow.class;
    if arrow.is_flow() {
        // A gap in the line below makes a crossing readable.
        let crosses = match arrow.joined {
            0.0 => path.clone(),
            joined => bent_path(&shortened(&arrow.points, joined + BEND)),
        };
        line(out, &format!("<path class=\"halo\" d=\"{crosses}\"/>"));
    }
    let kind = if arrow.is_flow() { "flow" } else { "thin" };
    // Dashes are counted from the tip, so that the dashes of merged edges coincide.
    let dashes = match arrow.joined {
        0.0 => String::new(),
        _ => format!(" stroke-dashoffset=\"{}\"", number(-length_of(&points))),
    };
    line(out, &format!("<path class=\"{kind} {class}\"{dashes} d=\"{path}\"/>"));
    if arrow.tip == Tip::Hook {
        return;
    }
    let corner = |side: f64| {
        format!("{} {}", number(neck.0 - dy * half * side), number(neck.1 + dx * half * side))
    };
    let tip = format!("M{} {}L{}L{}z", number(end.0), number(end.1), corner(1.0), corner(-1.0));
    let kind = if arrow.tip == Tip::Hollow { "flow hollow" } else { "tip" };
    line(out, &format!("<path class=\"{kind} {class}\" d=\"{tip}\"/>"));
}

/// A circle whose diameter is the line between two points.
fn paint_ring(out: &mut String, arrow: &Arrow, from: Point, to: Point) {
    let radius = distance(from, to) / 2.0;
    let (left, y) = (number((from.0 + to.0) / 2.0 - radius), number((from.1 + to.1) / 2.0));
    let (r, across, class) = (number(radius), number(2.0 * radius), arrow.class);
    let half = |sign: &str| format!("a{r} {r} 0 1 0 {sign}{across} 0");
    let ring = format!("M{left} {y}{}{}z", half(""), half("-"));
    line(out, &format!("<path class=\"flow hollow {class}\" d=\"{ring}\"/>"));
}

/// A polyline with rounded corners.
fn bent_path(points: &[(f64, f64)]) -> String {
    let text = |(x, y): (f64, f64)| format!("{} {}", number(x), number(y));
    let Some(first) = points.first() else { return String::new() };
    let mut path = format!("M{}", text(*first));
    for corner in points.windows(3) {
        let [before, at, after] = corner else { continue };
        let radius = radius(*before, *at, *after);
        let (into, out) = (direction(*before, *at), direction(*at, *after));
        let from = (at.0 - into.0 * radius, at.1 - into.1 * radius);
        let to = (at.0 + out.0 * radius, at.1 + out.1 * radius);
        let _ = write!(path, "L{}Q{} {}", text(from), text(*at), text(to));
    }
    if let [_, .., last] = points {
        let _ = write!(path, "L{}", text(*last));
    }
    path
}

/// The length of a polyline with rounded corners.
fn length_of(points: &[(f64, f64)]) -> f64 {
    let straight: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    let cut = points.windows(3).map(|corner| radius(corner[0], corner[1], corner[2]) * CUT);
    straight - cut.sum::<f64>()
}

/// The radius of a polyline's corner.
fn radius(before: (f64, f64), at: (f64, f64), after: (f64, f64)) -> f64 {
    BEND.min(distance(before, at) / 2.0).min(distance(at, after) / 2.0)
}

/// Escaped text for XML content and attributes; control characters that XML forbids are left out.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\n' | '\t' => out.push(character),
            control if control.is_control() || matches!(control, '\u{fffe}' | '\u{ffff}') => {}
            plain => out.push(plain),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{bent_path, escaped, number};

    #[test]
    fn texts_are_escaped() {
        assert_eq!(escaped("a<b & \"c\"\u{1}"), "a&lt;b &amp; &quot;c&quot;");
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            [1.0, 1.04, -0.04, 2.55, -12.06, 1e300].map(|value| number(value).to_string()),
            ["1", "1", "0", "2.6", "-12.1", &1e300.to_string()]
        );
    }

    #[test]
    fn corners_are_rounded_within_the_space() {
        let path = bent_path(&[(0.0, 0.0), (0.0, 20.0), (4.0, 20.0)]);
        assert_eq!(path, "M0 0L0 18Q0 20 2 20L4 20");
    }
}
