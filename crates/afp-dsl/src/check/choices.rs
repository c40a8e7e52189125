//! Templates whose states are the values of an enum: one for each enum that a plan can bind.
//!
//! The toolbox declares one template. The graph has the states of the bound enum, so that its users
//! find ordinary states.

use std::rc::Rc;
use std::sync::Arc;

use crate::check::edges::{DEADLINE_MISSED, ERROR};
use crate::check::scope::FileScope;
use crate::check::signature::{Signature, Signatures};
use crate::gather::PlanFile;
use crate::graph::{EntryId, Formula, Op};
use crate::toolbox::{Case, Condition, Outcome, StatesOf, Template, Toolbox};
use crate::types::text::a_type;
use crate::types::{Enum, Type};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_types::Comparison;

/// Adds a template for each enum to the used toolboxes, if a file uses such a template.
pub(super) fn specialise(
    linked: &mut [Arc<Toolbox>],
    files: &[PlanFile],
    scopes: &[FileScope<'_>],
) {
    for toolbox in linked {
        let named = |template: &&Template| {
            let said = |file: &PlanFile| file.source.text.contains(&template.name);
            template.states_of.is_some() && files.iter().any(said)
        };
        let open: Vec<_> = toolbox.templates.iter().filter(named).cloned().collect();
        if open.is_empty() {
            continue;
        }
        let enums = enums(scopes);
        let own = Arc::make_mut(toolbox);
        for template in open {
            own.templates.extend(enums.iter().map(|home| of_enum(&template, home)));
        }
    }
}

/// All enums that a file can name, each once.
fn enums(scopes: &[FileScope<'_>]) -> Vec<Arc<Enum>> {
    let mut found: Vec<Arc<Enum>> = Vec::new();
    for (_, home) in scopes.iter().flat_map(|scope| &scope.types.enums) {
        if !found.contains(home) {
            found.push(home.clone());
        }
    }
    found
}

fn of_enum(template: &Template, home: &Arc<Enum>) -> Template {
    let spans = home.variant_spans.iter().copied().chain(std::iter::repeat(home.span));
    let outcomes = home.variants.iter().zip(spans);
    let outcome = |(name, span): (&String, Span)| Outcome {
        name: name.clone(),
        doc: String::new(),
        once: false,
        span,
    };
    let states = template.states_of.clone();
    let cases = states.as_ref().map(|states| cases(states, home));
    Template {
        cases,
        outcomes: outcomes.map(outcome).collect(),
        states_of: states.map(|states| StatesOf { home: Some(home.clone()), ..states }),
        ..template.clone()
    }
}

fn cases(states: &StatesOf, home: &Arc<Enum>) -> Arc<[Case]> {
    let formula = |op| Formula::new(op, [], Type::Enum(home.clone()), states.span);
    let last = home.variants.len().saturating_sub(1);
    let places = (0..).take(home.variants.len());
    let cases = places.map(|place: u16| Case {
        when: Vec::from_iter((usize::from(place) < last).then(|| Condition {
            left: formula(Op::Entry(EntryId(states.port))),
            comparison: Comparison::Equal,
            right: formula(Op::Choice(place)),
        })),
        writes: Vec::new(),
    });
    cases.collect()
}

/// The signature with the states of the enum that is bound; the signature itself where it has states
/// of its own. Reports what is bound instead of an enum.
pub(super) fn chosen(
    signatures: &Signatures,
    signature: &Rc<Signature>,
    generic: Option<&Type>,
    at: Span,
    diags: &mut Diagnostics,
) -> Option<Rc<Signature>> {
    let is_open = signature.template().is_some_and(|template| template.states_of.is_some());
    if !is_open {
        return Some(signature.clone());
    }
    let (id, _) = signature.template.as_ref()?;
    let home = match generic? {
        Type::Enum(home) => home,
        other => {
            let message = message!(
                "the states of '{}' are the values of an enum, and this is {}",
                signature.name,
                Words(a_type(other))
            );
            diags.push(
                Diagnostic::new(Code::E0244, at, message)
                    .help("bind an enum, or compare the value in a computation"),
            );
            return None;
        }
    };
    if let Some(index) =
        home.variants.iter().position(|v| [ERROR, DEADLINE_MISSED].contains(&v.as_str()))
    {
        let message = message!(
            "'{}' has the value '{}', which no state can be called",
            home.name,
            home.variants[index]
        );
        let declared = home.variant_spans.get(index).copied().unwrap_or(home.span);
        diags.push(
            Diagnostic::new(Code::E0244, at, message)
                .note(declared, "declared here")
                .help("give the value another name"),
        );
        return None;
    }
    signatures.of_enum(id.toolbox, &signature.name, home)
}
