//! The whole contract between a plan and the scheduler.
//!
//! Code made by `plan!`, `toolbox!` and `afpc build`, and plans loaded at run time, use this module
//! and nothing else of the crate's inside. It is public for them alone; no other code should name it.

mod formula;
mod names;
mod native;
mod plan;
mod ports;
mod probe;
mod row;
mod run;
mod state;
mod store;
mod sub_plan;
mod table;
mod write;

pub use afp_types::function::*;
pub use afp_types::{
    Scale, Unit, bool_to_float, bool_to_int, float_to_int, int_add, int_mul, int_neg, int_rem,
    int_sub, int_to_float, parse_bool, parse_choice, parse_float, parse_int, parse_quantity, rem,
};
pub use formula::{divisor, join, order, print_quantity};
pub use names::{ComponentRow, EntryRow, NameTable, NamedPlan, PortRow};
pub use native::{
    finite, initial, input, limited, output, print_choice, read_choice, set_input, stage_outside,
    store_text, within, within_int, within_value,
};
pub use plan::{Committer, Cx, Fired, Flow, Polled, Slot, Started};
pub(crate) use plan::{Place, StepState};
pub use ports::{Args, FromArgs, Outcome, Outputs, Ports, Registry};
pub use probe::{ActorSupported, Probe, SupervisorSupported, Unsupported};
pub use row::{RowInputs, row};
pub use run::Run;
pub use state::{AtElement, Plan, PlanState};
pub use store::{Any, Choice, Discrete, Entry, Number, Object, Stored, Writable};
pub use table::{
    Child, ElementId, ElementKind, ElementRow, PlanTable, Range, ReasonId, SupervisorId,
    SupervisorRow, Tables, Target, Timing,
};
pub use write::WriteError;

pub use crate::fault::BadValue;

pub use crate::component::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Environment, Events, Supervisor,
    SupervisorTemplate,
};
pub use crate::machine::Machine;
