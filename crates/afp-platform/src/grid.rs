//! A world of square cells, drawn with letters.
//!
//! ```text
//! Hall
//! cell 25 cm
//!
//! ##########
//! # * #
//! # > #
//! ##########
//! ```
//!
//! The text has a name, the side of a cell, and the drawing: `#` is a wall, a space is floor, one
//! of `>^<v` is the robot with its heading. Robots define the meaning of other letters.

use std::f64::consts::TAU;

use afp_session::{Drawing, Patch, Pose2, Shape, Thing, WorldError, frames};

use crate::noise::Noise;

const WALL: char = '#';
const FLOOR: char = ' ';
/// The letters of the robot's start, with the heading in degrees.
const STARTS: [(char, f64); 4] = [('>', 0.0), ('^', 90.0), ('<', 180.0), ('v', -90.0)];
/// Height of walls, metres.
const HEIGHT: f64 = 0.4;
/// Maximum number of cells, with missing cells of short rows: two kilometres a side with cells of a
/// metre.
const MOST: usize = 4 << 20;
/// Number of corners of a drawn body.
const CORNERS: u32 = 24;

/// A world of square cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The name.
    pub name: String,
    /// Start of the robot in metres; the origin is the lower left corner.
    pub start: Pose2,
    /// Side of a cell, metres.
    cell: f64,
    columns: usize,
    /// Row by row, the lowest first.
    cells: Vec<char>,
}

/// A wall that overlaps a round body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Unit vector from the body's middle towards the wall.
    pub towards: [f64; 2],
    /// Depth of the overlap, metres.
    pub depth: f64,
}

impl Grid {
    /// Reads a world with these extra letters.
    ///
    /// # Errors
    /// The first error, with its place.
    pub fn read(text: &str, letters: &str) -> Result<Grid, WorldError> {
        let mut lines = lines(text);
        let (_, name) = lines.next().unwrap_or_default();
        let (at, size) = lines.next().unwrap_or_default();
        let cell = cell(size).ok_or_else(|| {
            wrong(
                at,
                size.len(),
                "the second line is the side of a cell, 'cell 25 cm', from 1 to 500",
            )
        })?;
        let rows: Vec<_> = lines.filter(|(_, row)| !row.trim().is_empty()).collect();
        let columns = columns(&rows)?;
        let (name, start) = (name.trim().to_owned(), Pose2::default());
        let mut grid = Grid { name, start, cell, columns, cells: Vec::new() };
        let mut starts = 0;
        for (y, (at, row)) in rows.iter().rev().enumerate() {
            for (x, (offset, letter)) in row.char_indices().enumerate() {
                let heading = STARTS.iter().find(|(known, _)| *known == letter);
                if let Some((_, heading)) = heading {
                    let [x, y] = [x, y].map(|n| (n as f64 + 0.5) * cell);
                    grid.start = Pose2 { x, y, heading: heading.to_radians() };
                    starts += 1;
                } else if !letters.contains(letter) && letter != WALL && letter != FLOOR {
                    let why = format!("'{letter}' is none of '#', ' ', '>^<v' and '{letters}'");
                    return Err(wrong(at + offset, letter.len_utf8(), &why));
                }
                grid.cells.push(if heading.is_some() { FLOOR } else { letter });
            }
            grid.cells.resize((y + 1) * columns, FLOOR);
        }
        match starts {
            1 => Ok(grid),
            _ => {
                let why = format!("the robot starts at one of '>^<v': the drawing has {starts}");
                Err(WorldError::new(None, why))
            }
        }
    }

