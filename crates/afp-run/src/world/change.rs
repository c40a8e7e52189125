//! Changes a value of a world's file: `--set world.robot.charge=0.5`.
//!
//! Keys of a file contain units (`height_m`); here the value carries its unit.

use toml_edit::{DocumentMut, Item, Value};

use afp_session::AnyRobot;

use super::place::Place;
use super::{LoadedWorld, Measure};
use crate::error::RunError;

const PREFIX: &str = "world.";

/// The key of a setting of the world; `None` for an entry of the plan.
pub fn key(name: &str) -> Option<&str> {
    name.strip_prefix(PREFIX)
}

impl LoadedWorld {
    /// Changes values of the world's file, all at once. A key is a path of names of tables and
    /// keys; an element of a list is given by name or by number from 0: `robot.charge`,
    /// `box.sofa.height_m`, `robot.pose_m_deg.0`, `wall.0.points_m.1.0`.
    ///
    /// # Errors
    /// The key does not exist, a unit does not fit, or the changed world is wrong.
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
        world.started_at(start).map_err(|why| RunError::usage(why.message, "choose another start"))
    }

    /// The value for a key in SI units; `None` if it is not a number.
    ///
    /// # Errors
    /// As [`LoadedWorld::with`], but the world itself is not checked.
    pub fn si(&self, key: &str, text: &str) -> Result<Option<f64>, RunError> {
        Ok(changed(&self.text, key, text)?.1)
    }
}

/// The changed text, and the value in SI units.
fn changed(world: &str, key: &str, text: &str) -> Result<(String, Option<f64>), RunError> {
    let refused = |why: &str| refused(key, text, why);
    let mut document: DocumentMut = world
        .parse()
        .map_err(|_| refused("worlds of this robot are not TOML: no value can be set"))?;
    let parts: Vec<&str> = key.split('.').collect();
    let Place { item, listed } =
        Place::find(document.as_item_mut(), &parts).map_err(|why| refused(&why))?;
    let measure = measure(&parts, listed);
    // A name that looks like a number stays a text.
    let is_text = !listed && item.is_str();
    let to = if is_text { Ok(Value::from(text)) } else { read(text, measure) };
    let to = to.map_err(|why| refused(&why))?;
    let number = to.as_float().or_else(|| Some(to.as_integer()? as f64));
    let si = number.map(|number| match measure {
        Some(Measure::Angle) => number.to_radians(),
        _ => number,
    });
    replace(item, to);
    Ok((document.to_string(), si))
}

/// An error in a changed world: the excerpt shows a text that no file contains.
fn with_changes(error: RunError, changes: &[(&str, &str)]) -> RunError {
    let RunError::Content { path, text, mistake } = error else { return error };
    let list = changes.iter().map(|(key, value)| format!("{PREFIX}{key}={value}"));
    let path = format!("{} with {}", path.display(), list.collect::<Vec<_>>().join(", "));
    RunError::Content { path: path.into(), text, mistake }
}

fn refused(key: &str, text: &str, why: &str) -> RunError {
    RunError::usage(
        format!("'{PREFIX}{key}={text}': {why}"),
        "the path of a value in the world's file, such as 'world.robot.charge=0.5' or \
         'world.box.sofa.height_m=50cm'",
    )
}

/// The measure of a value, from its key and its position in a list.
fn measure(parts: &[&str], listed: bool) -> Option<Measure> {
    let is_key = |part: &&&str| !listed || part.parse::<usize>().is_err();
    let key = parts.iter().rev().find(is_key).copied().unwrap_or_default();
    let number = parts.last().filter(|_| listed).and_then(|part| part.parse().ok());
    Measure::of(key, number)
}

/// Replaces a value; the lines and comments around it stay.
fn replace(was: &mut Item, mut to: Value) {
    if let Some(was) = was.as_value() {
        to.decor_mut().clone_from(was.decor());
    }
    *was = Item::Value(to);
}

