//! Drawings of plans with what was used of them.

use std::fs;
use std::path::{Path, PathBuf};

use afp_run::{PictureFormat, RunError, say};
use afp_test::Coverage;

use super::Case;
use crate::commands::graph;
use crate::picture;
use crate::plan_file::NoPlan;

/// Draws one plan into a file, or each into a folder.
///
/// # Errors
/// Several plans and one file; a file that cannot be written.
pub(super) fn draw_all(plans: &[(&Case<'_>, Coverage)], output: &Path) -> Result<(), NoPlan> {
    if output.extension().is_some() && !output.is_dir() {
        let [(case, coverage)] = plans else {
            let message = format!("{} plans do not fit into one picture", plans.len());
            let help = "name a folder, such as '-o cover', or the scenarios of one plan";
            return Err(RunError::usage(message, help).into());
        };
        return draw(case, coverage, output);
    }
    fs::create_dir_all(output).map_err(RunError::file("cannot make the folder", output))?;
    for (index, (case, coverage)) in plans.iter().enumerate() {
        draw(case, coverage, &file_of(plans, index, output))?;
    }
    Ok(())
}

/// `cover/patrol.svg`; with a number where two plans have one name.
fn file_of(plans: &[(&Case<'_>, Coverage)], index: usize, folder: &Path) -> PathBuf {
    let name = |(_, coverage): &(&Case<'_>, Coverage)| coverage.plan.clone();
    let own = name(&plans[index]);
    let before = plans[..index].iter().filter(|other| name(other) == own).count();
    let number = if before > 0 { format!("_{}", before + 1) } else { String::new() };
    folder.join(format!("{own}{number}.{}", PictureFormat::Svg.ending()))
}

fn draw(case: &Case<'_>, coverage: &Coverage, path: &Path) -> Result<(), NoPlan> {
    let svg = graph::with_usage(case.plan_file, &case.scenario.graph, &coverage.usage, path)?;
    picture::write(path, &svg)?;
    say(format_args!("coverage drawn: {}", path.display()));
    Ok(())
}