    /// The text of a random world from a seed, with walls around it and this many blocks of each
    /// letter.
    pub fn made_up(seed: u64, columns: usize, rows: usize, blocks: &[(char, u32)]) -> String {
        let mut noise = Noise::new(seed, "floors");
        let mut below = |bound: usize| noise.below(bound as u32) as usize;
        let mut map = vec![vec![FLOOR; columns]; rows];
        for (letter, count) in blocks {
            for _ in 0..*count {
                let (x, y) = (below(columns), below(rows));
                let (wide, high) = (1 + below(3), 1 + below(3));
                for row in map.iter_mut().skip(y).take(high) {
                    row.iter_mut().skip(x).take(wide).for_each(|cell| *cell = *letter);
                }
            }
        }
        let mut text = format!("Floor {seed}\ncell 25 cm\n\n");
        for (y, row) in map.iter().enumerate() {
            for (x, letter) in row.iter().enumerate() {
                let edge = x == 0 || y == 0 || x + 1 == columns || y + 1 == rows;
                let near = x.abs_diff(2) <= 1 && y.abs_diff(rows / 2) <= 1;
                text.push(match (edge, near) {
                    (true, _) => WALL,
                    (_, true) if x == 2 && y == rows / 2 => '>',
                    (_, true) => FLOOR,
                    _ => *letter,
                });
            }
            text.push('\n');
        }
        text
    }

    /// The same world with the robot, a disc of this radius, at another start.
    ///
    /// # Errors
    /// The start overlaps a wall.
    pub fn started_at(&self, start: Pose2, radius: f64) -> Result<Grid, WorldError> {
        match self.contacts(start.x, start.y, radius).next() {
            Some(_) => Err(WorldError::new(None, "the robot starts inside of a wall")),
            None => Ok(Grid { start, ..self.clone() }),
        }
    }

    /// The letters of all cells, by index.
    pub fn letters(&self) -> &[char] {
        &self.cells
    }

    /// The index of the cell at a point; `None` outside.
    pub fn index(&self, x: f64, y: f64) -> Option<usize> {
        let [column, row] = [x, y].map(|along| libm::floor(along / self.cell));
        if column < 0.0 || row < 0.0 || column >= self.columns as f64 {
            return None;
        }
        let index = (row as usize).checked_mul(self.columns)?.checked_add(column as usize)?;
        (index < self.cells.len()).then_some(index)
    }

    /// The letter of the cell at a point; a wall outside.
    pub fn letter(&self, x: f64, y: f64) -> char {
        self.index(x, y).and_then(|index| self.cells.get(index)).copied().unwrap_or(WALL)
    }

    /// The walls that overlap a disc, cell by cell; none for a position that is not finite.
    pub fn contacts(&self, x: f64, y: f64, radius: f64) -> impl Iterator<Item = Contact> {
        let cell = self.cell;
        let reach = libm::ceil(radius / cell) as i32;
        let [column, row] = [x, y].map(|along| libm::floor(along / cell));
        let around = (-reach..=reach).flat_map(move |dy| (-reach..=reach).map(move |dx| (dx, dy)));
        let around = around.filter(move |_| x.is_finite() && y.is_finite());
        around.filter_map(move |(dx, dy)| {
            let (left, low) = ((column + f64::from(dx)) * cell, (row + f64::from(dy)) * cell);
            if self.letter(left + cell / 2.0, low + cell / 2.0) != WALL {
                return None;
            }
            let towards = [x.clamp(left, left + cell) - x, y.clamp(low, low + cell) - y];
            let distance = libm::hypot(towards[0], towards[1]);
            let depth = radius - distance;
            let unit = || towards.map(|part| if distance > 0.0 { part / distance } else { 0.0 });
            (depth > 0.0).then(|| Contact { towards: unit(), depth })
        })
    }

    /// Moves a disc out of the wall with the deepest overlap.
    pub fn push_out(&self, pose: &mut Pose2, radius: f64) {
        let contacts = self.contacts(pose.x, pose.y, radius);
        if let Some(deepest) = contacts.max_by(|one, two| one.depth.total_cmp(&two.depth)) {
            pose.x -= deepest.towards[0] * deepest.depth;
            pose.y -= deepest.towards[1] * deepest.depth;
        }
    }

