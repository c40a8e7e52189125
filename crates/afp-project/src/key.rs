//! A key of a project file, with the texts of editors.

/// A key of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    pub name: &'static str,
    /// A description in one sentence.
    pub help: &'static str,
    pub example: &'static str,
}

pub(crate) const fn key(name: &'static str, help: &'static str, example: &'static str) -> Key {
    Key { name, help, example }
}
