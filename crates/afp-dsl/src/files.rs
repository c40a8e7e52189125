//! The plan files that plan files use: their sources, and the meaning of their paths.
//!
//! The compiler does no I/O. Its caller provides [`Files`]: the [`Disk`], unsaved files of an
//! editor, or files embedded in a program.

mod uri;

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::PathBuf;

pub use afp_output::{read_text, read_text_file};
pub use uri::{path_of, uri_of};

/// The source of used plan files.
pub trait Files {
    /// The text of a file. The path is the using file's folder joined with the path after `use`,
    /// without `.` and with `..` resolved as far as possible, separated by `/`.
    ///
    /// # Errors
    /// Why there is no text: lower case, no final period.
    fn read(&self, path: &str) -> Result<String, String>;

    /// A common identity of all paths of one file, so that a link and its target are one file; the
    /// path itself if links are unknown.
    fn identity(&self, path: &str) -> String {
        path.to_owned()
    }

    /// The absolute path of the base folder, without links; `None` without one.
    fn folder(&self) -> Option<String> {
        None
    }
}

impl<F: Fn(&str) -> Result<String, String>> Files for F {
    fn read(&self, path: &str) -> Result<String, String> {
        self(path)
    }
}

/// Files on disk, relative to a folder; the process's folder if empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Disk(pub PathBuf);

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        read_text_file(&self.0.join(path)).map_err(|error| match error.kind() {
            ErrorKind::NotFound => "there is no such file".to_owned(),
            ErrorKind::InvalidData | ErrorKind::InvalidInput | ErrorKind::FileTooLarge => {
                error.to_string()
            }
            _ => error.to_string().to_lowercase(),
        })
    }

    fn identity(&self, path: &str) -> String {
        let real = self.0.join(path).canonicalize();
        real.map_or_else(|_| path.to_owned(), |real| real.to_string_lossy().into_owned())
    }

    fn folder(&self) -> Option<String> {
        let real = self.0.join(".").canonicalize().ok()?;
        Some(normalised(&real.to_string_lossy()))
    }
}

/// File contents by path; empty if a plan file uses no others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Texts(BTreeMap<String, String>);

impl Texts {
    pub fn add(&mut self, path: &str, text: impl Into<String>) {
        self.0.insert(normalised(path), text.into());
    }

    /// Splits a string with several files, each after a line `// file: PATH`, into the first file
    /// and the others.
    #[doc(hidden)]
    pub fn in_one(text: &str) -> (String, Texts) {
        const HEAD: &str = "// file: ";
        let (mut first, mut texts) = (String::new(), Texts::default());
        let mut path = None;
        for line in text.split_inclusive('\n') {
            if let Some(next) = line.strip_prefix(HEAD) {
                path = Some(normalised(next.trim_end()));
            }
            match &path {
                None => first += line,
                Some(path) => {
                    let text = texts.0.entry(path.clone()).or_default();
                    *text += if line.starts_with(HEAD) { "" } else { line };
                }
            }
        }
        (first, texts)
    }
}

impl Files for Texts {
    fn read(&self, path: &str) -> Result<String, String> {
        self.0.get(&normalised(path)).cloned().ok_or_else(|| "there is no such file".to_owned())
    }
}

/// Normalises a path: without `.` and empty parts, with `..` resolved as far as possible, separated
/// by `/`. Equal paths then have equal text, apart from links.
pub fn normalised(path: &str) -> String {
    let path = path.replace('\\', "/");
    let root = if path.starts_with('/') { "/" } else { "" };
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/').filter(|part| !matches!(*part, "" | ".")) {
        match (part, parts.last()) {
            ("..", Some(last)) if *last != ".." => {
                parts.pop();
            }
            ("..", None) if !root.is_empty() => {}
            _ => parts.push(part),
        }
    }
    format!("{root}{}", parts.join("/"))
}

/// The path of a file that `user` names as `written`.
pub fn joined(user: &str, written: &str) -> String {
    let user = normalised(user);
    match user.rsplit_once('/') {
        Some((folder, _)) => normalised(&format!("{folder}/{written}")),
        None => normalised(written),
    }
}

/// How `user` can name the file `path`, both normalised; `None` if that is impossible.
pub fn relative(user: &str, path: &str) -> Option<String> {
    if user.starts_with('/') != path.starts_with('/') {
        return None;
    }
    let mut from: Vec<&str> = user.split('/').collect();
    from.pop();
    let to: Vec<&str> = path.split('/').collect();
    let same = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    // The name of the folder before '..' is unknown.
    if from[same..].contains(&"..") {
        return None;
    }
    let up = std::iter::repeat_n("..", from.len() - same);
    Some(up.chain(to[same..].iter().copied()).collect::<Vec<_>>().join("/"))
}

