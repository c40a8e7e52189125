//! Conditions on hits of a breakpoint: `3`, `> 3`, `== 3`, `% 3`.

/// A condition on the number of a hit, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct HitCount {
    compare: Compare,
    number: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Compare {
    From,
    /// Later hits.
    After,
    /// Earlier hits.
    Before,
    /// Up to that hit.
    To,
    Only,
    /// Every n-th hit.
    Every,
}

/// Operators, longer ones first.
const SIGNS: [(&str, Compare); 8] = [
    (">=", Compare::From),
    ("<=", Compare::To),
    ("==", Compare::Only),
    (">", Compare::After),
    ("<", Compare::Before),
    ("=", Compare::Only),
    ("%", Compare::Every),
    ("", Compare::From),
];

impl HitCount {
    /// Parses a condition; an empty text accepts every hit.
    ///
    /// # Errors
    /// The text is invalid, or no hit would ever count.
    pub fn new(text: &str) -> Result<HitCount, String> {
        let text = text.trim();
        if text.is_empty() {
            return Ok(HitCount { compare: Compare::From, number: 1 });
        }
        let like = "write one such as '3' (from the third on), '> 3', '== 3' or '% 3'";
        let signs =
            SIGNS.iter().find_map(|(sign, compare)| Some((text.strip_prefix(sign)?, *compare)));
        let read = signs.and_then(|(number, compare)| {
            let number = number.trim_start();
            // 'parse' also accepts '+3', which is not a number of hits.
            let number = number
                .parse()
                .ok()
                .filter(|_| number.starts_with(|it: char| it.is_ascii_digit()))?;
            Some(HitCount { compare, number })
        });
        let read = read.ok_or_else(|| format!("'{text}' is not a number of hits: {like}"))?;
        let never = match read.compare {
            Compare::Before => read.number <= 1,
            Compare::To | Compare::Only | Compare::Every => read.number == 0,
            // '0' would mean '1'.
            Compare::From => read.number == 0 && !text.starts_with('>'),
            Compare::After => read.number == u64::MAX,
        };
        match never {
            true => Err(format!("'{text}' is not a number of hits, which start at 1: {like}")),
            false => Ok(read),
        }
    }

    pub fn holds(self, hit: u64) -> bool {
        match self.compare {
            Compare::From => hit >= self.number,
            Compare::After => hit > self.number,
            Compare::Before => hit < self.number,
            Compare::To => hit <= self.number,
            Compare::Only => hit == self.number,
            Compare::Every => hit.is_multiple_of(self.number),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hit_counts_have_their_meaning() {
        for (text, wanted) in [
            ("", vec![1, 2, 3, 4, 5, 6]),
            (" 3 ", vec![3, 4, 5, 6]),
            (">= 3", vec![3, 4, 5, 6]),
            (">3", vec![4, 5, 6]),
            (">= 0", vec![1, 2, 3, 4, 5, 6]),
            ("== 2", vec![2]),
            ("=2", vec![2]),
            ("< 3", vec![1, 2]),
            ("<=3", vec![1, 2, 3]),
            ("%2", vec![2, 4, 6]),
        ] {
            let count = HitCount::new(text).unwrap();
            let held: Vec<_> = (1..=6).filter(|hit| count.holds(*hit)).collect();
            assert_eq!(held, wanted, "'{text}'");
        }
        for text in
            ["0", "== 0", "%0", "< 1", "x", "3 4", "> > 3", "=> 3", "-1", "+3", "3.5", "!= 3", ">"]
        {
            assert!(HitCount::new(text).is_err(), "'{text}'");
        }
    }
}
