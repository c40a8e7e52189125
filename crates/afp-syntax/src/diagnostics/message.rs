//! Sentences of diagnostics. The names in a sentence are separate fields, and the text is made only
//! for display.

use std::fmt::Display;

use super::words;

/// A sentence with holes and their arguments. Other code can read its names but not its wording.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Message {
    /// The text with `{}` for each argument; without arguments, the literal text.
    template: &'static str,
    args: Vec<Arg>,
}

/// An argument of a message.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Arg {
    /// A name or another text of the plan.
    Name(String),
    /// Several names in single quotes, with a word before the last.
    Names(Vec<String>, &'static str),
    /// Words of the compiler, numbers, kinds.
    Words(String),
    /// A part of the sentence with its own arguments.
    Part(Message),
}

/// Creates a message from a format string with `{}` for each argument.
///
/// Strings are names of the plan; words of the compiler are wrapped in
/// [`Words`](crate::diagnostics::Words).
#[macro_export]
macro_rules! message {
    ($template:literal, $($arg:expr),+ $(,)?) => {{
        use $crate::diagnostics::ToArg as _;
        const { assert!($crate::diagnostics::holes($template) == [$(stringify!($arg)),+].len()) }
        $crate::diagnostics::Message::new($template, ::std::vec![$($arg.to_arg()),+])
    }};
}

/// The number of holes in a template; `{{` and `}}` are literal braces.
pub const fn holes(template: &str) -> usize {
    let (bytes, mut at, mut holes) = (template.as_bytes(), 0, 0);
    while at + 1 < bytes.len() {
        at += match (bytes[at], bytes[at + 1]) {
            (b'{', b'}') => {
                holes += 1;
                2
            }
            (b'{', b'{') | (b'}', b'}') => 2,
            (b'{' | b'}', _) => panic!("a placeholder is empty"),
            _ => 1,
        };
    }
    holes
}

impl Message {
    /// A message from a template and its arguments; use [`message!`](crate::message).
    pub fn new(template: &'static str, args: Vec<Arg>) -> Message {
        Message { template, args }
    }

    pub fn is_empty(&self) -> bool {
        self.template.is_empty()
    }

    /// Whether it consists of this name only.
    pub(super) fn is_name(&self, name: &str) -> bool {
        matches!(&*self.args, [Arg::Name(only)] if only == name)
    }

    /// The names in it, in the order of the arguments.
    pub(super) fn names<'a>(&'a self, names: &mut Vec<&'a str>) {
        for arg in &self.args {
            match arg {
                Arg::Name(name) => names.push(name),
                Arg::Names(some, _) => names.extend(some.iter().map(String::as_str)),
                Arg::Words(_) => {}
                Arg::Part(part) => part.names(names),
            }
        }
    }

    pub(super) fn write(&self, text: &mut String) {
        let mut rest = self.template;
        for arg in &self.args {
            rest = literal(rest, text);
            match arg {
                Arg::Name(words) | Arg::Words(words) => text.push_str(words),
                Arg::Names(names, joint) => {
                    text.push_str(&words::list(names.iter().map(String::as_str), joint));
                }
                Arg::Part(part) => part.write(text),
            }
        }
        match self.args.is_empty() {
            true => text.push_str(rest),
            false => _ = literal(rest, text),
        }
    }
}

/// Appends a template up to its first hole and returns the text after the hole.
fn literal<'t>(mut template: &'t str, text: &mut String) -> &'t str {
    while let Some(at) = template.find(['{', '}']) {
        let (before, brace) = template.split_at(at);
        text.push_str(before);
        let (brace, rest) = brace.split_at_checked(2).unwrap_or((brace, ""));
        if brace == "{}" {
            return rest;
        }
        text.push_str(&brace[..1]);
        template = rest;
    }
    text.push_str(template);
    ""
}

impl From<&'static str> for Message {
    fn from(text: &'static str) -> Message {
        Message { template: text, args: Vec::new() }
    }
}

/// Types that can be arguments of a message.
pub trait ToArg {
    fn to_arg(&self) -> Arg;
}

/// Several names in single quotes, with a word before the last: `'a', 'b' or 'c'`.
pub fn list<'a>(names: impl IntoIterator<Item = &'a str>, joint: &'static str) -> Arg {
    Arg::Names(names.into_iter().map(str::to_owned).collect(), joint)
}

/// Words of the compiler, as opposed to names of the plan.
pub struct Words<T>(pub T);

impl<T: Display> ToArg for Words<T> {
    fn to_arg(&self) -> Arg {
        Arg::Words(self.0.to_string())
    }
}

impl ToArg for Arg {
    fn to_arg(&self) -> Arg {
        self.clone()
    }
}

impl ToArg for Message {
    fn to_arg(&self) -> Arg {
        Arg::Part(self.clone())
    }
}

macro_rules! args {
    ($($arg:ident: $($ty:ty)+;)*) => {
        $($(impl ToArg for $ty {
            fn to_arg(&self) -> Arg {
                Arg::$arg(self.to_string())
            }
        })+)*
    };
}

args! {
    Name: str String char;
    Words: u8 u16 u32 u64 usize i64 f64;
}
