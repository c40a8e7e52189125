//! From a plan file to a running plan: toolbox files and their Rust implementations.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use afp_core::{Environment, Scheduler};
use afp_dsl::Toolboxes;
use afp_dsl::compile_plan;
use afp_dsl::files::{Disk, read_text};
use afp_syntax::diagnostics::Code;
use afp_syntax::source::Source;

use super::error::LoadError;
use super::plan::LoadedPlan;
use super::registry::Registry;

/// A platform with the templates for its plans.
///
/// ```
/// use afp::load::{Library, Templates};
/// # use afp::{Environment, Instant};
/// # struct Lamp;
/// # impl Environment for Lamp {
/// # fn stop(&mut self, _: Instant) {}
/// # fn emergency_stop(&mut self) {}
/// # }
///
/// impl Templates for Lamp {
///     fn add_to(library: &mut Library<Self>) {
///         library.register(afp_std::templates::register);
///         // For your own toolbox, add:
///         // library.toolbox("signals.afp", signals::templates::SOURCE);
///         // library.register(signals::templates::register);
///     }
/// }
/// # let mut library = Library::<Lamp>::new();
/// # Lamp::add_to(&mut library);
/// # let plan = "use std\nplan P {\n start a\n actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n";
/// # library.load_text("p.afp", plan).unwrap();
/// ```
pub trait Templates: Environment + Sized + 'static {
    /// Adds the toolboxes and their implementations on this platform.
    fn add_to(library: &mut Library<Self>);
}

/// Toolboxes, and their Rust implementations on platform `E`.
///
/// It starts with the built-in toolbox files but without their templates, because a platform's
/// templates depend on its devices.
pub struct Library<E: ?Sized + 'static> {
    toolboxes: Toolboxes,
    registry: Registry<E>,
}

/// Why a plan file cannot be loaded.
#[derive(Debug)]
#[non_exhaustive]
pub enum OpenError {
    /// The file cannot be read.
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: io::Error,
    },
    /// The plan has errors: the output of `afpc check`, and how to add a missing toolbox.
    Plan(String),
    /// A template or object type has no implementation in the library.
    Load(LoadError),
}

/// Reads, checks and loads the first plan of a file for platform `E`; `errand.afp:Search` selects
/// another plan. The plan has not started.
///
/// ```ignore
/// let ending = afp::load("errand.afp")?.run(&mut robot)?;
/// ```
///
/// # Errors
/// [`OpenError`]: the file cannot be read, the plan has errors, or the platform lacks a template.
pub fn load<E: Templates>(path: impl AsRef<Path>) -> Result<Scheduler<LoadedPlan<E>>, OpenError> {
    let mut library = Library::new();
    E::add_to(&mut library);
    library.load(path)
}

impl<E: Environment + ?Sized + 'static> Library<E> {
    /// Starts with the built-in toolbox files and no templates.
    pub fn new() -> Self {
        Library { toolboxes: afp_toolboxes::sources().collect(), registry: Registry::new() }
    }

    /// Adds a toolbox: the name of its file, for messages, and its text. For a toolbox read by
    /// `toolbox!`, the text is `SOURCE`.
    pub fn toolbox(&mut self, file: &str, text: &str) -> &mut Self {
        // The crate is only needed for generated Rust.
        self.toolboxes.add(Source::new(file, text), "crate");
        self
    }

    /// Adds implementations by a toolbox's `register`.
    pub fn register(&mut self, register: impl FnOnce(&mut Registry<E>)) -> &mut Self {
        register(&mut self.registry);
        self
    }

    /// Reads, checks and loads the first plan of a file, or the plan named after a colon. Files
    /// that it uses are relative to its folder.
    ///
    /// # Errors
    /// As for [`load`].
    pub fn load(&self, path: impl AsRef<Path>) -> Result<Scheduler<LoadedPlan<E>>, OpenError> {
        let (path, plan) = split(path.as_ref());
        let text = read_text(path).map_err(|why| OpenError::Read { path: path.to_owned(), why })?;
        self.load_plan(&path.display().to_string(), &text, plan)
    }

    /// Checks and loads the first plan of a text. `file` is its name in messages; used files are
    /// relative to its folder.
    ///
    /// # Errors
    /// As for [`load`].
    pub fn load_text(&self, file: &str, text: &str) -> Result<Scheduler<LoadedPlan<E>>, OpenError> {
        self.load_plan(file, text, None)
    }

    fn load_plan(
        &self,
        file: &str,
        text: &str,
        plan: Option<&str>,
    ) -> Result<Scheduler<LoadedPlan<E>>, OpenError> {
        let source = Source::new(file, text);
        let compiled = compile_plan(&source, &self.toolboxes, &Disk::default(), plan);
        match &compiled.graph {
            None => {
                let mut report = compiled.render(false);
                if compiled.diags.iter().any(|each| each.code == Code::E0238) {
                    report.push_str(TOOLBOX);
                }
                Err(OpenError::Plan(report))
            }
            Some(graph) => {
                LoadedPlan::new(graph, &self.registry).map(Scheduler::new).map_err(OpenError::Load)
            }
        }
    }
}

