//! Tells copper's macros where their index of log strings goes.

fn main() {
    cu29_build::setup();
}
