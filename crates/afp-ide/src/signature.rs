//! The ports of the element or supervisor at the cursor.

use std::ops::Range;

use crate::View;
use crate::describe::bound;
use afp_draw::formula::constant;
use afp_dsl::outline::{Component, Input, Output};
use afp_dsl::toolbox::Constant;
use afp_syntax::source::Span;

/// The ports of a template or plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The whole text: `Forward(distance: length = 100 cm, driven => length)`.
    pub label: String,
    pub doc: String,
    /// The ports in order.
    pub ports: Vec<Port>,
    /// The port at the cursor.
    pub active: Option<usize>,
}

/// A port of a [`Signature`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Port {
    pub label: Range<usize>,
    pub doc: String,
}

/// Returns the ports of the component whose parentheses contain a byte offset; `None` elsewhere,
/// and for an unknown template.
pub fn signature(view: &View, offset: u32) -> Option<Signature> {
    let component = around(view, offset)?;
    let template = component.template.as_ref()?;
    template.made_from.as_ref()?;
    let doc = view.index().name(template.name_span).and_then(|name| name.meaning.definition());
    let doc = doc.map(|id| view.index().definition(id).doc.clone()).unwrap_or_default();
    let place = view.place(offset);
    let mut signature =
        Signature { label: format!("{}(", template.text), doc, ports: Vec::new(), active: None };
    let inputs = component.inputs.iter().filter(|port| port.nth == 1);
    for input in inputs.filter(|port| port.declared.is_some()) {
        let covers = input.binding.as_ref().is_some_and(|it| it.span.contains(place));
        signature.push(&input_text(input), help(view, input.declared), covers);
    }
    let outputs = component.outputs.iter().filter(|port| port.nth == 1);
    for output in outputs.filter(|port| port.declared.is_some()) {
        let covers = output.binding.as_ref().is_some_and(|it| it.span.contains(place));
        signature.push(&output_text(output), help(view, output.declared), covers);
    }
    signature.label.push(')');
    Some(signature)
}

impl Signature {
    fn push(&mut self, text: &str, doc: String, active: bool) {
        if !self.ports.is_empty() {
            self.label += ", ";
        }
        let start = self.label.len();
        self.label += text;
        if active {
            self.active = Some(self.ports.len());
        }
        self.ports.push(Port { label: start..self.label.len(), doc });
    }
}

/// The component whose parentheses contain a byte offset.
fn around<'a>(view: &View<'a>, offset: u32) -> Option<&'a Component> {
    let place = view.place(offset);
    let mut components = view.plan_at(offset)?.components();
    components.find(|component| {
        let Some(args) = component.args_span else { return false };
        let closed = view.text_of(args).ends_with(')');
        args.contains(place) && offset > args.start && !(closed && offset == args.end)
    })
}

fn help(view: &View, declared: Option<Span>) -> String {
    let id = declared.and_then(|span| view.index().declared_at(span));
    id.map(|id| view.index().definition(id).doc.clone()).unwrap_or_default()
}

/// `distance: length = 100 cm from -1000 m to 1000 m`
pub(crate) fn input_text(input: &Input) -> String {
    let ty = input.ty.as_ref();
    let mut text = input.name.to_string();
    text += &ty.map(|ty| format!(": {ty}")).unwrap_or_default();
    text += &input
        .default
        .as_ref()
        .map(|it: &Constant| format!(" = {}", constant(it, ty)))
        .unwrap_or_default();
    if let Some((from, to)) = input.range {
        text += &format!(" from {} to {}", bound(from, ty), bound(to, ty));
    }
    text
}

/// `driven => length`
pub(crate) fn output_text(output: &Output) -> String {
    let ty = output.ty.as_ref().map(|ty| format!(" => {ty}")).unwrap_or_default();
    format!("{}{ty}", output.name)
}
