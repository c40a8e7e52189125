//! The legend of colours and symbols, and the run's results, next to the room.

use std::fmt::Write;

use super::canvas::{ECHO, MARGIN, View, escape};
use super::symbol::symbol;

const LINE: f64 = 21.0;
/// The width of an average letter, in pixels.
const LETTER: f64 = 7.2;
/// The width of symbols before their text, in pixels.
const INDENT: f64 = 30.0;

pub(super) struct Legend {
    x: f64,
    y: f64,
    width: f64,
    body: String,
}

impl Legend {
    pub(super) fn new(view: View) -> Self {
        Legend { x: view.end().0 + 28.0, y: MARGIN + 14.0, width: 220.0, body: String::new() }
    }

    pub(super) fn head(&mut self, title: &str, subtitle: &str) {
        self.text("title", 0.0, title);
        self.text("quiet", 0.0, subtitle);
    }

    pub(super) fn actors<'a>(&mut self, actors: impl Iterator<Item = (&'a str, &'a str)>) {
        self.section("ACTIVE");
        for (path, color) in actors {
            let (x, y) = (self.x, self.y - 4.5);
            let end = x + INDENT - 9.0;
            self.put(format_args!(
                r#"<line class="path" x1="{x:.1}" y1="{y:.1}" x2="{end:.1}" y2="{y:.1}" stroke="{color}"/>"#
            ));
            self.text("name", INDENT, path);
        }
    }

    pub(super) fn events(&mut self, events: impl Iterator<Item = (usize, String, usize)>) {
        for (number, (kind, name, count)) in events.enumerate() {
            if number == 0 {
                self.section("EVENTS");
            }
            let symbol = symbol(kind, self.x + 10.0, self.y - 4.5, 1.0);
            self.put(format_args!(r#"<g class="mark">{symbol}</g>"#));
            let times = if count > 1 { format!("  ×{count}") } else { String::new() };
            self.text("name", INDENT, &format!("{name}{times}"));
        }
    }

    /// The symbols of a map of echoes.
    pub(super) fn sonar(&mut self) {
        self.section("RANGE SENSOR");
        let circle = |class: &str, x: f64, y: f64| {
            format!(r#"<circle class="echo {class}" cx="{x:.1}" cy="{y:.1}" r="{ECHO}"/>"#)
        };
        let line = |class: &str, x: f64, y: f64| {
            let (from, to) = (x - 10.0, x + 11.0);
            format!(r#"<polyline class="line {class}" points="{from:.1},{y:.1} {to:.1},{y:.1}"/>"#)
        };
        let arc = |x: f64, y: f64| {
            let (from, to, y) = (x - 10.0, x + 10.0, y + 3.0);
            format!(
                r#"<path class="arc" style="opacity:.5" d="M{from:.1} {y:.1}A18 18 0 0 1 {to:.1} {y:.1}"/>"#
            )
        };
        let (x, y) = (self.x + 10.0, |legend: &Self| legend.y - 4.5);
        let symbol = circle("true", x, y(self));
        self.entry(&symbol, "echo, from the robot's position");
        let symbol = arc(x, y(self));
        self.entry(&symbol, "the cone of its possible sources");
        let symbol = circle("believed", x, y(self));
        self.entry(&symbol, "the same, by odometry");
        let symbol = line("true", x, y(self));
        self.entry(&symbol, "way");
        let symbol = line("believed", x, y(self));
        self.entry(&symbol, "path by odometry");
    }

    fn entry(&mut self, symbol: &str, text: &str) {
        self.put(format_args!("{symbol}"));
        self.text("name", INDENT, text);
    }

    pub(super) fn figures(&mut self, figures: &[(String, String)]) {
        self.section("RUN");
        let longest = figures.iter().map(|(key, _)| key.chars().count()).max().unwrap_or(0);
        let column = (longest as f64 * LETTER + 12.0).max(110.0);
        for (key, value) in figures {
            self.text("quiet", 0.0, key);
            self.y -= LINE;
            self.text("name", column, value);
        }
    }

    pub(super) fn finish(self) -> (String, f64, f64) {
        (self.body, self.x + self.width, self.y)
    }

    fn section(&mut self, title: &str) {
        self.y += 12.0;
        self.text("section", 0.0, title);
    }

    fn text(&mut self, class: &str, indent: f64, text: &str) {
        let (x, y) = (self.x + indent, self.y);
        self.width = self.width.max(indent + text.chars().count() as f64 * LETTER);
        let text = escape(text);
        self.put(format_args!(r#"<text class="{class}" x="{x:.1}" y="{y:.1}">{text}</text>"#));
        self.y += LINE;
    }

    fn put(&mut self, element: std::fmt::Arguments<'_>) {
        let _ = writeln!(self.body, "{element}");
    }
}
