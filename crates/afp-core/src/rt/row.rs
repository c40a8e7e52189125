//! Tables of constants. The plan's table defines the ports of a template that reads rows, so no
//! toolbox implements it.

use afp_types::ValueRef;

use crate::fault::BadValue;
use crate::rt::native::within_int;
use crate::rt::ports::Ports;

#[derive(Clone, Copy, Debug)]
pub struct RowInputs {
    /// The row's index, from 0.
    pub index: i64,
}

impl Ports for RowInputs {
    #[inline]
    fn check(&self) -> Result<(), BadValue> {
        within_int(0, self.index, 0, i64::MAX)
    }

    fn each(&self, see: &mut dyn FnMut(u16, ValueRef<'_>)) {
        see(0, ValueRef::Int(self.index));
    }
}

/// The row at an index, from 0; `None` after the last row.
#[inline]
pub fn row<T>(rows: &[T], index: i64) -> Option<&T> {
    rows.get(usize::try_from(index).ok()?)
}

#[cfg(test)]
mod tests {
    use super::{Ports, RowInputs, row};
    use crate::fault::Fault;

    #[test]
    fn a_row_is_found_by_its_number() {
        assert_eq!(row(&["a", "b"], 0), Some(&"a"));
        assert_eq!(row(&["a", "b"], 2), None);
        assert_eq!(row(&["a", "b"], i64::MAX), None);
    }

    #[test]
    fn no_row_has_a_negative_number() {
        let wrong = RowInputs { index: -1 }.check().map_err(|why| (why.fault, why.value));
        assert_eq!(wrong, Err((Fault::RANGE, Some(-1.0))));
        assert_eq!(RowInputs { index: 0 }.check(), Ok(()));
        assert_eq!(RowInputs { index: i64::MAX }.check(), Ok(()));
    }
}
