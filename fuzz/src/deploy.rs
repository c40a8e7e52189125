//! Bytes for the agent of a robot.

use std::path::Path;

use afp_deploy::agent::{Agent, Host, Service, Started};
use afp_deploy::disk::ThisDisk;
use afp_deploy::manifest::Manifest;
use afp_deploy::store::{Store, names_in};
use afp_deploy::wire::Hello;

/// A robot that runs every release.
struct Robot(Option<String>);

impl Host for Robot {
    fn hello(&self) -> Hello {
        Hello { model: "carbot".to_owned(), ..Hello::default() }
    }

    fn check(&mut self, _: &Path, manifest: &Manifest) -> Result<String, String> {
        Ok(manifest.trace.clone())
    }

    fn service(&mut self) -> Result<Service, String> {
        Ok(Service::default())
    }

    fn restart(&mut self) -> Result<Started, String> {
        let release = self.0.take().unwrap_or_default();
        Ok(Started { release, instead: None })
    }

    fn arm(&mut self, _: bool) -> Result<(), String> {
        Ok(())
    }
}

/// A valid manifest is written back unchanged. An agent reads any bytes without a panic, and
/// writes nothing outside of its folder.
pub fn deploy(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data)
        && let Ok(manifest) = Manifest::read(text)
    {
        assert_eq!(Manifest::read(&manifest.text()).as_ref(), Ok(&manifest));
    }
    let Ok(folder) = tempfile::tempdir() else { return };
    let root = folder.path().join("root");
    let Ok(store) = Store::open(&root, &ThisDisk) else { return };
    let _ = Agent::new(store, &mut Robot(None)).serve(&mut &*data, &mut Vec::new());
    assert_eq!(names_in(folder.path()), ["root"]);
    if let Ok(store) = Store::open(&root, &ThisDisk)
        && let Some(current) = store.current()
    {
        assert!(store.is_intact(&current.release));
    }
}
