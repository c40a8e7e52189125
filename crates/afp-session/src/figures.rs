//! What a run came to, by names.

use afp_core::Instant;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Something that a run came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its name: `contacts`, `wall_error`.
    pub name: &'static str,
    /// What it is.
    pub value: FigureValue,
    /// The same in words; empty where there is nothing to say.
    pub text: String,
}

/// The value of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum FigureValue {
    /// A count.
    Count(u64),
    /// Numbers, each with a name that ends in its unit: `mean_m`.
    Numbers(Vec<(&'static str, f64)>),
    /// Stretches of time.
    Spans {
        /// What their names stand for: `obstacle`.
        of: &'static str,
        /// In the order of their beginnings.
        spans: Vec<Span>,
    },
}

/// A stretch of time in which something was so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// What.
    pub name: String,
    /// Since when.
    pub begin: Instant,
    /// When it was so for the last time.
    pub end: Instant,
}

/// What a run came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures(pub Vec<Figure>);

impl Figures {
    /// The figure of that name.
    pub fn get(&self, name: &str) -> Option<&Figure> {
        self.0.iter().find(|figure| figure.name == name)
    }

    /// The stretches of time of that name; none where there is no such figure.
    pub fn spans(&self, name: &str) -> &[Span] {
        match self.get(name).map(|figure| &figure.value) {
            Some(FigureValue::Spans { spans, .. }) => spans,
            _ => &[],
        }
    }

    /// A number of a figure: `wall_error`, `mean_m`.
    pub fn number(&self, name: &str, part: &str) -> Option<f64> {
        match &self.get(name)?.value {
            FigureValue::Numbers(all) => {
                all.iter().find(|(known, _)| *known == part).map(|it| it.1)
            }
            FigureValue::Count(_) | FigureValue::Spans { .. } => None,
        }
    }
}

impl Serialize for FigureValue {
    /// A count, numbers by their names, stretches of time in a list.
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            FigureValue::Count(count) => count.serialize(to),
            FigureValue::Numbers(all) => to.collect_map(all.iter().copied()),
            FigureValue::Spans { of, spans } => {
                to.collect_seq(spans.iter().map(|span| SpanRow { of, span }))
            }
        }
    }
}

impl Serialize for Figures {
    /// By their names.
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|figure| (figure.name, &figure.value)))
    }
}

struct SpanRow<'a> {
    of: &'a str,
    span: &'a Span,
}

impl Serialize for SpanRow<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(Some(3))?;
        map.serialize_entry(self.of, &self.span.name)?;
        map.serialize_entry("begin_s", &self.span.begin.as_secs_f64())?;
        map.serialize_entry("end_s", &self.span.end.as_secs_f64())?;
        map.end()
    }
}
