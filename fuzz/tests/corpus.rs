//! All files of the corpora, including the cases found so far, keep their property.

use std::fs;
use std::path::Path;

use afp_fuzz::TARGETS;

#[test]
fn every_file_of_the_corpora_keeps_its_property() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for (name, target) in TARGETS {
        let mut files: Vec<_> = fs::read_dir(home.join(name))
            .unwrap_or_else(|why| panic!("no corpus for '{name}': {why}"))
            .map(|file| file.unwrap().path())
            .collect();
        files.sort();
        assert!(!files.is_empty(), "the corpus of '{name}' is empty");
        for file in files {
            // Shown only after a panic of the target.
            println!("{}", file.display());
            target(&fs::read(&file).unwrap());
        }
    }
}

/// These scenarios are the seeds of the search.
#[test]
fn the_shipped_scenarios_keep_their_property() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plans/tests");
    let files = fs::read_dir(home).unwrap().map(|file| file.unwrap().path());
    let plans: Vec<_> =
        files.filter(|file| file.extension().is_some_and(|it| it == "afp")).collect();
    assert!(plans.len() > 5, "{plans:?}");
    for file in plans {
        println!("{}", file.display());
        afp_fuzz::scenario(&fs::read(&file).unwrap());
    }
}

#[test]
fn every_target_has_its_fuzzer() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz_targets");
    let fuzzers: Vec<_> = fs::read_dir(home)
        .unwrap()
        .map(|file| file.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    assert_eq!(fuzzers.len(), TARGETS.len());
    for (name, _) in TARGETS {
        assert!(fuzzers.iter().any(|known| known == name), "{name}");
    }
}
