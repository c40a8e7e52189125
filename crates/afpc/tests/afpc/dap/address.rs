//! Plans that a client names by an address.

use super::{framed, told_at, told_in};
use crate::common::Place;

#[test]
fn the_address_of_a_plan_is_decoded() {
    let place = Place::new();
    let plan = "use std\nplan P {\n    start a\n    actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n";
    place.write("a b/é#1.afp", plan);
    let folder = place.path("").canonicalize().unwrap().display().to_string();
    for host in ["", "localhost"] {
        let address = format!("file://{host}{folder}/a%20b/%C3%A9%231.afp");
        for program in [address.clone(), format!("{address}:P")] {
            let launch = format!(r#"{{"program":"{program}","stopOnEntry":true}}"#);
            let lines =
                format!(r#"{{"source":{{"path":"{address}"}},"breakpoints":[{{"line":4}}]}}"#);
            let bytes = [framed("launch", &launch), framed("setBreakpoints", &lines)].concat();
            let said = told_in(&place, bytes.as_bytes());
            assert!(said.out.contains(r#""verified":true"#), "{program}: {said:?}");
        }
    }
}

#[test]
fn only_files_inside_of_the_folder_can_run() {
    let place = Place::new();
    place.write("w/sub/plan.afp", "use std\n");
    let plan = "use std\nplan P {\n    start a\n    actor a: Wait(duration = 1 s) { Elapsed -> terminate }\n}\n";
    place.write("other/plan.txt", plan);
    place.write("other/plan.afp:P", plan);
    let outside = place.path("other/plan.txt").canonicalize().unwrap().display().to_string();
    let dots = format!("{}/../other/plan.txt:P", place.path("w").canonicalize().unwrap().display());
    let mut named = vec![
        dots,
        outside.clone(),
        format!("{outside}:P"),
        format!("file://{outside}:P"),
        "w/sub/../../other/plan.txt:P".to_owned(),
        "other/plan.afp:P".to_owned(),
    ];
    #[cfg(unix)]
    for (link, to) in [("w/linked", &*outside), ("w/plan.afp", "../other/plan.txt")] {
        std::os::unix::fs::symlink(to, place.path(link)).unwrap();
        named.extend([link.to_owned(), format!("{link}:P")]);
    }
    for program in named {
        let launch = framed("launch", &format!(r#"{{"program":"{program}"}}"#));
        let world = framed("afp/world", &format!(r#"{{"program":"{program}"}}"#));
        for said in [launch, world] {
            let said = told_at(&place, "", &["dap", "--inside", "w"], said.as_bytes());
            assert!(said.out.contains("is outside of '"), "{program}: {said:?}");
        }
    }
}
