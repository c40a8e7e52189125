//! The devices of a toolbox: their table, controls, faults and signals as Rust names.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

use super::type_paths;
use crate::layout::doc;
use crate::names::{UniqueNames, camel, ident, shout, snake};
use crate::rust_type::float;
use afp_dsl::toolbox::{
    Amount, Control, Device, Fault, Signal, SignalType, Toolbox, device::ROBOT,
};

/// The modules that [`devices`] generates.
pub const MODULES: [&str; 2] = ["devices", "signal"];

/// The modules `devices` and `signal`; empty without devices.
pub fn devices(core: &TokenStream, toolbox: &Toolbox) -> TokenStream {
    let all = &toolbox.devices;
    if all.is_empty() {
        return TokenStream::new();
    }
    let rows = all.iter().map(|device| row(core, device));
    let (controls, control) = controls(core, all);
    let (faults, fault) = faults(core, all);
    let signals = signals(core, all);
    quote! {
        #[doc = " The devices that the toolbox declares."]
        pub mod devices {
            #[doc = " Their table, and the meaning of its numbers."]
            #[derive(Clone, Copy, Debug)]
            pub struct Devices;

            #controls
            #faults

            impl #core::devices::Devices for Devices {
                const TABLE: &'static [#core::devices::DeviceRow] = &[#(#rows),*];
                type Control = Control;
                type Fault = Fault;
                #control
                #fault
            }
        }
        #signals
    }
}

/// The name of a device's part. For the robot it is the part's name, otherwise the device's name
/// comes first; equal names are not repeated.
fn joined(device: &Device, name: &str) -> String {
    let (device_name, own) = (snake(&device.name), snake(name));
    if device.name == ROBOT || device_name == own { own } else { format!("{device_name}_{own}") }
}

fn unique(names: &mut UniqueNames, name: String, spell: fn(&str) -> String) -> Ident {
    ident(&spell(&names.unique(name)))
}

fn controls(core: &TokenStream, devices: &[Device]) -> (TokenStream, TokenStream) {
    let mut names = UniqueNames::default();
    let all = devices.iter().flat_map(|device| device.controls.iter().map(move |it| (device, it)));
    let all: Vec<_> = all
        .map(|(device, control)| {
            let name = unique(&mut names, joined(device, &control.name), camel);
            let fallback = format!("`{}.{}`", device.name, control.name);
            (name, doc(&control.doc, &fallback))
        })
        .collect();
    let (names, docs): (Vec<_>, Vec<_>) = all.into_iter().unzip();
    let numbers = numbers(names.len());
    let declared = quote! {
        #[doc = " The controls that can be held down."]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Control { #(#docs #names,)* }
    };
    let found = quote! {
        fn control(id: #core::devices::ControlId) -> ::core::option::Option<Control> {
            match id.0 {
                #(#numbers => ::core::option::Option::Some(Control::#names),)*
                _ => ::core::option::Option::None,
            }
        }
    };
    (declared, found)
}

