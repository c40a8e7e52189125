//! An empty path to begin with.

use crate::objects::Path;
use crate::templates;
use crate::templates::new_path::{Inputs, State};
use afp_core::{Computation, Fault};

/// Makes a path without places.
#[derive(Clone, Copy, Debug)]
pub struct NewPath;

impl Computation<templates::NewPath> for NewPath {
    fn compute(_: Inputs) -> Result<State, Fault> {
        Ok(State::Done { path: Path::default() })
    }
}
