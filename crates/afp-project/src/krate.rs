//! The Rust crate of a toolbox or robot: its location and name.

use std::path::{Path, PathBuf};

use afp_excerpt::Mistake;
use afp_output::read_text_file;
use toml_edit::Document;

use crate::path::{NAME, shown};
use crate::project::{Crate, Hardware, Origin, Robot, Toolbox};

/// A crate of the project, for a manifest's dependency.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CrateLink {
    /// The key of the dependency; with `_` for `-` the crate's name in Rust.
    pub key: String,
    pub package: String,
    /// The origin of the package; a folder as an absolute path.
    pub origin: Origin,
    /// Its folder, if it is on this machine.
    pub folder: Option<PathBuf>,
    /// The module in it, if not its root.
    pub module: Option<String>,
}

impl CrateLink {
    /// The path of the module with `templates`, for other crates.
    pub fn rust_path(&self) -> String {
        self.in_crate(&self.rust_name())
    }

    pub fn rust_name(&self) -> String {
        self.key.replace('-', "_")
    }

    /// The path of the module with `templates`, with another crate name.
    pub fn in_crate(&self, name: &str) -> String {
        match &self.module {
            Some(module) => format!("{name}::{module}"),
            None => name.to_owned(),
        }
    }
}

/// The robot's type and its crate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotLink {
    /// The toolbox with its devices.
    pub toolbox: Option<String>,
    pub krate: CrateLink,
    /// The type, relative to the crate's root.
    pub sim: String,
}

impl RobotLink {
    /// The path of the type, for other crates.
    pub fn rust_type(&self) -> String {
        format!("{}::{}", self.krate.rust_name(), self.sim)
    }
}

/// The type of the hardware robot and its crate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HardwareLink {
    pub krate: CrateLink,
    /// The type, relative to the crate's root.
    pub ty: String,
    /// Names and values of its settings, and of [`Realtime`](crate::Realtime) with their prefix.
    pub settings: Vec<(String, String)>,
}

impl HardwareLink {
    /// The path of the type, for other crates.
    pub fn rust_type(&self) -> String {
        format!("{}::{}", self.krate.rust_name(), self.ty)
    }
}

/// An error and its help.
type Wrong = (String, String);

/// Finds the crate of a toolbox of the project in `folder`; `file` is the toolbox file.
///
/// # Errors
/// The crate is missing on this machine, or differs from the entry.
pub(crate) fn link(folder: &Path, toolbox: &Toolbox, file: &Path) -> Result<CrateLink, Mistake> {
    let wrong = |(message, help)| Mistake { span: Some(toolbox.span.clone()), message, help };
    let what = format!("the file of the toolbox '{}'", toolbox.name);
    find(folder, &toolbox.krate, &toolbox.name, (&what, file)).map_err(wrong)
}

/// Finds the robot's crate for the project in `folder`; `file` is its toolbox file, or else the
/// project file.
///
/// # Errors
/// As [`link`].
pub(crate) fn link_robot(
    folder: &Path,
    robot: &Robot,
    krate: &Crate,
    file: &Path,
) -> Result<RobotLink, Mistake> {
    let wrong = |(message, help)| Mistake { span: Some(robot.span.clone()), message, help };
    let sim = robot.sim.clone().ok_or_else(|| {
        wrong((
            "'[robot]' has no 'sim', so plans run only on the real robot".to_owned(),
            "add '--robot hardware', or name the simulated robot: 'sim = \"Vacuum\"'".to_owned(),
        ))
    })?;
    let what = format!("'{}'", shown(file).display());
    let krate = find(folder, krate, "robot", (&what, file)).map_err(wrong)?;
    Ok(RobotLink { toolbox: robot.toolbox.clone(), krate, sim })
}

/// Finds the hardware robot's crate for the project in `folder`. By default it is that of the
/// toolbox or the project, `krate`; `file` is the toolbox file, or else the project file.
///
/// # Errors
/// As [`link`].
pub(crate) fn link_hardware(
    folder: &Path,
    hardware: &Hardware,
    krate: &Crate,
    file: &Path,
) -> Result<HardwareLink, Mistake> {
    let Hardware { ty, settings, span, .. } = hardware;
    let wrong = |(message, help)| Mistake { span: Some(span.clone()), message, help };
    let project = folder.join(NAME);
    let around = format!("'{}'", shown(file).display());
    let krate = match &hardware.krate {
        Some(own) => find(folder, own, "hardware", ("the project file", &project)),
        None => find(folder, krate, "robot", (&around, file)),
    };
    let krate = krate.map_err(wrong)?;
    Ok(HardwareLink { krate, ty: ty.clone(), settings: settings.clone() })
}

/// Finds a crate; without an origin, the crate around a file.
fn find(
    folder: &Path,
    krate: &Crate,
    name: &str,
    (what, file): (&str, &Path),
) -> Result<CrateLink, Wrong> {
    let Crate { package, origin, module } = krate;
    let home = match origin {
        Some(Origin::Path(path)) => folder.join(path),
        Some(elsewhere) => {
            // Cargo may not have fetched the crate yet.
            let name = package.clone().unwrap_or_else(|| name.to_owned());
            let (origin, module) = (elsewhere.clone(), module.clone());
            return Ok(CrateLink {
                key: name.clone(),
                package: name,
                origin,
                folder: None,
                module,
            });
        }
        None => around(what, file)?,
    };
    let manifest = home.join("Cargo.toml");
    let names = Names::read(&manifest)?;
    if let Some(package) = package.as_ref().filter(|package| **package != names.package) {
        return Err((
            format!(
                "'{}' belongs to '{}', not to '{package}'",
                shown(&manifest).display(),
                names.package
            ),
            "'crate = { path = \"...\" }' names the folder of its Cargo.toml".to_owned(),
        ));
    }
    let folder = home.canonicalize().unwrap_or(home);
    let origin = Origin::Path(folder.display().to_string());
    let (key, module) = (names.key(), module.clone());
    Ok(CrateLink { key, package: names.package, origin, folder: Some(folder), module })
}

/// The nearest folder around a file with a manifest.
fn around(what: &str, file: &Path) -> Result<PathBuf, Wrong> {
    let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    let mut folders = file.ancestors().skip(1);
    let home = folders.find(|folder| folder.join("Cargo.toml").is_file());
    home.map(Path::to_owned).ok_or_else(|| {
        (
            format!("no folder around {what} has a Cargo.toml"),
            "'crate = { path = \"...\" }' names the folder of its Cargo.toml".to_owned(),
        )
    })
}

/// Names of a manifest's package and library.
struct Names {
    package: String,
    library: Option<String>,
}

impl Names {
    fn read(manifest: &Path) -> Result<Names, Wrong> {
        let shown = shown(manifest);
        let shown = shown.display();
        let help = "'crate = { path = \"...\" }' names the folder of its Cargo.toml".to_owned();
        let text = match read_text_file(manifest) {
            Ok(text) => text,
            Err(error) => {
                return Err((format!("cannot read the manifest '{shown}': {error}"), help));
            }
        };
        let document = Document::parse(text)
            .map_err(|error| (format!("'{shown}': {}", error.message()), "mend it".to_owned()))?;
        let name = |table: &str| Some(document.get(table)?.get("name")?.as_str()?.to_owned());
        match name("package") {
            Some(package) => Ok(Names { package, library: name("lib") }),
            None => Err((format!("'{shown}' has no package"), help)),
        }
    }

    /// The package's name, unless its library has another name.
    fn key(&self) -> String {
        match &self.library {
            Some(library) if *library != self.package.replace('-', "_") => library.clone(),
            _ => self.package.clone(),
        }
    }
}
