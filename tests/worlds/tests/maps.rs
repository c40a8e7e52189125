//! Success rates of `GoTo` on public maps. The test downloads nothing: `AFP_MAPS` is a folder with
//! the repositories of `maps.toml`, each in a folder of its name. `AFP_PLACES` sets the number of
//! places on each map, 9 by default, and `AFP_MAP` selects maps by a part of their path.

use std::path::Path;
use std::sync::Mutex;
use std::{env, fs};

use afp_sim::{Pose, World};
use afp_worlds::{Errand, Reach, run};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use serde::Deserialize;

const LIST: &str = include_str!("../maps.toml");
/// The default number of places on each map.
const PLACES: u64 = 9;
/// The time limit of the robot, in seconds.
const PATIENCE: u64 = 900;

#[derive(Deserialize)]
struct List {
    map: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    repository: String,
    path: String,
    start: [f64; 3],
    /// The permitted misses of nine places.
    #[serde(default)]
    missed: u64,
}

impl Entry {
    /// The world of the map, as text and loaded.
    fn load(&self, folder: &Path) -> Result<(String, World), String> {
        let path = folder.join(&self.repository).join(&self.path);
        let read = |path: &Path| fs::read(path).map_err(|why| format!("{}: {why}", path.display()));
        let said = |why: &dyn ToString| format!("{}: {}", path.display(), why.to_string());
        let map = String::from_utf8(read(&path)?).map_err(|why| said(&why))?;
        let picture = World::map_picture(&map).map_err(|why| said(&why))?;
        let picture = read(&path.with_file_name(picture))?;
        let text = World::map_text(&self.path, &map, &picture).map_err(|why| said(&why))?;
        let world = World::parse(&text).map_err(|why| said(&why))?;
        let [x, y, degrees] = self.start;
        let start = Pose { x, y, heading: degrees.to_radians() };
        let world = afp_session::World::started_at(&world, start).map_err(|why| said(&why))?;
        Ok((text, world))
    }

    /// Drives to places of the map; returns the numbers of misses, of drives with contacts, and of
    /// places.
    fn visit(&self, folder: &Path, places: u64) -> Result<[usize; 3], String> {
        let (text, world) = self.load(folder)?;
        let reach = Reach::of(&world);
        println!("{}: {:.0} square metres", self.path, reach.area());
        let account = Mutex::new([0; 3]);
        (0..places).into_par_iter().for_each(|number| {
            let map = (&world, &reach);
            let errand = Errand::within_reach(map, text.clone(), number, PATIENCE);
            let Some(errand) = errand else { return };
            let outcome = run(&errand.case);
            let (why, touches) = (errand.objection(&outcome), errand.touches(&outcome).count());
            if let Some(why) = &why {
                println!("  {number} ({:?}): {why}", errand.case.inputs);
                if let Some(at) = outcome.seen.astray {
                    println!("    it did not know where it was from {at} on");
                }
            }
            let counts = [usize::from(why.is_some()), usize::from(touches > 0), 1];
            let mut account = account.lock().expect("nobody panics here");
            account.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        });
        Ok(account.into_inner().expect("nobody panics here"))
    }
}

#[test]
fn places_of_public_maps_are_reached() {
    let list: List = toml_edit::de::from_str(LIST).expect("the list is sound");
    let Some(folder) = env::var_os("AFP_MAPS") else {
        let names: Vec<_> = list.map.iter().map(|map| map.repository.as_str()).collect();
        println!("left out, since AFP_MAPS names no folder with {}", names.join(", "));
        return;
    };
    let places = env::var("AFP_PLACES").map_or(PLACES, |text| text.parse().expect("a number"));
    let only = env::var("AFP_MAP").unwrap_or_default();
    let maps: Vec<_> = list.map.iter().filter(|map| map.path.contains(&only)).collect();
    assert!(!maps.is_empty(), "no map of the list has '{only}' in its path");
    let mut bad = Vec::new();
    for map in maps {
        let [missed, touched, all] =
            map.visit(folder.as_ref(), places).unwrap_or_else(|why| panic!("{why}"));
        let told = format!("{missed} of {all} missed, {touched} touch");
        println!("  {told}");
        if all == 0 || touched > 0 || missed as u64 * PLACES > map.missed * places {
            bad.push(format!("{}: {told}", map.path));
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}
