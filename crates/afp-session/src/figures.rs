//! The results of a run, by name.

use afp_core::Instant;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// A result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its name: `contacts`, `wall_error`.
    pub name: &'static str,
    /// Its value.
    pub value: FigureValue,
    /// The value as text; empty if there is nothing to report.
    pub text: String,
}

/// The value of a result.
#[derive(Clone, Debug, PartialEq)]
pub enum FigureValue {
    /// A count.
    Count(u64),
    /// Numbers, each with a name that ends in its unit: `mean_m`.
    Numbers(Vec<(&'static str, f64)>),
    /// Periods of time.
    Spans {
        /// The kind of their names: `obstacle`.
        of: &'static str,
        /// The periods, ordered by their begin.
        spans: Vec<Span>,
    },
}

/// A period in which a condition held.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The name of the condition.
    pub name: String,
    /// Its begin.
    pub begin: Instant,
    /// The last instant at which the condition held.
    pub end: Instant,
}

/// The results of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures(pub Vec<Figure>);

impl Figures {
    /// The result of that name.
    pub fn get(&self, name: &str) -> Option<&Figure> {
        self.0.iter().find(|figure| figure.name == name)
    }

    /// The periods of a result; empty without such a result.
    pub fn spans(&self, name: &str) -> &[Span] {
        match self.get(name).map(|figure| &figure.value) {
            Some(FigureValue::Spans { spans, .. }) => spans,
            _ => &[],
        }
    }

    /// A number of a result: `wall_error`, `mean_m`.
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
    /// A count, an object of numbers, or a list of periods.
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
    /// An object with the results by name.
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
