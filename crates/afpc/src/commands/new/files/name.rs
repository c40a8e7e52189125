//! The name of a project in its forms.

use afp_run::RunError;

/// Words of the language, names of AFP's packages, and modules that new projects declare.
const TAKEN: &[&str] = &[
    "actor",
    "carbot",
    "computation",
    "core",
    "device",
    "event",
    "fault",
    "input",
    "libm",
    "object",
    "out",
    "plan",
    "press",
    "scenario",
    "sensor",
    "signal",
    "sim",
    "start",
    "state",
    "std",
    "stop",
    "supervisor",
    "templates",
    "test",
    "toolbox",
    "truth",
    "var",
    "wag",
    "work",
];
/// Rust's keywords and reserved words.
const OF_RUST: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];
/// Types of Rust's prelude and of new projects.
const TYPES: &[&str] = &[
    "Box", "Clone", "Copy", "Default", "Drop", "Eq", "Err", "Fn", "From", "Into", "Iterator",
    "None", "Ok", "Option", "Ord", "Result", "Self", "Send", "Some", "String", "Sync", "Vec",
];

/// Whether a project's name clashes with a name that its files use: a package, a word, or a type.
fn is_taken(snake: &str, camel: &str) -> bool {
    let is_afp = ["afp", "afpc"].contains(&snake) || snake.starts_with("afp_");
    let is_word = TAKEN.contains(&snake) || OF_RUST.contains(&snake);
    is_afp || is_word || TYPES.contains(&camel) || is_used(camel)
}

/// Whether a type of that name is in the files of new projects.
fn is_used(camel: &str) -> bool {
    let is_code = |line: &&str| !line.trim_start().starts_with("//");
    let drafts = super::PLAN.iter().chain(super::TOOLBOX).chain(super::ROBOT);
    let code = drafts.filter(|(path, _)| path.ends_with(".afp") || path.ends_with(".rs"));
    let lines = code.flat_map(|(_, text)| text.lines());
    let is_word = |c: char| c.is_alphanumeric() || "_{}".contains(c);
    lines.filter(is_code).any(|line| line.split(|c| !is_word(c)).any(|word| word == camel))
}

/// A project's name.
#[derive(Debug)]
pub(crate) struct Names {
    /// The given name, for files and the package: `my-rover`.
    pub(crate) name: String,
    /// The name of the toolbox and the crate in Rust: `my_rover`.
    snake: String,
    /// The name of the plan and the robot's type: `MyRover`.
    camel: String,
}

impl Names {
    pub(crate) fn new(name: &str) -> Result<Names, RunError> {
        let is_part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-_".contains(c);
        let begins = name.chars().next().is_some_and(|first| first.is_ascii_lowercase());
        let ends = name.ends_with(['-', '_']) || name.contains("__") || name.contains("--");
        if !begins || ends || !name.chars().all(is_part) {
            return Err(RunError::usage(
                format!("'{name}' cannot be the name of a project"),
                "use lower-case letters, digits, '-' and '_', a letter first, such as 'my-rover'",
            ));
        }
        let snake = name.replace('-', "_");
        let camel = snake.split('_').map(|word| {
            let (first, rest) = word.split_at(1.min(word.len()));
            first.to_ascii_uppercase() + rest
        });
        let camel: String = camel.collect();
        if is_taken(&snake, &camel) {
            let help = format!("another name, such as 'my-{name}'");
            return Err(RunError::usage(format!("the name '{name}' is taken"), help));
        }
        Ok(Names { name: name.to_owned(), camel, snake })
    }

    pub(crate) fn fill(&self, text: &str) -> String {
        let text = text.replace("{{name}}", &self.name).replace("{{snake}}", &self.snake);
        text.replace("{{Name}}", &self.camel)
    }
}
