//! Typed templates from a toolbox: a marker, inputs and outcomes for each template, and the
//! devices.
//!
//! An implementing crate has them in a module `templates`. The implementing types have the
//! templates' names in the module around it.

mod cases;
mod complete;
mod declared;
mod devices;
mod outcomes;
mod ports;
mod register;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::Options;
use crate::enums;
use crate::layout::doc;
use crate::names::{PRIMITIVES, camel, ident, snake};
use crate::rust_type::TypePaths;
use afp_dsl::toolbox::{InPort, Template, TemplateKind, Toolbox};
use afp_dsl::types::{Enum, Object, Type};

pub use complete::{Asked, complete};
pub use declared::declaration;
pub use register::{Support, register_supported};

/// The whole output of `toolbox!`.
pub fn toolbox(toolbox: &Toolbox, options: &Options) -> TokenStream {
    let (core, source) = (&options.core, &options.source);
    let text = doc("", "The text of the toolbox file.");
    let rust_name = |choices: &Enum| ident(&camel(&choices.name));
    let enums = toolbox.enums.iter();
    let enums = enums.map(|choices| enums::choices(core, choices, &rust_name(choices)));
    let templates = toolbox.templates.iter().filter(|template| template.reads_table.is_none());
    let templates = templates.map(|t| template(core, t));
    let register = register::register(core, toolbox);
    let devices = devices::devices(core, toolbox);
    quote! {
        #text
        pub const SOURCE: &str = #source;

        #devices
        #(#enums)*
        #(#templates)*
        #register
    }
}

/// The templates that Rust types of the crate implement.
fn implemented(toolbox: &Toolbox) -> impl Iterator<Item = &Template> {
    toolbox.templates.iter().filter(|template| !template.is_declared())
}

struct Words {
    template: Ident,
    component: Ident,
    outcome: Ident,
    outcomes: &'static str,
}

fn words(kind: TemplateKind) -> Words {
    let (template, component, outcome, outcomes) = match kind {
        TemplateKind::Actor => ("ActorTemplate", "Actor", "State", "states"),
        TemplateKind::Supervisor => ("SupervisorTemplate", "Supervisor", "Event", "events"),
        TemplateKind::Computation => ("ComputationTemplate", "Computation", "State", "states"),
    };
    let [template, component, outcome] = [template, component, outcome].map(ident);
    Words { template, component, outcome, outcomes }
}

