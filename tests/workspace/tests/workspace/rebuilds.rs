//! The packages that cargo rebuilds after a change.

use std::collections::BTreeSet;
use std::fs::File;
use std::path::Path;
use std::time::SystemTime;

use afp_workspace::{built_from, cargo, output, packages, root};
use serde_json::Value;

const STYLE: &str = "crates/afp-draw/src/svg/style.rs";

/// The packages of the workspace that cargo checks again.
fn rebuilt() -> BTreeSet<String> {
    let mut check = cargo("check");
    check.args(["--message-format", "json", "--quiet"]);
    check.args(["--package", "afp-draw", "--package", "afp-ide"]);
    check.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("rebuilds"));
    let text = output(&mut check);
    let messages = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let built = messages.filter(|message| message["fresh"] == false);
    let names = built.filter_map(|message| Some(message["package_id"].as_str()?.to_owned()));
    let ours: Vec<String> = packages().into_keys().collect();
    let name = |id: String| {
        let is =
            |name: &&String| id.contains(&format!("/{name}#")) || id.contains(&format!("#{name}@"));
        ours.iter().find(is).cloned()
    };
    names.filter_map(name).collect()
}

/// Changes a file's modification time, and restores it.
struct Touched {
    file: File,
    before: SystemTime,
}

impl Touched {
    fn new(path: &str) -> Touched {
        let file = File::options().append(true).open(root().join(path)).unwrap();
        let before = file.metadata().unwrap().modified().unwrap();
        file.set_modified(SystemTime::now()).unwrap();
        Touched { file, before }
    }
}

impl Drop for Touched {
    fn drop(&mut self) {
        // If this fails, only this file is rebuilt once more.
        let _ = self.file.set_modified(self.before);
    }
}

#[test]
fn a_style_of_the_drawing_rebuilds_nothing_below_it() {
    rebuilt();
    assert_eq!(rebuilt(), BTreeSet::new(), "nothing has changed");
    let touched = Touched::new(STYLE);
    let rebuilt = rebuilt();
    drop(touched);
    assert!(rebuilt.contains("afp-draw"), "{rebuilt:?}");
    let packages = packages();
    for name in &rebuilt {
        assert!(built_from(&packages, name).contains("afp-draw"), "'{name}' was built again");
    }
}
