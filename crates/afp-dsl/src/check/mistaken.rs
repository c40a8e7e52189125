//! Elements with the ports and states of another template, which was meant.

use super::Program;
use super::places::Ranges;
use crate::toolbox::Template;
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Errors about the ports and edges of a component.
const OF_TEMPLATE: &[Code] = &[Code::E0202, Code::E0210, Code::E0211, Code::E0225];

/// The maximum number of components that are compared with all templates.
const MOST: usize = 100;

/// Reports only the template, if several of its ports and states do not exist and another template
/// has all of them.
pub(super) fn hold_back(program: &Program<'_>, diags: &mut Diagnostics) {
    let places = |code: Code| -> Vec<Span> {
        diags.iter().filter(|each| each.code == code).map(|each| each.span).collect()
    };
    let (ports, states) = (places(Code::E0202), places(Code::E0210));
    if ports.is_empty() || states.is_empty() || ports.len() > MOST {
        return;
    }
    let elements = program.plans.iter().flat_map(|head| head.node.elements());
    let wrong = elements.filter(|element| {
        let has = |places: &[Span]| places.iter().any(|place| element.span().contains(*place));
        has(&ports) && has(&states)
    });
    let mut found = Vec::new();
    for element in wrong {
        let Some(template) = element.template() else { continue };
        let Some(meant) = meant(program, &element) else { continue };
        let message = message!("'{}' has these ports and states", meant);
        let error = Diagnostic::new(Code::E0202, template.span(), message).write(meant);
        found.push((element.span(), error));
    }
    let (spans, errors): (Vec<_>, Vec<_>) = found.into_iter().unzip();
    let spans = Ranges::new(spans);
    diags.retain(|each| !(OF_TEMPLATE.contains(&each.code) && spans.any(each.span)));
    errors.into_iter().for_each(|error| diags.push(error));
}

/// The only template with all ports and states of an element.
fn meant<'p>(program: &'p Program<'_>, element: &ast::Element) -> Option<&'p str> {
    let own = element.template()?.name()?;
    let binds = element.binds();
    let edges = element.edges();
    let has_ports = |template: &Template| {
        let mut binds = binds.iter().map(|bind| &bind.port().text);
        binds.all(|port| {
            template.inputs.iter().any(|it| it.name == *port)
                || template.outputs.iter().any(|it| it.name == *port)
        })
    };
    let has_states = |template: &Template| {
        let mut names = edges.iter().flat_map(|edge| &edge.names);
        names.all(|name| {
            name.text == "Error" || template.outcomes.iter().any(|it| it.name == name.text)
        })
    };
    let templates = || program.toolboxes.iter().flat_map(|toolbox| &toolbox.templates);
    let kind = templates().find(|it| it.name == own.text)?.kind;
    let mut fitting = templates().filter(|it| it.kind == kind && has_ports(it) && has_states(it));
    let only = fitting.next()?;
    fitting.next().is_none().then_some(&*only.name)
}
