//! The colours and fonts of drawings, for light and dark pages and for paper.
//!
//! Only the tables below define these colours; a page reads them as [`properties`]. A test measures
//! the contrast in every theme: 4.5 : 1 for texts, 3 : 1 for lines and signs.

use super::super::Theme;

/// The rules for all themes. All rules are scoped to one class, because the picture may be inside a
/// page with its own styles.
const COMMON: &str = "\
.afp-plan{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif}
.afp-plan .bold{font-weight:600}
.afp-plan rect,.afp-plan path.box{stroke-width:1.4}
.afp-plan .inner{fill:none}
.afp-plan .flow{fill:none;stroke-width:2.4;stroke-linejoin:round}
.afp-plan .halo{fill:none;stroke-width:7}
.afp-plan .thin{fill:none;stroke-width:1.2}
.afp-plan .flow.error{stroke-dasharray:7 4}
.afp-plan .flow.missed{stroke-dasharray:2 4}
.afp-plan path.flow.hollow{stroke-width:1.8;stroke-dasharray:none}
.afp-plan rect.formula{stroke-dasharray:3 2}
.afp-plan rect.ignore{stroke-dasharray:3 3}
.afp-plan rect.open,.afp-plan rect.hole,.afp-plan rect.nowhere,.afp-plan rect.unknown{stroke-dasharray:3 2}
.afp-plan rect.spine{stroke:none}
";

