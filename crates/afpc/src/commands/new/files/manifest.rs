//! The manifest of a new project's crate.

use afp_project::Origin;

use super::Kind;

pub(crate) fn text(name: &str, kind: Kind, afp: &Origin) -> String {
    let (needs, tests): (&[_], &[_]) = match kind {
        Kind::Robot => (
            &[("afp", ""), ("afp-platform", ""), ("afp-session", "load")],
            &[("afp-std", ""), ("afp-test", "")],
        ),
        _ => (&[("afp", ""), ("afp-carbot", "")], &[("afp-sim", "load"), ("afp-test", "")]),
    };
    let lines = |all: &[(&str, &str)]| -> String {
        all.iter().map(|(krate, feature)| dependency(krate, feature, afp)).collect()
    };
    let libm = if kind == Kind::Robot { "libm = \"0.2\"\n" } else { "" };
    format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\npublish = false\n\n\
         [dependencies]\n{}{libm}\n[dev-dependencies]\n{}\n[workspace]\n",
        lines(needs),
        lines(tests),
    )
}

fn dependency(krate: &str, feature: &str, afp: &Origin) -> String {
    let (key, value) = match afp {
        Origin::Path(root) => {
            ("path", format!("{}/crates/{krate}", root.trim_end_matches(['/', '\\'])))
        }
        Origin::Git(url) => ("git", url.clone()),
        Origin::Version(version) => ("version", version.clone()),
    };
    let value = value.replace('\\', "\\\\").replace('"', "\\\"");
    let features = match feature {
        "" => String::new(),
        feature => format!(", features = [\"{feature}\"]"),
    };
    format!("{krate} = {{ {key} = \"{value}\"{features} }}\n")
}
