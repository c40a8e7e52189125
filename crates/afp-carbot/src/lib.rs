//! The Carbot: robot traits and the templates written against them.
