//! Reasons of failures.

mod detail;

use core::fmt;

use crate::trace::{ComponentId, Names};

pub(crate) use detail::Port;
pub use detail::{BadValue, Detail, Subject};

/// A reason why a component failed. It is one pointer, so that poll results stay in registers.
#[derive(Clone, Copy)]
pub struct Fault(&'static Reason);

/// The target of a [`Fault`]; templates declare their own as constants.
///
/// ```
/// use afp_core::{Fault, Reason};
/// const NO_ECHO: Fault = Fault::new(&Reason { code: "no-echo", text: "no valid range for 500 ms" });
/// assert_eq!(NO_ECHO.code(), "no-echo");
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct Reason {
    /// A short name in kebab case, stable over versions.
    pub code: &'static str,
    /// The message for users.
    pub text: &'static str,
}

/// A component that failed, and the reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// The component; 0 is the plan itself.
    pub component: ComponentId,
    /// The reason.
    pub fault: Fault,
    /// The value that caused the fault, if any.
    pub detail: Option<Detail>,
}

/// Declares faults as constants with documentation, code and text.
///
/// ```
/// afp_core::faults! {
///     /// The light sensor does not answer.
///     pub NO_LIGHT = "no-light", "the light sensor does not answer";
/// }
/// assert_eq!(NO_LIGHT.code(), "no-light");
/// ```
#[macro_export]
macro_rules! faults {
    ($($(#[$doc:meta])* $vis:vis $name:ident = $code:literal, $text:literal;)*) => {$(
        $(#[$doc])*
        $vis const $name: $crate::Fault =
            $crate::Fault::new(&$crate::Reason { code: $code, text: $text });
    )*};
}

impl Fault {
    faults! {
        /// Overflow, `% 0`, or a result that is not finite.
        pub ARITHMETIC = "arithmetic", "a formula overflowed, divided by zero, or has no finite value";
        /// A value outside the range of its port or entry.
        pub RANGE = "range", "a value is out of its range";
        /// A string that is not a value of the target type.
        pub CONVERSION = "conversion", "a text does not read as the value it should become";
        /// A string of more than 64 bytes.
        pub TOO_LONG = "too-long", "a text is longer than 64 bytes";
        /// An object that was read before it was written.
        pub UNSET = "unset", "an object is read before it was written";
        /// More than `MAX_TRANSITIONS_PER_STEP` edges in one step.
        pub LIVELOCK = "livelock", "the plan takes edge after edge without time passing";
        /// A component panicked.
        pub PANIC = "panic", "a component panicked";
        /// The sink, the clock or the driver of a step panicked.
        pub PANIC_OUTSIDE = "panic-outside", "the sink or the clock of the run panicked";
        /// A test injected this fault.
        pub INJECTED = "injected", "a test made the component fail";
        /// The run time reached a state that the compiler excludes.
        pub INTERNAL = "internal", "the run time met an impossible state";
    }

    /// A fault with your own reason.
    pub const fn new(reason: &'static Reason) -> Self {
        Fault(reason)
    }

    /// The [`Fault::code`] of a plan that ended by an edge to `fail`; the text is the plan's own.
    pub const FAILED: &str = "failed";

    /// The reason's short name.
    pub const fn code(self) -> &'static str {
        self.0.code
    }

    /// The message for users.
    pub const fn text(self) -> &'static str {
        self.0.text
    }

    /// The message with the value that caused it, if any: `'speed' of 'go' is 2 m/s, at most 1 m/s;
    /// formula at plan.afp:12:30`.
    pub fn explained<'n, N: Names + ?Sized>(
        self,
        detail: Option<Detail>,
        names: &'n N,
    ) -> impl fmt::Display + use<'n, N> {
        detail::Explained { fault: self, detail, names }
    }
}

impl Failure {
    /// Formats the failure: `go (Forward): the drive does not move`.
    pub fn named(self, names: &impl Names) -> impl fmt::Display {
        NamedFailure(self, names)
    }
}

struct NamedFailure<'a, N>(Failure, &'a N);

impl<N: Names> fmt::Display for NamedFailure<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Failure { component, fault, detail } = self.0;
        let name = self.1.component(component);
        let fault = fault.explained(detail, self.1);
        match name.template {
            "" => write!(f, "{}: {fault}", name.path),
            template => write!(f, "{} ({template}): {fault}", name.path),
        }
    }
}

impl PartialEq for Fault {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl Eq for Fault {}

impl fmt::Debug for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Fault({})", self.0.code)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.text)
    }
}

impl core::error::Error for Fault {}
