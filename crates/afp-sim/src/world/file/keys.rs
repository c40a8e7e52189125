//! The keys of a world file, table by table, and the errors for others.

use std::ops::Range;

use afp_excerpt::words::instead;
use toml_edit::{Item, TableLike, Value};

use crate::world::WorldError;

pub(super) struct Key {
    pub(super) name: &'static str,
    kind: Kind,
    /// Whether the key is required.
    needed: bool,
    example: &'static str,
}

enum Kind {
    Text,
    Truth,
    /// A number without a fraction.
    Whole,
    Number,
    /// A fixed number of numbers.
    Numbers(usize),
    /// Positions of two numbers.
    Places,
    One(&'static [Key]),
    Many(&'static [Key]),
}

use Kind::{Many, Number, Numbers, One, Places, Text, Truth, Whole};

const fn needed(name: &'static str, kind: Kind, example: &'static str) -> Key {
    Key { name, kind, needed: true, example }
}

const fn maybe(name: &'static str, kind: Kind, example: &'static str) -> Key {
    Key { name, kind, needed: false, example }
}

const NAME: Key = maybe("name", Text, "name = \"sofa\"");
const COLOR: Key = maybe("color", Text, "color = \"#b08d57\"");
const TEXTURE: Key = maybe("texture", Text, "texture = \"bricks\"");
const ECHO: Key = maybe("echo", Number, "echo = 0.5");
const MAPPED: Key = maybe("mapped", Truth, "mapped = false");
const POSE: Key = needed("pose_m_deg", Numbers(3), "pose_m_deg = [1.0, 2.0, 90]");
const HEIGHT: Key = needed("height_m", Number, "height_m = 0.5");
const CORNERS: Key = needed("points_m", Places, "points_m = [[0, 0], [2, 0], [1, 1]]");
const MASS: Key = maybe("mass_kg", Number, "mass_kg = 2");
const WAY: Key = maybe("path", One(PATH), "path = { by_m = [[1, 0]], speed_m_s = 0.3 }");

/// The keys of a whole file, as in [`super::tables::File`].
pub(super) const WORLD: &[Key] = &[
    needed("version", Whole, "version = 1"),
    maybe("name", Text, "name = \"hall\""),
    needed("robot", One(ROBOT), "[robot]"),
    maybe("floor", One(&[COLOR, TEXTURE]), "[floor]"),
    maybe("wall", Many(WALL), "[[wall]]"),
    maybe("box", Many(BOX), "[[box]]"),
    maybe("polygon", Many(POLYGON), "[[polygon]]"),
    maybe("patch", Many(PATCH), "[[patch]]"),
    maybe("infrared", Many(INFRARED), "[[infrared]]"),
    maybe("map", One(MAP), "[map]"),
];

const ROBOT: &[Key] = &[
    POSE,
    maybe("charge", Number, "charge = 0.5"),
    maybe("length_m", Number, "length_m = 0.24"),
    maybe("width_m", Number, "width_m = 0.18"),
    maybe("track_m", Number, "track_m = 0.14"),
    maybe("wheelbase_m", Number, "wheelbase_m = 0.09"),
    maybe("steering_deg", Number, "steering_deg = 30"),
    maybe("fastest_m_s", Number, "fastest_m_s = 0.5"),
    maybe("sonar_m", Number, "sonar_m = 0.08"),
    maybe("encoders", Truth, "encoders = false"),
];

const WALL: &[Key] = &[
    NAME,
    needed("points_m", Places, "points_m = [[0, 0], [4, 0]]"),
    maybe("closed", Truth, "closed = true"),
    maybe("thickness_m", Number, "thickness_m = 0.1"),
    maybe("height_m", Number, "height_m = 2.5"),
    COLOR,
    TEXTURE,
    ECHO,
    MAPPED,
];

const BOX: &[Key] = &[
    NAME,
    POSE,
    needed("size_m", Numbers(2), "size_m = [1.0, 0.5]"),
    HEIGHT,
    MASS,
    WAY,
    COLOR,
    TEXTURE,
    ECHO,
    MAPPED,
];

const POLYGON: &[Key] = &[NAME, CORNERS, HEIGHT, MASS, WAY, COLOR, TEXTURE, ECHO, MAPPED];

const PATH: &[Key] = &[
    needed("by_m", Places, "by_m = [[1, 0]]"),
    needed("speed_m_s", Number, "speed_m_s = 0.3"),
    maybe("closed", Truth, "closed = true"),
    maybe("wait_s", Number, "wait_s = 1.5"),
    maybe("start_s", Number, "start_s = 1.5"),
];

const PATCH: &[Key] = &[NAME, CORNERS, needed("color", Text, "color = \"#b08d57\"")];

const INFRARED: &[Key] = &[
    NAME,
    needed("position_m", Numbers(2), "position_m = [1.0, 2.0]"),
    maybe("height_m", Number, "height_m = 0.15"),
    maybe("strength", Number, "strength = 1"),
];

const MAP: &[Key] = &[needed("corners_m", Places, "corners_m = [[0, 0], [4, 0], [4, 3], [0, 3]]")];

/// Finds the first error in a file; `own` are top-level keys that other code reads.
///
/// # Errors
/// The error with its place.
pub(super) fn check(file: &dyn TableLike, own: &[&str]) -> Result<(), WorldError> {
    let head = Head { name: "a world", span: None };
    head.check(file, WORLD, own)
}

struct Head<'a> {
    name: &'a str,
    span: Option<Range<usize>>,
}

impl Head<'_> {
    fn check(&self, table: &dyn TableLike, keys: &[Key], own: &[&str]) -> Result<(), WorldError> {
        for (name, item) in table.iter().filter(|(name, _)| !own.contains(name)) {
            let at = table.get_key_value(name).and_then(|(key, _)| key.span());
            match keys.iter().find(|key| key.name == name) {
                Some(key) => key.check(item, at.as_ref())?,
                None => return Err(self.unknown(name, at, keys, own)),
            }
        }
        match keys.iter().find(|key| key.needed && !table.contains_key(key.name)) {
            None => Ok(()),
            Some(Key { name, example, .. }) => {
                let message = format!("{} has no '{name}'", self.name);
                let help = format!("write '{example}'");
                Err(WorldError::new(self.span.clone(), message).with_help(help))
            }
        }
    }

