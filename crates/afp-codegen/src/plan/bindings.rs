//! The functions between entries and ports: inputs pulled from the configuration, outputs staged.

use proc_macro2::{Ident, Literal, TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::context::{ComponentNames, Context, Paths};
use crate::formula::{Formulas, convert};
use crate::layout::{at, doc};
use crate::names::{camel, ident, snake};
use crate::rust_type::{TypePaths, float};
use afp_dsl::graph::{Entry, Formula, Output};
use afp_dsl::toolbox::{InPort, Template, TemplateKind};
use afp_dsl::types::{Conversion, Type};
use afp_syntax::source::Span;

/// A component for its bindings.
pub struct Bound<'a> {
    pub context: &'a Context<'a>,
    pub names: &'a ComponentNames,
    pub template: &'a Template,
    pub paths: Paths,
    pub generic: Option<&'a Type>,
    pub inputs: &'a [Formula],
    pub outputs: &'a [Output],
    /// The place of its name in the text.
    pub span: Span,
}

pub struct Function {
    /// Its item; empty if it would do nothing.
    pub item: TokenStream,
    /// Statements that declare its scratch strings.
    pub scratch: TokenStream,
    /// The expression that calls it.
    pub call: TokenStream,
}

impl Bound<'_> {
    /// The function for the inputs before the start.
    pub fn inputs(&self) -> Function {
        let about = format!("Inputs of `{}`.", self.names.text);
        self.pulled(&self.names.inputs, "Inputs", &about, |port| !self.is_live(port))
    }

    /// The function for the inputs at every poll.
    pub fn live(&self) -> Function {
        let about = format!("Live inputs of `{}`.", self.names.text);
        self.pulled(&self.names.live, "Live", &about, |port| self.is_live(port))
    }

    fn is_live(&self, port: &InPort) -> bool {
        port.live && self.template.kind != TemplateKind::Computation
    }

    fn pulled(
        &self,
        name: &Ident,
        ty: &str,
        about: &str,
        wanted: impl Fn(&InPort) -> bool,
    ) -> Function {
        let (module, ty) = (&self.paths.module, ident(ty));
        let ports = (0..).zip(self.template.inputs.iter().zip(self.inputs));
        let ports: Vec<_> = ports.filter(|(_, (port, _))| wanted(port)).collect();
        if ports.is_empty() {
            return Function {
                item: TokenStream::new(),
                scratch: TokenStream::new(),
                call: quote!(Ok(#module::#ty {})),
            };
        }
        let generic = ports.iter().any(|(_, (port, _))| is_generic(&port.ty));
        let borrowed = |ty: &Type| matches!(ty, Type::Text | Type::Object(_));
        let borrows = ports.iter().any(|(_, (port, _))| borrowed(&port.ty));
        let (fields, scratch) = self.fields(&ports);
        let reads = ports.iter().any(|(_, (_, formula))| reads_entries(formula));
        let lifetime = borrows.then(|| quote!('a));
        let config = reads.then(|| {
            let lifetime = &lifetime;
            if scratch.is_empty() {
                quote!(config: & #lifetime Config)
            } else {
                quote!(config: & #lifetime Config,)
            }
        });
        let arguments = self.arguments(borrows, generic);
        let generics = lifetime.map(|lifetime| quote!(<#lifetime>));
        let (help, at) = (doc("", about), at(self.span));
        let config_call = reads
            .then(|| if scratch.is_empty() { quote!(&self.config) } else { quote!(&self.config,) });
        Function {
            scratch: quote!(#(let mut #scratch = Text::new();)*),
            call: quote!(#name(#config_call #(&mut #scratch),*)),
            item: quote! {
                #help
                #at
                fn #name #generics (#config #(#scratch: &'a mut Text),*)
                    -> Result<#module::#ty #arguments, BadValue>
                {
                    Ok(#module::#ty { #(#fields),* })
                }
            },
        }
    }

    /// The values of inputs by their names, and the scratch strings for them.
    fn fields(&self, ports: &[(u16, (&InPort, &Formula))]) -> (Vec<TokenStream>, Vec<Ident>) {
        self.context.with_type_paths(|type_paths| {
            let mut formulas = Formulas::new(type_paths, &self.context.entries);
            let fields = ports.iter().map(|(number, (port, formula))| {
                let value = match port.ty {
                    Type::Any | Type::Number | Type::Discrete => formulas.value(formula),
                    _ => formulas.input(formula),
                };
                let value = tried("input", *number, value);
                let (port, at) = (ident(&snake(&port.name)), at(formula.span));
                quote!(#at #port: #value)
            });
            (fields.collect(), formulas.scratch)
        })
    }

    /// The arguments of the type of a template's inputs.
    fn arguments(&self, borrows: bool, generic: bool) -> TokenStream {
        match (borrows, self.generic.filter(|_| generic)) {
            (true, Some(ty)) => {
                let ty = self.context.entry_type(ty);
                quote!(<'a, #ty>)
            }
            (true, None) => quote!(<'a>),
            (false, Some(ty)) => {
                let ty = self.context.entry_type(ty);
                quote!(<#ty>)
            }
            (false, None) => TokenStream::new(),
        }
    }

    /// The function that stages the outputs, and the closure that calls it.
    pub fn outputs(&self) -> Function {
        let (name, module) = (&self.names.outputs, &self.paths.module);
        let outcome = ident(match self.template.kind {
            TemplateKind::Supervisor => "Event",
            TemplateKind::Actor | TemplateKind::Computation => "State",
        });
        let arms: Vec<_> = (0..)
            .zip(&self.template.outcomes)
            .filter_map(|(index, declared)| {
                let variant = ident(&camel(&declared.name));
                let (fields, puts) = self.puts(index)?;
                let rest = (fields.len() < self.carried(index)).then(|| quote!(..));
                Some((quote!(#module::#outcome::#variant { #(#fields,)* #rest }), puts))
            })
            .collect();
        if arms.is_empty() {
            return Function {
                item: TokenStream::new(),
                scratch: TokenStream::new(),
                call: quote!(|_| Ok(())),
            };
        }
        let generic = self.template.outputs.iter().any(|port| is_generic(&port.ty));
        let arguments = self.generic.filter(|_| generic).map(|ty| {
            let ty = self.context.entry_type(ty);
            quote!(<#ty>)
        });
        let body = match (arms.as_slice(), self.template.outcomes.len() - arms.len()) {
            ([(pattern, puts)], 0) => quote!(let #pattern = outcome; #(#puts)*),
            ([(pattern, puts)], _) => quote!(if let #pattern = outcome { #(#puts)* }),
            (arms, missing) => {
                let rest = (missing > 0).then(|| quote!(_ => {}));
                let arms = arms.iter().map(|(pattern, puts)| quote!(#pattern => { #(#puts)* }));
                quote!(match outcome { #(#arms)* #rest })
            }
        };
        let help = doc("", &format!("Outputs of `{}`.", self.names.text));
        let at = at(self.span);
        Function {
            scratch: TokenStream::new(),
            call: quote!(|outcome| #name(&mut self.staged, outcome)),
            item: quote! {
                #help
                #at
                fn #name(staged: &mut Staged, outcome: #module::#outcome #arguments)
                    -> Result<(), BadValue>
                {
                    #body
                    Ok(())
                }
            },
        }
    }

    /// The number of outputs of an outcome.
    fn carried(&self, outcome: u16) -> usize {
        let ports = self.template.outputs.iter();
        ports.filter(|port| port.on.is_empty() || port.on.contains(&outcome)).count()
    }

    /// The bound fields of an outcome, and the statements that stage them.
    ///
    /// Each field is bound to a local with a reserved name: its own name could hide a called
    /// function.
    fn puts(&self, outcome: u16) -> Option<(Vec<TokenStream>, Vec<TokenStream>)> {
        let ports = (0..).zip(&self.template.outputs);
        let carried = ports.filter(|(_, port)| port.on.is_empty() || port.on.contains(&outcome));
        let bound = carried.filter_map(|(number, port)| {
            let output = self.outputs.iter().find(|output| output.port == number)?;
            let generic = is_generic(&port.ty);
            let ty = if generic { self.generic? } else { &port.ty };
            let (name, local) = (ident(&snake(&port.name)), format_ident!("value_{number}"));
            let value = match (generic, ty) {
                // It is already an entry's object.
                (true, Type::Object(_)) => quote!(#local),
                _ => self
                    .context
                    .with_type_paths(|type_paths| staged_value(type_paths, output, ty, &local)),
            };
            let value = limited(&self.context.plan.entries[output.entry.index()], value);
            let value = tried("output", number, value);
            let entry = &self.context.entries[output.entry.index()];
            Some((quote!(#name: #local), quote!(staged.#entry = Some(#value);)))
        });
        let (fields, puts): (Vec<_>, Vec<_>) = bound.unzip();
        (!fields.is_empty()).then_some((fields, puts))
    }
}

/// The value of an output port in its entry's type.
fn staged_value(
    type_paths: &TypePaths<'_>,
    output: &Output,
    ty: &Type,
    value: &Ident,
) -> TokenStream {
    match (&output.conversion, ty) {
        (None, Type::Quantity(_)) => quote!(finite(#value)?),
        (None, Type::Object(_)) => quote!(Object::new(#value)),
        (None, _) => quote!(#value),
        (Some(conversion), ty) => converted(type_paths, conversion, ty, quote!(#value)),
    }
}

pub fn limited(entry: &Entry, value: TokenStream) -> TokenStream {
    match entry.range {
        Some((least, greatest)) => {
            let (least, greatest) = (float(least), float(greatest));
            quote!(limited(#value, #least, #greatest)?)
        }
        None => value,
    }
}

/// A fallible value, with its port or entry.
pub fn tried(what: &str, number: u16, value: TokenStream) -> TokenStream {
    if !can_fail(&value) {
        return value;
    }
    let (what, number) = (ident(what), Literal::u16_unsuffixed(number));
    let value = refusing(&value).unwrap_or_else(|| quote!(Ok(#value)));
    quote!(#what(#number, || #value)?)
}

/// A fallible call, without the final `?`.
fn refusing(value: &TokenStream) -> Option<TokenStream> {
    let tokens: Vec<_> = value.clone().into_iter().collect();
    match tokens.as_slice() {
        [TokenTree::Ident(called), TokenTree::Group(values), _question]
            if called == "limited" || called == "finite" =>
        {
            Some(quote!(#called #values))
        }
        _ => None,
    }
}

/// Whether an expression can return early.
fn can_fail(value: &TokenStream) -> bool {
    value.clone().into_iter().any(|token| match token {
        TokenTree::Punct(punct) => punct.as_char() == '?',
        TokenTree::Group(group) => can_fail(&group.stream()),
        TokenTree::Ident(_) | TokenTree::Literal(_) => false,
    })
}

/// A value converted for its entry; numbers from a string or an `int` are finite.
pub fn converted(
    type_paths: &TypePaths<'_>,
    conversion: &Conversion,
    ty: &Type,
    value: TokenStream,
) -> TokenStream {
    match (conversion, ty) {
        (Conversion::ToText(Type::Text), _) => value,
        (Conversion::FromText(_), Type::Text) => {
            convert(type_paths, conversion, quote!(#value.as_str()))
        }
        _ => convert(type_paths, conversion, value),
    }
}

fn is_generic(ty: &Type) -> bool {
    matches!(ty, Type::Any | Type::Number | Type::Discrete)
}

pub fn reads_entries(formula: &Formula) -> bool {
    formula.entries().next().is_some()
}
