//! Why a plan cannot be loaded, or an input not be set.

use std::fmt;

use afp_core::WriteError;

/// Why a graph cannot be loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadError {
    /// No Rust type was registered for a template.
    NoComponent {
        /// The toolbox.
        toolbox: String,
        /// The template.
        template: String,
    },
    /// No Rust type was registered for an object type.
    NoObject {
        /// The toolbox.
        toolbox: String,
        /// The object type.
        name: String,
    },
}

/// Why an input of a plan cannot be set.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InputError {
    /// The plan has no such entry.
    Unknown(String),
    /// The entry is there, but not with this value.
    Refused(String, WriteError),
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LoadError::NoComponent { toolbox, template } => {
                write!(f, "no implementation of '{toolbox}.{template}' is registered")
            }
            LoadError::NoObject { toolbox, name } => {
                write!(f, "no Rust type of object '{toolbox}.{name}' is registered")
            }
        }
    }
}

impl std::error::Error for LoadError {}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InputError::Unknown(name) => write!(f, "the plan has no entry '{name}'"),
            InputError::Refused(name, why) => write!(f, "'{name}': {why}"),
        }
    }
}

impl std::error::Error for InputError {}
