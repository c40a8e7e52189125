//! Errors of loading a plan.

use std::fmt;

/// Why a graph cannot be loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadError {
    /// No Rust type is registered for a template.
    NoComponent {
        /// The toolbox.
        toolbox: String,
        /// The template.
        template: String,
    },
    /// The platform lacks a trait that a template needs.
    Unsupported {
        /// The toolbox.
        toolbox: String,
        /// The template.
        template: String,
        /// The toolbox's required traits that the platform does not implement.
        missing: Vec<&'static str>,
        /// The first use in the plan: file, line, column.
        at: String,
    },
    /// No Rust type is registered for an object type.
    NoObject {
        /// The toolbox.
        toolbox: String,
        /// The object type.
        name: String,
    },
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LoadError::NoComponent { toolbox, template } => {
                write!(f, "no implementation of '{toolbox}.{template}' is registered")
            }
            LoadError::Unsupported { toolbox, template, missing, at } => {
                write!(f, "the robot does not support '{toolbox}.{template}', used at {at}")?;
                let names: Vec<_> = missing.iter().map(|name| format!("'{name}'")).collect();
                match &*names {
                    [] => Ok(()),
                    [one] => write!(f, ": it does not implement {one}"),
                    all => write!(f, ": it does not implement all of {}", all.join(", ")),
                }
            }
            LoadError::NoObject { toolbox, name } => {
                write!(f, "no Rust type of object '{toolbox}.{name}' is registered")
            }
        }
    }
}

impl std::error::Error for LoadError {}
