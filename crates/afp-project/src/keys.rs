//! The keys of a project file, table by table, for reader and editors.

use crate::key::{Key, key};
use crate::profile::PROFILES;

pub(crate) const PROJECT: &[Key] = &[
    key("run", "How the plans of the project run.", "[run]"),
    key("robot", "The robot of the project, if it is not the Carbot.", "[robot]"),
    key("toolboxes", "Toolboxes of the project, by name.", "[toolboxes]"),
    key("target", "The timing of a machine that runs programs.", "[target.NAME]"),
    key("afp", "The path of AFP's crates, if 'afpc' does not know it.", "[afp]"),
];

/// `[run]`
pub(crate) const RUN: &[Key] = &[
    key("world", "The world file for runs.", "world = \"worlds/room.toml\""),
    key("measures", "The measures of every run.", "measures = [\"wall\"]"),
];

/// `[afp]`, and the origin of a crate.
pub(crate) const ORIGIN: &[Key] = &[
    key("path", "A folder on this machine, relative to this file.", "path = \"../afp\""),
    key("git", "The address of a repository.", "git = \"https://example.org/afp\""),
    key("version", "A version in the registry.", "version = \"0.1\""),
];

/// One of `[toolboxes]`.
pub(crate) const TOOLBOX: &[Key] = &[
    key("path", "The toolbox file, relative to this file.", "path = \"gripper.afp\""),
    key(
        "crate",
        "The crate that implements it, if the toolbox file is not inside of that crate.",
        "crate = \"my-gripper\"",
    ),
];

/// `[robot]`
pub(crate) const ROBOT: &[Key] = &[
    key("profile", "A robot made of parts from a shop, without Rust.", "profile = \"carbot\""),
    key(
        "toolbox",
        "The toolbox of '[toolboxes]' that declares the robot's devices.",
        "toolbox = \"vacuum\"",
    ),
    key(
        "sim",
        "The Rust type of the simulated robot, from the root of its crate.",
        "sim = \"Vacuum\"",
    ),
    key("crate", "The crate of that type, if it is not the toolbox's crate.", "crate = \"vacuum\""),
    key(
        "hardware",
        "The real robot, for '--robot hardware'.",
        "hardware = { type = \"Board\", crate = { path = \"board\" } }",
    ),
    key("realtime", "Settings of the real robot's control loop.", "realtime.stall = \"100 ms\""),
    key("autostart", "Whether the robot is armed when it boots.", "autostart = true"),
    key("logs", "The size of all logs on the robot together.", "logs = \"1 GB\""),
];

/// `hardware` of `[robot]`
pub(crate) const HARDWARE: &[Key] = &[
    key("type", "The Rust type that drives the real robot.", "type = \"Board\""),
    key(
        "crate",
        "The crate of that type, if it is not the robot's crate.",
        "crate = { path = \"board\" }",
    ),
    key("settings", "Settings for that type, by name.", "settings = { port = \"/dev/ttyUSB0\" }"),
];

/// `realtime` of `[robot]`
pub(crate) const REALTIME: &[Key] = &[
    key(
        "stall",
        "The largest permitted delay of the control loop; a longer delay ends the run.",
        "stall = \"100 ms\"",
    ),
    key("priority", "The FIFO priority of the control thread, from 1 to 98.", "priority = 50"),
    key("cpu", "The processor on which the control thread runs.", "cpu = 3"),
];

/// The keys of a crate in addition to its origin.
pub(crate) const CRATE: &[Key] = &[
    key("package", "The name of the package.", "package = \"my-gripper\""),
    key(
        "module",
        "The module with 'templates', if it is not the crate's root.",
        "module = \"gripper::fast\"",
    ),
];

/// `[target.NAME]`
pub(crate) const TARGET: &[Key] = &[
    key("tick", "The longest delay until the target notices due work.", "tick = \"1 ms\""),
    key("capacity", "The processor share for plans, at most 1.", "capacity = 0.5"),
    key("slowdown", "A factor for all declared times.", "slowdown = 4"),
    key(
        "budgets",
        "The time of a template's poll on this machine.",
        "budgets.carbot.Forward = \"30 us\"",
    ),
];

/// The keys of a table, given by its path; empty for free names or an unknown table.
pub fn keys(table: &[&str]) -> Vec<Key> {
    let of_profile = match table {
        ["robot"] => of_profiles(""),
        ["robot", section] => of_profiles(section),
        _ => Vec::new(),
    };
    let lists: &[&[Key]] = match table {
        [] => &[PROJECT],
        ["run"] => &[RUN],
        ["afp"] => &[ORIGIN],
        ["robot"] => &[ROBOT],
        ["robot", "hardware"] => &[HARDWARE],
        ["robot", "realtime"] => &[REALTIME],
        ["toolboxes", _] => &[TOOLBOX],
        ["toolboxes", _, "crate"] | ["robot", "crate"] | ["robot", "hardware", "crate"] => {
            &[ORIGIN, CRATE]
        }
        ["target", _] => &[TARGET],
        _ => &[],
    };
    [lists.concat(), of_profile].concat()
}

/// The keys of a section of any profile; for `[robot]` itself also the sections.
fn of_profiles(name: &str) -> Vec<Key> {
    let sections = || PROFILES.iter().flat_map(|profile| profile.sections);
    let own = sections().filter(|section| section.key.name == name);
    let mut keys: Vec<Key> = own.flat_map(|it| it.settings).map(|setting| setting.key).collect();
    if name.is_empty() {
        keys.extend(sections().map(|section| section.key).filter(|key| !key.name.is_empty()));
    }
    // Profiles share keys; the help of the first one is shown.
    let mut known = Vec::new();
    keys.retain(|key| {
        !known.contains(&key.name) && {
            known.push(key.name);
            true
        }
    });
    keys
}

/// The only table that has a key with this name, if it occurs once in a file.
pub(crate) fn table_of(name: &str) -> Option<&'static str> {
    let has = |table: &&str| keys(&[*table]).iter().any(|key| key.name == name);
    ["run", "robot", "afp"].into_iter().find(has)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read;

    #[test]
    fn every_key_accepts_its_example() {
        for (head, table) in [
            ("run", &["run"][..]),
            ("afp", &["afp"]),
            ("toolboxes.a", &["toolboxes", "a"]),
            ("toolboxes.a.crate", &["toolboxes", "a", "crate"]),
            ("robot", &["robot"]),
            ("robot.hardware", &["robot", "hardware"]),
            ("robot.realtime", &["robot", "realtime"]),
            ("target.a", &["target", "a"]),
        ] {
            let all = keys(table);
            assert!(!all.is_empty(), "{head}");
            for key in all {
                let (_, mistakes) = read(&format!("[{head}]\n{}\n", key.example));
                // Other keys may be missing or refer to missing files.
                let unknown = mistakes.iter().find(|it| {
                    it.message.ends_with(&format!("has no '{}'", key.name))
                        && !it.help.contains('=')
                        || it.message.contains("cannot have this value")
                });
                assert_eq!(unknown, None, "{head}: {}", key.example);
            }
        }
        let heads: Vec<_> = keys(&[]).iter().map(|key| key.example.replace("NAME", "a")).collect();
        let (_, mistakes) = read(&heads.join("\n"));
        assert!(
            mistakes.iter().all(|it| it.message.contains("'[robot]' has no 'sim'")),
            "{mistakes:?}"
        );
    }
}
