//! Suggestions for a missing plan file.

use std::io;
use std::path::{Path, PathBuf};

use afp_run::RunError;

/// The folder in which projects keep their plans.
const PLANS: &str = "plans";

/// The maximum number of suggested plans.
const MOST: usize = 3;

/// The error for an unreadable plan; for a missing file, with suggestions.
pub fn unreadable(path: &Path) -> impl FnOnce(io::Error) -> RunError {
    let path = path.to_owned();
    move |error| {
        let help = (error.kind() == io::ErrorKind::NotFound).then(|| help(&path)).flatten();
        let what = "cannot read the plan";
        match help {
            Some(help) => {
                let message = format!("{what} '{}': {error}", path.display());
                RunError::Missing { message, help }
            }
            None => RunError::file(what, &path)(error),
        }
    }
}

/// The plan of that name in the usual folders, or else the plans in them.
fn help(path: &Path) -> Option<String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = PathBuf::from(path.file_name()?).with_extension("afp");
    let meant = [folder.join(&name), folder.join(PLANS).join(&name)];
    if let Some(meant) = meant.into_iter().find(|meant| meant.is_file()) {
        return Some(format!("write '{}'", meant.display()));
    }
    let plans = [folder.to_owned(), folder.join(PLANS)].map(|folder| plans(&folder)).concat();
    let shown: Vec<_> =
        plans.iter().take(MOST).map(|plan| format!("'{}'", plan.display())).collect();
    match plans.len() - shown.len() {
        _ if shown.is_empty() => None,
        0 => Some(format!("plans here: {}", shown.join(", "))),
        more => Some(format!("plans here: {} and {more} more", shown.join(", "))),
    }
}

/// The plan files of a folder, by name. Toolbox files have the same extension and are included.
fn plans(folder: &Path) -> Vec<PathBuf> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = here.read_dir().into_iter().flatten().flatten();
    let is_plan = |path: &PathBuf| path.extension().is_some_and(|end| end == "afp");
    let mut plans: Vec<_> =
        entries.map(|entry| folder.join(entry.file_name())).filter(is_plan).collect();
    plans.sort();
    plans
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_with_similar_names_are_suggested() {
        let place = tempfile::tempdir().unwrap();
        let (root, plans) = (place.path(), place.path().join("plans"));
        let said = |name: &str| {
            let help = help(&root.join(name))?;
            Some(help.replace(&format!("{}/", root.display()), ""))
        };
        assert_eq!(said("go.afp"), None);
        std::fs::create_dir(&plans).unwrap();
        std::fs::write(plans.join("go.afp"), "").unwrap();
        for name in ["go.afp", "go"] {
            assert_eq!(said(name).unwrap(), "write 'plans/go.afp'");
        }
        assert_eq!(said("plans/go").unwrap(), "write 'plans/go.afp'");
        assert_eq!(said("stop.afp").unwrap(), "plans here: 'plans/go.afp'");
        for name in ["a.afp", "b.afp", "c.afp", "no.toml"] {
            std::fs::write(plans.join(name), "").unwrap();
        }
        let listed = "plans here: 'plans/a.afp', 'plans/b.afp', 'plans/c.afp' and 1 more";
        assert_eq!(said("stop.afp").unwrap(), listed);
    }
}
