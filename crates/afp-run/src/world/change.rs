//! One value of a world's file in place of another: `--set world.robot.charge=0.5`.
//!
//! Keys of a file carry their units (`height_m`); what is written here carries its own.

use afp_core::rt::{Scale, Unit, parse_quantity};
use toml_edit::{DocumentMut, Item, Table, Value, value};

use afp_session::AnyRobot;

use super::LoadedWorld;
use crate::error::RunError;

/// What the name of a setting begins with that is one of the world.
const PREFIX: &str = "world.";

/// The key of a setting of the world; `None` for an entry of the plan.
pub fn key(name: &str) -> Option<&str> {
    name.strip_prefix(PREFIX)
}

/// Metres first.
pub(crate) const LENGTH: &[Unit<'static>] = &[
    Unit { name: "m", scale: Scale::Decimal(0) },
    Unit { name: "cm", scale: Scale::Decimal(-2) },
    Unit { name: "mm", scale: Scale::Decimal(-3) },
    Unit { name: "km", scale: Scale::Decimal(3) },
];
/// Degrees first.
pub(crate) const ANGLE: &[Unit<'static>] = &[
    Unit { name: "deg", scale: Scale::Decimal(0) },
    Unit { name: "rad", scale: Scale::fraction(1, 1, 0, -1) },
];
const SPEED: &[Unit<'static>] = &[
    Unit { name: "m/s", scale: Scale::Decimal(0) },
    Unit { name: "cm/s", scale: Scale::Decimal(-2) },
    Unit { name: "mm/s", scale: Scale::Decimal(-3) },
];
const MASS: &[Unit<'static>] =
    &[Unit { name: "kg", scale: Scale::Decimal(0) }, Unit { name: "g", scale: Scale::Decimal(-3) }];
const TIME: &[Unit<'static>] =
    &[Unit { name: "s", scale: Scale::Decimal(0) }, Unit { name: "ms", scale: Scale::Decimal(-3) }];

/// The units of a key, by the end of its name; the first is that of the file. None for plain numbers.
fn units(key: &str, place: Option<usize>) -> &'static [Unit<'static>] {
    let ends = |end: &str| key.ends_with(end);
    match place {
        Some(2) if ends("_m_deg") => ANGLE,
        _ if ends("_m") || ends("_m_deg") => LENGTH,
        _ if ends("_m_s") => SPEED,
        _ if ends("_kg") => MASS,
        _ if ends("_s") => TIME,
        _ => &[],
    }
}

impl LoadedWorld {
    /// This world with values of its file changed, all at once: `key` is the way to one: names of tables, in a
    /// list the name or the number from 0 of what is meant, a key, in a list of numbers a number from
    /// 0: `robot.charge`, `box.sofa.height_m`, `robot.pose_m_deg.0`.
    ///
    /// # Errors
    /// There is no such thing, a unit does not fit, or the world makes no sense with those values.
    pub fn with(
        &self,
        changes: &[(&str, &str)],
        robot: &dyn AnyRobot,
    ) -> Result<LoadedWorld, RunError> {
        let mut changed = self.text.clone();
        for (key, text) in changes {
            changed = self::changed(&changed, key, text)?.0;
        }
        let world = super::parse(changed, self.path.clone(), self.world.name(), robot);
        let world = world.map_err(|error| with_changes(error, changes))?;
        let world = LoadedWorld { path: self.path.clone(), ..world };
        let Some(start) = self.start else { return Ok(world) };
        world.started_at(start).map_err(|why| RunError::usage(why, "choose another start"))
    }

    /// What a value for a key is in SI units; `None` for what is no number.
    ///
    /// # Errors
    /// As [`LoadedWorld::with`], but for worlds that make no sense.
    pub fn si(&self, key: &str, text: &str) -> Result<Option<f64>, RunError> {
        Ok(changed(&self.text, key, text)?.1)
    }
}

/// The text with a value changed, and the value in SI units.
fn changed(world: &str, key: &str, text: &str) -> Result<(String, Option<f64>), RunError> {
    let refused = |why: &str| refused(key, text, why);
    let mut document: DocumentMut = world
        .parse()
        .map_err(|_| refused("worlds of this robot are no TOML: no value can be set"))?;
    let mut parts: Vec<&str> = key.split('.').collect();
    let index = parts.last().and_then(|last| last.parse::<usize>().ok());
    if index.is_some() {
        parts.pop();
    }
    let (name, tables) = parts.split_last().ok_or_else(|| refused("there is no such key"))?;
    let units = units(name, index);
    let to = read(text, units).map_err(|why| refused(&why))?;
    let si = to.as_float().map(|number| match units.first() {
        Some(unit) if unit.name == "deg" => number.to_radians(),
        _ => number,
    });
    let mut item = document.as_item_mut();
    for part in tables {
        item = inside(item, part).map_err(|why| refused(&why))?;
    }
    set(item, name, index, to).map_err(|why| refused(&why))?;
    Ok((document.to_string(), si))
}

/// An error in a world that was changed: the excerpt is of a text that no file has.
fn with_changes(error: RunError, changes: &[(&str, &str)]) -> RunError {
    let RunError::Content { path, span, text, message } = error else { return error };
    let list = changes.iter().map(|(key, value)| format!("{PREFIX}{key}={value}"));
    let path = format!("{} with {}", path.display(), list.collect::<Vec<_>>().join(", "));
    RunError::Content { path: path.into(), span, text, message }
}

fn refused(key: &str, text: &str, why: &str) -> RunError {
    RunError::usage(
        format!("'{PREFIX}{key}={text}': {why}"),
        "the way to a value of the world's file, such as 'world.robot.charge=0.5' or \
         'world.box.sofa.height_m=50cm'",
    )
}

/// What is called `part` in a table, or is the one of that name or number in a list of tables.
fn inside<'a>(item: &'a mut Item, part: &str) -> Result<&'a mut Item, String> {
    let absent = || format!("there is no '{part}'");
    if let Some(table) = item.as_table_like_mut() {
        if !table.contains_key(part) {
            table.insert(part, Item::Table(Table::new()));
        }
        return item.get_mut(part).ok_or_else(absent);
    }
    let list = item.as_array_of_tables().ok_or_else(absent)?;
    let name =
        |table: &'_ Table| table.get("name").and_then(Item::as_str).unwrap_or_default().to_owned();
    let names: Vec<String> = list.iter().map(name).collect();
    let by_number = || part.parse::<usize>().ok().filter(|number| *number < names.len());
    let Some(index) = names.iter().position(|name| name == part).or_else(by_number) else {
        let names: Vec<_> = names.iter().map(|name| format!("'{name}'")).collect();
        return Err(format!("there is no '{part}' among {}", names.join(", ")));
    };
    item.get_mut(index).ok_or_else(absent)
}

