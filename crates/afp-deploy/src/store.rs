//! The folder of releases on a robot.
//!
//! ```text
//! afp.toml               the robot's own project file
//! objects/SHA256         files, each complete
//! releases/ID/           a release: manifest.json, and links to its objects in files/
//! generations/00000012   -> ../releases/ID: every switch, in order
//! current                -> generations/00000012: starts next
//! confirmed              -> generations/00000011: has started without a failure
//! ```
//!
//! A release appears by one rename, and so does the link `current`. [`Store::prune`] removes the
//! remains of an interrupted deploy.

use std::collections::BTreeSet;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::{fmt, fs};

use sha2::{Digest, Sha256};

use crate::disk::Disk;
use crate::hash;
use crate::manifest::{Entry, Manifest, is_id};

/// The releases that are kept.
pub const KEPT: usize = 3;

const MANIFEST: &str = "manifest.json";
const CURRENT: &str = "current";
const CONFIRMED: &str = "confirmed";

/// A folder of releases.
pub struct Store<'a> {
    root: PathBuf,
    disk: &'a dyn Disk,
}

/// A switch to a release.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generation {
    pub number: u64,
    /// The name of the release.
    pub release: String,
}

/// A file that is being received.
pub struct Incoming {
    entry: Entry,
    hasher: Sha256,
    size: u64,
}

/// A failure of the disk, or a damaged file.
#[derive(Debug)]
pub struct StoreError {
    path: PathBuf,
    why: io::Error,
}

impl fmt::Display for StoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "'{}': {}", self.path.display(), self.why)
    }
}

impl std::error::Error for StoreError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.why)
    }
}

type Stored<T> = Result<T, StoreError>;

/// For `map_err` on operations with a path.
fn at(path: &Path) -> impl FnOnce(io::Error) -> StoreError {
    let path = path.to_owned();
    move |why| StoreError { path, why }
}

fn damaged(path: &Path, why: &str) -> StoreError {
    at(path)(io::Error::new(io::ErrorKind::InvalidData, why))
}

