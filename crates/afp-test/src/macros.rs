//! The function called by tests of `afp::scenarios!`.

use std::path::Path;

use afp_dsl::files::{Disk, read_text};
use afp_session::Loader;
use afp_syntax::source::Source;
use afp_toolboxes::project::OwnToolboxes;

use crate::{Setting, run};

/// Runs the named scenario of `file` on a robot; panics with the broken lines and a part of the
/// timeline.
///
/// # Panics
/// The scenario failed, or could not run.
pub fn check(file: &Path, name: &str, robot: &dyn Loader) {
    let failed = |text: String| -> ! {
        panic!("scenario \"{name}\" of {}\n{}", file.display(), anstream::adapter::strip_str(&text))
    };
    let text = read_text(file).unwrap_or_else(|error| failed(error.to_string()));
    let toolboxes = OwnToolboxes::of_plan(file).and_then(|own| own.with_built_in());
    let toolboxes = toolboxes.unwrap_or_else(|error| failed(error.to_string()));
    let source = Source::new(file.display().to_string(), text);
    let compiled = afp_dsl::compile(&source, &toolboxes, &Disk::default());
    let Some(scenario) = compiled.scenarios.iter().find(|each| each.name == name) else {
        failed(compiled.render(false))
    };
    let setting = Setting::find(scenario, file, robot.kind())
        .unwrap_or_else(|error| failed(error.to_string()));
    match run(scenario, &setting, robot, None) {
        Ok(verdict) if verdict.passed() => {}
        Ok(verdict) => failed(verdict.report()),
        Err(error) => failed(error.to_string()),
    }
}
