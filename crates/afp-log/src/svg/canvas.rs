//! Draws in metres, y up; writes SVG in pixels, y down.

use std::fmt::Write;

use afp_core::Instant;
use afp_session::Pose2;

use super::placed;
use super::symbol::symbol;

pub(super) const MARGIN: f64 = 28.0;
/// The width of the room, in pixels, unless it is very tall.
const ROOM_WIDTH: f64 = 860.0;
const ROOM_HEIGHT: f64 = 860.0;

/// The maximum number of floor lines in a direction.
const MOST_LINES: f64 = 200.0;

/// The radius of an echo's dot, pixels.
pub(super) const ECHO: f64 = 2.2;

/// From metres to pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    low: [f64; 2],
    high: [f64; 2],
    scale: f64,
}

impl View {
    pub(super) fn around([low, high]: [[f64; 2]; 2]) -> Self {
        let (width, height) = ((high[0] - low[0]).max(0.1), (high[1] - low[1]).max(0.1));
        View { low, high, scale: (ROOM_WIDTH / width).min(ROOM_HEIGHT / height) }
    }

    fn point(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        (MARGIN + (x - self.low[0]) * self.scale, MARGIN + (self.high[1] - y) * self.scale)
    }

    /// The distance between two lines of the floor: a metre, or a power of ten of metres if there
    /// would be too many lines.
    fn step(&self) -> f64 {
        let side = (self.high[0] - self.low[0]).max(self.high[1] - self.low[1]);
        libm::pow(10.0, libm::ceil(libm::log10(side / MOST_LINES)).max(0.0))
    }

    pub(super) fn end(&self) -> (f64, f64) {
        self.point([self.high[0], self.low[1]])
    }
}

pub(super) struct Canvas {
    view: View,
    body: String,
}

impl Canvas {
    pub(super) fn new(view: View) -> Self {
        Canvas { view, body: String::new() }
    }

    /// The floor, with a line about every metre.
    pub(super) fn floor(&mut self) {
        let (View { low, high, .. }, step) = (self.view, self.view.step());
        let ((x, y), (right, below)) = (self.view.point([low[0], high[1]]), self.view.end());
        let (width, height) = (right - x, below - y);
        self.put(format_args!(
            r##"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" fill="#ffffff"/>"##
        ));
        for metre in multiples(step, low[0], high[0]) {
            let (at, _) = self.view.point([metre, 0.0]);
            self.put(format_args!(
                r##"<line class="grid" x1="{at:.1}" y1="{y:.1}" x2="{at:.1}" y2="{below:.1}"/>"##
            ));
        }
        for metre in multiples(step, low[1], high[1]) {
            let (_, at) = self.view.point([0.0, metre]);
            self.put(format_args!(
                r##"<line class="grid" x1="{x:.1}" y1="{at:.1}" x2="{right:.1}" y2="{at:.1}"/>"##
            ));
        }
    }

    pub(super) fn patch(&mut self, corners: &[[f64; 2]], [red, green, blue]: [u8; 3]) {
        let points = self.points(corners);
        self.put(format_args!(
            r#"<polygon class="patch" fill="rgb({red},{green},{blue})" points="{points}"/>"#
        ));
    }

