//! The computations of the toolbox, a file each.

mod describe_object;
mod new_path;
mod widest_gap;

pub use describe_object::DescribeObject;
pub use new_path::NewPath;
pub use widest_gap::WidestGap;