/// Types for the module of a template.
fn type_paths(core: &TokenStream) -> TypePaths<'_> {
    let choice = &|choices: &Enum| {
        let name = ident(&camel(&choices.name));
        quote!(super::#name)
    };
    let object = &|object: &Object| {
        let name = ident(&camel(&object.name));
        quote!(super::super::#name)
    };
    TypePaths { core: quote!(#core::), quantity: quote!(#core::quantity::), choice, object }
}

/// The module of a template's types. A template whose name collides with the devices' modules or a
/// Rust type gets another name.
pub(crate) fn module(template: &Template) -> Ident {
    let name = snake(&template.name);
    let taken = devices::MODULES.contains(&&*name) || PRIMITIVES.contains(&&*name);
    if taken { ident(&format!("{name}_")) } else { ident(&name) }
}

pub(crate) fn template(core: &TokenStream, template: &Template) -> TokenStream {
    let words = words(template.kind);
    let module = module(template);
    let about = doc("", &format!("Ports and {} of [`{}`].", words.outcomes, camel(&template.name)));
    let inputs = ports::inputs(core, template);
    let live = has_live(template).then(|| ports::live(core, template));
    let outcomes = outcomes::outcomes(core, template);
    let computed = cases::implement(core, template);
    let marker = marker(template);
    let implemented = implement(core, template);
    quote! {
        #marker
        #implemented

        #about
        pub mod #module {
            #inputs
            #live
            #outcomes
            #computed
        }
    }
}

/// Whether components of this kind read inputs while they run.
fn has_live(template: &Template) -> bool {
    template.kind != TemplateKind::Computation
}

fn marker(template: &Template) -> TokenStream {
    let name = ident(&camel(&template.name));
    let help = doc(&template.doc, &format!("The template `{}`.", template.name));
    let body = match bound(template) {
        Some(_) => quote!(<V>(::core::marker::PhantomData<V>)),
        None => TokenStream::new(),
    };
    quote! {
        #help
        #[derive(Clone, Copy, Debug)]
        pub struct #name #body;
    }
}

fn implement(core: &TokenStream, template: &Template) -> TokenStream {
    let Words { template: trait_name, outcome, .. } = words(template.kind);
    let (name, module) = (ident(&camel(&template.name)), module(template));
    let (parameters, arguments) = match bound(template) {
        Some(bound) => (quote!(<V: #core::rt::#bound>), quote!(<V>)),
        None => Default::default(),
    };
    let inputs = Parameters::of(inputs(template).map(|(_, port)| &port.ty)).arguments();
    let live = Parameters::of(live(template).map(|(_, port)| &port.ty)).arguments();
    let outcomes = Parameters::of(template.outputs.iter().map(|port| &port.ty)).owned_arguments();
    let live = has_live(template).then(|| quote!(type Live<'a> = #module::Live #live;));
    quote! {
        impl #parameters #core::#trait_name for self::#name #arguments {
            type Inputs<'a> = #module::Inputs #inputs;
            #live
            type #outcome = #module::#outcome #outcomes;
        }
    }
}

/// The bound on the type parameter for `any`, `number` or `discrete`, if the template has such
/// ports.
fn bound(template: &Template) -> Option<Ident> {
    let types = || {
        let inputs = template.inputs.iter().map(|port| &port.ty);
        inputs.chain(template.outputs.iter().map(|port| &port.ty))
    };
    let bounds = [(Type::Number, "Number"), (Type::Discrete, "Discrete"), (Type::Any, "Any")];
    let bound = bounds.iter().find(|(wanted, _)| types().any(|ty| ty == wanted));
    bound.map(|(_, bound)| ident(bound))
}

/// The inputs before the start, with their positions among all inputs. A computation reads all of
/// its inputs there.
fn inputs(template: &Template) -> impl Iterator<Item = (u16, &InPort)> {
    let all = (0..).zip(&template.inputs);
    all.filter(|(_, port)| !port.live || !has_live(template))
}

/// The live inputs, with their positions among all inputs.
fn live(template: &Template) -> impl Iterator<Item = (u16, &InPort)> {
    let all = (0..).zip(&template.inputs);
    all.filter(|(_, port)| port.live && has_live(template))
}

/// The generic parameters of a struct or enum of ports.
#[derive(Clone, Copy)]
struct Parameters {
    /// It borrows strings or objects.
    borrows: bool,
    /// It owns strings or objects, and cannot be copied.
    owns: bool,
    /// It has objects, which only implement `Clone`.
    opaque: bool,
    /// It has values of the type `V`.
    generic: bool,
}

impl Parameters {
    fn of<'t>(types: impl Iterator<Item = &'t Type>) -> Self {
        let mut all = Parameters { borrows: false, owns: false, opaque: false, generic: false };
        for ty in types {
            let object = matches!(ty, Type::Object(_));
            all.borrows |= object || *ty == Type::Text;
            all.opaque |= object;
            all.generic |= matches!(ty, Type::Any | Type::Number | Type::Discrete);
        }
        all.owns = all.borrows;
        all
    }

    fn arguments(self) -> TokenStream {
        match (self.borrows, self.generic) {
            (true, true) => quote!(<'a, V>),
            (true, false) => quote!(<'a>),
            (false, true) => quote!(<V>),
            (false, false) => TokenStream::new(),
        }
    }

    fn owned_arguments(self) -> TokenStream {
        if self.generic { quote!(<V>) } else { TokenStream::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_syntax::source::Source;

    #[test]
    fn templates_with_names_of_neighbours_are_renamed() {
        let text = "toolbox lamps\ndevice lamp { signal on: bool }\nactor Signal { state Shown }\n\
                    actor Devices { state Done }\nactor Str { state Done }\nactor Blink { state Done }";
        let (lamps, _) = Toolbox::parse(&Source::new("lamps.afp", text), 0, "lamps");
        let lamps = lamps.expect("it is sound");
        let names: Vec<_> = lamps.templates.iter().map(|it| module(it).to_string()).collect();
        assert_eq!(names, ["signal_", "devices_", "str_", "blink"]);
    }
}
