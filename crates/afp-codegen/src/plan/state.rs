//! The plan's data: its configuration, its staged values, and its interface to the scheduler.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::bindings::{limited, tried};
use super::context::Context;
use super::holder::Holder;
use crate::formula::{Formulas, is_literal};
use crate::layout::{at, doc};
use crate::rust_type::float;
use afp_dsl::graph::{Component, Entry, EntryKind};
use afp_dsl::types::Type;

/// The structs of the plan, its configuration and its staged values.
pub fn structure(context: &Context<'_>) -> TokenStream {
    let (plan, ty) = (context.plan, &context.ty);
    let about = doc(&plan.doc, &format!("The plan `{}`.", plan.name));
    let entries = || plan.entries.iter().zip(&context.entries);
    let fields = entries().map(|(entry, name)| {
        let (help, ty) = (entry_doc(entry), context.entry_type(&entry.ty));
        let at = at(entry.span);
        quote!(#help #at pub #name: Entry<#ty>,)
    });
    let staged = entries().zip(&context.written).filter(|(_, written)| **written);
    let staged = staged.map(|((entry, name), _)| {
        let (ty, at) = (context.entry_type(&entry.ty), at(entry.span));
        quote!(#at #name: Option<#ty>,)
    });
    let read = entries().zip(&context.read).filter(|(_, read)| **read);
    let getters: Vec<_> = read.map(|((entry, name), _)| getter(context, entry, name)).collect();
    let getters = (!getters.is_empty()).then(|| quote!(impl Config { #(#getters)* }));
    let [config, shadow] =
        ["The configuration.", "The values of the next commit."].map(|t| doc("", t));
    let started = Holder::all(context).into_iter();
    let started = started.map(|Holder { ty, field, .. }| quote!(#field: #ty,));
    quote! {
        #about
        #[derive(Clone, Default)]
        pub struct #ty {
            pub(super) config: Config,
            staged: Staged,
            #(#started)*
            supervisors: Supervisors,
        }

        #config
        #[derive(Clone, Debug, Default)]
        pub struct Config {
            #(#fields)*
        }

        #shadow
        #[derive(Clone, Default)]
        struct Staged {
            #(#staged)*
        }

        #getters
    }
}

/// The help of an entry with its kind and type.
pub fn entry_doc(entry: &Entry) -> TokenStream {
    let kind = entry.kind.word();
    let facts = format!("`{kind} {}: {}`", entry.name, entry.ty);
    if entry.doc.is_empty() {
        doc("", &facts)
    } else {
        doc(&format!("{}\n\n{facts}", entry.doc), "")
    }
}

fn getter(context: &Context<'_>, entry: &Entry, name: &Ident) -> TokenStream {
    let value = context.value_type(&entry.ty);
    let help = doc("", &format!("The value of `{}`.", entry.name));
    let at = at(entry.span);
    let (ty, body) = match entry.ty {
        Type::Text => (quote!(&str), quote!(self.#name.get().as_str())),
        Type::Object(_) => (quote!(Result<&#value, Fault>), quote!(self.#name.get().get())),
        _ => (value, quote!(*self.#name.get())),
    };
    quote! {
        #help
        #[inline]
        #at
        pub fn #name(&self) -> #ty { #body }
    }
}

fn number(index: usize) -> Literal {
    Literal::usize_unsuffixed(index)
}

/// Moves each staged value into its entry.
fn commits(context: &Context<'_>) -> Vec<TokenStream> {
    let written = context.entries.iter().zip(&context.written).enumerate();
    let written = written.filter(|(_, (_, written))| **written);
    let commits = written.map(|(index, (name, _))| {
        let index = number(index);
        quote! {
            if let Some(value) = self.staged.#name.take() {
                to.write(#index, &mut self.config.#name, value);
            }
        }
    });
    commits.collect()
}

fn value(context: &Context<'_>) -> TokenStream {
    if context.entries.is_empty() {
        return quote! {
            fn entry(&self, _: u16) -> ValueRef<'_> {
                ValueRef::Unset
            }
        };
    }
    let values = context.entries.iter().enumerate().map(|(index, name)| {
        let index = number(index);
        quote!(#index => self.config.#name.as_value(),)
    });
    quote! {
        fn entry(&self, entry: u16) -> ValueRef<'_> {
            match entry { #(#values)* _ => ValueRef::Unset }
        }
    }
}

fn missing_input(context: &Context<'_>) -> TokenStream {
    let entries = context.plan.entries.iter().zip(&context.entries).enumerate();
    let missing =
        entries.filter(|(_, (entry, _))| entry.kind == EntryKind::In && entry.init.is_none());
    let missing = missing.map(|(index, (_, name))| {
        let index = number(index);
        quote!(if !self.config.#name.is_set() { return Some(#index); })
    });
    quote! {
        fn missing_input(&self) -> Option<u16> {
            #(#missing)*
            None
        }
    }
}

pub fn plan_state(context: &Context<'_>) -> TokenStream {
    let ty = &context.ty;
    let slots = number(slots(context));
    let (missing_input, value) = (missing_input(context), value(context));
    let commits = commits(context);
    let to = if commits.is_empty() { quote!(_) } else { quote!(to) };
    let (initialise, outside) = (initialise(context), outside(context));
    let at_element = at_element(context);
    let aside = aside(context);
    let holds = context.shared.hold.then(|| {
        quote!(
            const HOLDS: bool = true;
        )
    });
    quote! {
        impl PlanState for #ty {
            type Tables = Rules;
            type Slots = [Slot; #slots];
            type Aside = #aside;
            #holds

            #[inline]
            fn tables(&self) -> Rules {
                Rules
            }

            #at_element

            fn try_clone(&self) -> Option<Self> {
                Some(Clone::clone(self))
            }

            fn slots(&self) -> [Slot; #slots] {
                [Slot::default(); #slots]
            }

            #missing_input

            #initialise

            #value

            #outside

            #[inline]
            fn commit<S: Sink>(&mut self, #to: &mut Committer<'_, S>) {
                #(#commits)*
            }

            #[inline]
            fn discard(&mut self) {
                self.staged = Staged::default();
            }
        }
    }
}

/// The storage for the element that is set aside.
fn aside(context: &Context<'_>) -> TokenStream {
    match context.suspends() {
        true => quote!(Option<SetAside>),
        false => quote!(()),
    }
}

/// With more elements, a separate step for each would cost more memory than it saves time.
const MAX_STEPS: usize = 64;

/// A separate step for each element that can be active.
fn at_element(context: &Context<'_>) -> Option<TokenStream> {
    let elements = context.plan.elements.iter().zip(&context.elements);
    let lasting = elements.filter(|(e, _)| !matches!(e.component, Component::Computation(_)));
    let numbers: Vec<_> = lasting.map(|(_, names)| &names.number).collect();
    (numbers.len() <= MAX_STEPS).then(|| {
        quote! {
            #[inline(always)]
            fn at_element<A: AtElement>(element: ElementId, run: A) -> A::Out {
                match element {
                    #(#numbers => run.at::<{ #numbers.0 }>(),)*
                    _ => run.unknown(),
                }
            }
        }
    })
}

/// The number of kept releases: those of the global supervisors and of the element with the most.
fn slots(context: &Context<'_>) -> usize {
    let locals = context.plan.elements.iter().map(|element| element.supervisors.len());
    usize::from(context.plan.globals) + locals.max().unwrap_or(0)
}

/// The initial values, in the order of their references.
fn initialise(context: &Context<'_>) -> TokenStream {
    let entries = context.plan.entries.iter().zip(&context.entries);
    let cleared = entries.filter(|(entry, _)| entry.kind != EntryKind::In);
    let cleared: Vec<_> = cleared.map(|(_, name)| quote!(config.#name.clear();)).collect();
    let set: Vec<_> = context
        .plan
        .initial()
        .map(|(id, entry, formula)| {
            let (number, name) = (id.0, &context.entries[id.index()]);
            let value = context.with_type_paths(|type_paths| {
                Formulas::new(type_paths, &context.entries).value(formula)
            });
            let set = match (&entry.ty, is_literal(formula.part())) {
                (_, true) => quote!(config.#name.set(#value);),
                (ty, false) => {
                    let value = match ty {
                        Type::Quantity(_) if entry.range.is_none() => quote!(finite(#value)?),
                        _ => limited(entry, value),
                    };
                    let value = tried("initial", number, value);
                    quote! {
                        let value = #value;
                        config.#name.set(value);
                    }
                }
            };
            match entry.kind {
                EntryKind::In => quote!(if !config.#name.is_set() { #set }),
                _ => set,
            }
        })
        .collect();
    let config =
        (!cleared.is_empty() || !set.is_empty()).then(|| quote!(let config = &mut self.config;));
    quote! {
        fn initialise(&mut self) -> Result<(), BadValue> {
            #config
            #(#cleared)*
            #(#set)*
            Ok(())
        }
    }
}

/// The accepted external values of each entry, as arms of a match.
fn accepts(context: &Context<'_>) -> Vec<TokenStream> {
    let entries = context.plan.entries.iter().enumerate();
    let accepts = entries.map(|(index, entry)| {
        let index = number(index);
        match (entry.kind, &entry.ty) {
            (EntryKind::Const | EntryKind::Out, _) => {
                quote!(#index => Err(WriteError::ReadOnly),)
            }
            (_, Type::Object(_)) => quote!(#index => Err(WriteError::Type),),
            (_, ty) => {
                let ty = context.value_type(ty);
                match entry.range.map(|(least, greatest)| (float(least), float(greatest))) {
                    None => quote!(#index => WriteError::check::<#ty>(value),),
                    Some((least, greatest)) => {
                        quote!(#index => WriteError::check_within::<#ty>(value, #least, #greatest),)
                    }
                }
            }
        }
    });
    accepts.collect()
}

fn outside(context: &Context<'_>) -> TokenStream {
    let entries = || context.plan.entries.iter().zip(&context.entries).enumerate();
    let accepts = accepts(context);
    let stages: Vec<_> = entries()
        .filter(|(_, (entry, _))| is_open(entry))
        .map(|(index, (_, name))| {
            let index = number(index);
            quote!(#index => stage_outside(&mut self.staged.#name, value),)
        })
        .collect();
    let inputs = entries()
        .filter(|(_, (entry, _))| entry.kind == EntryKind::In && is_open(entry))
        .map(|(index, (_, name))| {
            let index = number(index);
            quote!(#index => set_input(&mut self.config.#name, value),)
        });
    let read = context.plan.entries.iter().any(is_open);
    let value = if read { quote!(value) } else { quote!(_) };
    let (entry, accepts) = if accepts.is_empty() {
        (quote!(_), quote!(Err(WriteError::Unknown)))
    } else {
        (quote!(entry), quote!(match entry { #(#accepts)* _ => Err(WriteError::Unknown) }))
    };
    let staging = (!stages.is_empty()).then(|| quote!(match entry { #(#stages)* _ => {} }));
    let staged = if stages.is_empty() { quote!(_) } else { quote!(entry) };
    quote! {
        fn accepts(&self, #entry: u16, #value: &Value) -> Result<(), WriteError> {
            #accepts
        }

        fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
            PlanState::accepts(self, entry, value)?;
            match entry {
                #(#inputs)*
                _ => Err(WriteError::NotStarted),
            }
        }

        fn stage(&mut self, #staged: u16, #value: &Value) {
            #staging
        }
    }
}

/// Whether external writers can write an entry.
pub fn is_open(entry: &Entry) -> bool {
    matches!(entry.kind, EntryKind::In | EntryKind::Var) && !matches!(entry.ty, Type::Object(_))
}
