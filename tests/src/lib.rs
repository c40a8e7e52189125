//! Suites that run across the whole workspace.