impl<'a> Store<'a> {
    /// Opens a folder, and creates what it lacks.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn open(root: &Path, disk: &'a dyn Disk) -> Stored<Self> {
        let store = Store { root: root.to_owned(), disk };
        for name in ["objects", "releases", "generations", "logs"] {
            let path = root.join(name);
            if !path.is_dir() {
                disk.create_dir_all(&path).map_err(at(&path))?;
            }
        }
        Ok(store)
    }

    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The folder with the files of a release.
    pub fn files(&self, release: &str) -> PathBuf {
        self.release(release).join("files")
    }

    fn release(&self, id: &str) -> PathBuf {
        self.root.join("releases").join(id)
    }

    fn object(&self, sha256: &str) -> PathBuf {
        self.root.join("objects").join(sha256)
    }

    fn generation(&self, number: u64) -> PathBuf {
        self.root.join("generations").join(name_of(number))
    }

    fn incoming(&self) -> PathBuf {
        self.root.join("objects/incoming")
    }

    /// The folder in which a release is put together.
    fn staging(&self) -> PathBuf {
        self.root.join("staging")
    }

    /// The hashes of a release that the robot lacks, without repetition.
    pub fn missing(&self, manifest: &Manifest) -> Vec<String> {
        let hashes: BTreeSet<_> = manifest.files.iter().map(|entry| &entry.sha256).collect();
        hashes.into_iter().filter(|hash| !self.object(hash).is_file()).cloned().collect()
    }

    /// Begins to receive a file.
    ///
    /// # Errors
    /// The disk fails.
    pub fn begin(&self, entry: &Entry) -> Stored<Incoming> {
        let path = self.incoming();
        self.disk.remove(&path).map_err(at(&path))?;
        self.disk.append(&path, &[]).map_err(at(&path))?;
        Ok(Incoming { entry: entry.clone(), hasher: Sha256::new(), size: 0 })
    }

    /// Receives a part of a file. Returns the number of bytes that are still to come.
    ///
    /// # Errors
    /// The disk fails, or the file is longer than announced.
    pub fn part(&self, incoming: &mut Incoming, part: &[u8]) -> Stored<u64> {
        let path = self.incoming();
        incoming.size = incoming.size.saturating_add(part.len() as u64);
        let Some(left) = incoming.entry.size.checked_sub(incoming.size) else {
            return Err(damaged(&path, "the file is longer than announced"));
        };
        self.disk.append(&path, part).map_err(at(&path))?;
        incoming.hasher.update(part);
        Ok(left)
    }

    /// Keeps a file that was received.
    ///
    /// # Errors
    /// The disk fails, or the file is not the announced one.
    pub fn keep(&self, incoming: Incoming) -> Stored<()> {
        let (path, sha256) = (self.incoming(), &incoming.entry.sha256);
        if hash::text(incoming.hasher) != *sha256 {
            return Err(damaged(&path, "the file was damaged on the way"));
        }
        let object = self.object(sha256);
        self.disk.seal(&path).map_err(at(&path))?;
        self.disk.rename(&path, &object).map_err(at(&object))?;
        self.sync("objects")
    }

    fn sync(&self, name: &str) -> Stored<()> {
        let path = self.root.join(name);
        self.disk.sync_dir(&path).map_err(at(&path))
    }

    /// Puts a release together, whose files are all on the robot. Returns the folder of its files.
    ///
    /// # Errors
    /// The disk fails, or a file is damaged.
    pub fn stage(&self, manifest: &Manifest) -> Stored<PathBuf> {
        let staging = self.staging();
        self.disk.remove(&staging).map_err(at(&staging))?;
        let files = staging.join("files");
        let mut folders = BTreeSet::from([staging.clone(), files.clone()]);
        for entry in &manifest.files {
            let (object, path) = (self.object(&entry.sha256), files.join(&entry.path));
            if !is_whole(&object, &entry.sha256) {
                self.disk.remove(&object).map_err(at(&object))?;
                return Err(damaged(&object, "the file is damaged: deploy again to send it again"));
            }
            let inside = path.ancestors().skip(1).take_while(|it| it.starts_with(&files));
            folders.extend(inside.map(Path::to_owned));
            let folder = path.parent().unwrap_or(&files);
            self.disk.create_dir_all(folder).map_err(at(folder))?;
            self.disk.hard_link(&object, &path).map_err(at(&path))?;
        }
        let text = staging.join(MANIFEST);
        self.disk.append(&text, manifest.text().as_bytes()).map_err(at(&text))?;
        self.disk.seal(&text).map_err(at(&text))?;
        for folder in folders.iter().rev() {
            self.disk.sync_dir(folder).map_err(at(folder))?;
        }
        Ok(files)
    }

    /// Makes the staged release one of the robot's releases, and switches to it.
    ///
    /// # Errors
    /// The disk fails.
    pub fn publish(&self, manifest: &Manifest) -> Stored<Generation> {
        let (staging, id) = (self.staging(), manifest.id());
        let release = self.release(&id);
        match self.manifest(&id) {
            Ok(_) => self.disk.remove(&staging).map_err(at(&staging))?,
            Err(_) => {
                self.disk.remove(&release).map_err(at(&release))?;
                self.disk.rename(&staging, &release).map_err(at(&release))?;
                self.sync("releases")?;
            }
        }
        self.switch(&id)
    }

    /// Switches to a release, which the next start runs.
    ///
    /// # Errors
    /// The disk fails.
    pub fn switch(&self, release: &str) -> Stored<Generation> {
        let last = self.generations().last().map_or(0, |last| last.number);
        let number = last.saturating_add(1);
        let (link, target) = (self.generation(number), Path::new("../releases").join(release));
        self.disk.symlink(&target, &link).map_err(at(&link))?;
        self.sync("generations")?;
        self.point(CURRENT, number)?;
        Ok(Generation { number, release: release.to_owned() })
    }

    /// Notes that the current release has started without a failure.
    ///
    /// # Errors
    /// The disk fails.
    pub fn confirm(&self) -> Stored<()> {
        match self.current() {
            Some(current) if self.confirmed().as_ref() != Some(&current) => {
                self.point(CONFIRMED, current.number)
            }
            _ => Ok(()),
        }
    }

    /// Replaces a link to a generation.
    fn point(&self, name: &str, number: u64) -> Stored<()> {
        let (link, new) = (self.root.join(name), self.root.join(format!("{name}.new")));
        self.disk.remove(&new).map_err(at(&new))?;
        let target = Path::new("generations").join(name_of(number));
        self.disk.symlink(&target, &new).map_err(at(&new))?;
        self.disk.rename(&new, &link).map_err(at(&link))?;
        self.sync("")
    }

    /// The release that the next start runs.
    pub fn current(&self) -> Option<Generation> {
        self.pointed(CURRENT)
    }

    /// The release that started last without a failure.
    pub fn confirmed(&self) -> Option<Generation> {
        self.pointed(CONFIRMED)
    }

    fn pointed(&self, name: &str) -> Option<Generation> {
        let target = fs::read_link(self.root.join(name)).ok()?;
        self.read_generation(target.file_name()?.to_str()?)
    }

    fn read_generation(&self, name: &str) -> Option<Generation> {
        let number = name.parse().ok()?;
        let target = fs::read_link(self.generation(number)).ok()?;
        let release = target.file_name()?.to_str()?.to_owned();
        (is_id(&release) && self.manifest(&release).is_ok())
            .then_some(Generation { number, release })
    }

    /// All switches, the oldest first.
    fn generations(&self) -> Vec<Generation> {
        let names = names_in(&self.root.join("generations"));
        let mut all: Vec<_> = names.iter().filter_map(|name| self.read_generation(name)).collect();
        all.sort_by_key(|generation| generation.number);
        all
    }

    /// The manifest of a complete release.
    ///
    /// # Errors
    /// There is no such release, or a file of it is missing.
    pub fn manifest(&self, release: &str) -> Stored<Manifest> {
        let path = self.release(release).join(MANIFEST);
        let text = fs::read_to_string(&path).map_err(at(&path))?;
        let manifest = Manifest::read(&text).map_err(|why| damaged(&path, &why))?;
        for entry in &manifest.files {
            let path = self.files(release).join(&entry.path);
            let size = fs::metadata(&path).map_err(at(&path))?.len();
            if size != entry.size {
                return Err(damaged(&path, "the file has another length"));
            }
        }
        Ok(manifest)
    }

    /// Whether every file of a release has its hash.
    pub fn is_intact(&self, release: &str) -> bool {
        let is_whole =
            |entry: &Entry| is_whole(&self.files(release).join(&entry.path), &entry.sha256);
        self.manifest(release).is_ok_and(|manifest| manifest.files.iter().all(is_whole))
    }

    /// The release that ran before the current one; a second rollback therefore undoes the first.
    pub fn before(&self) -> Option<Generation> {
        let current = self.current()?;
        let all = self.generations().into_iter().rev();
        let mut before = all.skip_while(|it| it.number >= current.number);
        before.find(|it| it.release != current.release)
    }

    /// Switches to the last confirmed release if the current one is another, and forgets that one.
    ///
    /// # Errors
    /// The disk fails.
    pub fn fall_back(&self) -> Stored<Option<Generation>> {
        match (self.current(), self.confirmed()) {
            (Some(current), Some(good)) if good.release != current.release => {
                let good = self.switch(&good.release)?;
                // A rollback must not return to the failed release.
                let failed = self.generation(current.number);
                self.disk.remove(&failed).map_err(at(&failed))?;
                Ok(Some(good))
            }
            _ => Ok(None),
        }
    }

    /// The newest switch to each release, from the current one backwards.
    pub fn releases(&self) -> Vec<Generation> {
        let Some(current) = self.current() else { return Vec::new() };
        let mut releases: Vec<Generation> = Vec::new();
        for generation in self.generations().into_iter().rev() {
            let is_known = releases.iter().any(|known| known.release == generation.release);
            if generation.number <= current.number && !is_known {
                releases.push(generation);
            }
        }
        releases
    }

    /// Removes old releases, and the remains of an interrupted deploy. The current release, the
    /// confirmed one and the [`KEPT`] newest stay.
    ///
    /// # Errors
    /// The disk fails.
    pub fn prune(&self) -> Stored<()> {
        let releases = self.releases();
        if releases.is_empty() {
            return Ok(());
        }
        let confirmed = self.confirmed();
        let newest = releases.into_iter().take(KEPT);
        let kept: Vec<_> = newest.chain(confirmed).collect();
        let generations: BTreeSet<_> = kept.iter().map(|it| name_of(it.number)).collect();
        self.keep_only("generations", &generations)?;
        let ids: BTreeSet<_> = kept.iter().map(|it| it.release.clone()).collect();
        self.keep_only("releases", &ids)?;
        let manifests = ids.iter().filter_map(|id| self.manifest(id).ok());
        let hashes = manifests.flat_map(|it| it.files).map(|entry| entry.sha256);
        self.keep_only("objects", &hashes.collect())?;
        let staging = self.staging();
        self.disk.remove(&staging).map_err(at(&staging))
    }

    fn keep_only(&self, folder: &str, kept: &BTreeSet<String>) -> Stored<()> {
        let folder = self.root.join(folder);
        for name in names_in(&folder).iter().filter(|name| !kept.contains(*name)) {
            let path = folder.join(name);
            self.disk.remove(&path).map_err(at(&path))?;
        }
        Ok(())
    }
}

fn name_of(number: u64) -> String {
    format!("{number:08}")
}

/// The names in a folder, in order.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut names: Vec<_> = names.collect();
    names.sort();
    names
}

fn is_whole(path: &Path, sha256: &str) -> bool {
    let Ok(mut file) = fs::File::open(path) else { return false };
    let (mut hasher, mut part) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut part) {
            Ok(0) => return hash::text(hasher) == sha256,
            Ok(count) => hasher.update(part.get(..count).unwrap_or_default()),
            Err(_) => return false,
        }
    }
}
