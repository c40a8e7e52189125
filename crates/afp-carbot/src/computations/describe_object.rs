//! Describe an object by its colour.

use crate::objects::Appearance;
use crate::templates;
use crate::templates::describe_object::{Inputs, State};
use afp_core::{Computation, Fault};

/// Makes an appearance of one colour.
#[derive(Clone, Copy, Debug)]
pub struct DescribeObject;

impl Computation<templates::DescribeObject> for DescribeObject {
    fn compute(inputs: Inputs) -> Result<State, Fault> {
        let Inputs { red, green, blue, tolerance } = inputs;
        Ok(State::Done { look: Appearance::of_color([red, green, blue], tolerance) })
    }
}
