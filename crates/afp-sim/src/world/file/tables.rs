//! The tables of a world file as serde reads them.

use serde::Deserialize;

/// The other allowed keys depend on the robot.
#[derive(Deserialize)]
pub(super) struct File {
    pub(super) version: u32,
    #[serde(default)]
    pub(super) name: String,
    pub(super) robot: Robot,
    #[serde(default)]
    pub(super) floor: Floor,
    #[serde(default)]
    pub(super) wall: Vec<Wall>,
    #[serde(default, rename = "box")]
    pub(super) boxes: Vec<Box>,
    #[serde(default)]
    pub(super) polygon: Vec<Polygon>,
    #[serde(default)]
    pub(super) patch: Vec<Patch>,
    #[serde(default)]
    pub(super) infrared: Vec<Infrared>,
    pub(super) map: Option<Map>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Map {
    pub(super) corners_m: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Robot {
    pub(super) pose_m_deg: [f64; 3],
    pub(super) charge: Option<f64>,
    pub(super) length_m: Option<f64>,
    pub(super) width_m: Option<f64>,
    pub(super) track_m: Option<f64>,
    pub(super) wheelbase_m: Option<f64>,
    pub(super) steering_deg: Option<f64>,
    pub(super) fastest_m_s: Option<f64>,
    pub(super) sonar_m: Option<f64>,
    pub(super) encoders: Option<bool>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Floor {
    pub(super) color: Option<String>,
    pub(super) texture: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wall {
    pub(super) name: Option<String>,
    pub(super) points_m: Vec<[f64; 2]>,
    #[serde(default)]
    pub(super) closed: bool,
    pub(super) thickness_m: Option<f64>,
    pub(super) height_m: Option<f64>,
    pub(super) color: Option<String>,
    pub(super) texture: Option<String>,
    pub(super) echo: Option<f64>,
    pub(super) mapped: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Box {
    pub(super) name: Option<String>,
    pub(super) pose_m_deg: [f64; 3],
    pub(super) size_m: [f64; 2],
    pub(super) height_m: f64,
    pub(super) mass_kg: Option<f64>,
    pub(super) path: Option<Path>,
    pub(super) color: Option<String>,
    pub(super) texture: Option<String>,
    pub(super) echo: Option<f64>,
    pub(super) mapped: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Polygon {
    pub(super) name: Option<String>,
    pub(super) points_m: Vec<[f64; 2]>,
    pub(super) height_m: f64,
    pub(super) mass_kg: Option<f64>,
    pub(super) path: Option<Path>,
    pub(super) color: Option<String>,
    pub(super) texture: Option<String>,
    pub(super) echo: Option<f64>,
    pub(super) mapped: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Path {
    pub(super) by_m: Vec<[f64; 2]>,
    pub(super) speed_m_s: f64,
    #[serde(default)]
    pub(super) closed: bool,
    #[serde(default)]
    pub(super) wait_s: f64,
    #[serde(default)]
    pub(super) start_s: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Patch {
    pub(super) name: Option<String>,
    pub(super) points_m: Vec<[f64; 2]>,
    pub(super) color: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Infrared {
    pub(super) name: Option<String>,
    pub(super) position_m: [f64; 2],
    pub(super) height_m: Option<f64>,
    pub(super) strength: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::File;
    use crate::world::file::keys::WORLD;

    #[test]
    fn every_key_is_in_the_file() {
        let whole = "version = 1\nrobot = { pose_m_deg = [0, 0, 0] }\n";
        assert!(toml_edit::de::from_str::<File>(whole).is_ok());
        for key in WORLD.iter().map(|key| key.name) {
            // No key has the type of a moment of time.
            let others: String =
                whole.lines().filter(|line| !line.starts_with(key)).collect::<Vec<_>>().join("\n");
            let text = format!("{others}\n{key} = 2026-01-01\n");
            let wrong = toml_edit::de::from_str::<File>(&text).err();
            let span = wrong.as_ref().and_then(toml_edit::de::Error::span);
            assert_eq!(span.map(|span| &text[span]), Some("2026-01-01"), "{key}: {wrong:?}");
        }
    }
}
