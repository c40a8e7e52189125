//! Tokens as readable text.
//!
//! Comments are passed through the tokens as `#[comment = " text"]`, which the printer knows; code
//! for the compiler has them removed. Places of the plan use the same form and become a table next
//! to the text.

use proc_macro2::{Group, Span as RustSpan, TokenStream, TokenTree};
use quote::quote;

use crate::places::Places;
use afp_syntax::source::Span;

/// The prefix of a comment that is a place.
const PLACE: &str = "\u{1}";

/// A comment above the next item, arm, element or statement.
pub fn comment(text: &str) -> TokenStream {
    let text = format!(" {text}");
    quote!(#[comment = #text])
}

/// The place in the plan for the next item, arm, field or element; it comes after all other
/// attributes.
pub fn at(span: Span) -> TokenStream {
    let text = format!("{PLACE}{} {} {}", span.file, span.start, span.end);
    quote!(#[comment = #text])
}

fn place(line: &str) -> Option<Span> {
    let mut numbers = line.trim_start().strip_prefix("//")?.strip_prefix(PLACE)?.split(' ');
    let file = numbers.next()?.parse().ok()?;
    let [start, end] = [numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?];
    Some(Span { file, start, end })
}

/// Help lines as a doc comment; `fallback` if there are none.
pub fn doc(help: &str, fallback: &str) -> TokenStream {
    let help = if help.trim().is_empty() { fallback } else { help };
    let lines =
        help.lines().map(|line| if line.is_empty() { String::new() } else { format!(" {line}") });
    quote!(#(#[doc = #lines])*)
}

/// Tokens for the compiler with spans at a place; `$crate` keeps its meaning.
pub fn located(tokens: TokenStream, at: RustSpan) -> TokenStream {
    let each = tokens.into_iter().map(|mut token| {
        match &mut token {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), located(group.stream(), at));
                inner.set_span(at);
                *group = inner;
            }
            TokenTree::Ident(ident) if ident == "$crate" => {}
            token => token.set_span(at),
        }
        token
    });
    each.collect()
}

/// Tokens for the compiler: the same code without the comments.
pub fn code(tokens: TokenStream) -> TokenStream {
    let mut kept = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Group(group) if is_comment(&group) => {
                kept.pop();
            }
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), code(group.stream()));
                inner.set_span(group.span());
                kept.push(TokenTree::Group(inner));
            }
            token => kept.push(token),
        }
    }
    kept.into_iter().collect()
}

/// Whether a group is the bracket of `#[comment = ...]`.
fn is_comment(group: &Group) -> bool {
    let first = group.stream().into_iter().next();
    matches!(first, Some(TokenTree::Ident(ident)) if ident == "comment")
}

/// The text of a file: formatted, with empty lines between the items.
///
/// Tokens that are not a valid Rust file are returned unchanged, so that the compiler reports the
/// error.
pub fn file(tokens: TokenStream) -> String {
    file_with_places("", tokens).0
}

/// The text of a file below a comment line, if that is not empty, with the place of each line.
pub fn file_with_places(head: &str, tokens: TokenStream) -> (String, Places) {
    match syn::parse2(tokens.clone()) {
        Ok(file) => airy(head, &prettyplease::unparse(&file)),
        Err(_) => (tokens.to_string(), Places::default()),
    }
}

/// Adds empty lines below the head and between items, where the printer leaves none, and removes
/// the lines with places.
fn airy(head: &str, text: &str) -> (String, Places) {
    let mut airy = String::with_capacity(text.len() + text.len() / 16);
    let (mut places, mut here) = (Places::default(), None);
    let mut before = "";
    if !head.is_empty() {
        airy += &format!("{head}\n\n");
        places.line(head, None);
        places.line("", None);
    }
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        if let Some(place) = place(line) {
            here = Some(place);
            continue;
        }
        if separated(before, line) {
            airy.push('\n');
            places.line("", None);
        }
        places.line(line, here.take());
        airy += line;
        before = line;
        // The printer also breaks empty blocks.
        if line.ends_with(" {")
            && let Some(end) = lines.next_if(|next| next.trim_start().starts_with('}'))
        {
            airy += end.trim_start();
            before = end;
        }
        airy.push('\n');
    }
    (airy, places)
}

fn separated(before: &str, line: &str) -> bool {
    let is_header = |line: &str| line.starts_with("// ****");
    if !before.is_empty() && (is_header(before) || is_header(line)) {
        return true;
    }
    let depth = |line: &str| line.len() - line.trim_start().len();
    let starts = |words: &[&str]| words.iter().any(|word| line.trim_start().starts_with(word));
    let items = [
        "///", "//", "#[", "pub ", "fn ", "impl", "struct", "enum", "mod ", "use ", "const ",
        "static ", "type ",
    ];
    if before.is_empty() || depth(before) != depth(line) || depth(line) > 8 || line.is_empty() {
        return false;
    }
    if before.starts_with("//!") {
        return !line.starts_with("//!");
    }
    let ends_block = before.trim_start() == "}" && starts(&items);
    let ends_item =
        before.ends_with(';') && starts(&["///", "//", "#[", "fn ", "pub fn", "impl", "struct"]);
    ends_block || ends_item && depth(line) <= 4
}

#[cfg(test)]
mod tests {
    use super::{at, code, comment, file, file_with_places};
    use afp_syntax::source::Span;
    use quote::quote;

    #[test]
    fn comments_are_written_but_not_compiled() {
        let note = comment("why");
        let tokens = quote!(#note fn f() -> [u8; 1] { [#note 1] });
        assert!(file(tokens.clone()).starts_with("// why\nfn f()"));
        assert_eq!(
            code(tokens).to_string(),
            quote!(
                fn f() -> [u8; 1] {
                    [1]
                }
            )
            .to_string()
        );
    }

    #[test]
    fn lines_have_the_place_of_the_innermost_enclosing_item() {
        let span = |start| Span { file: 3, start, end: 90 };
        let [a, b, c, d] = [1, 2, 3, 4].map(|start| at(span(start)));
        let tokens = quote! {
            /// Help.
            #a
            fn f(x: u8) -> P { P { #b one: x, #c two: x } }
            fn g() { match 1 { #d 1 => {} _ => {} } }
            struct Last {}
        };
        let (text, places) = file_with_places("// Head.", tokens.clone());
        assert!(text.starts_with("// Head.\n\n/// Help.\n"), "{text}");
        assert!(!text.contains('\u{1}') && !code(tokens).to_string().contains("comment"));
        let place = |part: &str| {
            let line = text.lines().position(|line| line.contains(part)).unwrap();
            places.at(line + 1).map(|span| span.start)
        };
        assert_eq!(place("fn f"), Some(1));
        assert_eq!(place("P {"), Some(1));
        assert_eq!(place("one"), Some(2));
        assert_eq!(place("two"), Some(3));
        assert_eq!(place("fn g"), None);
        assert_eq!(place("1 =>"), Some(4));
        assert_eq!(place("_ =>"), None);
        assert_eq!(place("Last"), None);
        assert_eq!(places.at(0), None);
        assert_eq!(places.at(99), None);
    }
}