/// Selector below `.afp-plan`, declarations on light, declarations on dark.
const RULES: &[Rule] = &[
    (".page", "fill:#ffffff;stroke:none", "fill:#12161d;stroke:none"),
    (".halo", "stroke:#ffffff", "stroke:#12161d"),
    (".hollow", "fill:#ffffff", "fill:#12161d"),
    ("text", "fill:#1c2430", "fill:#e6ebf2"),
    ("text.template,text.port", "fill:#5b6675", "fill:#9aa7b8"),
    (".box.actor", "fill:#f3f7fd;stroke:#5b7fb5", "fill:#1b2635;stroke:#5f86c0"),
    (".icon.actor", "color:#2559a8", "color:#8ab4f0"),
    (".box.computation", "fill:#fdf7e4;stroke:#b08a2a", "fill:#2b2618;stroke:#c29b3c"),
    (".icon.computation", "color:#8a6612", "color:#e3c06a"),
    (".box.subplan", "fill:#f4f1fd;stroke:#7b68c4", "fill:#231f35;stroke:#8f7dd8"),
    (".inner.subplan", "stroke:#7b68c4", "stroke:#8f7dd8"),
    (".icon.subplan", "color:#5a45ad", "color:#b6a6f5"),
    (".box.supervisor", "fill:#fff5ec;stroke:#b06a2c", "fill:#2c2119;stroke:#b87a45"),
    (
        ".box.reactions",
        "fill:#fffaf5;stroke:#b06a2c;stroke-dasharray:4 3",
        "fill:#201b17;stroke:#b87a45;stroke-dasharray:4 3",
    ),
    (".icon.supervisor", "color:#b45309", "color:#f0a868"),
    (".box.start", "fill:#1f2b3d;stroke:#1f2b3d", "fill:#dfe7f2;stroke:#dfe7f2"),
    ("text.start", "fill:#ffffff", "fill:#12161d"),
    (".icon.start", "color:#7ddba3", "color:#1a7f46"),
    (".flow.start", "stroke:#1f2b3d", "stroke:#dfe7f2"),
    (".tip.start", "fill:#1f2b3d", "fill:#dfe7f2"),
    (".box.configuration", "fill:#f7fbfa;stroke:#6b9b91", "fill:#15201f;stroke:#5a7f78"),
    (".box.entry", "fill:#cdeee6;stroke:#2c8c7a", "fill:#17443c;stroke:#41a592"),
    (".box.formula", "fill:#ffffff;stroke:#2c8c7a", "fill:#12161d;stroke:#41a592"),
    ("text.entry,text.formula", "fill:#0d4d41", "fill:#bdeee3"),
    (".thin.data", "stroke:#2c8c7a", "stroke:#41a592"),
    (".tip.data", "fill:#2c8c7a", "fill:#41a592"),
    (".box.state", "fill:#2f66b8;stroke:#2f66b8", "fill:#3a70c2;stroke:#3a70c2"),
    (".flow.state", "stroke:#2f66b8", "stroke:#6c9fe6"),
    (".tip.state", "fill:#2f66b8", "fill:#6c9fe6"),
    (".box.event", "fill:#b4530f;stroke:#b4530f", "fill:#b9571a;stroke:#b9571a"),
    (".flow.event", "stroke:#d0702c", "stroke:#e0894a"),
    (".tip.event", "fill:#d0702c", "fill:#e0894a"),
    (".box.error", "fill:#b3263a;stroke:#b3263a", "fill:#b8354a;stroke:#b8354a"),
    (".flow.error", "stroke:#b3263a", "stroke:#e0677a"),
    (".tip.error", "fill:#b3263a", "fill:#e0677a"),
    (".box.missed", "fill:#8a3fa0;stroke:#8a3fa0", "fill:#8a4a9e;stroke:#8a4a9e"),
    (".flow.missed", "stroke:#8a3fa0", "stroke:#c58ad6"),
    (".tip.missed", "fill:#8a3fa0", "fill:#c58ad6"),
    ("text.state,text.event,text.error,text.missed", "fill:#ffffff", "fill:#ffffff"),
    (".box.terminate", "fill:#1f2b3d;stroke:#1f2b3d", "fill:#dfe7f2;stroke:#dfe7f2"),
    ("text.terminate", "fill:#ffffff", "fill:#12161d"),
    (".box.fail", "fill:#b3263a;stroke:#b3263a", "fill:#b8354a;stroke:#b8354a"),
    ("text.fail", "fill:#ffffff", "fill:#ffffff"),
    (".box.spine", "fill:#b06a2c", "fill:#b87a45"),
    (".box.open", "fill:#ffffff;stroke:#b3263a", "fill:#12161d;stroke:#ff8a94"),
    (
        ".box.hole,.box.unknown,.box.nowhere",
        "fill:#ffffff;stroke:#b3263a",
        "fill:#12161d;stroke:#ff8a94",
    ),
    ("text.open,text.hole,text.unknown,text.nowhere", "fill:#b3263a", "fill:#ff8a94"),
    (".icon.wrong", "color:#b3263a", "color:#ff8a94"),
    (".icon.doubtful", "color:#8a5a00", "color:#f0c24b"),
    (".icon.note", "color:#5b6675", "color:#9aa7b8"),
    (".box.ignore", "fill:#ffffff;stroke:#8b95a3", "fill:#12161d;stroke:#8b95a3"),
    ("text.ignore", "fill:#5b6675", "fill:#9aa7b8"),
    ("text.resume", "fill:#a04a0d", "fill:#f0a868"),
];

/// The additional rules of a drawing by use. Used parts are blue; unused parts are orange and
/// dashed, so that colour-blind readers can distinguish them. Uncounted parts are grey.
const USAGE_COMMON: &str = "\
.afp-plan .box.unused{stroke-dasharray:4 3}
.afp-plan .box.partly{stroke-width:2.4}
.afp-plan .flow.used{stroke-dasharray:none}
.afp-plan .flow.unused{stroke-dasharray:6 4;stroke-width:1.7}
";

