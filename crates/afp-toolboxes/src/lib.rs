//! The built-in toolbox files and their icons, as data.
//!
//! Callers of the compiler pass these texts to it, so that `use std` and `use carbot` need no
//! files.
#![forbid(unsafe_code)]

#[cfg(feature = "project")]
pub mod project;

/// A toolbox embedded in every program with a compiler.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// The name for `use`.
    pub name: &'static str,
    pub file_name: &'static str,
    /// The text of its file.
    pub text: &'static str,
    /// The Rust crate that implements it.
    pub rust_path: &'static str,
}

pub const ALL: &[Builtin] = &[
    Builtin {
        name: "std",
        file_name: "std.afp",
        text: include_str!("../toolboxes/std.afp"),
        rust_path: "afp_std",
    },
    Builtin {
        name: "carbot",
        file_name: "carbot.afp",
        text: include_str!("../toolboxes/carbot.afp"),
        rust_path: "afp_carbot",
    },
];

/// File name, text and crate of each toolbox.
pub fn sources() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    ALL.iter().map(|toolbox| (toolbox.file_name, toolbox.text, toolbox.rust_path))
}

macro_rules! icons {
    ($($name:literal),* $(,)?) => {
        /// Every icon: its name in templates, and the SVG text (24 x 24, drawn in `currentColor`).
        pub const ICONS: &[(&str, &str)] =
            &[$(($name, include_str!(concat!("../icons/", $name, ".svg")))),*];
    };
}

icons! {
    "after",
    "approach_infrared",
    "assign",
    "blink",
    "changed",
    "check_battery",
    "check_color",
    "check_distance",
    "check_driving_lane",
    "check_escape_button",
    "check_infrared",
    "check_line",
    "check_motion",
    "check_progress",
    "check_timeout",
    "check_touch_sensor",
    "check_value",
    "choose_view",
    "compare",
    "count",
    "curve",
    "describe_object",
    "drive",
    "drive_to",
    "every",
    "find_object",
    "follow_object",
    "follow_path",
    "forward",
    "hold",
    "idle",
    "is",
    "learn_object",
    "log",
    "look_around",
    "measure_distance",
    "measure_light",
    "new_path",
    "plan_path",
    "random",
    "retrace",
    "row",
    "search_wall",
    "signal",
    "stop",
    "stopwatch",
    "switch",
    "turn",
    "turn_to_infrared",
    "wait",
    "wall_forward",
    "widest_gap",
}

/// Whether a text is a valid icon name, and thus file name: letters, digits, `-` and `_`.
pub fn is_icon_name(name: &str) -> bool {
    let plain = |each: char| each.is_ascii_alphanumeric() || matches!(each, '-' | '_');
    !name.is_empty() && name.chars().all(plain)
}

/// The SVG text of an icon; `None` for an unknown name.
pub fn icon(name: &str) -> Option<&'static str> {
    ICONS.iter().find(|(known, _)| *known == name).map(|(_, svg)| *svg)
}

#[cfg(test)]
mod tests {
    use super::{ALL, ICONS, icon, is_icon_name};

    #[test]
    fn every_icon_named_by_a_toolbox_is_embedded() {
        for toolbox in ALL {
            let names = toolbox.text.lines().filter_map(|line| line.trim().strip_prefix("icon \""));
            for name in names.map(|rest| rest.trim_end_matches('"')) {
                assert!(icon(name).is_some(), "{}: no icon '{name}'", toolbox.file_name);
            }
        }
    }

    #[test]
    fn icons_are_24_by_24_in_the_current_colour() {
        for (name, svg) in ICONS {
            assert!(svg.contains("viewBox=\"0 0 24 24\""), "{name}");
            assert!(svg.contains("currentColor"), "{name}");
        }
    }

    #[test]
    fn no_icon_name_leaves_its_folder() {
        assert!(ICONS.iter().all(|(name, _)| is_icon_name(name)));
        assert!(!["", "../x", "a/b", "a.svg", "é"].iter().any(|name| is_icon_name(name)));
    }

    #[test]
    fn an_unknown_icon_is_not_found() {
        assert!(icon("teapot").is_none());
    }
}
