//! Stored sources of a plan find each other again.

use crate::support;

use std::fs;

use afp_dsl::compile;
use afp_dsl::files::{Disk, Files, Texts};
use afp_syntax::source::Source;

const MAIN: &str = "use \"z.afp\"\nuse \"../lib.afp\"\nplan X { start a subplan a: L { OK -> b } \
                    subplan b: Z { OK -> terminate } }\n";
const LIB: &str = "use \"plans/z.afp\"\nplan L { start a subplan a: Z { OK -> terminate } }\n";
const PART: &str = "use std\nplan Z { start a actor a: Wait { Elapsed -> terminate } }\n";

/// The paths of the stored sources of `MAIN`, after compiling them again.
fn kept(files: &dyn Files) -> Vec<String> {
    let toolboxes = support::toolboxes();
    let compiled = compile(&Source::new("x.afp", MAIN), &toolboxes, files);
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    let texts = compiled.plan_texts();
    let mut again = Texts::default();
    texts.iter().for_each(|(path, text)| again.add(path, text.as_str()));
    let (path, text) = &texts[0];
    let compiled = compile(&Source::new(path, text), &toolboxes, &again);
    assert!(compiled.graph.is_some(), "{path}: {}", compiled.render(false));
    texts.into_iter().map(|(path, _)| path).collect()
}

#[test]
fn a_file_that_is_used_by_two_paths_is_found_by_both() {
    let folder = std::env::temp_dir().join(format!("afp-texts-{}", std::process::id()));
    let plans = folder.join("plans");
    fs::create_dir_all(&plans).unwrap();
    fs::write(plans.join("z.afp"), PART).unwrap();
    fs::write(folder.join("lib.afp"), LIB).unwrap();
    let paths = kept(&Disk(plans));
    fs::remove_dir_all(folder).unwrap();
    assert_eq!(paths, ["plans/x.afp", "plans/z.afp", "lib.afp"]);
}

/// A disk with an unknown base folder.
struct Nowhere;

impl Files for Nowhere {
    fn read(&self, path: &str) -> Result<String, String> {
        Ok(if path == "../lib.afp" { LIB } else { PART }.to_owned())
    }

    fn identity(&self, path: &str) -> String {
        path.rsplit('/').next().unwrap_or(path).to_owned()
    }
}

#[test]
fn without_a_folder_name_a_file_has_an_entry_for_each_path() {
    assert_eq!(kept(&Nowhere), ["here/x.afp", "here/z.afp", "lib.afp", "plans/z.afp"]);
}
