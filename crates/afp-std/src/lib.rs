//! The `std` toolbox: templates that need no robot.
