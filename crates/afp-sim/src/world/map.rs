//! Maps of `map_server`: a `.yaml` file and a picture, converted to a world.
//!
//! The result is the text of a world file, so that logs and pictures can use it. Occupied cells
//! become boxes that are as large as possible.

mod boxes;
mod picture;
mod settings;

use super::{FARTHEST, World, WorldError};
use crate::chassis::{HALF_LENGTH, HALF_WIDTH};
use boxes::{Cells, Rectangle};
use picture::Grid;
use settings::{Cell, Settings};
use std::fmt::Write;

/// The maximum number of boxes in a map of rooms.
const MOST: usize = 50_000;
const ROOM: f64 = 0.05;

impl World {
    /// The picture's file name in a map's `.yaml` file, relative to its folder.
    ///
    /// # Errors
    /// The text is not a map.
    pub fn map_picture(yaml: &str) -> Result<String, WorldError> {
        Settings::read(yaml).map(|settings| settings.image)
    }

    /// The text of a world file for a map: `yaml` is the text of its `.yaml` file, `picture` the
    /// bytes of its PGM or PNG. Walls are 2.5 m high. The robot starts inside of the walls, at the
    /// free place nearest to the origin of the map's frame, and faces along x.
    ///
    /// # Errors
    /// The text or the picture is invalid, the map's mode is unknown, no cell is occupied, the map
    /// has too many cells or no place for the robot.
    pub fn map_text(name: &str, yaml: &str, picture: &[u8]) -> Result<String, WorldError> {
        let settings = Settings::read(yaml)?;
        let known = picture::read(picture, |pixel| settings.cell(pixel));
        let known = known.map_err(|message| WorldError::new(None, message))?;
        if !is_near(&settings, [known.width, known.height].map(|cells| cells as f64)) {
            let message = format!("the map reaches farther than {FARTHEST} m");
            return Err(WorldError::new(None, message));
        }
        let cells = Cells::new(&known, |cell| settings.is_wall(cell));
        if cells.is_empty() {
            let message =
                "no cell of the map is occupied: check 'mode', 'negate' and 'occupied_thresh'";
            return Err(WorldError::new(None, message));
        }
        let start = start(&settings, &cells, &known)
            .ok_or_else(|| WorldError::new(None, "the map has no free place for the robot"))?;
        let boxes = cells.boxes();
        if boxes.len() > MOST {
            let message = format!("the map has {} separate parts, more than {MOST}", boxes.len());
            return Err(WorldError::new(None, message));
        }
        Ok(text(name, &settings, &cells, start, &boxes))
    }
}

/// Whether a map with this number of cells is small enough and near enough to the origin.
fn is_near(settings: &Settings, [width, height]: [f64; 2]) -> bool {
    let corners = [[0.0, 0.0], [width, 0.0], [0.0, height], [width, height]];
    let places = corners.map(|[across, up]| settings.place(across, up));
    let sizes = [width, height].map(|cells| cells * settings.resolution);
    places.as_flattened().iter().chain(&sizes).all(|value| value.abs() <= FARTHEST)
}

/// The middle of the start cell: the cell nearest to the origin with free surroundings. Known free
/// cells that cannot be reached from beyond the map come first, then known free cells, then others.
fn start(settings: &Settings, cells: &Cells, known: &Grid<Cell>) -> Option<[f64; 2]> {
    let radius = libm::hypot(HALF_LENGTH, HALF_WIDTH) + ROOM;
    let reach = libm::ceil(radius / settings.resolution) as usize;
    let far = |at: [f64; 2]| at[0] * at[0] + at[1] * at[1];
    let outside = cells.outside();
    let rank = |row: usize, column: usize| {
        let at = row * cells.width + column;
        let free = known.values.get(at) == Some(&Cell::Free);
        let inside = outside.get(at) == Some(&false);
        u8::from(!free) + u8::from(!(free && inside))
    };
    let all = (0..cells.height).flat_map(|row| (0..cells.width).map(move |column| (row, column)));
    let roomy = all.filter(|(row, column)| cells.free_around(*row, *column, reach));
    let places = roomy.map(|(row, column)| {
        let place = settings.place(column as f64 + 0.5, (cells.height - row) as f64 - 0.5);
        (rank(row, column), place)
    });
    let order =
        |a: &(u8, [f64; 2]), b: &(u8, [f64; 2])| a.0.cmp(&b.0).then(far(a.1).total_cmp(&far(b.1)));
    places.min_by(order).map(|(_, place)| place)
}

fn text(
    name: &str,
    settings: &Settings,
    cells: &Cells,
    start: [f64; 2],
    boxes: &[Rectangle],
) -> String {
    let [x, y] = start;
    let name = toml_edit::Value::from(name);
    let mut text =
        format!("version = 1\nname = {name}\n\n[robot]\npose_m_deg = [{x:.4}, {y:.4}, 0.0]\n");
    let [width, height] = [cells.width, cells.height].map(|count| count as f64);
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(|[across, up]| {
        let [x, y] = settings.place(across, up);
        format!("[{x:.4}, {y:.4}]")
    });
    // Writing to a String cannot fail.
    let _ = write!(text, "\n[map]\ncorners_m = [{}]\n", corners.join(", "));
    let degrees = settings.yaw.to_degrees();
    for Rectangle { left, right, top, bottom } in boxes {
        let (across, up) = ((left + right) as f64 / 2.0, (top + bottom) as f64 / 2.0);
        let [x, y] = settings.place(across, cells.height as f64 - up);
        let size = [right - left, bottom - top].map(|n| n as f64 * settings.resolution);
        let _ = write!(
            text,
            "\n[[box]]\nname = \"map\"\npose_m_deg = [{x:.4}, {y:.4}, {degrees:.4}]\n\
             size_m = [{:.4}, {:.4}]\nheight_m = 2.5\n",
            size[0], size[1]
        );
    }
    text
}