    pub(super) fn way(&mut self, places: &[[f64; 2]]) {
        let points = self.points(places);
        self.put(format_args!(r#"<polyline class="way" points="{points}"/>"#));
    }

    pub(super) fn light(&mut self, at: [f64; 2]) {
        let (x, y) = self.view.point(at);
        self.put(format_args!(
            r#"<g class="light"><circle cx="{x:.1}" cy="{y:.1}" r="4"/><circle cx="{x:.1}" cy="{y:.1}" r="9"/></g>"#
        ));
    }

    /// An obstacle, or the start of an obstacle that has moved.
    pub(super) fn obstacle(&mut self, corners: &[[f64; 2]], low: bool, began: bool) {
        let points = self.points(corners);
        let (class, began) = (if low { "low" } else { "high" }, if began { " began" } else { "" });
        self.put(format_args!(r#"<polygon class="{class}{began}" points="{points}"/>"#));
    }

    /// A name in the middle of an obstacle; left out if it would stick out far.
    pub(super) fn label(&mut self, middle: [f64; 2], width: f64, name: &str) {
        let (x, y) = self.view.point(middle);
        let needed = name.chars().count() as f64 * 6.5;
        let room = width * self.view.scale;
        // A narrow obstacle has its name next to it.
        let (x, anchor) =
            if needed <= room { (x, "middle") } else { (x + room / 2.0 + 6.0, "start") };
        let anchor = if x + needed > self.view.end().0 { "end" } else { anchor };
        let x = if anchor == "end" { x - room - 12.0 } else { x };
        let name = escape(name);
        self.put(format_args!(
            r#"<text class="label" x="{x:.1}" y="{:.1}" text-anchor="{anchor}">{name}</text>"#,
            y + 4.0
        ));
    }

    /// The robot's outline with an arrow ahead; faint at the start.
    pub(super) fn robot(&mut self, body: &[[f64; 2]], pose: Pose2, end: bool) {
        let outline = self.points(&placed(body, pose).collect::<Vec<_>>());
        let (sin, cos) = libm::sincos(pose.heading);
        let beside = |ahead: f64, left: f64| {
            [pose.x + ahead * cos - left * sin, pose.y + ahead * sin + left * cos]
        };
        let arrow = self.points(&[beside(0.15, 0.0), beside(0.02, 0.07), beside(0.02, -0.07)]);
        let class = if end { "robot" } else { "robot start" };
        self.put(format_args!(r#"<g class="{class}"><polygon points="{outline}"/>"#));
        self.put(format_args!(r#"<polygon class="arrow" points="{arrow}"/></g>"#));
    }

    pub(super) fn path(&mut self, points: &[[f64; 2]], color: &str) {
        let points = self.points(points);
        self.put(format_args!(r#"<polyline class="path" stroke="{color}" points="{points}"/>"#));
    }

    /// The floor under the moving body.
    pub(super) fn footprint(&mut self, body: &[[f64; 2]], points: &[[f64; 2]]) {
        let side = body.iter().map(|[_, y]| y.abs()).fold(0.0, f64::max);
        let (points, width) = (self.points(points), 2.0 * side * self.view.scale);
        self.put(format_args!(
            r#"<polyline class="footprint" stroke-width="{width:.1}" points="{points}"/>"#
        ));
    }

    /// An actor that acts on the spot: the `number`-th dot next to a point.
    pub(super) fn dot(&mut self, at: [f64; 2], number: usize, color: &str) {
        let (x, y) = self.view.point(at);
        let x = x + 3.0 + 11.0 * number as f64;
        self.put(format_args!(
            r#"<circle class="dot" cx="{x:.1}" cy="{y:.1}" r="4" fill="{color}"/>"#
        ));
    }

    /// A symbol at the place of an event; its title has the time.
    pub(super) fn mark(&mut self, pose: Pose2, kind: usize, size: f64, at: Instant) {
        let (x, y) = self.view.point([pose.x, pose.y]);
        let symbol = symbol(kind, x, y, size);
        let secs = at.as_secs_f64();
        self.put(format_args!("<g class=\"mark\"><title>{secs:.3} s</title>{symbol}</g>"));
    }

    /// Draws contents that must not run into the legend.
    pub(super) fn clipped(&mut self, draw: impl FnOnce(&mut Self)) {
        let (right, below) = self.view.end();
        let (width, height) = (right + MARGIN / 2.0, below + MARGIN / 2.0);
        self.put(format_args!(
            r#"<clipPath id="room"><rect width="{width:.1}" height="{height:.1}"/></clipPath>"#
        ));
        self.put(format_args!(r#"<g clip-path="url(#room)">"#));
        draw(self);
        self.put(format_args!("</g>"));
    }

    pub(super) fn line(&mut self, class: &str, points: &[[f64; 2]]) {
        let points = self.points(points);
        self.put(format_args!(r#"<polyline class="line {class}" points="{points}"/>"#));
    }

    /// The apparent place of an echo.
    pub(super) fn echo(&mut self, class: &str, at: [f64; 2]) {
        let (x, y) = self.view.point(at);
        self.put(format_args!(
            r#"<circle class="echo {class}" cx="{x:.1}" cy="{y:.1}" r="{ECHO}"/>"#
        ));
    }

    /// The arc of an echo's possible places: its ends, left first, and the range.
    pub(super) fn arc(&mut self, [left, right]: [[f64; 2]; 2], range: f64) {
        let ((x, y), (to_x, to_y)) = (self.view.point(left), self.view.point(right));
        let radius = range * self.view.scale;
        self.put(format_args!(
            r#"<path class="arc" d="M{x:.1} {y:.1}A{radius:.1} {radius:.1} 0 0 1 {to_x:.1} {to_y:.1}"/>"#
        ));
    }

    /// The distance between two lines, below the room.
    pub(super) fn scale_bar(&mut self) {
        let (_, below) = self.view.end();
        let (x, y) = (MARGIN, below + 20.0);
        let step = self.view.step();
        let end = x + self.view.scale * step;
        let (up, down) = (y - 5.0, y + 5.0);
        self.put(format_args!(
            r#"<path class="scale" d="M{x:.1} {up:.1}V{down:.1}M{x:.1} {y:.1}H{end:.1}M{end:.1} {up:.1}V{down:.1}"/>"#
        ));
        self.put(format_args!(
            r#"<text class="quiet" x="{:.1}" y="{:.1}">{step} m</text>"#,
            end + 8.0,
            y + 4.0
        ));
    }

    /// The picture with the legend next to it: its elements, its right end and its lower end.
    pub(super) fn finish(self, (legend, right, lowest): (String, f64, f64)) -> String {
        let (_, below) = self.view.end();
        let (width, height) = (right + MARGIN, (below + 40.0).max(lowest + MARGIN));
        let body = self.body;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\">\n{STYLE}\
             <rect width=\"100%\" height=\"100%\" fill=\"#f6f5f2\"/>\n{body}{legend}</svg>\n"
        )
    }

    fn points(&self, corners: &[[f64; 2]]) -> String {
        let mut text = String::new();
        for corner in corners {
            let (x, y) = self.view.point(*corner);
            let _ = write!(text, "{x:.1},{y:.1} ");
        }
        text.truncate(text.trim_end().len());
        text
    }

    fn put(&mut self, element: std::fmt::Arguments<'_>) {
        let _ = writeln!(self.body, "{element}");
    }
}

/// The multiples of `step` in a range, limited to the number of floor lines.
fn multiples(step: f64, from: f64, to: f64) -> impl Iterator<Item = f64> {
    let first = libm::ceil(from / step);
    let all = (0..=MOST_LINES as u32).map(move |count| (first + f64::from(count)) * step);
    all.take_while(move |at| *at <= to)
}

pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

const STYLE: &str = r##"<style>
text { font: 13px system-ui, "Helvetica Neue", Arial, sans-serif; fill: #2b2b2b }
.title { font-size: 17px; font-weight: 600 }
.section { font-size: 11px; font-weight: 600; letter-spacing: .06em; fill: #77736b }
.quiet { fill: #77736b }
.label { font-size: 11.5px; fill: #77736b; paint-order: stroke; stroke: #ffffff; stroke-width: 2.5px; stroke-linejoin: round }
.grid { stroke: #ecebe7; stroke-width: 1 }
.high { fill: #ddd8cf; stroke: #9b948a; stroke-width: 1 }
.low { fill: url(#hatch); stroke: #b4642d; stroke-width: 1.2; stroke-dasharray: 4 2.5 }
.began { fill: #ddd8cf; fill-opacity: .25; stroke-dasharray: 4 3; stroke-opacity: .8 }
.patch { opacity: .35 }
.way { fill: none; stroke: #77736b; stroke-width: 1.6; stroke-dasharray: 2 4; stroke-linecap: round }
.light circle { fill: none; stroke: #c2185b; stroke-width: 1.6 }
.path { fill: none; stroke-width: 3.2; stroke-linecap: round; stroke-linejoin: round; opacity: .92 }
.footprint { fill: none; stroke: #2b2b2b; stroke-linecap: butt; stroke-linejoin: round; opacity: .045 }
.dot { stroke: #ffffff; stroke-width: 1.2 }
.robot polygon { fill: #2b2b2b; fill-opacity: .12; stroke: #2b2b2b; stroke-width: 1.4 }
.robot .arrow { fill-opacity: .75; stroke: none }
.start polygon { stroke-dasharray: 4 3; stroke: #77736b; fill-opacity: .04 }
.start .arrow { fill-opacity: .35 }
.mark { fill: #ffffff; stroke: #2b2b2b; stroke-width: 1.6; stroke-linejoin: round }
.line { fill: none; stroke-width: 1.4; stroke: #2b2b2b; opacity: .55 }
.line.believed { stroke: #d55e00; stroke-dasharray: 5 4; opacity: .8 }
.echo { fill: #0072b2 }
.echo.believed { fill: none; stroke: #d55e00; stroke-width: 1; opacity: .55 }
.arc { fill: none; stroke: #0072b2; stroke-width: 1.1; opacity: .13 }
.scale { fill: none; stroke: #55524c; stroke-width: 1.6 }
</style>
<defs><pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
<rect width="6" height="6" fill="#fbeee4"/><line x1="0" y1="0" x2="0" y2="6" stroke="#d98b52" stroke-width="2"/>
</pattern></defs>
"##;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_floor_of_any_size_has_a_fitting_number_of_lines() {
        for (side, lines, step) in [
            (8.5, 9, 1.0),
            (99.0, 100, 1.0),
            (150.0, 16, 10.0),
            (1000.0, 101, 10.0),
            (1e9, 101, 1e7),
            (f64::MAX, 180, 1e306),
            (f64::INFINITY, 0, f64::INFINITY),
        ] {
            let view = View::around([[-0.0, -side], [side, side.min(1e9)]]);
            let mut canvas = Canvas::new(view);
            canvas.floor();
            let upright = multiples(view.step(), 0.0, side).count();
            assert_eq!((upright, view.step()), (lines, step), "{side}");
            assert!(canvas.body.lines().count() < 500, "{side}");
        }
    }
}
