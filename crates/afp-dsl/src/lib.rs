//! The compiler of Action Flow Plans: text in; diagnostics, static graph, Rust and drawings out.