/// How to add a missing toolbox.
const TOOLBOX: &str = "
to add a toolbox with its Rust:
  library.toolbox(\"NAME.afp\", NAME::templates::SOURCE);
  library.register(NAME::templates::register);
";

/// Splits `FILE:Plan`; a file whose name contains the colon has precedence.
fn split(path: &Path) -> (&Path, Option<&str>) {
    match path.to_str().and_then(|name| name.rsplit_once(':')) {
        Some((file, plan)) if file.ends_with(".afp") && !path.exists() => {
            (file.as_ref(), Some(plan))
        }
        _ => (path, None),
    }
}

impl<E: Environment + ?Sized + 'static> Default for Library<E> {
    fn default() -> Self {
        Library::new()
    }
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OpenError::Read { path, why } => write!(f, "cannot read '{}': {why}", path.display()),
            OpenError::Plan(report) => write!(f, "the plan has errors\n{report}"),
            OpenError::Load(why) => {
                why.fmt(f)?;
                let (LoadError::NoComponent { toolbox, .. } | LoadError::NoObject { toolbox, .. }) =
                    why
                else {
                    return Ok(());
                };
                // The crates of built-in toolboxes have other names.
                let ours = afp_toolboxes::ALL.iter().find(|known| known.name == toolbox);
                let krate = ours.map_or(toolbox.as_str(), |known| known.rust_path);
                write!(f, ": 'library.register({krate}::templates::register)' adds its Rust")
            }
        }
    }
}

impl std::error::Error for OpenError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            OpenError::Read { why, .. } => Some(why),
            OpenError::Load(why) => Some(why),
            OpenError::Plan(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use afp_core::Instant;

    use super::*;

    struct Bare;

    impl Environment for Bare {
        fn stop(&mut self, _: Instant) {}

        fn emergency_stop(&mut self) {}
    }

    #[test]
    fn a_plan_is_selected_after_a_colon() {
        assert_eq!(split("errand.afp:Search".as_ref()), ("errand.afp".as_ref(), Some("Search")));
        assert_eq!(split("errand.afp".as_ref()), ("errand.afp".as_ref(), None));
        assert_eq!(split("C:/errand".as_ref()), ("C:/errand".as_ref(), None));
    }

    #[test]
    fn missing_parts_of_a_library_are_reported_with_the_calls_that_add_them() {
        let said = |text| {
            let loaded = Library::<Bare>::new().load_text("p.afp", text);
            loaded.err().map(|why| why.to_string()).unwrap_or_default()
        };
        let toolbox =
            said("use lift\nplan P {\n    start a\n    actor a: Go { Gone -> terminate }\n}\n");
        assert!(toolbox.contains("there is no toolbox 'lift'"), "{toolbox}");
        assert!(
            toolbox.contains("library.toolbox(\"NAME.afp\", NAME::templates::SOURCE)"),
            "{toolbox}"
        );
        let rust =
            said("use std\nplan P {\n    start a\n    actor a: Wait { Elapsed -> terminate }\n}\n");
        let call = "'library.register(afp_std::templates::register)' adds its Rust";
        assert!(rust.contains(call), "{rust}");
    }
}