fn set(item: &mut Item, name: &str, index: Option<usize>, to: Value) -> Result<(), String> {
    let Some(table) = item.as_table_like_mut() else {
        return Err(format!("there is no '{name}' in a list; name one of them first"));
    };
    let Some(index) = index else {
        table.insert(name, value(to));
        return Ok(());
    };
    let known = table.iter().map(|(name, _)| format!("'{name}'")).collect::<Vec<_>>().join(", ");
    let Some(list) = table.get_mut(name) else {
        return Err(format!("there is no '{name}' among {known}"));
    };
    let Some(list) = list.as_array_mut() else {
        return Err(format!("'{name}' is no list, so that it has no number {index}"));
    };
    let count = list.len();
    let place = list.get_mut(index);
    *place.ok_or_else(|| {
        format!("'{name}' has {count} values, from 0 on, and no number {index}")
    })? = to;
    Ok(())
}

/// A value as it stands in the file.
fn read(text: &str, units: &[Unit<'static>]) -> Result<Value, String> {
    if units.is_empty() {
        let number = text.parse::<f64>().map(Value::from);
        let truth = || text.parse::<bool>().map(Value::from);
        return Ok(number.or_else(|_| truth()).unwrap_or_else(|_| Value::from(text)));
    }
    let names = || units.iter().map(|unit| unit.name).collect::<Vec<_>>().join(", ");
    let number = parse_quantity(text, units.iter().copied());
    number.map(Value::from).map_err(|_| format!("expected a number with a unit: {}", names()))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use afp_session::{Kind, kind};
    use afp_sim::{Simulation, World};

    use super::*;

    const ROBOT: Kind<Simulation> = kind();

    fn room() -> LoadedWorld {
        super::super::find(None, Path::new("nowhere/else.afp"), &ROBOT).unwrap()
    }

    fn with(world: &LoadedWorld, key: &str, text: &str) -> (LoadedWorld, World) {
        let changed = world.with(&[(key, text)], &ROBOT).unwrap();
        let typed = changed.world.as_any().downcast_ref::<World>().unwrap().clone();
        (changed, typed)
    }

    #[test]
    fn values_are_found_by_name_and_carry_units() {
        let (world, typed) = with(&room(), "box.closet.height_m", "150cm");
        let closet = typed.obstacles.iter().find(|it| it.name == "closet").unwrap();
        assert_eq!(closet.height, 1.5);
        let (world, typed) = with(&world, "robot.pose_m_deg.2", "90deg");
        assert!((typed.start.heading - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert_eq!(with(&world, "robot.charge", "0.5").1.charge, 0.5);
        assert_eq!(with(&room(), "box.0.height_m", "1m").1.obstacles.len(), 10);
    }

    #[test]
    fn values_count_together() {
        // The second alone puts the robot into the sofa.
        let (x, y) = (("robot.pose_m_deg.0", "5m"), ("robot.pose_m_deg.1", "4.5m"));
        let tried = |changes: &[(&str, &str)]| room().with(changes, &ROBOT).map(|it| it.world);
        let refused = tried(&[y]).unwrap_err().to_string();
        assert!(refused.contains("built-in room with world.robot.pose_m_deg.1=4.5m"), "{refused}");
        assert!(tried(&[x, y]).is_ok() && tried(&[y, x]).is_ok());
    }

    #[test]
    fn what_is_not_there_or_does_not_fit_is_refused() {
        for (key, text, why) in [
            ("box.clost.height_m", "1m", "no 'clost' among 'closet'"),
            ("box.closet.height_m", "1", "a number with a unit: m, cm"),
            ("box.closet.height_m", "1s", "a number with a unit: m, cm"),
            ("robot.charg", "0.5", "charg"),
            ("robot.charge", "2", "charge"),
            ("box.height_m", "1m", "name one of them first"),
            ("robot.pose.1", "4.5m", "there is no 'pose' among 'pose_m_deg'"),
            ("robot.pose_m_deg.3", "1m", "'pose_m_deg' has 3 values, from 0 on, and no number 3"),
            ("name.1", "4.5", "'name' is no list, so that it has no number 1"),
        ] {
            let refused = room().with(&[(key, text)], &ROBOT).err().map(|error| error.to_string());
            let error = refused.unwrap_or_default();
            assert!(error.contains(why), "{key}: {error}");
        }
    }
}
