//! Wording shared by diagnostics: lists, and the name that was probably meant.

/// `'a', 'b' and 'c'`, in single quotes.
pub fn list<'a>(names: impl IntoIterator<Item = &'a str>, joint: &str) -> String {
    let quoted: Vec<_> = names.into_iter().map(|name| format!("'{name}'")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [front @ .., last] => format!("{} {joint} {last}", front.join(", ")),
    }
}

/// The candidate that differs least from `name`, when it is near enough to be a slip.
///
/// Only what looks alike is compared letter by letter, and not more than some hundreds of those, so
/// that thousands of unknown names among thousands of known ones are no trouble.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (name.chars().count() / 3).clamp(1, 3);
    let alike = candidates.into_iter().filter(|candidate| look_alike(name, candidate, limit));
    let scored = alike.take(MOST_ALIKE).map(|candidate| (distance(name, candidate), candidate));
    scored.filter(|(score, _)| *score <= limit).min_by_key(|(score, _)| *score).map(|(_, c)| c)
}

/// Whether two words are about as long and begin or end with the same letter; short ones and those
/// with foreign letters always are.
fn look_alike(left: &str, right: &str, limit: usize) -> bool {
    if !left.is_ascii() || !right.is_ascii() {
        return true;
    }
    let (a, b) = (left.as_bytes(), right.as_bytes());
    let same = |x: Option<&u8>, y: Option<&u8>| match (x, y) {
        (Some(x), Some(y)) => x.eq_ignore_ascii_case(y),
        _ => false,
    };
    let ends = a.len() <= 3 || same(a.first(), b.first()) || same(a.last(), b.last());
    ends && a.len().abs_diff(b.len()) <= limit
}

/// How many candidates are compared letter by letter.
const MOST_ALIKE: usize = 200;

/// How many letters have to be changed, added, removed or swapped with their neighbour; case
/// counts for nothing.
fn distance(left: &str, right: &str) -> usize {
    let letters = |word: &str| word.chars().flat_map(char::to_lowercase).collect::<Vec<char>>();
    let (left, right) = (letters(left), letters(right));
    let mut before = vec![0; right.len() + 1];
    let mut row: Vec<usize> = (0..=right.len()).collect();
    let mut next = before.clone();
    for (i, a) in left.iter().enumerate() {
        next[0] = i + 1;
        for (j, b) in right.iter().enumerate() {
            let changed = row[j] + usize::from(a != b);
            let mut best = changed.min(row[j + 1] + 1).min(next[j] + 1);
            let swapped = i > 0 && j > 0 && *a == right[j - 1] && left[i - 1] == *b;
            if swapped {
                best = best.min(before[j - 1] + 1);
            }
            next[j + 1] = best;
        }
        // The oldest row is written over next.
        std::mem::swap(&mut before, &mut row);
        std::mem::swap(&mut row, &mut next);
    }
    row[right.len()]
}

#[cfg(test)]
mod tests {
    use super::{list, nearest};

    #[test]
    fn slips_find_the_name_that_was_meant() {
        let names = ["Forward", "Turn", "SearchWall"];
        assert_eq!(nearest("Froward", names), Some("Forward"));
        assert_eq!(nearest("forward", names), Some("Forward"));
        assert_eq!(nearest("SearchWal", names), Some("SearchWall"));
        assert_eq!(nearest("Curve", names), None);
        assert_eq!(nearest("oFrward", names), Some("Forward"));
        assert_eq!(nearest("ba", ["ab", "cd"]), Some("ab"));
    }

    #[test]
    fn lists_read_like_sentences() {
        assert_eq!(list(["a"], "or"), "'a'");
        assert_eq!(list(["a", "b", "c"], "or"), "'a', 'b' or 'c'");
    }
}
