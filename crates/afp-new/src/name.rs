//! The name of a project in its forms.

use std::fmt;

/// Why a name is none for a project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameError {
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub help: String,
}

/// Words of the language and of Rust, names of what comes with AFP, and of what new projects declare themselves.
const TAKEN: &[&str] = &[
    "actor",
    "afp",
    "as",
    "break",
    "carbot",
    "check_bumper",
    "computation",
    "const",
    "core",
    "crate",
    "device",
    "drive",
    "else",
    "enum",
    "event",
    "extern",
    "fault",
    "fn",
    "for",
    "if",
    "impl",
    "in",
    "input",
    "let",
    "loop",
    "match",
    "mod",
    "move",
    "object",
    "out",
    "plan",
    "press",
    "pub",
    "ref",
    "return",
    "robot",
    "scenario",
    "self",
    "sensor",
    "signal",
    "sim",
    "start",
    "state",
    "static",
    "std",
    "stop",
    "struct",
    "super",
    "supervisor",
    "templates",
    "test",
    "toolbox",
    "trait",
    "true",
    "truth",
    "turn",
    "type",
    "unsafe",
    "use",
    "var",
    "wag",
    "where",
    "while",
    "work",
    "world",
];

/// A project's name.
#[derive(Debug)]
pub(crate) struct Names {
    /// As it was given, of files and the package: `my-rover`.
    pub(crate) name: String,
    /// Of the toolbox and the crate in Rust: `my_rover`.
    snake: String,
    /// Of the plan and the robot's type: `MyRover`.
    camel: String,
}

impl Names {
    pub(crate) fn new(name: &str) -> Result<Names, NameError> {
        let is_part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-_".contains(c);
        let begins = name.chars().next().is_some_and(|first| first.is_ascii_lowercase());
        let ends = name.ends_with(['-', '_']) || name.contains("__") || name.contains("--");
        if !begins || ends || !name.chars().all(is_part) {
            return Err(NameError {
                message: format!("'{name}' cannot be the name of a project"),
                help: "use lower-case letters, digits, '-' and '_', such as 'my-rover'".to_owned(),
            });
        }
        let snake = name.replace('-', "_");
        if TAKEN.contains(&&*snake) {
            return Err(NameError {
                message: format!("the name '{name}' is taken"),
                help: format!("another one, such as 'my-{name}'"),
            });
        }
        let camel = snake.split('_').map(|word| {
            let (first, rest) = word.split_at(1.min(word.len()));
            first.to_ascii_uppercase() + rest
        });
        Ok(Names { name: name.to_owned(), camel: camel.collect(), snake })
    }

    /// A text with the names in it.
    pub(crate) fn fill(&self, text: &str) -> String {
        let text = text.replace("{{name}}", &self.name).replace("{{snake}}", &self.snake);
        text.replace("{{Name}}", &self.camel)
    }
}

impl fmt::Display for NameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message, self.help)
    }
}

impl std::error::Error for NameError {}
