//! The command line of Action Flow Plans.
fn main() {}
