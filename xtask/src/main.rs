//! Chores of the project: test, bench, nightly.
fn main() {}
