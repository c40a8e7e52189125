//! Reads rows of tables. It is not in a registry, since its ports are those of the plan's table.

use std::sync::Arc;

use afp_core::Value;
use afp_core::rt::{Args, BadValue, Outputs, Ports, RowInputs, input, row};
use afp_dsl::table::Table;

use super::slots::{ComputationSlot, See};

/// The states, as declared in the toolbox.
const ROW: u16 = 0;
const END: u16 = 1;

/// Reaches `Row` with the columns as outputs, or `End`.
#[derive(Clone)]
pub struct RowSlot {
    rows: Arc<[Box<[Value]>]>,
}

impl RowSlot {
    /// A reader of a table without errors.
    pub fn new(table: &Table) -> Self {
        let rows = table.rows.iter();
        let rows = rows.map(|row| row.iter().map(|cell| cell.value.clone()).collect());
        RowSlot { rows: rows.collect() }
    }
}

impl ComputationSlot for RowSlot {
    fn compute(
        &self,
        args: &dyn Args,
        see: See<'_>,
        to: &mut dyn Outputs,
    ) -> Result<u16, BadValue> {
        let inputs = RowInputs { index: input(0, || Ok(args.int(0)?))? };
        if let Some(see) = see {
            inputs.each(see);
        }
        inputs.check()?;
        let Some(row) = row(&self.rows, inputs.index) else { return Ok(END) };
        for (port, value) in (0..).zip(row) {
            to.value(port, value.clone());
        }
        Ok(ROW)
    }

    fn try_clone(&self) -> Option<Box<dyn ComputationSlot>> {
        Some(Box::new(self.clone()))
    }
}
