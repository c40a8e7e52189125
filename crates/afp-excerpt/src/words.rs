//! Common wording of messages: lists, articles, quoted words, and suggestions for misspelled names.

/// `'a', 'b' and 'c'`, in single quotes.
pub fn list<'a>(names: impl IntoIterator<Item = &'a str>, joint: &str) -> String {
    let quoted: Vec<_> = names.into_iter().map(|name| format!("'{name}'")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [front @ .., last] => format!("{} {joint} {last}", front.join(", ")),
    }
}

/// A name with its article.
pub fn a(name: &str) -> String {
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {name}")
}

/// A word for a shell, quoted if necessary.
///
/// ```
/// use afp_excerpt::words::shell_word;
///
/// assert_eq!(shell_word("plans/square.afp"), "plans/square.afp");
/// assert_eq!(shell_word("name=it's"), r"'name=it'\''s'");
/// ```
pub fn shell_word(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "._-+=:/,@%".contains(c);
    // The shell zsh looks up a word that begins with '='.
    match !word.is_empty() && !word.starts_with('=') && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

/// A file name for a shell: with its path if it looks like an option.
pub fn shell_file(name: &str) -> String {
    match name.starts_with('-') {
        true => shell_word(&format!("./{name}")),
        false => shell_word(name),
    }
}

/// The name and the value of a setting, such as `distance=35cm`; `None` without a name. Spaces
/// around both are ignored, and the value may be in quotes.
pub fn read_setting(text: &str) -> Option<(&str, &str)> {
    let (name, value) = text.split_once('=')?;
    let name = Some(name.trim()).filter(|name| !name.is_empty())?;
    Some((name, unquoted(value.trim())))
}

/// A setting for [`read_setting`] and a shell: in quotes if a part of the value would be ignored.
pub fn shell_setting(name: &str, value: &str) -> String {
    let plain = format!("{name}={value}");
    match read_setting(&plain) == Some((name, value)) && !value.is_empty() {
        true => shell_word(&plain),
        false => shell_word(&format!("{name}=\"{value}\"")),
    }
}

/// A value without its optional quotes.
pub fn unquoted(value: &str) -> &str {
    value.strip_prefix('"').and_then(|it| it.strip_suffix('"')).unwrap_or(value)
}

/// The help for an unknown name: the name in `known` that was probably meant, or a list of all.
pub fn instead<'a>(name: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    match nearest(name, known.clone()) {
        Some(meant) => format!("write '{meant}'"),
        None => format!("it has {}", list(known, "and")),
    }
}

/// The candidate nearest to `name` if it is near enough for a misspelling; the first of several.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    all_nearest(name, candidates).first().copied()
}

/// The candidates nearest to `name` at the same distance, if they are near enough for a
/// misspelling.
///
/// Only similar candidates are compared letter by letter, and at most some hundreds of them.
/// Therefore thousands of unknown names among thousands of known ones take little time.
pub fn all_nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let limit = (name.chars().count() / 3).clamp(1, 3);
    let alike = candidates.into_iter().filter(|candidate| look_alike(name, candidate, limit));
    let (name, mut other, mut rows) = (letters(name, Vec::new()), Vec::new(), Rows::default());
    let (mut least, mut nearest) = (limit, Vec::new());
    for candidate in alike.take(MOST_ALIKE) {
        other = letters(candidate, other);
        let score = distance(&name, &other, &mut rows);
        // If every letter differs, it is another word.
        if score >= name.len().max(other.len()) {
            continue;
        }
        if score < least {
            nearest.clear();
        }
        if score <= least {
            least = score;
            nearest.push(candidate);
        }
    }
    nearest
}

/// Whether two words have about the same length and begin or end with the same letter; always true
/// for short words and words with non-ASCII letters.
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

/// The maximum number of candidates that are compared letter by letter.
const MOST_ALIKE: usize = 200;

/// The lower-case letters of a word, in the buffer of another one.
fn letters(word: &str, mut room: Vec<char>) -> Vec<char> {
    room.clear();
    match word.is_ascii() {
        true => room.extend(word.chars().map(|letter| letter.to_ascii_lowercase())),
        false => room.extend(word.chars().flat_map(char::to_lowercase)),
    }
    room
}

/// Buffers for the rows of a table of distances: the one before the last, the last, the next.
type Rows = [Vec<usize>; 3];

/// The number of letters to change, add, remove or swap with their neighbour.
fn distance(left: &[char], right: &[char], rows: &mut Rows) -> usize {
    // The common start and end cost nothing, and similar words share most of their letters.
    let same = left.iter().zip(right).take_while(|(a, b)| a == b).count();
    let (left, right) = (&left[same..], &right[same..]);
    let same = left.iter().rev().zip(right.iter().rev()).take_while(|(a, b)| a == b).count();
    let (left, right) = (&left[..left.len() - same], &right[..right.len() - same]);
    if left.is_empty() || right.is_empty() {
        return left.len().max(right.len());
    }
    let [before, row, next] = rows;
    for room in [&mut *before, row, next] {
        room.clear();
        room.extend(0..=right.len());
    }
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
        // The oldest row is overwritten next.
        std::mem::swap(before, row);
        std::mem::swap(row, next);
    }
    row[right.len()]
}

#[cfg(test)]
mod tests {
    use super::{Rows, all_nearest, distance, instead, list, nearest};

    #[test]
    fn a_misspelled_name_finds_the_intended_name() {
        let names = ["Forward", "Turn", "SearchWall"];
        assert_eq!(nearest("Froward", names), Some("Forward"));
        assert_eq!(nearest("forward", names), Some("Forward"));
        assert_eq!(nearest("SearchWal", names), Some("SearchWall"));
        assert_eq!(nearest("Curve", names), None);
        assert_eq!(nearest("oFrward", names), Some("Forward"));
        assert_eq!(nearest("ba", ["ab", "cd"]), Some("ab"));
        assert_eq!((nearest("s", ["n"]), nearest("S", ["s"])), (None, Some("s")));
        assert_eq!(nearest("WÄNDE", ["Turn", "wände"]), Some("wände"));
        assert_eq!(all_nearest("roundd", ["way", "rounds", "round"]), ["rounds", "round"]);
    }

    #[test]
    fn an_unrelated_name_gets_a_list() {
        assert_eq!(instead("wordl", ["world", "measures"]), "write 'world'");
        assert_eq!(instead("speed", ["world", "measures"]), "it has 'world' and 'measures'");
    }

    #[test]
    fn misspellings_are_counted_by_letters() {
        let count = |a: &str, b: &str| {
            let letters = |word: &str| word.chars().collect::<Vec<_>>();
            distance(&letters(a), &letters(b), &mut Rows::default())
        };
        for (a, b, slips) in [
            ("", "", 0),
            ("drive", "", 5),
            ("drive", "drive", 0),
            ("drive12", "drove12", 1),
            ("drive12", "drve12", 1),
            ("drive12", "drivve12", 1),
            ("drive12", "drvie12", 1),
            ("aab", "ab", 1),
            ("abcabc", "abc", 3),
            ("kitten", "sitting", 3),
            ("ca", "abc", 3),
        ] {
            assert_eq!((count(a, b), count(b, a)), (slips, slips), "{a} {b}");
        }
    }

    #[test]
    fn lists_read_like_sentences() {
        assert_eq!(list(["a"], "or"), "'a'");
        assert_eq!(list(["a", "b", "c"], "or"), "'a', 'b' or 'c'");
    }
}