const USAGE_RULES: &[Rule] = &[
    (".box.entry,.box.formula", "fill:#f2f4f6;stroke:#828d99", "fill:#1d232c;stroke:#5c6774"),
    ("text.entry,text.formula", "fill:#4c5764", "fill:#aeb9c5"),
    (".box.configuration", "fill:#fafbfc;stroke:#828d99", "fill:#161b22;stroke:#66717d"),
    (".thin.data", "stroke:#828d99", "stroke:#5c6774"),
    (".tip.data", "fill:#828d99", "fill:#5c6774"),
    (".box.ignore", "fill:#ffffff;stroke:#828d99", "fill:#12161d;stroke:#5c6774"),
    (".box.event,.box.state", "fill:#66717d;stroke:#66717d", "fill:#4a545f;stroke:#6b7681"),
    (".flow.event,.flow.state", "stroke:#7f8a96", "stroke:#6b7681"),
    (".tip.event,.tip.state", "fill:#7f8a96", "fill:#6b7681"),
    (".box.used", "fill:#dceefa;stroke:#0072b2", "fill:#0f2c40;stroke:#56b4e9"),
    (".box.partly", "fill:#fbf0c0;stroke:#0072b2", "fill:#3d3512;stroke:#56b4e9"),
    (".box.unused", "fill:#ffffff;stroke:#d55e00", "fill:#12161d;stroke:#f0924a"),
    (".inner.used,.inner.partly", "stroke:#0072b2", "stroke:#56b4e9"),
    (".inner.unused", "stroke:#d55e00", "stroke:#f0924a"),
    (".icon.used,.icon.partly", "color:#0072b2", "color:#56b4e9"),
    (".icon.unused", "color:#d55e00", "color:#f0924a"),
    (
        ".box.state.used,.box.event.used,.box.error.used,.box.missed.used",
        "fill:#0072b2;stroke:#0072b2",
        "fill:#1d6fa5;stroke:#1d6fa5",
    ),
    (
        "text.state.unused,text.event.unused,text.error.unused,text.missed.unused,text.entry.unused",
        "fill:#a84300",
        "fill:#f7b27d",
    ),
    (
        ".box.state.unused,.box.event.unused,.box.error.unused,.box.missed.unused",
        "fill:#ffffff;stroke:#d55e00",
        "fill:#12161d;stroke:#f0924a",
    ),
    ("text.entry.used", "fill:#00476f", "fill:#bfe2f8"),
    (".flow.used", "stroke:#0072b2", "stroke:#56b4e9"),
    (".tip.used", "fill:#0072b2", "fill:#56b4e9"),
    (".flow.unused", "stroke:#d55e00", "stroke:#f0924a"),
    (".tip.unused", "fill:#d55e00", "fill:#f0924a"),
];

/// The style sheet of a theme, for a drawing by kind or by use: for pages that build a scene
/// themselves. Paper is always light.
pub fn sheet(theme: Theme, usage: bool) -> String {
    let sets = if usage { &[RULES, USAGE_RULES][..] } else { &[RULES] };
    let light = || sets.iter().map(|set| rules(set, |rule| rule.1)).collect::<String>();
    let dark = || sets.iter().map(|set| rules(set, |rule| rule.2)).collect::<String>();
    let colours = match theme {
        Theme::Light => light(),
        // Paper is light.
        Theme::Dark => format!("{}@media print{{\n{}}}\n", dark(), light()),
        Theme::Auto => {
            let dark = dark();
            format!("{}@media screen and (prefers-color-scheme:dark){{\n{dark}}}\n", light())
        }
    };
    let more = if usage { USAGE_COMMON } else { "" };
    format!("{COMMON}{colours}{more}")
}

/// The colours of drawings as properties of a page: `--icon-actor-color` is the `color` of
/// `.icon.actor`.
pub fn properties() -> String {
    let all = |declarations: fn(&Rule) -> &'static str| {
        let named = RULES.iter().flat_map(|rule| {
            let selector = rule.0.split(',').next().unwrap_or_default();
            let name = selector.trim_start_matches('.').replace('.', "-");
            declarations(rule).split(';').map(move |declaration| format!("--{name}-{declaration};"))
        });
        named.collect::<String>()
    };
    let (light, dark) = (all(|rule| rule.1), all(|rule| rule.2));
    format!(":root{{{light}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}\n")
}

type Rule = (&'static str, &'static str, &'static str);

fn rules(rules: &[Rule], declarations: impl Fn(&Rule) -> &'static str) -> String {
    let scoped = |selectors: &str| {
        let scoped = selectors.split(',').map(|selector| format!(".afp-plan {selector}"));
        scoped.collect::<Vec<_>>().join(",")
    };
    rules.iter().map(|rule| format!("{}{{{}}}\n", scoped(rule.0), declarations(rule))).collect()
}

#[cfg(test)]
mod tests;
