//! The files of new projects are valid with every name.

use afp_dsl::Toolboxes;
use afp_project::Origin;
use afp_syntax::source::Source;

use super::{File, Kind, files};

const KINDS: [Kind; 7] =
    [Kind::Plan, Kind::Toolbox, Kind::Robot, Kind::Carbot, Kind::Pi, Kind::Ugv, Kind::PicarX];

#[test]
fn every_profile_has_a_project() {
    for profile in afp_project::PROFILES {
        let kind = Kind::of_profile(profile.name).unwrap();
        let files = made("mycar", kind);
        let (project, _) = afp_project::read(text(&files, "afp.toml"));
        let robot = project.robot.unwrap().profile.unwrap();
        assert_eq!(robot.name, profile.name);
    }
}

fn made(name: &str, kind: Kind) -> Vec<File> {
    files(name, kind, &Origin::Path("/afp".to_owned())).unwrap()
}

fn text<'a>(files: &'a [File], path: &str) -> &'a str {
    let file = files.iter().find(|file| file.path == path);
    &file.unwrap_or_else(|| panic!("{path} among {files:?}")).text
}

#[test]
fn plans_scenarios_and_toolboxes_are_valid_and_canonical() {
    for (name, kind) in KINDS.into_iter().flat_map(|kind| [("rover", kind), ("my-2nd_rover", kind)])
    {
        let files = made(name, kind);
        let (project, mistakes) = afp_project::read(text(&files, "afp.toml"));
        assert_eq!(mistakes, []);
        let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        for toolbox in &project.toolboxes {
            toolboxes.add(Source::new(&toolbox.path, text(&files, &toolbox.path)), &toolbox.name);
        }
        let read = |path: &str| Ok(text(&files, path).to_owned());
        for file in files.iter().filter(|file| file.path.ends_with(".afp")) {
            let canonical = afp_format::format(&file.text).ok();
            assert_eq!(canonical.as_deref(), Some(&*file.text), "{}", file.path);
            if file.path.starts_with("plans/") {
                let source = Source::new(&file.path, &*file.text);
                let compiled = afp_dsl::compile(&source, &toolboxes, &read);
                assert!(compiled.diags.is_empty(), "{}", compiled.render(false));
            }
        }
    }
}

#[test]
fn no_placeholder_is_left() {
    for file in KINDS.into_iter().flat_map(|kind| made("my-rover", kind)) {
        assert!(!file.text.contains("{{name") && !file.text.contains("{{Name"), "{file:?}");
        assert!(!file.path.contains('{'), "{}", file.path);
    }
}

#[test]
fn a_manifest_takes_the_crates_from_the_given_place() {
    let manifest = |origin: Origin| {
        let files = files("rover", Kind::Robot, &origin).unwrap();
        text(&files, "Cargo.toml").to_owned()
    };
    let path = manifest(Origin::Path("/a \"b\"/".to_owned()));
    assert!(path.contains(r#"afp = { path = "/a \"b\"/crates/afp" }"#), "{path}");
    let version = manifest(Origin::Version("0.1".to_owned()));
    let line = r#"afp-session = { version = "0.1", features = ["load"] }"#;
    assert!(version.contains(line), "{version}");
}

#[test]
fn keywords_of_rust_are_not_valid_names() {
    // The keywords of the 2024 edition, strict ones and reserved ones.
    let strict = "as async await break const continue crate dyn else enum extern false fn for if impl in let loop match mod move \
                  mut pub ref return self static struct super trait true type unsafe use where while";
    let reserved =
        "abstract become box do final gen macro override priv try typeof unsized virtual yield";
    for word in strict.split_whitespace().chain(reserved.split_whitespace()) {
        for kind in KINDS {
            assert!(files(word, kind, &Origin::Version(String::new())).is_err(), "{word}");
        }
    }
}

#[test]
fn invalid_names_are_refused_with_a_suggestion() {
    for name in ["", "Rover", "2nd", "a b", "a--b", "rover-", "r\u{e4}der", "../x", "a/b"] {
        let error = files(name, Kind::Plan, &Origin::Version(String::new())).unwrap_err();
        assert!(error.to_string().contains("'my-rover'"), "{name:?}: {error}");
    }
    // Words of Rust; packages, traits and types of the project's own files; types of Rust's
    // prelude.
    let taken = [
        "std",
        "turn",
        "self",
        "robot",
        "wheels",
        "floor",
        "environment",
        "noise",
        "grid",
        "length",
        "check_bumper",
        "check-touch-sensor",
        "forward",
        "option",
        "libm",
        "afp",
        "afpc",
        "afp-session",
        "afp-mine",
    ];
    for name in taken {
        let error = files(name, Kind::Plan, &Origin::Version(String::new())).unwrap_err();
        let help = format!("another name, such as 'my-{name}'");
        assert!(error.to_string().contains(&help), "{error}");
        assert!(files(&format!("my-{name}"), Kind::Plan, &Origin::Version(String::new())).is_ok());
    }
}
