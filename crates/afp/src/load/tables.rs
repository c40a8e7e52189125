//! The rows of a loaded plan: those of the graph, with reasons as faults.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use afp_core::rt::{PlanTable, Tables};
use afp_core::{Fault, Reason};
use afp_dsl::rows::Rows;

/// The rows of one plan, shared with its graph.
#[derive(Clone, Debug)]
pub struct LoadedTables {
    rows: Arc<Rows>,
    reasons: Arc<[Fault]>,
}

impl Tables for LoadedTables {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        self.rows.table(&self.reasons)
    }
}

impl LoadedTables {
    pub fn new(rows: &Arc<Rows>) -> Self {
        let reasons = rows.reasons.iter().map(|text| reason(text)).collect();
        LoadedTables { rows: Arc::clone(rows), reasons }
    }
}

/// The fault of a reason. A fault is a static reference, so each text is kept once for the life of
/// the process.
fn reason(text: &str) -> Fault {
    static KNOWN: LazyLock<Mutex<HashMap<String, &'static Reason>>> = LazyLock::new(Mutex::default);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(reason) = known.get(text) {
        return Fault::new(reason);
    }
    let kept: &'static str = Box::leak(text.into());
    let reason = Box::leak(Box::new(Reason { code: Fault::FAILED, text: kept }));
    known.insert(text.to_owned(), reason);
    Fault::new(reason)
}
