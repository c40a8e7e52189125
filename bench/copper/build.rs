//! Sets the path of copper's index of log strings for its macros.

fn main() {
    cu29_build::setup();
}
