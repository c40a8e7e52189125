//! Queries of places by line and enclosing range, each in a few steps, since a file may have an
//! error at every token.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::gather::PlanFile;
use afp_syntax::source::{LineTable, Span};
use rustc_hash::FxHashMap;

pub(crate) struct Lines<'f>(FxHashMap<u16, LineTable<'f>>);

impl<'f> Lines<'f> {
    pub(crate) fn new(files: &'f [PlanFile]) -> Lines<'f> {
        let tables = files.iter().map(|file| (file.index, LineTable::new(&file.source.text)));
        Lines(tables.collect())
    }

    /// The byte range of a place's line, including its line break.
    pub(crate) fn of(&self, place: Span) -> Range<usize> {
        self.0.get(&place.file).map_or(0..0, |table| table.line(place.start as usize))
    }

    pub(crate) fn text(&self, file: u16, line: &Range<usize>) -> &'f str {
        let text = self.0.get(&file).and_then(|table| table.text().get(line.clone()));
        text.unwrap_or_default()
    }
}

pub(crate) struct ByLine(BTreeMap<(u16, usize), (Range<usize>, Vec<Span>)>);

impl ByLine {
    pub(crate) fn new(lines: &Lines<'_>, places: &[Span]) -> ByLine {
        let mut by_line: BTreeMap<_, (Range<usize>, Vec<Span>)> = BTreeMap::new();
        for place in places {
            let line = lines.of(*place);
            let here = by_line.entry((place.file, line.start)).or_insert((line, Vec::new()));
            here.1.push(*place);
        }
        ByLine(by_line)
    }

    pub(crate) fn lines(&self) -> impl Iterator<Item = (u16, &Range<usize>)> {
        self.0.iter().map(|((file, _), (line, _))| (*file, line))
    }

    /// The line of another place, with the places on it.
    pub(crate) fn beside(&self, lines: &Lines<'_>, place: Span) -> Option<(usize, &[Span])> {
        let (line, here) = self.0.get(&(place.file, lines.of(place).start))?;
        line.contains(&(place.start as usize)).then_some((line.start, here))
    }
}

/// Places for containment queries.
pub(crate) struct Within(Vec<(Span, u32)>);

impl Within {
    pub(crate) fn new(places: &[Span]) -> Within {
        let mut sorted: Vec<(Span, u32)> = places.iter().map(|place| (*place, place.end)).collect();
        sorted.sort_unstable();
        // Store the minimum end of each place and its successors in the file.
        for at in (1..sorted.len()).rev() {
            let ((before, least), (next, end)) = (sorted[at - 1], sorted[at]);
            if before.file == next.file {
                sorted[at - 1].1 = least.min(end);
            }
        }
        Within(sorted)
    }

    pub(crate) fn any(&self, range: Span) -> bool {
        let from = (range.file, range.start);
        let first = self.0.partition_point(|(place, _)| (place.file, place.start) < from);
        let next = self.0.get(first);
        next.is_some_and(|(place, end)| place.file == range.file && *end <= range.end)
    }
}

/// Ranges that do not contain each other.
pub(crate) struct Ranges(Vec<Span>);

impl Ranges {
    pub(crate) fn new(mut ranges: Vec<Span>) -> Ranges {
        ranges.sort_unstable();
        Ranges(ranges)
    }

    pub(crate) fn any(&self, place: Span) -> bool {
        let from = (place.file, place.start);
        let behind = self.0.partition_point(|range| (range.file, range.start) <= from);
        behind.checked_sub(1).is_some_and(|last| self.0[last].contains(place))
    }
}

#[cfg(test)]
mod tests {
    use super::{Ranges, Span, Within};

    fn span(start: u32, end: u32) -> Span {
        Span { file: 1, start, end }
    }

    #[test]
    fn nesting_equals_an_exhaustive_search() {
        let ranges = [span(0, 4), span(4, 9), span(12, 12), span(14, 20)];
        let places =
            [span(3, 5), span(6, 20), span(7, 8), span(12, 12), span(15, 40), span(19, 21)];
        let (within, around) = (Within::new(&places), Ranges::new(ranges.to_vec()));
        for start in 0..24 {
            for end in start..24 {
                let here = span(start, end);
                assert_eq!(
                    within.any(here),
                    places.iter().any(|it| here.contains(*it)),
                    "{here:?}"
                );
                assert_eq!(around.any(here), ranges.iter().any(|it| it.contains(here)), "{here:?}");
                assert!(
                    !within.any(Span { file: 0, ..here }) && !around.any(Span { file: 2, ..here })
                );
            }
        }
    }
}
