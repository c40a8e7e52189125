//! The world of a run, for its picture.

use afp_session::{Drawing, Pose2, Thing};
use serde_json::{Value, json};

use super::{Adapter, Answer, Launch, Surroundings};

impl Adapter<'_> {
    /// Returns the world of a run: metres and radians, x forward from the start, y left.
    pub(super) fn world(&mut self, launch: Launch) -> Answer<Value> {
        let Surroundings { drawing, worlds, drops, camera, seed, cut_short } =
            self.host.world(&launch)?;
        let Drawing { start, body, things, patches, lights } = &drawing;
        let Pose2 { x, y, heading } = start;
        let patches: Vec<_> = patches
            .iter()
            .map(|patch| json!({ "corners": patch.corners, "color": patch.color }))
            .collect();
        let drops: Vec<_> = drops
            .iter()
            .map(|drop| json!({ "shape": drop.shape, "outline": drop.outline }))
            .collect();
        let worlds: Vec<_> =
            worlds.iter().map(|(name, from)| json!({ "name": name, "from": from })).collect();
        Ok(json!({
            "start": [x, y, heading],
            "body": body,
            "things": things.iter().map(thing).collect::<Vec<_>>(),
            "patches": patches,
            "lights": lights,
            "worlds": worlds,
            "drops": drops,
            "camera": camera,
            // JavaScript numbers are too short for a seed.
            "seed": seed.map(|seed| seed.to_string()),
            "cutShort": cut_short,
        }))
    }
}

fn thing(thing: &Thing) -> Value {
    let Thing { id, name, outline, low, movable, labelled, path, end: _ } = thing;
    json!({ "id": id, "name": name, "outline": outline, "low": low, "movable": movable, "labelled": labelled, "path": path })
}
