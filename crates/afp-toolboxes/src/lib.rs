//! The built-in toolbox files and their icons, as data.
