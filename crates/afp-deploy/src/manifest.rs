//! The list of a release's files, and how the release runs.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::hash::{is_hash, sha256};

/// The value of `--robot` of a robot without motors.
pub const SIMULATED: &str = "sim";
/// The most files of a release.
pub const MOST_FILES: usize = 256;
/// The longest text in a manifest, such as a path, in bytes.
pub const LONGEST_TEXT: usize = 256;
/// The largest release, in bytes.
pub const LARGEST: u64 = 256 << 20;
/// The digits of a release's name, the beginning of its manifest's hash.
const ID_DIGITS: usize = 16;

/// A release.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// The name of the plan.
    pub plan: String,
    /// The file among `files` that runs: the plan's file, or the built program.
    pub file: String,
    pub kind: Kind,
    /// The model of the robot that the plan is for: its profile, or else the toolbox with its
    /// devices.
    pub model: String,
    /// The value of `--robot`: `hardware`, or `sim` to try a deploy without motors.
    pub robot: String,
    /// Values of `in` entries: name and value.
    pub set: Vec<(String, String)>,
    /// The SHA-256 of the calibration with which the plan was tried.
    #[serde(default)]
    pub calibration: Option<String>,
    /// The hash of the trace of the self-check on the machine that deploys.
    pub trace: String,
    pub files: Vec<Entry>,
}

/// How a release runs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The `afpc` of the robot interprets the plan.
    Interpreted,
    /// A program for this processor, such as `aarch64`.
    Built { architecture: String },
}

/// A file of a release.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Entry {
    /// Its path in the release, with `/`.
    pub path: String,
    /// Its length in bytes.
    pub size: u64,
    /// Its SHA-256 in lower-case hexadecimal digits.
    pub sha256: String,
}

/// A rule that a manifest breaks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Invalid {
    #[error("'{0}' is not a path inside of a release")]
    Path(String),
    #[error("the path '{0}' is listed twice, or as a file and as a folder")]
    Twice(String),
    #[error("'{0}' is not a SHA-256")]
    Hash(String),
    #[error("a string is empty, longer than {LONGEST_TEXT} bytes, or has control characters")]
    Text,
    #[error("more than {MOST_FILES} files or values")]
    Files,
    #[error("the files have more than {} MiB", LARGEST >> 20)]
    Size,
    #[error("'{0}' runs, but is not among the files")]
    NoFile(String),
    #[error("'{0}' is not the name of a plan or a robot")]
    Name(String),
}

impl Manifest {
    /// Checks all texts, paths, hashes and limits.
    ///
    /// # Errors
    /// The first rule that does not hold.
    pub fn check(&self) -> Result<(), Invalid> {
        if self.files.len() > MOST_FILES || self.set.len() > MOST_FILES {
            return Err(Invalid::Files);
        }
        let values = self.set.iter().flat_map(|(name, value)| [name, value]);
        let texts = [&self.model, &self.trace].into_iter().chain(values);
        if !texts.into_iter().all(|text| is_plain(text)) {
            return Err(Invalid::Text);
        }
        if let Some(name) = [&self.plan, &self.robot].into_iter().find(|name| !is_word(name)) {
            return Err(Invalid::Name((*name).clone()));
        }
        if let Some(hash) = self.calibration.as_ref().filter(|hash| !is_hash(hash)) {
            return Err(Invalid::Hash(hash.clone()));
        }
        let mut paths = BTreeSet::new();
        for entry in &self.files {
            if !is_inside(&entry.path) {
                return Err(Invalid::Path(entry.path.clone()));
            }
            if !is_hash(&entry.sha256) {
                return Err(Invalid::Hash(entry.sha256.clone()));
            }
            if !paths.insert(entry.path.as_str()) {
                return Err(Invalid::Twice(entry.path.clone()));
            }
        }
        let folder_of_another = |path: &&&str| {
            path.match_indices('/')
                .any(|(slash, _)| paths.contains(path.get(..slash).unwrap_or("")))
        };
        if let Some(path) = paths.iter().find(folder_of_another) {
            return Err(Invalid::Twice((*path).to_owned()));
        }
        if self.size().is_none_or(|size| size > LARGEST) {
            return Err(Invalid::Size);
        }
        match paths.contains(self.file.as_str()) {
            true => Ok(()),
            false => Err(Invalid::NoFile(self.file.clone())),
        }
    }

