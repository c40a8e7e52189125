//! Plans that a client names by an address.

use super::{framed, told_in};
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
