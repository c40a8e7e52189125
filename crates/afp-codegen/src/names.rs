//! Names in the source as Rust identifiers.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use afp_dsl::types::Dimension;

/// Rust's words that need `r#` to be names.
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let",
    "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return",
    "static", "struct", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use",
    "virtual", "where", "while", "yield",
];

/// Rust's words that cannot be names. The checker rejects them, except `self_`, which becomes
/// `self` by the change of case.
pub const NEVER: &[&str] = &["self", "Self", "super", "crate"];

/// Rust's lower-case types: a module of that name hides the type from its neighbours.
pub const PRIMITIVES: &[&str] = &[
    "bool", "char", "f128", "f16", "f32", "f64", "i128", "i16", "i32", "i64", "i8", "isize", "str",
    "u128", "u16", "u32", "u64", "u8", "usize",
];

/// An identifier, raw if necessary.
pub fn ident(name: &str) -> Ident {
    if KEYWORDS.contains(&name) {
        Ident::new_raw(name, Span::call_site())
    } else if NEVER.contains(&name) {
        Ident::new(&format!("{name}_"), Span::call_site())
    } else {
        Ident::new(name, Span::call_site())
    }
}

/// A path in a toolbox, such as `afp_carbot` or `crate::gripper`.
pub fn path(text: &str) -> TokenStream {
    let parts = text.split("::").map(|part| match part {
        "crate" | "self" | "super" => Ident::new(part, Span::call_site()),
        part => ident(part),
    });
    quote!(#(#parts)::*)
}

pub fn units_name(dimension: Dimension) -> Ident {
    let name = dimension.name().replace('/', "_PER_").replace('-', "_MINUS_");
    let name = name.replace('*', "_").replace('^', "").to_uppercase();
    match name.strip_prefix('1') {
        Some(rest) => ident(&format!("ONE{rest}")),
        None => ident(&name),
    }
}

/// `searchFirstWall` as `search_first_wall`.
pub fn snake(name: &str) -> String {
    words(name).join("_")
}

/// `searchFirstWall` as `SearchFirstWall`.
pub fn camel(name: &str) -> String {
    let capital = |word: String| {
        let (first, rest) = word.split_at(1);
        first.to_uppercase() + rest
    };
    let name: String = words(name).into_iter().map(capital).collect();
    if name == "Self" { "Self_".to_owned() } else { name }
}

/// `searchFirstWall` as `SEARCH_FIRST_WALL`.
pub fn shout(name: &str) -> String {
    snake(name).to_uppercase()
}

/// The words of a name, in lower case. A word begins after `_`, at a capital after a small letter
/// or digit, and at the last capital of a run before small letters.
fn words(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().collect();
    let mut words = vec![String::new()];
    for (at, letter) in letters.iter().enumerate() {
        let before = at.checked_sub(1).map(|at| letters[at]);
        let after = letters.get(at + 1);
        let begins = letter.is_ascii_uppercase()
            && (before.is_some_and(|b| b.is_ascii_lowercase() || b.is_ascii_digit())
                || before.is_some_and(|b| b.is_ascii_uppercase())
                    && after.is_some_and(char::is_ascii_lowercase));
        if begins || *letter == '_' {
            words.push(String::new());
        }
        if let (true, Some(word)) = (*letter != '_', words.last_mut()) {
            word.push(letter.to_ascii_lowercase());
        }
    }
    words.retain(|word| !word.is_empty());
    // A name of only digits or underscores still needs a first letter.
    match words.first() {
        Some(word) if word.starts_with(|first: char| first.is_ascii_digit()) => {
            words.insert(0, "n".to_owned());
        }
        None => words.push("n".to_owned()),
        Some(_) => {}
    }
    words
}

/// Assigns distinct names.
#[derive(Debug, Default)]
pub struct UniqueNames(Vec<String>);

impl UniqueNames {
    /// A register with some names taken.
    pub fn taken<'n>(names: impl IntoIterator<Item = &'n str>) -> Self {
        UniqueNames(names.into_iter().map(str::to_owned).collect())
    }

    /// The name itself; a taken name gets a suffix word, then a number.
    pub fn unique_or(&mut self, name: String, word: &str) -> String {
        let is_taken = self.0.contains(&name);
        self.unique(if is_taken { format!("{name}_{word}") } else { name })
    }

    /// The name itself, or the first free one of `name_2`, `name_3`...
    pub fn unique(&mut self, name: String) -> String {
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let free = std::iter::once(name.clone()).chain(numbered).find(|n| !self.0.contains(n));
        let name = free.unwrap_or(name);
        self.0.push(name.clone());
        name
    }
}

#[cfg(test)]
mod tests {
    use super::{UniqueNames, camel, ident, shout, snake};

    #[test]
    fn names_follow_rust_in_case() {
        for (name, small, big) in [
            ("searchFirstWall", "search_first_wall", "SearchFirstWall"),
            ("SearchWall", "search_wall", "SearchWall"),
            ("HTTPServer2Go", "http_server2_go", "HttpServer2Go"),
            ("wall_dist", "wall_dist", "WallDist"),
            ("X", "x", "X"),
            ("_9", "n_9", "N9"),
        ] {
            assert_eq!(snake(name), small);
            assert_eq!(camel(name), big);
        }
        assert_eq!(shout("goHome"), "GO_HOME");
    }

    #[test]
    fn keywords_become_raw() {
        assert_eq!(ident("loop").to_string(), "r#loop");
        assert_eq!(ident("looped").to_string(), "looped");
        assert_eq!(ident(&snake("self_")).to_string(), "self_");
    }

    #[test]
    fn a_taken_name_gets_a_number() {
        let mut names = UniqueNames::taken(["touch"]);
        assert_eq!(names.unique("touch".into()), "touch_2");
        assert_eq!(names.unique("lane".into()), "lane");
        assert_eq!(names.unique("touch".into()), "touch_3");
        assert_eq!(names.unique_or("touch".into(), "plan"), "touch_plan");
        assert_eq!(names.unique_or("touch".into(), "plan"), "touch_plan_2");
        assert_eq!(names.unique_or("free".into(), "plan"), "free");
    }
}
