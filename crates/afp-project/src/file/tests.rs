use std::fs;
use std::path::Path;

use super::ProjectFile;
use crate::project::Origin;

fn project(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn find(folder: &Path) -> ProjectFile {
    ProjectFile::find(folder).unwrap()
}

#[test]
fn the_nearest_file_in_a_parent_folder_counts() {
    let folder = project(&[("afp.toml", "[run]\nworld = 'a'"), ("b/c/plan.afp", "")]);
    let found = ProjectFile::of_plan(&folder.path().join("b/c/plan.afp")).unwrap();
    assert_eq!(found.project.world.as_deref(), Some("a"));
    assert_eq!(found.folder, folder.path());
}

#[test]
fn errors_are_shown_at_their_lines() {
    let folder = project(&[("afp.toml", "[run]\nwordl = 'a'\n[afp]\npath = 3\n")]);
    let text = ProjectFile::find(folder.path()).unwrap_err().to_string();
    assert!(text.contains("error: '[run]' has no 'wordl'\n"), "{text}");
    assert!(text.contains("afp.toml:2:1\n  |\n2 | wordl = 'a'\n  | ^^^^^ help: write 'world'"));
    assert!(text.contains("\n\nerror: 'path' cannot have this value\n"), "{text}");
    assert!(text.contains("afp.toml:4:8\n"), "{text}");
}

#[test]
fn a_key_above_its_table_is_reported_with_its_place() {
    let folder = project(&[("afp.toml", "world = 'a'\nruns = 3\n")]);
    let text = ProjectFile::find(folder.path()).unwrap_err().to_string();
    assert!(text.contains("error: 'world' is above the tables\n"), "{text}");
    assert!(text.contains("help: write it below '[run]'"), "{text}");
    assert!(text.contains("error: a project has no 'runs'\n"), "{text}");
    assert!(text.contains("help: write 'run'"), "{text}");
    let folder = project(&[("afp.toml", "[run]\n[hardware]\ntype = 'x::Y'\n[path]\na = 1\n")]);
    let text = ProjectFile::find(folder.path()).unwrap_err().to_string();
    assert!(text.contains("a project has no '[hardware]'\n"), "{text}");
    assert!(text.contains("help: write '[robot.hardware]'"), "{text}");
    assert!(text.contains("a project has no 'path'\n"), "{text}");
}

#[test]
fn a_missing_toolbox_file_is_reported_at_its_name() {
    let folder = project(&[("afp.toml", "[toolboxes]\na = { path = 'x.afp' }\n")]);
    let text = find(folder.path()).toolboxes().unwrap_err().to_string();
    assert!(text.contains("cannot read") && text.contains("x.afp"), "{text}");
    assert!(text.contains("afp.toml:2:1"), "{text}");
}

#[test]
fn the_crate_is_the_one_around_the_toolbox_file() {
    let folder = project(&[
        (
            "afp.toml",
            "[toolboxes]\na.path = 'kit/boxes/a.afp'\nb = { path = 'kit/b.afp', crate = 'kit-b' }",
        ),
        ("kit/Cargo.toml", "[package]\nname = \"kit-b\"\n"),
        ("kit/boxes/a.afp", ""),
        ("kit/b.afp", ""),
    ]);
    let project = find(folder.path());
    for file in project.toolboxes().unwrap() {
        let link = file.krate.unwrap();
        assert_eq!((&*link.key, &*link.rust_path()), ("kit-b", "kit_b"));
        assert_eq!(
            link.folder.as_deref(),
            Some(&*folder.path().join("kit").canonicalize().unwrap())
        );
    }
}

#[test]
fn crates_in_other_folders_are_named_in_the_error() {
    let text = "[toolboxes]
a = { path = 'a.afp', crate = { git = 'https://x', package = 'far-away', module = 'm' } }
b = { path = 'a.afp', crate = { path = 'b' } }";
    let manifest = "[package]\nname = \"bb\"\n[lib]\nname = \"short\"\n";
    let folder = project(&[("afp.toml", text), ("a.afp", ""), ("b/Cargo.toml", manifest)]);
    let project = find(folder.path());
    let files = project.toolboxes().unwrap();
    let a = files[0].krate.clone().unwrap();
    assert_eq!((&*a.key, &*a.rust_path()), ("far-away", "far_away::m"));
    assert_eq!((a.origin, a.folder), (Origin::Git("https://x".to_owned()), None));
    let b = files[1].krate.clone().unwrap();
    // Rust code uses the name of the library.
    assert_eq!((&*b.key, &*b.package, &*b.rust_path()), ("short", "bb", "short"));
}

#[test]
fn a_missing_crate_is_reported_at_the_toolbox() {
    let said = |text: &str, files: &[(&str, &str)]| {
        let all = [&[("afp.toml", text), ("a/a.afp", "")], files].concat();
        let folder = project(&all);
        let project = find(folder.path());
        let mistake = project.toolboxes().unwrap().remove(0).krate.unwrap_err();
        assert_eq!(&text[mistake.span.clone().unwrap()], "a");
        mistake.message
    };
    let plain = "[toolboxes]\na = { path = 'a/a.afp' }";
    let workspace = ("a/Cargo.toml", "[workspace]\n");
    assert!(said(plain, &[workspace]).contains("has no package"));
    let named = "[toolboxes]\na = { path = 'a/a.afp', crate = 'b' }";
    let other = ("a/Cargo.toml", "[package]\nname = \"c\"");
    assert!(said(named, &[other]).contains("belongs to 'c', not to 'b'"));
    let elsewhere = "[toolboxes]\na = { path = 'a/a.afp', crate = { path = 'z' } }";
    assert!(said(elsewhere, &[]).contains("cannot read the manifest"));
}

#[test]
fn a_folder_as_a_toolbox_is_reported_with_the_meaning_of_path() {
    let folder = project(&[("afp.toml", "[toolboxes]\na = { path = '.' }")]);
    let text = find(folder.path()).toolboxes().unwrap_err().to_string();
    assert!(text.contains("'.' is a folder"), "{text}");
    assert!(text.contains("'path' names the toolbox's file, such as 'a.afp'"), "{text}");
}

#[test]
fn the_crate_of_a_robot_is_named_or_its_toolboxes_or_the_projects() {
    let toolbox = "[toolboxes]\nv = { path = 'kit/v.afp' }\n";
    let manifest = |name: &str| format!("[package]\nname = \"{name}\"\n");
    let robot_of = |text: &str| {
        let folder = project(&[
            ("afp.toml", text),
            ("Cargo.toml", &manifest("whole")),
            ("kit/Cargo.toml", &manifest("kit-v")),
            ("kit/v.afp", ""),
        ]);
        find(folder.path()).robot().unwrap().map(|robot| robot.rust_type())
    };
    let text = format!("[robot]\ntoolbox = 'v'\nsim = 'Vacuum'\n{toolbox}");
    assert_eq!(robot_of(&text).as_deref(), Some("kit_v::Vacuum"));
    assert_eq!(robot_of("[robot]\nsim = 'a::Toy'").as_deref(), Some("whole::a::Toy"));
    let text = format!("[robot]\ntoolbox = 'v'\nsim = 'Toy'\ncrate = {{ path = '.' }}\n{toolbox}");
    assert_eq!(robot_of(&text).as_deref(), Some("whole::Toy"));
    assert_eq!(robot_of(toolbox), None);
}

#[test]
fn a_robot_without_a_crate_is_reported_at_its_heading() {
    let folder = project(&[("afp.toml", "[robot]\nsim = 'Toy'\ncrate = { path = 'x' }")]);
    let text = find(folder.path()).robot().unwrap_err().to_string();
    assert!(text.contains("cannot read the manifest"), "{text}");
    assert!(text.contains("afp.toml:1:2"), "{text}");
}

#[test]
fn a_robot_without_a_simulation_has_only_hardware() {
    let text = "[robot]\nhardware = { type = 'Board', settings = { port = 'x' } }";
    let folder = project(&[("afp.toml", text), ("Cargo.toml", "[package]\nname = \"arm\"\n")]);
    let project = find(folder.path());
    let hardware = project.hardware().unwrap().unwrap();
    assert_eq!(hardware.rust_type(), "arm::Board");
    assert_eq!(project.robot_for_hardware().unwrap(), None);
    let why = project.robot().unwrap_err().to_string();
    assert!(why.contains("no 'sim'") && why.contains("--robot hardware"), "{why}");
}
