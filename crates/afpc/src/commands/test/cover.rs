//! Drawings of plans with their usage.

use std::fs;
use std::path::Path;

use afp_draw::free_names;
use afp_run::{PictureFormat, RunError, say};

use super::Used;
use crate::commands::graph;
use crate::no_plan::NoPlan;
use crate::picture;

/// Draws one plan into a file, or each plan into a folder.
///
/// # Errors
/// There are several plans and one file; a file cannot be written.
pub(super) fn draw_all(plans: &[Used<'_>], output: &Path) -> Result<(), NoPlan> {
    if output.extension().is_some() && !output.is_dir() {
        let [used] = plans else {
            let message = format!("{} plans do not fit into one picture", plans.len());
            let help = "name a folder, such as '-o cover', or the scenarios of one plan";
            return Err(RunError::usage(message, help).into());
        };
        return draw(used, output);
    }
    fs::create_dir_all(output).map_err(RunError::file("cannot make the folder", output))?;
    let names = free_names(plans.iter().map(|used| used.coverage.plan.as_str()));
    for (used, name) in plans.iter().zip(names) {
        draw(used, &output.join(format!("{name}.{}", PictureFormat::Svg.ending())))?;
    }
    Ok(())
}

fn draw(used: &Used<'_>, path: &Path) -> Result<(), NoPlan> {
    let Used { plan_file, scenario, coverage } = used;
    let svg = graph::with_usage(plan_file, &scenario.graph, &coverage.usage, path)?;
    picture::write(path, &svg)?;
    say(format_args!("coverage drawn: {}", path.display()));
    Ok(())
}
