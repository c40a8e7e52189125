//! The gallery shows exactly the shipped plans.

use std::fs;

use crate::docs;

/// The largest total size of the gallery's pictures.
const MOST_BYTES: u64 = 2 << 20;

#[test]
fn every_shipped_plan_is_in_the_gallery() {
    let page = fs::read_to_string(docs().join("gallery.md")).unwrap();
    let files = fs::read_dir(docs().join("../plans")).unwrap().map(|file| file.unwrap().path());
    let plans = files.filter(|path| path.extension().is_some_and(|end| end == "afp"));
    let mut plans: Vec<_> =
        plans.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    plans.sort();
    let shown: Vec<_> =
        page.lines().filter_map(|line| line.strip_prefix("## `")?.strip_suffix('`')).collect();
    assert_eq!(shown, plans, "'cargo xtask gallery' writes the page");
    let sections = page.split("\n## `").skip(1).zip(&plans);
    for (section, plan) in sections {
        for picture in ["", "-run"] {
            let file = format!("(images/gallery/{plan}{picture}.svg)");
            assert!(section.contains(&file), "{plan}: no {file}");
        }
        assert!(section.contains("| runs | ended |"), "{plan}: no table of a sweep");
    }
}

#[test]
fn the_pictures_of_the_gallery_are_small() {
    let files = fs::read_dir(docs().join("images/gallery")).unwrap();
    let bytes: u64 = files.map(|file| file.unwrap().metadata().unwrap().len()).sum();
    assert!(bytes < MOST_BYTES, "{bytes} bytes");
}