    /// The length of all files in bytes; `None` beyond 64 bits.
    pub fn size(&self) -> Option<u64> {
        self.files.iter().try_fold(0_u64, |sum, entry| sum.checked_add(entry.size))
    }

    /// The text that is stored and hashed.
    pub fn text(&self) -> String {
        // Texts, numbers and lists always have a form in JSON.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// The name of the release: the beginning of the hash of its manifest.
    pub fn id(&self) -> String {
        let mut id = sha256(self.text().as_bytes());
        id.truncate(ID_DIGITS);
        id
    }

    /// Reads the text of a manifest.
    ///
    /// # Errors
    /// The text is not a manifest, or breaks a rule.
    pub fn read(text: &str) -> Result<Manifest, String> {
        let manifest: Manifest = serde_json::from_str(text).map_err(|why| why.to_string())?;
        manifest.check().map_err(|why| why.to_string())?;
        Ok(manifest)
    }
}

/// Whether a text is a name of a release.
pub(crate) fn is_id(text: &str) -> bool {
    text.len() == ID_DIGITS && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// Whether a text can be a word of a command line, and in a report.
fn is_plain(text: &str) -> bool {
    (1..=LONGEST_TEXT).contains(&text.len()) && !text.chars().any(char::is_control)
}

fn is_word(text: &str) -> bool {
    let is_letter = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_');
    is_plain(text) && !text.starts_with('-') && text.bytes().all(is_letter)
}

/// Whether a path stays inside of its folder on every system.
fn is_inside(path: &str) -> bool {
    let is_part = |part: &str| !matches!(part, "" | "." | "..") && !part.starts_with('-');
    is_plain(path) && !path.contains(['\\', ':']) && path.split('/').all(is_part)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A release with these files.
    pub(crate) fn manifest(files: &[(&str, &str)]) -> Manifest {
        let entry = |(path, text): &(&str, &str)| Entry {
            path: (*path).to_owned(),
            size: text.len() as u64,
            sha256: sha256(text.as_bytes()),
        };
        Manifest {
            plan: "Patrol".to_owned(),
            file: files[0].0.to_owned(),
            kind: Kind::Interpreted,
            model: "carbot".to_owned(),
            robot: "sim".to_owned(),
            set: vec![("side".to_owned(), "left".to_owned())],
            calibration: None,
            trace: "00ff".to_owned(),
            files: files.iter().map(entry).collect(),
        }
    }

    #[test]
    fn a_manifest_is_read_back_and_names_its_release() {
        let one = manifest(&[("plan.afp", "plan A {}"), ("parts/b.afp", "plan B {}")]);
        assert_eq!(Manifest::read(&one.text()), Ok(one.clone()));
        let other = Manifest { set: Vec::new(), ..one.clone() };
        assert!(is_id(&one.id()) && one.id() != other.id());
        assert_eq!(sha256(b""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    }

    #[test]
    fn paths_that_leave_the_release_and_other_broken_rules_are_refused() {
        for path in ["/etc/passwd", "../a", "a/../b", "a//b", "", ".", "a\\b", "c:a", "-rf", "a\nb"]
        {
            let mut wrong = manifest(&[("plan.afp", "")]);
            wrong.files[0].path = path.to_owned();
            assert_eq!(wrong.check(), Err(Invalid::Path(path.to_owned())), "{path:?}");
        }
        let twice = manifest(&[("a", "1"), ("a", "2")]);
        assert_eq!(twice.check(), Err(Invalid::Twice("a".to_owned())));
        let nested = manifest(&[("a", "1"), ("a/b", "2")]);
        assert_eq!(nested.check(), Err(Invalid::Twice("a/b".to_owned())));
        let fine = manifest(&[("a", "1")]);
        let mut wrong = [(); 6].map(|()| fine.clone());
        wrong[0].files[0].sha256 = "00".to_owned();
        wrong[1].files[0].size = u64::MAX;
        wrong[2].file = "b".to_owned();
        wrong[3].robot = "sim --log /etc/passwd".to_owned();
        wrong[4].plan = "A\nB".to_owned();
        wrong[5].files = vec![fine.files[0].clone(); MOST_FILES + 1];
        for (n, wrong) in wrong.iter().enumerate() {
            assert!(wrong.check().is_err(), "{n}");
        }
    }
}