/// The enum of faults, and its lookup by number.
fn faults(core: &TokenStream, devices: &[Device]) -> (TokenStream, TokenStream) {
    let mut names = UniqueNames::default();
    let mut code = Code::default();
    for device in devices {
        // The faults of every sensor are one kind of fault.
        let inherited: Vec<_> = device.faults.iter().filter_map(defect).collect();
        if !inherited.is_empty() {
            let name = names.unique(snake(&device.name));
            code.sensor(core, device, &name, &inherited);
        }
        for fault in device.faults.iter().filter(|fault| fault.span.is_some()) {
            let name = names.unique(joined(device, &fault.name));
            code.own(core, device, fault, &name);
        }
    }
    let Code { variants, accessors, made } = code;
    let numbers = numbers(made.len());
    let alone = (accessors.len() == 1).then(|| quote!(#[allow(unreachable_patterns)]));
    let accessors = (!accessors.is_empty()).then(|| quote!(#alone impl Fault { #(#accessors)* }));
    let declared = quote! {
        #[doc = " The faults, with their amounts."]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Fault { #(#variants)* }

        #accessors
    };
    let found = quote! {
        fn fault(
            id: #core::devices::FaultId,
            amount: ::core::option::Option<f64>,
        ) -> ::core::option::Option<Fault> {
            let amount = #core::devices::amount(Self::TABLE, id, amount)?;
            let _ = amount;
            match id.0 {
                #(#numbers => ::core::option::Option::Some(#made),)*
                _ => ::core::option::Option::None,
            }
        }
    };
    (declared, found)
}

/// The code for faults, in the order of their numbers.
#[derive(Default)]
struct Code {
    variants: Vec<TokenStream>,
    accessors: Vec<TokenStream>,
    /// The construction of each number's fault from `amount`.
    made: Vec<TokenStream>,
}

impl Code {
    fn sensor(&mut self, core: &TokenStream, device: &Device, name: &str, defects: &[Ident]) {
        let (variant, accessor) = (ident(&camel(name)), ident(name));
        let help = doc("", &format!("A common sensor fault of `{}`.", device.name));
        let defect = quote!(#core::devices::Defect);
        self.variants.push(quote!(#help #variant(#defect),));
        self.accessors.push(quote! {
            #help
            pub fn #accessor(self) -> ::core::option::Option<#defect> {
                match self {
                    Fault::#variant(defect) => ::core::option::Option::Some(defect),
                    _ => ::core::option::Option::None,
                }
            }
        });
        let faults = device.faults.iter().filter(|fault| fault.span.is_none());
        self.made.extend(faults.zip(defects).map(|(fault, kind)| {
            let time = fault.amount.as_ref();
            let time = time.map(|_| quote!((#core::Duration::from_secs_f64(amount))));
            quote!(Fault::#variant(#defect::#kind #time))
        }));
    }

    fn own(&mut self, core: &TokenStream, device: &Device, fault: &Fault, name: &str) {
        let (variant, accessor) = (ident(&camel(name)), ident(name));
        let help = doc(&fault.doc, &format!("`{}.{}`", device.name, fault.name));
        let (fields, pattern, ty, value, made) = match &fault.amount {
            None => (None, None, quote!(()), quote!(()), None),
            Some(amount) => {
                let (field, ty) = (ident(&snake(&amount.name)), quantity(core, amount));
                let about = doc("", &bounds(amount));
                let from = type_paths(core).quantity_from(amount.dimension, quote!(amount));
                let fields = Some(quote!({ #about #field: #ty }));
                let (pattern, made) = (quote!({ #field: value }), quote!({ #field: #from }));
                (fields, Some(pattern), ty, quote!(value), Some(made))
            }
        };
        self.variants.push(quote!(#help #variant #fields,));
        self.accessors.push(quote! {
            #help
            pub fn #accessor(self) -> ::core::option::Option<#ty> {
                match self {
                    Fault::#variant #pattern => ::core::option::Option::Some(#value),
                    _ => ::core::option::Option::None,
                }
            }
        });
        self.made.push(quote!(Fault::#variant #made));
    }
}

/// The variant of `Defect` for a fault that every sensor has.
fn defect(fault: &Fault) -> Option<Ident> {
    let name = fault.name.as_str();
    let own = || if name == "nan" { "NotANumber".to_owned() } else { camel(name) };
    fault.span.is_none().then(|| ident(&own()))
}

fn quantity(core: &TokenStream, amount: &Amount) -> TokenStream {
    type_paths(core).quantity(amount.dimension)
}

/// The range of an amount, as readable text.
fn bounds(amount: &Amount) -> String {
    let unit = amount.dimension.si_unit();
    let Amount { name, from, to, default, .. } = amount;
    let range = match from.is_finite() || to.is_finite() {
        true => format!("{from} to {to} {unit}"),
        false => format!("any {unit}"),
    };
    format!("`{name}`: {}; {default} by default", range.trim_end())
}

fn numbers(count: usize) -> Vec<Literal> {
    (0..count).map(Literal::usize_unsuffixed).collect()
}

fn signals(core: &TokenStream, devices: &[Device]) -> TokenStream {
    let mut names = UniqueNames::default();
    let all = devices.iter().flat_map(|device| device.signals.iter().map(move |it| (device, it)));
    let all = all.zip(0_u16..).map(|((device, signal), number)| {
        let name = unique(&mut names, joined(device, &signal.name), shout);
        let help = doc(&signal.doc, &format!("`{}.{}`", device.name, signal.name));
        let number = Literal::u16_unsuffixed(number);
        quote! {
            #help
            pub const #name: #core::devices::SignalId = #core::devices::SignalId(#number);
        }
    });
    quote! {
        #[doc = " The numbers of the signals of [`devices`]."]
        pub mod signal { #(#all)* }
    }
}

fn row(core: &TokenStream, device: &Device) -> TokenStream {
    let devices = quote!(#core::devices);
    let Device { name, controls, faults, signals, .. } = device;
    let help = help(&device.doc);
    let controls = controls.iter().map(|it| control_row(&devices, it));
    let faults = faults.iter().map(|it| fault_row(&devices, it));
    let signals = signals.iter().map(|it| signal_row(&devices, it));
    quote! {
        #devices::DeviceRow {
            name: #name,
            help: #help,
            controls: &[#(#controls),*],
            faults: &[#(#faults),*],
            signals: &[#(#signals),*],
        }
    }
}

fn control_row(devices: &TokenStream, control: &Control) -> TokenStream {
    let (name, help, stops) = (&control.name, help(&control.doc), control.stops);
    quote!(#devices::ControlRow { name: #name, help: #help, stops: #stops })
}

fn fault_row(devices: &TokenStream, fault: &Fault) -> TokenStream {
    let (name, help) = (&fault.name, help(&fault.doc));
    let amount = match &fault.amount {
        None => quote!(::core::option::Option::None),
        Some(amount) => {
            let (name, unit) = (&amount.name, amount.dimension.si_unit());
            let [default, from, to] = [amount.default, amount.from, amount.to].map(number);
            quote! {
                ::core::option::Option::Some(#devices::AmountRow {
                    name: #name, unit: #unit, default: #default, from: #from, to: #to,
                })
            }
        }
    };
    quote!(#devices::FaultRow { name: #name, amount: #amount, help: #help })
}

fn signal_row(devices: &TokenStream, signal: &Signal) -> TokenStream {
    let (name, help, truth) = (&signal.name, help(&signal.doc), signal.truth);
    let ty = match signal.ty {
        SignalType::Float(dimension) => {
            let unit = dimension.si_unit();
            quote!(Float(#unit))
        }
        plain => ident(&format!("{plain:?}")).into_token_stream(),
    };
    quote!(#devices::SignalRow { name: #name, ty: #devices::SignalType::#ty, truth: #truth, help: #help })
}

fn number(value: f64) -> TokenStream {
    match value {
        f64::INFINITY => quote!(f64::INFINITY),
        f64::NEG_INFINITY => quote!(f64::NEG_INFINITY),
        value => float(value),
    }
}

/// Help as one line for tables: lower case if it begins with an ordinary word, without a period.
fn help(text: &str) -> String {
    let line = text.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    let line = line.trim_end_matches('.');
    let mut letters = line.chars();
    match (letters.next(), letters.next()) {
        (Some(first), Some(second)) if second.is_lowercase() || second == ' ' => {
            let rest: String = line.chars().skip(1).collect();
            format!("{}{rest}", first.to_lowercase())
        }
        _ => line.to_owned(),
    }
}