    /// The walls and the body, a disc of this radius and height, for a scene.
    pub fn scene(&self, radius: f64, height: f64) -> Vec<Shape> {
        let wall = |(number, outline)| {
            let (id, color) = (format!("wall {number}"), [0.6, 0.6, 0.6, 0.9]);
            Shape { id, frame: frames::WORLD, outline, height: HEIGHT, color }
        };
        let (id, color) = ("robot".to_owned(), [0.15, 0.45, 0.75, 0.9]);
        let body = Shape { id, frame: frames::BODY, outline: disc(radius), height, color };
        self.outlines(WALL).enumerate().map(wall).chain([body]).collect()
    }

    /// The walls, patches in these colours for these letters, and the body, for a picture.
    pub fn drawing(&self, radius: f64, colors: &[(char, [u8; 3])]) -> Drawing {
        let wall = |(number, outline)| Thing {
            id: format!("wall {number}"),
            name: "wall".to_owned(),
            outline,
            end: None,
            low: false,
            movable: false,
            labelled: false,
            path: Vec::new(),
        };
        let patches = colors.iter().flat_map(|(letter, color)| {
            self.outlines(*letter).map(|corners| Patch { corners, color: *color })
        });
        Drawing {
            start: self.start,
            body: disc(radius),
            things: self.outlines(WALL).enumerate().map(wall).collect(),
            patches: patches.collect(),
            lights: Vec::new(),
        }
    }

    /// The outlines of one letter's cells; adjacent cells in a row are combined.
    fn outlines(&self, of: char) -> impl Iterator<Item = Vec<[f64; 2]>> {
        let rows = self.cells.chunks(self.columns.max(1)).enumerate();
        rows.flat_map(move |(y, row)| {
            let runs = row.chunk_by(|one, other| one == other);
            let mut right = 0;
            let runs = runs.map(move |run| {
                right += run.len();
                (run, [right - run.len(), right])
            });
            runs.filter(move |(run, _)| run.first() == Some(&of)).map(move |(_, [left, right])| {
                let corners = [[left, y], [right, y], [right, y + 1], [left, y + 1]];
                corners.map(|corner| corner.map(|n| n as f64 * self.cell)).to_vec()
            })
        })
    }
}

/// Number of cells of the longest row.
///
/// # Errors
/// The whole grid would have too many cells.
fn columns(rows: &[(usize, &str)]) -> Result<usize, WorldError> {
    let longest = rows.iter().map(|(at, row)| (row.chars().count(), *at, row.len())).max();
    let (columns, at, length) = longest.unwrap_or_default();
    match columns.saturating_mul(rows.len()) <= MOST {
        true => Ok(columns),
        false => {
            let rows = rows.len();
            let why = format!("a floor has at most {MOST} cells, not {columns} by {rows}");
            Err(wrong(at, length, &why))
        }
    }
}

/// The lines of a text without trailing spaces, each with its place.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split_inclusive('\n').scan(0, |next, line| {
        let at = *next;
        *next += line.len();
        Some((at, line.trim_end()))
    })
}

/// Metres of `cell 25 cm`; `None` for another line or an invalid length.
fn cell(line: &str) -> Option<f64> {
    let text = line.strip_prefix("cell")?.trim().strip_suffix("cm")?;
    let centimetres: f64 = text.trim().parse().ok()?;
    (1.0..=500.0).contains(&centimetres).then_some(centimetres / 100.0)
}

/// A disc as a polygon around the origin.
fn disc(radius: f64) -> Vec<[f64; 2]> {
    let corner = |n| libm::sincos(f64::from(n) * TAU / f64::from(CORNERS));
    (0..CORNERS).map(corner).map(|(sin, cos)| [radius * cos, radius * sin]).collect()
}

fn wrong(at: usize, length: usize, message: &str) -> WorldError {
    WorldError::new(Some(at..at + length), message)
}

#[cfg(test)]
mod tests;
