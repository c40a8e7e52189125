//! Why something cannot go on.

mod detail;

use core::fmt;

use crate::trace::{ComponentId, Names};

pub(crate) use detail::Port;
pub use detail::{BadValue, Detail, Subject};

/// A reason why a component failed. One pointer, so that results of polls stay in registers.
#[derive(Clone, Copy)]
pub struct Fault(&'static Reason);

/// What a [`Fault`] points to; a template declares its own as constants.
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
    /// What happened, for people.
    pub text: &'static str,
}

/// Which component of a plan failed, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// The component; 0 is the plan itself.
    pub component: ComponentId,
    /// Why.
    pub fault: Fault,
    /// The value that it is about, where it is about one.
    pub detail: Option<Detail>,
}

/// Faults as constants: each with its documentation, its code and its text.
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
        /// A text that does not read as the type it is converted to.
        pub CONVERSION = "conversion", "a text does not read as the value it should become";
        /// A text of more than 64 bytes.
        pub TOO_LONG = "too-long", "a text is longer than 64 bytes";
        /// An object that nobody has written yet.
        pub UNSET = "unset", "an object is read before it was written";
        /// More than `MAX_TRANSITIONS_PER_STEP` edges in one step.
        pub LIVELOCK = "livelock", "the plan takes edge after edge without time passing";
        /// A component panicked.
        pub PANIC = "panic", "a component panicked";
        /// The sink or the clock of a step panicked, whoever drives the plan.
        pub PANIC_OUTSIDE = "panic-outside", "what records or times the run panicked";
        /// A test made a component fail.
        pub INJECTED = "injected", "a test made the component fail";
        /// The run time met a state that the compiler rules out.
        pub INTERNAL = "internal", "the run time met an impossible state";
    }

    /// A fault with a reason of one's own.
    pub const fn new(reason: &'static Reason) -> Self {
        Fault(reason)
    }

    /// The [`Fault::code`] of what an edge to `fail` ends a plan with; the text is the plan's own.
    pub const FAILED: &str = "failed";

    /// The reason's short name.
    pub const fn code(self) -> &'static str {
        self.0.code
    }

    /// What happened, for people.
    pub const fn text(self) -> &'static str {
        self.0.text
    }

    /// What happened, for people, with the value that it is about, if it is about one:
    /// `'speed' of 'go' is 2 m/s, at most 1 m/s; formula at plan.afp:12:30`.
    pub fn explained<'n, N: Names + ?Sized>(
        self,
        detail: Option<Detail>,
        names: &'n N,
    ) -> impl fmt::Display + use<'n, N> {
        detail::Explained { fault: self, detail, names }
    }
}

impl Failure {
    /// The failure as people read it: `go (Forward): the drive does not move`.
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
