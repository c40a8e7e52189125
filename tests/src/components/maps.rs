//! An object type, its maker and its reader.

use afp_core::{Computation, Fault};

use crate::templates::{self, make_map, read_map};

/// A type that only components can read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Map(i64);

#[derive(Debug)]
pub struct MakeMap;

/// Looks into a map.
#[derive(Debug)]
pub struct ReadMap;

impl Computation<templates::MakeMap> for MakeMap {
    fn compute(inputs: make_map::Inputs) -> Result<make_map::State, Fault> {
        Ok(make_map::State::Done { map: Map(inputs.id) })
    }
}

impl Computation<templates::ReadMap> for ReadMap {
    fn compute(inputs: read_map::Inputs<'_>) -> Result<read_map::State, Fault> {
        Ok(read_map::State::Done { id: inputs.map.0 })
    }
}
