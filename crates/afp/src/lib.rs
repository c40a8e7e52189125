//! What users name in Cargo.toml: the run time, the macros, and plans loaded at run time.
