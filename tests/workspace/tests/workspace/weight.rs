//! The dependencies of `afpc`: no asynchronous run time and no web server, since messages to
//! editors use standard input.

use std::collections::BTreeSet;

use afp_workspace::{cargo, output};

/// Families of crates, by prefixes of their names.
const FAMILIES: &[&str] = &[
    "actix",
    "async-",
    "axum",
    "embassy-",
    "futures",
    "h2",
    "hyper",
    "native-tls",
    "openssl",
    "quinn",
    "reqwest",
    "rocket",
    "rouille",
    "rustls",
    "smol",
    "tiny_http",
    "tokio",
    "tonic",
    "tower",
    "tungstenite",
    "warp",
    "websocket",
    "zenoh",
];

fn is_refused(name: &str) -> bool {
    FAMILIES.iter().any(|family| {
        let rest = name.strip_prefix(family);
        rest.is_some_and(|rest| {
            family.ends_with('-') || rest.is_empty() || rest.starts_with(['-', '_'])
        })
    })
}

/// The crates of these families in `afpc` with some features.
fn refused(features: &str) -> BTreeSet<String> {
    let options = ["--package", "afpc", "--edges", "normal,build", "--prefix", "none"];
    let tree =
        output(cargo("tree").args(options).args(["--format", "{p}", "--features", features]));
    let names: Vec<_> = tree.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.contains(&"clap") && names.contains(&"afp-core"), "{tree}");
    names.into_iter().filter(|name| is_refused(name)).map(str::to_owned).collect()
}

#[test]
fn the_command_line_carries_no_server() {
    assert_eq!(refused(""), BTreeSet::new());
}

#[test]
fn even_the_live_server_has_no_asynchronous_runtime() {
    assert_eq!(refused("live"), BTreeSet::from(["tungstenite".to_owned()]));
}

#[test]
fn families_are_refused_and_their_namesakes_are_not() {
    for name in ["tokio", "tokio-util", "async-std", "hyper", "tower-lsp", "h2"] {
        assert!(is_refused(name), "{name}");
    }
    for name in ["smolvec", "clap", "h2o", "towers", "afp-core", "lsp-server"] {
        assert!(!is_refused(name), "{name}");
    }
}