/// The normalised paths, relative to their deepest common folder. If only some leave the base
/// folder, its name is taken from `folder`, its absolute path, or is `here` if unknown.
pub(crate) fn below_all(paths: &[String], folder: Option<&str>) -> Vec<String> {
    let ups = |path: &str| path.split('/').take_while(|part| *part == "..").count();
    let highest = paths.iter().map(|path| ups(path)).max().unwrap_or(0);
    let names: Vec<&str> =
        folder.unwrap_or("").split('/').filter(|name| !name.is_empty()).collect();
    let names = match names.len().checked_sub(highest) {
        Some(above) => names[above..].to_vec(),
        None => vec!["here"; highest],
    };
    let grounded = paths.iter().map(|path| {
        let up = ups(path);
        let folders = names.iter().take(highest - up).flat_map(|name| [*name, "/"]);
        folders.collect::<String>() + &path["../".len() * up..]
    });
    let paths: Vec<_> = grounded.collect();
    let folder = |path: &str| path.rfind('/').map_or(0, |slash| slash + 1);
    let mut shared = paths.first().map_or("", |path| &path[..folder(path)]);
    while let Some(other) = paths.iter().find(|path| !path.starts_with(shared)) {
        let same = shared.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
        // The common prefix may end inside a name; a folder ends at a slash.
        let cut = shared.as_bytes()[..same].iter().rposition(|byte| *byte == b'/');
        shared = &shared[..cut.map_or(0, |slash| slash + 1)];
    }
    paths.iter().map(|path| path[shared.len()..].to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::{Disk, Files, Texts, below_all, joined, normalised, relative};

    #[test]
    fn a_binary_file_is_not_read() {
        let folder = std::env::temp_dir().join(format!("afp-files-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("bytes.afp"), [0xff, 0xfe]).unwrap();
        std::fs::write(folder.join("text.afp"), "plan \u{e4}").unwrap();
        let disk = Disk(folder.clone());
        assert_eq!(disk.read("text.afp").unwrap(), "plan \u{e4}");
        assert_eq!(disk.read("bytes.afp").unwrap_err(), "it is not UTF-8 text");
        assert_eq!(disk.read("none.afp").unwrap_err(), "there is no such file");
        if cfg!(target_os = "linux") {
            assert_eq!(disk.read("/dev/zero").unwrap_err(), "it is a pipe or a device, not a file");
        }
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn paths_of_one_file_become_equal() {
        for (path, same) in [
            ("a.afp", "a.afp"),
            ("./x//a.afp", "x/a.afp"),
            ("x/../a.afp", "a.afp"),
            ("../x/a.afp", "../x/a.afp"),
            ("../../a.afp", "../../a.afp"),
            ("/x/../../a.afp", "/a.afp"),
            (r"x\y\a.afp", "x/y/a.afp"),
        ] {
            assert_eq!(normalised(path), same);
        }
    }

    #[test]
    fn a_path_is_relative_to_the_folder_of_its_file() {
        assert_eq!(joined("plans/main.afp", "lib/a.afp"), "plans/lib/a.afp");
        assert_eq!(joined("plans/main.afp", "../a.afp"), "a.afp");
        assert_eq!(joined("main.afp", "../a.afp"), "../a.afp");
        assert_eq!(joined("/main.afp", "a.afp"), "/a.afp");
        assert_eq!(joined("./main.afp", "./a.afp"), "a.afp");
    }

    #[test]
    fn a_relative_path_leads_to_the_file() {
        for (user, path) in [
            ("plans/main.afp", "plans/lib/a.afp"),
            ("plans/lib/a.afp", "plans/main.afp"),
            ("a.afp", "../b.afp"),
            ("/x/a.afp", "/y/b.afp"),
        ] {
            assert_eq!(joined(user, &relative(user, path).unwrap()), path);
        }
        assert_eq!(relative("../a.afp", "b.afp"), None);
        assert_eq!(relative("/a.afp", "b.afp"), None);
    }

    #[test]
    fn the_common_beginning_of_all_paths_is_removed() {
        let below = |paths: &[&str]| {
            below_all(&paths.iter().map(|path| (*path).to_owned()).collect::<Vec<_>>(), None)
        };
        assert_eq!(below(&["x/y/a.afp"]), ["a.afp"]);
        assert_eq!(below(&["x/y/a.afp", "x/z/b.afp"]), ["y/a.afp", "z/b.afp"]);
        assert_eq!(below(&["x/ya/a.afp", "x/yb/b.afp"]), ["ya/a.afp", "yb/b.afp"]);
        assert_eq!(below(&["../x/a.afp", "../b.afp"]), ["x/a.afp", "b.afp"]);
        assert_eq!(below(&["x/a.afp", "../b.afp"]), ["here/x/a.afp", "b.afp"]);
        assert_eq!(below(&["/a.afp", "/x/b.afp"]), ["a.afp", "x/b.afp"]);
        assert_eq!(below(&["a.afp", "x/b.afp"]), ["a.afp", "x/b.afp"]);
        let paths = ["x/a.afp", "../b.afp", "../../c.afp", "../y/b.afp"].map(str::to_owned);
        let known = below_all(&paths, Some("/home/robot/plans/new"));
        assert_eq!(known, ["plans/new/x/a.afp", "plans/b.afp", "c.afp", "plans/y/b.afp"]);
        let shallow = below_all(&paths, Some("/new"));
        assert_eq!(shallow, ["here/here/x/a.afp", "here/b.afp", "c.afp", "here/y/b.afp"]);
    }

    #[test]
    fn files_in_one_string_are_separated() {
        let (first, texts) = Texts::in_one("one\n// file: x/b.afp\ntwo\nthree\n// file: c.afp\n");
        assert_eq!(first, "one\n");
        assert_eq!(texts.read("x/b.afp").unwrap(), "two\nthree\n");
        assert_eq!(texts.read("./c.afp").unwrap(), "");
        assert!(texts.read("b.afp").is_err());
    }
}
