//! `calibration.toml`: measured values of a robot with a profile, which replace those of `afp.toml`.

use afp_excerpt::Mistake;
use afp_excerpt::words::instead;
use toml_edit::Document;

use crate::profile::ProfileRobot;

use super::{Reader, pairs, simple, value_span};

/// Replaces values of a robot by those of a calibration, and notes its date. Returns the errors in
/// the text.
pub fn read_calibration(text: &str, robot: &mut ProfileRobot) -> Vec<Mistake> {
    let mut reader = Reader { mistakes: Vec::new() };
    match Document::parse(text) {
        Ok(document) => reader.calibration(document.as_table(), robot),
        Err(error) => {
            let span = error.span().unwrap_or(0..0);
            reader.mistakes.push(Mistake::new(Some(span), error.message().replace('\n', ", ")));
        }
    }
    reader.mistakes
}

impl Reader {
    fn calibration(&mut self, table: &dyn toml_edit::TableLike, robot: &mut ProfileRobot) {
        let Some(profile) = robot.profile() else { return };
        for pair in pairs(table) {
            match pair.key {
                "date" => robot.calibrated = self.text(&pair, "a date in quotes"),
                "robot" => {
                    let name = self.text(&pair, "the name of a profile in quotes");
                    if name.is_some_and(|name| name != robot.name) {
                        let message = "this is the calibration of a robot with another profile";
                        let help = "measure this robot: 'afpc calibrate'";
                        self.wrong(value_span(&pair), message.to_owned(), help);
                    }
                }
                // Further measurements, for the reader.
                "measured" => {}
                name => {
                    let section = profile.section(name);
                    let Some(section) = section.filter(|it| robot.sections.contains(&it.key.name))
                    else {
                        let help = instead(name, robot.sections.iter().copied());
                        self.wrong(pair.span.clone(), format!("the robot has no '{name}'"), &help);
                        continue;
                    };
                    for value in self.table(&pair, &format!("a heading '[{name}]'")) {
                        let known = section.settings.iter().find(|it| it.key.name == value.key);
                        let Some(setting) = known else {
                            let keys: Vec<_> = section.settings.iter().map(|it| it.key).collect();
                            self.unknown(&value, &format!("'{name}'"), &keys);
                            continue;
                        };
                        let text = simple(&value).unwrap_or_default();
                        match setting.of.read(&text) {
                            Ok(_) => robot.replace(&format!("{name}.{}", value.key), text),
                            Err(what) => self.value(&value, &what),
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read;

    fn calibrated(text: &str) -> (ProfileRobot, Vec<String>) {
        let project = "[robot]\nprofile = 'ugv'\n[robot.body]\nlength = '24 cm'\nwidth = '24 cm'\n\
                       [robot.drive]\ntrack = '17 cm'\nfastest = '35 cm/s'\n";
        let mut robot = read(project).0.robot.unwrap().profile.unwrap();
        let mistakes = read_calibration(text, &mut robot);
        (robot, mistakes.into_iter().map(|it| it.message).collect())
    }

    #[test]
    fn measured_values_replace_those_of_the_project() {
        let text = "date = '2026-11-29'\nrobot = 'ugv'\n[drive]\ntrack = '17.4 cm'\ntrim = 1.01\n\
                    [measured]\nstop = '310 ms'\n";
        let (robot, mistakes) = calibrated(text);
        assert_eq!(mistakes, <[&str; 0]>::default());
        assert_eq!(robot.calibrated.as_deref(), Some("2026-11-29"));
        assert_eq!(robot.number("drive.track"), Some(0.174));
        assert_eq!(
            (robot.number("drive.trim"), robot.number("drive.scale")),
            (Some(1.01), Some(1.0))
        );
    }

    #[test]
    fn a_calibration_of_another_robot_is_refused() {
        let another = "this is the calibration of a robot with another profile";
        assert_eq!(calibrated("robot = 'carbot'\n").1, [another]);
        assert_eq!(calibrated("[bumper]\n").1, ["the robot has no 'bumper'"]);
        assert_eq!(calibrated("[drive]\ntrim = 3\n").1, ["'trim' cannot have this value"]);
        assert_eq!(calibrated("[drive]\ntrimm = 1\n").1, ["'drive' has no 'trimm'"]);
        assert_eq!(calibrated("[drive\n").1.len(), 1);
    }
}
