//! The tables of a robot's profile in `[robot]`.

use afp_excerpt::words::instead;

use crate::profile::{PROFILES, Profile, ProfileRobot, Section};

use super::{Pair, Reader, numbers, simple, value_span};

impl Reader {
    /// The profile that a value names.
    pub(super) fn profile(&mut self, pair: &Pair<'_>) -> Option<&'static Profile> {
        let name = self.text(pair, "the name of a profile, such as \"carbot\"")?;
        let profile = Profile::named(&name);
        if profile.is_none() {
            let help = instead(&name, PROFILES.iter().map(|profile| profile.name));
            self.wrong(value_span(pair), format!("no profile '{name}'"), &help);
        }
        profile
    }

    /// A robot with a profile, from the other keys of `[robot]`.
    pub(super) fn profile_robot(
        &mut self,
        (named, profile): (&Pair<'_>, &'static Profile),
        pairs: Vec<Pair<'_>>,
    ) -> ProfileRobot {
        let mut robot = ProfileRobot {
            name: profile.name,
            sections: Vec::new(),
            values: Vec::new(),
            calibrated: None,
            span: value_span(named),
        };
        let known = || profile.sections.iter().filter(|section| !section.key.name.is_empty());
        let top = profile.section("");
        let is_of_robot = |pair: &Pair<'_>| {
            top.is_some_and(|top| top.settings.iter().any(|setting| setting.key.name == pair.key))
        };
        let (own, others): (Vec<_>, Vec<_>) = pairs.into_iter().partition(is_of_robot);
        if let Some(top) = top {
            self.values(top, named, &own, &mut robot.values);
        }
        for pair in &others {
            let Some(section) = known().find(|section| section.key.name == pair.key) else {
                let own = top.iter().flat_map(|top| top.settings).map(|it| it.key.name);
                let names = known().map(|section| section.key.name).chain(own);
                let help = instead(pair.key, names.chain(["realtime", "autostart", "logs"]));
                let message = format!("the profile '{}' has no '{}'", profile.name, pair.key);
                self.wrong(pair.span.clone(), message, &help);
                continue;
            };
            robot.sections.push(section.key.name);
            let pairs = self.table(pair, &format!("a heading '{}'", section.key.example));
            self.values(section, pair, &pairs, &mut robot.values);
        }
        for section in known().filter(|section| section.needed) {
            if !robot.sections.contains(&section.key.name) {
                let message =
                    format!("the profile '{}' needs '{}'", profile.name, section.key.name);
                let help = format!("write '{}' with its keys", section.key.example);
                self.wrong(robot.span.clone(), message, &help);
            }
        }
        robot
    }

    /// Reads the values of a section at `place`, and adds its defaults.
    fn values(
        &mut self,
        section: &'static Section,
        place: &Pair<'_>,
        pairs: &[Pair<'_>],
        all: &mut Vec<(String, String)>,
    ) {
        let name = section.key.name;
        let path = |key: &str| match name {
            "" => key.to_owned(),
            _ => format!("{name}.{key}"),
        };
        for pair in pairs {
            let setting = section.settings.iter().find(|setting| setting.key.name == pair.key);
            let Some(setting) = setting else {
                let keys: Vec<_> = section.settings.iter().map(|it| it.key).collect();
                self.unknown(pair, &format!("'{name}'"), &keys);
                continue;
            };
            let text = simple(pair).or_else(|| numbers(pair)).unwrap_or_default();
            match setting.of.read(&text) {
                Ok(_) => {
                    self.occupied(pair, &path(pair.key), &setting.of.occupies(&text), all);
                    all.push((path(pair.key), text));
                }
                Err(what) => self.value(pair, &what),
            }
        }
        for setting in section.settings {
            if pairs.iter().any(|pair| pair.key == setting.key.name) {
                continue;
            }
            match setting.usual {
                Some(usual) => all.push((path(setting.key.name), usual.to_owned())),
                None => {
                    let message = format!("'{name}' has no '{}'", setting.key.name);
                    let help = format!("write '{}'", setting.key.example);
                    self.wrong(place.span.clone(), message, &help);
                }
            }
        }
    }

    /// Reports a line or a channel that another setting, or the same one, also names.
    fn occupied(
        &mut self,
        pair: &Pair<'_>,
        path: &str,
        things: &[String],
        all: &[(String, String)],
    ) {
        let own = things.iter().map(|thing| (path, thing));
        for (at, (_, thing)) in own.clone().enumerate() {
            let other = all.iter().find(|(path, text)| {
                let setting = PROFILES.iter().find_map(|profile| profile.setting(path));
                setting.is_some_and(|setting| setting.of.occupies(text).contains(thing))
            });
            let other = other.map(|(path, _)| path.as_str());
            let twice = own.clone().take(at).find(|(_, other)| *other == thing);
            if let Some(other) = other.or(twice.map(|(path, _)| path)) {
                let message = format!("{thing} already belongs to '{other}'");
                self.wrong(value_span(pair), message, "each part needs its own");
            }
        }
    }
}
