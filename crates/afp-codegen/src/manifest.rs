//! The manifests of generated crates.

/// The start of every manifest.
pub const MADE_BY: &str = "# Made by 'afpc";
/// The start of every Rust file that the next build may replace or remove.
pub const RUST_MADE_BY: &str = "// Made by 'afpc build'";

/// The source of a crate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A folder; for the `afp` crates, their checkout.
    Path(String),
    /// A repository.
    Git(String),
    /// A registry, by version.
    Version(String),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dependency {
    /// The name in the manifest; with `_` for `-` the name in Rust.
    pub key: String,
    /// The name of the package.
    pub package: String,
    /// The source of the crate; a path is that of the package.
    pub origin: Origin,
    pub features: Features,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Features {
    Default,
    Only(Vec<String>),
}

impl Dependency {
    /// One of the `afp` crates.
    pub(super) fn ours(package: &str, origin: &Origin) -> Dependency {
        let origin = match origin {
            Origin::Path(root) => {
                Origin::Path(format!("{}/crates/{package}", root.trim_end_matches('/')))
            }
            other => other.clone(),
        };
        let [key, package] = [package; 2].map(str::to_owned);
        Dependency { key, package, origin, features: Features::Default }
    }

    /// The dependency with only these features and those of other dependents.
    pub(super) fn with_only(self, features: &[String]) -> Dependency {
        Dependency { features: Features::Only(features.to_vec()), ..self }
    }

    fn line(&self) -> String {
        let Dependency { key, package, origin, features } = self;
        let (kind, value) = match origin {
            Origin::Path(path) => ("path", path),
            Origin::Git(url) => ("git", url),
            Origin::Version(version) => ("version", version),
        };
        let package =
            if key == package { String::new() } else { format!(", package = {}", quoted(package)) };
        let features = match features {
            Features::Default => String::new(),
            Features::Only(none) if none.is_empty() => ", default-features = false".to_owned(),
            Features::Only(some) => {
                let some: Vec<_> = some.iter().map(|name| quoted(name)).collect();
                format!(", default-features = false, features = [{}]", some.join(", "))
            }
        };
        format!("{key} = {{ {kind} = {}{package}{features} }}\n", quoted(value))
    }
}

/// A manifest: its generator (` build' from x.afp`), the package's name, its dependencies, its
/// profiles.
pub(super) fn manifest(
    made_by: &str,
    package: &str,
    mut dependencies: Vec<Dependency>,
    profile: &str,
) -> String {
    dependencies.sort_by(|one, other| one.key.cmp(&other.key));
    dependencies.dedup();
    let lines: String = dependencies.iter().map(Dependency::line).collect();
    format!(
        "{MADE_BY}{made_by}.\n\
         [package]\n\
         name = {name}\n\
         version = \"0.1.0\"\n\
         edition = \"2024\"\n\
         publish = false\n\
         \n\
         [dependencies]\n\
         {lines}\
         \n\
         {profile}\
         \n\
         [workspace]\n",
        name = quoted(package),
    )
}

pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            letter if letter.is_control() => quoted += &format!("\\u{:04X}", u32::from(letter)),
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}
