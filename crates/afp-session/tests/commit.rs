//! The commit that a build names.

use std::fs;
use std::path::Path;
use std::process::Command;

#[path = "../build.rs"]
#[allow(dead_code)]
mod script;

fn git(folder: &Path, arguments: &[&str]) {
    let identity = ["-c", "user.name=afp", "-c", "user.email=afp@example.org"];
    let status = Command::new("git").arg("-C").arg(folder).args(identity).args(arguments).output();
    assert!(status.is_ok_and(|output| output.status.success()), "git {arguments:?}");
}

#[test]
fn a_checkout_has_its_commit_and_a_mark_if_it_has_changes() {
    let folder = tempfile::tempdir().unwrap();
    let krate = folder.path().join("crates/some");
    fs::create_dir_all(&krate).unwrap();
    let commit = || script::of_checkout(krate.to_str().unwrap());
    assert_eq!(commit(), None, "it is no checkout");
    git(folder.path(), &["init", "--quiet"]);
    fs::write(krate.join("lib.rs"), "").unwrap();
    git(folder.path(), &["add", "."]);
    git(folder.path(), &["commit", "--quiet", "-m", "one"]);
    let clean = commit().unwrap();
    assert!(clean.len() == 12 && clean.chars().all(|c| c.is_ascii_hexdigit()), "{clean}");
    fs::write(krate.join("lib.rs"), "// changed").unwrap();
    assert_eq!(commit(), Some(format!("{clean}+")));
}

#[test]
fn a_package_has_the_commit_of_its_source() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(script::of_package(folder.path()), None);
    let text = "{\n  \"git\": {\n    \"sha1\": \"0123456789abcdef0123\"\n  }\n}";
    fs::write(folder.path().join(".cargo_vcs_info.json"), text).unwrap();
    assert_eq!(script::of_package(folder.path()).as_deref(), Some("0123456789ab"));
}