    fn unknown(
        &self,
        name: &str,
        at: Option<Range<usize>>,
        keys: &[Key],
        own: &[&str],
    ) -> WorldError {
        let known = keys.iter().map(|key| key.name).chain(own.iter().copied());
        let message = format!("{} has no '{name}'", self.name);
        WorldError::new(at, message).with_help(instead(name, known))
    }
}

impl Key {
    /// Checks the value of a key; `at` is the key's place.
    fn check(&self, item: &Item, at: Option<&Range<usize>>) -> Result<(), WorldError> {
        let Key { name, example, .. } = self;
        match self.kind {
            One(keys) => {
                let Some(table) = item.as_table_like() else {
                    return Err(self.wrong(item, at, "is a table", format!("write '{example}'")));
                };
                let heading = format!("'[{name}]'");
                let head = if example.starts_with('[') { heading } else { format!("'{name}'") };
                Head { name: &head, span: at.cloned() }.check(table, keys, &[])
            }
            Many(keys) => {
                let Some(tables) = tables(item) else {
                    let help = format!("write '{example}' above each of them");
                    return Err(self.wrong(item, at, "is a list of tables", help));
                };
                let head = format!("'[[{name}]]'");
                tables.into_iter().try_for_each(|(table, span)| {
                    let span = span.or_else(|| at.cloned());
                    Head { name: &head, span }.check(table, keys, &[])
                })
            }
            _ if item.as_value().is_some_and(|value| self.kind.fits(value)) => Ok(()),
            _ => {
                let what = self.kind.what();
                let help = format!("write {what}, such as '{example}'");
                Err(self.wrong(item, at, "cannot have this value", help))
            }
        }
    }

    fn wrong(&self, item: &Item, at: Option<&Range<usize>>, why: &str, help: String) -> WorldError {
        // For a table, the place of the error is its heading.
        let value = item.as_value().and_then(Value::span);
        let span = value.or_else(|| at.cloned()).or_else(|| item.span());
        WorldError::new(span, format!("'{}' {why}", self.name)).with_help(help)
    }
}

impl Kind {
    fn fits(&self, value: &Value) -> bool {
        let is_number = |value: &Value| value.is_integer() || value.is_float();
        let numbers = |value: &Value, count: usize| {
            let list = value.as_array();
            list.is_some_and(|list| list.len() == count && list.iter().all(is_number))
        };
        match self {
            Text => value.is_str(),
            Truth => value.is_bool(),
            Whole => value.is_integer(),
            Number => is_number(value),
            Numbers(count) => numbers(value, *count),
            Places => value.as_array().is_some_and(|all| all.iter().all(|one| numbers(one, 2))),
            One(_) | Many(_) => false,
        }
    }

    fn what(&self) -> &'static str {
        match self {
            Text => "a string in quotes",
            Truth => "true or false",
            Whole => "a whole number",
            Number => "a number",
            Numbers(2) => "two numbers in brackets",
            Numbers(_) => "x, y and a heading in brackets",
            Places => "places, each of two numbers",
            One(_) | Many(_) => "a table",
        }
    }
}

/// A table of a list, and its place.
type Placed<'a> = (&'a dyn TableLike, Option<Range<usize>>);

/// The tables of a list, in both notations.
fn tables(item: &Item) -> Option<Vec<Placed<'_>>> {
    if let Some(tables) = item.as_array_of_tables() {
        return Some(tables.iter().map(|table| (table as &dyn TableLike, table.span())).collect());
    }
    let all = item.as_array()?.iter().map(|value| {
        let table = value.as_inline_table()?;
        Some((table as &dyn TableLike, value.span()))
    });
    all.collect()
}
