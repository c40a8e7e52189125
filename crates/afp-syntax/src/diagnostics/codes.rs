//! The table of all codes.
//!
//! `afpc explain` and `docs/errors/` show the same text, which is embedded here. A code without a
//! page does not compile; a code without a case fails the suite.

use crate::diagnostics::Severity;

macro_rules! codes {
    ($($code:ident $severity:ident $title:literal)*) => {
        /// The rule of a diagnostic.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $(#[doc = $title] $code,)*
        }

        impl Code {
            /// Every code in order.
            pub const ALL: &'static [Code] = &[$(Code::$code),*];

            /// The name of the code, such as `E0203`.
            pub fn as_str(self) -> &'static str {
                match self {
                    $(Code::$code => stringify!($code),)*
                }
            }

            /// The rule in a few words.
            pub fn title(self) -> &'static str {
                match self {
                    $(Code::$code => $title,)*
                }
            }

            /// The severity of a violation.
            pub fn severity(self) -> Severity {
                match self {
                    $(Code::$code => Severity::$severity,)*
                }
            }

            /// The page of `docs/errors/` in Markdown: meaning, example and fix.
            pub fn explanation(self) -> &'static str {
                match self {
                    $(Code::$code => {
                        include_str!(concat!("../../../../docs/errors/", stringify!($code), ".md"))
                    })*
                }
            }
        }
    };
}

codes! {
    E0101 Error "unexpected character"
    E0102 Error "unexpected text"
    E0103 Error "missing closing bracket"
    E0104 Error "unterminated string or unknown escape"
    E0105 Error "block comment"
    E0106 Error "decimal comma"
    E0107 Error "unit sign that is not ASCII"
    E0108 Error "wrong arrow"
    E0109 Error "edge without a target"
    E0110 Warning "help text without a declaration below it"
    E0111 Error "nested too deeply"
    E0112 Error "reserved for later"
    E0113 Error "name that is not ASCII"
    E0114 Error "item in the wrong place"
    E0115 Error "invalid number"
    E0201 Error "unknown template or plan"
    E0202 Error "unknown port"
    E0203 Error "bare number where a unit is needed"
    E0204 Error "wrong dimension"
    E0205 Error "operands of different dimensions"
    E0206 Error "no conversion between the types"
    E0207 Note "conversion that changes the value"
    E0208 Warning "conversion that may fail at run time"
    E0209 Error "unknown entry"
    E0210 Error "unknown state or event"
    E0211 Error "state or event left unconnected"
    E0212 Error "name used twice"
    E0213 Error "name that is not allowed"
    E0214 Error "state or event declared under a reserved name"
    E0215 Error "not exactly one 'start'"
    E0216 Error "unknown target"
    E0217 Error "keyword that does not fit"
    E0218 Error "computation with a supervisor"
    E0219 Error "output with an invalid target"
    E0220 Error "two outputs to one entry"
    E0221 Error "'ignore' on a state"
    E0222 Error "plan that contains itself"
    E0223 Error "one resource commanded twice"
    E0224 Error "value out of range"
    E0225 Error "input without a value"
    E0226 Error "bound or connected twice"
    E0227 Error "input and output mixed up"
    E0228 Error "formula without a value"
    E0229 Error "initial value that is not known yet"
    E0230 Error "string too long"
    E0231 Error "formula, plan or toolbox too large"
    E0232 Error "unknown type"
    E0233 Error "'Interrupted' left unconnected"
    E0235 Error "Celsius inside a formula"
    E0236 Error "unknown unit"
    E0237 Error "ambiguous name"
    E0238 Error "unknown toolbox"
    E0239 Error "unknown value of an enum"
    E0240 Warning "entry named like a unit"
    E0241 Error "type that cannot be inferred"
    E0242 Error "operation that the type does not support"
    E0243 Error "unknown function or wrong number of operands"
    E0244 Error "value whose type has no states"
    E0247 Error "'resume' or 'suspend' where nothing is active"
    E0248 Error "'on' without a supervisor of the plan"
    E0249 Error "reaction that is never taken"
    E0250 Error "invalid column"
    E0251 Error "row that does not fit its table"
    E0252 Warning "table without rows"
    E0253 Error "unknown table"
    E0254 Note "template that hides another one"
    E0255 Error "edge without a name that is not for one state"
    E0256 Error "'return' where nothing is suspended"
    E0257 Error "handler that can be reached without 'suspend'"
    E0301 Warning "input read once from an entry that changes"
    E0302 Warning "element that can never be reached"
    E0303 Error "entry read before it is written"
    E0304 Warning "entry that nothing reads"
    E0305 Error "computations without an exit"
    E0306 Warning "conditions that end the run in a livelock"
    E0307 Warning "plan that can never end"
    E0308 Warning "supervisor that watches for nothing"
    E0309 Warning "recovery that starts itself again"
    E0310 Warning "result that may have no value"
    E0311 Note "element after which the plan cannot end"
    E0312 Warning "loop too long for one step"
    E0313 Warning "sub-plan that fails without an 'Error' edge"
    E0314 Note "fault whose reason is lost"
    E0315 Warning "actor that nothing can end"
    E0316 Warning "'resume' with nothing written"
    E0317 Warning "toggle by an event that lasts"
    E0320 Warning "end of a plan that should run forever"
    E0321 Error "element that cannot be suspended"
    E0322 Warning "handler without 'return'"
    E0323 Warning "event that starts a suspended element again"
    E0401 Error "invalid time"
    E0402 Error "deadline longer than the period"
    E0403 Error "period shorter than the tick"
    E0404 Error "more demand than the target has"
    E0405 Warning "response longer than the deadline"
    E0503 Error "no plan in the file"
    E0504 Error "no plan of that name"
    E0505 Error "unknown version of the language"
    E0506 Error "plan file that cannot be read"
    E0507 Error "invalid path"
    E0508 Error "toolbox used like a plan file"
    E0510 Error "part that does not belong in the template"
    E0511 Error "part given twice"
    E0512 Error "template without states or events"
    E0513 Error "invalid range"
    E0514 Error "invalid port declaration"
    E0515 Error "invalid device declaration"
    E0516 Error "unknown device"
    E0517 Error "device of two toolboxes"
    E0518 Error "template of another robot"
    E0519 Error "invalid declaration of a state or event"
    E0520 Note "sensor that the robot only estimates"
    E0601 Error "line in the wrong place in a scenario"
    E0602 Error "unknown component in a scenario"
    E0603 Error "event that cannot happen in the plan"
    E0604 Error "invalid claim"
    E0605 Error "invalid times in a scenario"
    E0606 Error "unknown action, device or fault"
    E0607 Error "entry that a scenario cannot set"
    E0608 Error "missing values of an outcome"
    E0609 Error "scenario that expects nothing"
}

impl Code {
    /// The code of that name (`E0203`), or `None`.
    pub fn parse(text: &str) -> Option<Code> {
        Code::ALL.iter().copied().find(|code| code.as_str().eq_ignore_ascii_case(text))
    }
}
