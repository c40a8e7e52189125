//! The declarations of a toolbox file: templates with their ports, timing, help and icons, and
//! devices.

pub mod case;
pub mod device;
pub mod fact;

use crate::table::Table;
use crate::types::{Enum, Object, Type};
use afp_syntax::source::Span;
use std::sync::Arc;

pub use crate::types::Constant;
pub use afp_syntax::ast::TemplateKind;
pub use case::{Case, Condition};
pub use device::{Amount, Control, Device, DeviceKind, Fault, Signal, SignalType};
pub use fact::Fact;

/// A checked toolbox file.
#[derive(Clone, Debug, Default)]
pub struct Toolbox {
    /// Its name in `use`.
    pub name: String,
    /// Its version; empty by default.
    pub version: String,
    /// Its `///` lines.
    pub doc: String,
    pub devices: Vec<Device>,
    pub templates: Vec<Template>,
    pub enums: Vec<Arc<Enum>>,
    /// The object types, in source order.
    pub objects: Vec<Arc<Object>>,
    /// The Rust crate (a path such as `afp_carbot`) that implements it.
    pub rust_path: String,
    /// The span of the name.
    pub span: Span,
}

impl Toolbox {
    /// Whether it declares facts of a whole robot, so that it is a robot's toolbox.
    pub(crate) fn declares_robot(&self) -> bool {
        self.devices.iter().any(|device| device.kind == DeviceKind::Robot)
    }

    /// Whether it has a name. The computations of a plan file are a toolbox without a name.
    pub fn is_named(&self) -> bool {
        !self.name.is_empty()
    }

    pub(crate) fn is_built_in(&self) -> bool {
        matches!(&*self.rust_path, "afp_std" | "afp_carbot")
    }

    /// Whether it declares an enum or an object type of that name.
    pub fn has_type(&self, name: &str) -> bool {
        let mut types =
            self.enums.iter().map(|it| &it.name).chain(self.objects.iter().map(|it| &it.name));
        types.any(|known| known == name)
    }
}

/// One actor, supervisor or computation that plans can use.
#[derive(Clone, Debug, Default)]
pub struct Template {
    pub kind: TemplateKind,
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// The name of its icon, without folder and extension.
    pub icon: Option<String>,
    /// Whether an actor can be suspended and continue later.
    pub resumable: bool,
    /// The resources that it controls exclusively.
    pub uses: Vec<String>,
    /// The other devices that a robot must have.
    pub needs: Vec<String>,
    pub inputs: Vec<InPort>,
    pub outputs: Vec<OutPort>,
    /// The states, or a supervisor's events, in source order.
    pub outcomes: Vec<Outcome>,
    /// The states of a declared computation, with their conditions and assignments.
    pub cases: Option<Arc<[Case]>>,
    /// The declared facts of a supervisor's events.
    pub facts: Arc<[Fact]>,
    /// The port whose values are the states. [`Template::outcomes`] is empty until an enum is bound
    /// to it.
    pub states_of: Option<StatesOf>,
    /// The port for a table whose columns are the outputs; there are none until a table is bound to
    /// it. No Rust type implements such a template: each back end reads its tables itself.
    pub reads_table: Option<ReadsTable>,
    /// Poll period in nanoseconds (default 10 ms).
    pub every: u64,
    /// Deadline in nanoseconds, if declared.
    pub deadline: Option<u64>,
    /// Bound of one poll in nanoseconds, if declared.
    pub budget: Option<u64>,
    /// Time from interruption to standstill in nanoseconds, if declared.
    pub stop: Option<u64>,
    /// The span of the name.
    pub span: Span,
}

impl Template {
    /// Whether no Rust or Python code implements it.
    pub fn is_declared(&self) -> bool {
        self.cases.is_some() || self.states_of.is_some() || self.reads_table.is_some()
    }

    /// The table that it reads, in the template of a component, and the port for it.
    pub fn table(&self) -> Option<(&InPort, &Arc<Table>)> {
        let reads = self.reads_table.as_ref()?;
        Some((&reads.port, reads.table.as_ref()?))
    }
}

/// The states of a template with one state for each value of an enum.
#[derive(Clone, Debug)]
pub struct StatesOf {
    /// The index of the input port.
    pub port: u16,
    /// The `///` lines above it.
    pub doc: String,
    /// The span of the word `states`.
    pub span: Span,
    /// The enum, in the template of a component.
    pub home: Option<Arc<Enum>>,
}

#[derive(Clone, Debug)]
pub struct ReadsTable {
    /// The index of the input port.
    pub port: InPort,
    /// The table, in the template of a component; there the port is absent.
    pub table: Option<Arc<Table>>,
}

#[derive(Clone, Debug)]
pub struct InPort {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Its type, which may be `any` or `number`.
    pub ty: Type,
    /// Whether it is read again at every poll.
    pub live: bool,
    /// The value of an unbound port.
    pub default: Option<Constant>,
    /// Least and greatest allowed value (`int`, `float` and quantities, in SI units).
    pub range: Option<(f64, f64)>,
    /// The span of the name.
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct OutPort {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Its type, which may be `any` or `number`.
    pub ty: Type,
    /// The indices of the outcomes that carry it; all of them without `on`.
    pub on: Vec<u16>,
    /// The span of the name.
    pub span: Span,
}

/// A state or an event.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Whether it is an event at an instant, declared with `once`.
    pub once: bool,
    /// The span of the name.
    pub span: Span,
}
