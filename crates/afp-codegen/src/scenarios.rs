//! Rust tests from scenarios.

use afp_dsl::Compiled;
use afp_dsl::graph::Graph;
use afp_dsl::scenario::Scenario;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::parse::{Parse, ParseStream};
use syn::{Ident, LitStr, Path, Token, Type};

use crate::names::{UniqueNames, ident, snake};
use crate::toolbox::{Support, register_supported};

/// The tests of the scenarios of some files, a module for each file.
pub struct ScenarioTests<'a> {
    setting: &'a ScenarioSetting,
    /// Whether a toolbox at this path is built in, so that its crate has a macro `register!`.
    is_built_in: fn(&str) -> bool,
    modules: TokenStream,
    names: UniqueNames,
}

/// The place of scenarios and their robot. Written as `"file or folder" [, robot = type] [, path of
/// a function that registers templates]...`.
pub struct ScenarioSetting {
    /// The file or folder, as in the source.
    pub path: String,
    robot: Option<TokenStream>,
    /// The paths of functions that register templates.
    register: Vec<TokenStream>,
}

impl Parse for ScenarioSetting {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let path = input.parse::<LitStr>()?.value();
        let (mut robot, mut register) = (None, Vec::new());
        while input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            if !input.peek2(Token![=]) {
                register.push(input.call(Path::parse_mod_style)?.into_token_stream());
                continue;
            }
            let word: Ident = input.parse()?;
            if word != "robot" || robot.is_some() {
                return Err(syn::Error::new(word.span(), "expected one 'robot = Type'"));
            }
            input.parse::<Token![=]>()?;
            robot = Some(input.parse::<Type>()?.into_token_stream());
        }
        Ok(ScenarioSetting { path, robot, register })
    }
}

impl<'a> ScenarioTests<'a> {
    /// Starts without tests. `is_built_in` returns whether a toolbox, by its Rust path, is built
    /// in.
    pub fn new(setting: &'a ScenarioSetting, is_built_in: fn(&str) -> bool) -> Self {
        let (modules, names) = (TokenStream::new(), UniqueNames::default());
        ScenarioTests { setting, is_built_in, modules, names }
    }

    /// Adds the module of a file. `path` is its name, `full` is its path at run time, and `texts`
    /// are the expressions of all its sources. An invalid scenario, or one that its plan can no
    /// longer pass, is a failing test.
    pub fn add(&mut self, path: &str, full: &str, compiled: &Compiled, texts: &[TokenStream]) {
        let module = ident(&self.names.unique(slug(path.trim_end_matches(".afp"))));
        let mut names = UniqueNames::default();
        let valid = compiled.scenarios.iter().map(|scenario| {
            let run = self.run(scenario, full);
            test(&mut names, &scenario.name, &run)
        });
        let valid: TokenStream = valid.collect();
        let invalid = compiled.invalid.iter().map(|each| {
            let text = format!("\n{}", each.errors.render(&compiled.sources, false));
            test(&mut names, &each.name, &quote!(panic!("{}", #text);))
        });
        let invalid: TokenStream = invalid.collect();
        // Cargo only watches included files.
        self.modules.extend(quote! {
            mod #module {
                #valid
                #invalid
                const _: &[&str] = &[#(#texts),*];
            }
        });
    }

    pub fn modules(self) -> Option<TokenStream> {
        (!self.modules.is_empty()).then_some(self.modules)
    }

    /// The statements that run a scenario of the file at `full`.
    fn run(&self, scenario: &Scenario, full: &str) -> TokenStream {
        let (title, robot) = (&scenario.name, self.robot(&scenario.graph));
        quote! {
            let robot = #robot;
            ::afp_test::check(::std::path::Path::new(#full), #title, &robot);
        }
    }

    fn robot(&self, plan: &Graph) -> TokenStream {
        let register = &self.setting.register;
        let Some(robot) = &self.setting.robot else {
            return quote! {
                ::afp_sim::carbot(|registry| {
                    let _ = &registry;
                    #(#register(registry);)*
                })
            };
        };
        let toolboxes = plan.toolboxes.iter().filter(|toolbox| toolbox.is_named());
        let toolboxes = toolboxes.map(|toolbox| {
            let path: TokenStream = toolbox.rust_path.parse().unwrap_or_default();
            match (self.is_built_in)(&toolbox.rust_path) {
                true => quote!(::#path::register!(registry, #robot);),
                false => {
                    let support = Support {
                        core: quote!(::afp_session::__private::afp_core),
                        file: String::new(),
                        module: path,
                        registry: quote!(registry),
                        platform: robot.clone(),
                        traits: None,
                    };
                    let registered = register_supported(toolbox, &support);
                    quote!(#registered;)
                }
            }
        });
        quote! {
            ::afp_session::simulated::<#robot, _>(|registry| {
                let _ = &registry;
                #(#toolboxes)*
                #(#register(registry);)*
            })
        }
    }
}

fn test(names: &mut UniqueNames, title: &str, body: &TokenStream) -> TokenStream {
    let name = ident(&names.unique(slug(title)));
    quote! {
        #[test]
        fn #name() {
            #body
        }
    }
}

/// A text as a Rust name.
fn slug(text: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    snake(&text.chars().map(plain).collect::<String>())
}
