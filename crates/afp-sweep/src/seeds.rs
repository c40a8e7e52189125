//! The seeds of a sweep.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;

/// The seeds of a sweep, all different.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seeds(Kind);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Kind {
    /// Consecutive seeds.
    Range(Range<u64>),
    /// Other seeds, in order.
    List(Vec<u64>),
}

impl Seeds {
    /// Seeds of a range without its end.
    pub fn new(range: Range<u64>) -> Self {
        Seeds(Kind::Range(range))
    }

    /// Seeds in that order; consecutive seeds equal their range.
    ///
    /// # Errors
    /// A repeated seed, which would repeat its run.
    pub fn list(seeds: Vec<u64>) -> Result<Self, String> {
        let mut known = BTreeSet::new();
        if let Some(twice) = seeds.iter().find(|seed| !known.insert(**seed)) {
            return Err(format!("the seed {twice} is given twice"));
        }
        let follow =
            seeds.windows(2).all(|pair| matches!(pair, [a, b] if a.checked_add(1) == Some(*b)));
        Ok(match (seeds.first(), seeds.last().and_then(|last| last.checked_add(1))) {
            (Some(first), Some(end)) if follow => Seeds::new(*first..end),
            _ => Seeds(Kind::List(seeds)),
        })
    }

    pub fn len(&self) -> u64 {
        match &self.0 {
            Kind::Range(range) => range.end.saturating_sub(range.start),
            Kind::List(seeds) => seeds.len() as u64,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn nth(&self, number: u64) -> u64 {
        match &self.0 {
            Kind::Range(range) => range.start.saturating_add(number),
            Kind::List(seeds) => seeds.get(number as usize).copied().unwrap_or_default(),
        }
    }
}

impl fmt::Display for Seeds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Range(range) => write!(f, "{}..{}", range.start, range.end),
            Kind::List(seeds) => {
                let seeds: Vec<_> = seeds.iter().map(u64::to_string).collect();
                f.write_str(&seeds.join(","))
            }
        }
    }
}