/// The value in the form of the file.
fn read(text: &str, measure: Option<Measure>) -> Result<Value, String> {
    if let Some(measure) = measure {
        return measure.read(text).map(Value::from);
    }
    let whole = text.parse::<i64>().map(Value::from);
    let number = || text.parse::<f64>().map(Value::from);
    let truth = || text.parse::<bool>().map(Value::from);
    let value = whole.or_else(|_| number()).or_else(|_| truth());
    Ok(value.unwrap_or_else(|_| Value::from(text)))
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
    fn items_of_lists_are_found_by_number() {
        let text = "wall = [{ points_m = [[0, 0], [4, 0]] }]\n[[box]]\nlane.0 = 1\nby_m = [[1, 2], [3, 4]]\n";
        for (key, value, was, is) in [
            ("wall.0.points_m.1.0", "8m", "[4, 0]", "[8.0, 0]"),
            ("box.0.by_m.0.1", "50cm", "[1, 2]", "[1, 0.5]"),
            ("box.0.lane.0", "2", "lane.0 = 1", "lane.0 = 2"),
        ] {
            assert_eq!(changed(text, key, value).unwrap().0, text.replace(was, is), "{key}");
        }
        for (key, why) in [
            ("wall.0.points_m.1", "'1' is a list; also name its item"),
            ("wall.0.points_m.2.0", "'points_m' has 2 values, from 0 on, and no number 2"),
            ("wall.0.points_m.x.0", "'points_m' has 2 values, from 0 on, and no 'x'"),
            ("box.1.by_m.0.1", "'box' has 1 value, from 0 on, and no number 1"),
        ] {
            let error = changed(text, key, "1m").unwrap_err().to_string();
            assert!(error.contains(why), "{key}: {error}");
        }
    }

    #[test]
    fn lines_and_comments_of_a_file_do_not_move() {
        let text = "version = 1\n# Where it begins.\nrobot.pose_m_deg = [\n  1,  # along x\n  1, 0\n]\n\n# Half.\nrobot.charge = 0.5 # of it\n";
        for (key, value, was, is) in [
            ("version", "1", "version = 1", "version = 1"),
            ("robot.charge", "1", "0.5 #", "1 #"),
            ("robot.pose_m_deg.0", "2m", "1,  #", "2.0,  #"),
            ("robot.pose_m_deg.1", "2m", "1, 0", "2.0, 0"),
        ] {
            assert_eq!(changed(text, key, value).unwrap().0, text.replace(was, is), "{key}");
        }
        let (world, _) = with(&room(), "version", "1");
        assert_eq!(world.text, room().text);
        assert_eq!(with(&room(), "name", "3").1.name, "3");
    }

    #[test]
    fn values_count_together() {
        // The second change alone would put the robot into the sofa.
        let (x, y) = (("robot.pose_m_deg.0", "5m"), ("robot.pose_m_deg.1", "4.5m"));
        let tried = |changes: &[(&str, &str)]| room().with(changes, &ROBOT).map(|it| it.world);
        let refused = tried(&[y]).unwrap_err().to_string();
        assert!(refused.contains("built-in room with world.robot.pose_m_deg.1=4.5m"), "{refused}");
        assert!(tried(&[x, y]).is_ok() && tried(&[y, x]).is_ok());
    }

    #[test]
    fn missing_and_invalid_settings_are_refused() {
        let set = "'robot' is a table";
        for (key, text, why) in [
            ("robot", "3", set),
            ("version", "2", "version 2 is unknown"),
            ("box.clost.height_m", "1m", "no 'clost' among 'closet'"),
            ("box.closet.height_m", "1", "a number with a unit: m, cm, mm"),
            ("box.closet.height_m", "1s", "a number with a unit: m, cm, mm"),
            ("robot.charg", "0.5", "charg"),
            ("robot.charge", "2", "charge"),
            ("box.height_m", "1m", "no 'height_m' among 'closet'"),
            ("box.0.height_m.1", "1m", "'height_m' is not a list, so it has no number 1"),
            ("box.closet", "3", "'closet' is a table; also name its key"),
            ("robot.pose.1", "4.5m", "there is no 'pose' among 'pose_m_deg'"),
            ("robot.pose_m_deg.3", "1m", "'pose_m_deg' has 3 values, from 0 on, and no number 3"),
            ("name.1", "4.5", "'name' is not a list, so it has no number 1"),
        ] {
            let refused = room().with(&[(key, text)], &ROBOT).err().map(|error| error.to_string());
            let error = refused.unwrap_or_default();
            assert!(error.contains(why), "{key}: {error}");
        }
    }
}
