//! Example plans, each copied with its world and the plans that it uses.

use std::path::{Path, PathBuf};
use std::{fs, io};

use serde_json::{Value, json};

use crate::files::Folder;

#[derive(Clone, Debug, Default)]
pub struct Example {
    /// The name of its file, `patrol.afp`.
    pub name: String,
    pub plan: String,
    /// The text of its world; by default the robot's world.
    pub world: Option<String>,
    /// The files that it uses: paths relative to it, and texts.
    pub uses: Vec<(String, String)>,
}

impl Example {
    /// Its entry in the clients' list, with the help text of its plan.
    pub(crate) fn listed(&self) -> Value {
        json!({ "name": self.name, "title": title(&self.plan) })
    }
}

/// The first sentence of the first plan's help text, or else of the first help text.
fn title(text: &str) -> String {
    let (mut first, mut help) = (String::new(), String::new());
    for line in text.lines().map(str::trim) {
        match line.strip_prefix("///") {
            Some(words) => help = format!("{help} {}", words.trim()).trim().to_owned(),
            None if line.starts_with("plan ") => break,
            None if first.is_empty() => first = std::mem::take(&mut help),
            None => help.clear(),
        }
    }
    let help = if help.is_empty() { first } else { help };
    help.split_once(". ").map_or(help.clone(), |(first, _)| format!("{first}."))
}

/// Copies an example into a folder, to a new file. Existing files of the example stay unchanged.
/// The world goes where a run looks for it: into the folder `worlds` next to the plan.
///
/// # Errors
/// A sentence: the example does not exist, or a file is outside the folder or cannot be written.
pub(crate) fn copy(
    examples: &[Example],
    name: &str,
    folder: &Folder,
    plan: &Path,
) -> Result<(), String> {
    let example = examples.iter().find(|example| example.name == name);
    let example = example.ok_or_else(|| format!("there is no example '{name}'"))?;
    let place = plan.parent().unwrap_or(folder.root());
    let world = example.world.as_ref().zip(world_of(plan)).map(|(text, path)| (path, text));
    let uses = example.uses.iter().map(|(path, text)| (place.join(path), text));
    let others: Vec<_> = world.into_iter().chain(uses).filter(|(path, _)| !path.exists()).collect();
    // All or nothing: a partial copy would block the next attempt.
    check_place(folder, plan)?;
    if let Some((path, _)) = others.iter().find(|(path, _)| !leads_into(folder, path)) {
        return Err(format!(
            "'{}' would be outside of '{}': put the plan into a separate folder, such as 'plans'",
            path.display(),
            folder.root().display()
        ));
    }
    write(folder, plan, &example.plan)?;
    for (path, text) in others {
        write(folder, &path, text)?;
    }
    Ok(())
}

/// The path where a run looks for the world of a plan.
fn world_of(plan: &Path) -> Option<PathBuf> {
    let file = Path::new(plan.file_stem()?).with_extension("toml");
    Some(plan.parent()?.parent()?.join("worlds").join(file))
}

/// Whether the nearest existing folder above a path is inside.
fn leads_into(folder: &Folder, path: &Path) -> bool {
    let above = path.ancestors().skip(1).find_map(|above| above.canonicalize().ok());
    above.is_some_and(|above| above.starts_with(folder.root()))
}

/// Checks that a file may be written, creating its folder if needed, but nothing outside.
fn check_place(folder: &Folder, path: &Path) -> Result<(), String> {
    let Some(parent) = path.parent().filter(|parent| !parent.exists()) else {
        return folder.inside(&path.to_string_lossy()).map(|_| ());
    };
    let above = parent.parent().and_then(|above| above.canonicalize().ok());
    match above.is_some_and(|above| above.starts_with(folder.root())) {
        true => Ok(()),
        false => Err(format!("the folder '{}' does not exist", parent.display())),
    }
}

/// Writes a file, creating its folder if needed.
fn write(folder: &Folder, path: &Path, text: &str) -> Result<(), String> {
    let wrong = |why: io::Error| format!("cannot write '{}': {why}", path.display());
    check_place(folder, path)?;
    if let Some(parent) = path.parent().filter(|parent| !parent.exists()) {
        fs::create_dir(parent).map_err(wrong)?;
    }
    let file = folder.inside(&path.to_string_lossy())?;
    afp_output::write_whole(&file, text.as_bytes()).map_err(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_title_of_an_example_is_the_help_of_its_plan() {
        let text = "use std\n\n/// Places.\ntable t(x: length) {}\n\n/// Drive to a room,\n/// around the obstacles. And back.\nplan P {\n";
        assert_eq!(title(text), "Drive to a room, around the obstacles.");
        assert_eq!(title("/// All of it.\nuse std\n\nplan P {"), "All of it.");
        assert_eq!(title("plan P {"), "");
    }

    #[test]
    fn an_example_is_copied_with_its_files_without_overwriting() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::new(place.path()).unwrap();
        let example = |name: &str, uses: &[&str]| Example {
            name: name.to_owned(),
            plan: format!("plan of {name}"),
            world: Some(format!("world of {name}")),
            uses: uses.iter().map(|path| ((*path).to_owned(), format!("text of {path}"))).collect(),
        };
        let uses = ["one.afp", "parts/three.afp"];
        let examples = [example("one.afp", &[]), example("two.afp", &uses)];
        let at = |path: &str| folder.root().join(path);
        let read = |path: &str| fs::read_to_string(at(path)).unwrap();
        copy(&examples, "two.afp", &folder, &at("plans/my.afp")).unwrap();
        assert_eq!(read("plans/my.afp"), "plan of two.afp");
        assert_eq!(read("worlds/my.toml"), "world of two.afp");
        assert_eq!(read("plans/one.afp"), "text of one.afp");
        assert_eq!(read("plans/parts/three.afp"), "text of parts/three.afp");
        fs::write(at("plans/one.afp"), "mine").unwrap();
        copy(&examples, "two.afp", &folder, &at("plans/other.afp")).unwrap();
        assert_eq!(read("plans/one.afp"), "mine");
        let outside = at("../elsewhere/my.afp");
        assert!(copy(&examples, "one.afp", &folder, &outside).is_err());
        assert!(!outside.parent().unwrap().exists());
        // The world would be outside, so the plan is not copied.
        let refused = copy(&examples, "two.afp", &folder, &at("my.afp")).unwrap_err();
        assert!(refused.contains("such as 'plans'"), "{refused}");
        assert!(!at("my.afp").exists());
    }
}
