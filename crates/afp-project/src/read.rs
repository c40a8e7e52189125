//! Parses a project file and reports all errors at once.

mod calibration;
mod profile;

pub use calibration::read_calibration;

use std::collections::BTreeMap;
use std::ops::Range;

use afp_excerpt::Mistake;
use afp_excerpt::hidden::hidden;
use afp_excerpt::words::instead;
use toml_edit::{Document, Item, TableLike, Value};

use crate::key::Key;
use crate::keys;
use crate::project::{Crate, Hardware, Origin, Project, Robot, Target, Toolbox};
use crate::realtime::Realtime;
use crate::time::duration;

/// Parses an `afp.toml`. Invalid parts are omitted, and their errors returned in source order.
pub fn read(text: &str) -> (Project, Vec<Mistake>) {
    let mut reader = Reader { mistakes: Vec::new() };
    let mut project = Project::default();
    for hidden in hidden(text) {
        let message = format!("'{}' {}", hidden.shown, hidden.fault());
        reader.wrong(hidden.span, message, "remove it");
    }
    match Document::parse(text) {
        Ok(document) => reader.project(document.as_table(), &mut project),
        Err(error) => {
            let span = error.span().unwrap_or(0..0);
            reader.mistakes.push(Mistake::new(Some(span), error.message().replace('\n', ", ")));
        }
    }
    reader.mistakes.sort_by_key(|mistake| mistake.span.as_ref().map(|span| span.start));
    (project, reader.mistakes)
}

/// A key with its value, and the place of the key.
struct Pair<'a> {
    key: &'a str,
    item: &'a Item,
    span: Range<usize>,
}

struct Reader {
    mistakes: Vec<Mistake>,
}

impl Reader {
    fn project(&mut self, table: &dyn TableLike, project: &mut Project) {
        let mut robot = None;
        for pair in pairs(table) {
            match pair.key {
                "run" => self.run(&pair, project),
                "afp" => project.afp = self.afp(&pair),
                "robot" => robot = Some(pair),
                "toolboxes" => project.toolboxes = self.each(&pair, Reader::toolbox),
                "target" => project.targets = self.each(&pair, Reader::target),
                key => match keys::table_of(key) {
                    Some(table) if !keys::keys(&[table, key]).is_empty() => {
                        let message = format!("a project has no '[{key}]'");
                        self.wrong(pair.span, message, &format!("write '[{table}.{key}]'"));
                    }
                    None => self.unknown(&pair, "a project", keys::PROJECT),
                    Some(_) if pair.item.is_table_like() => {
                        self.unknown(&pair, "a project", keys::PROJECT);
                    }
                    Some(table) => {
                        let message = format!("'{key}' is above the tables");
                        self.wrong(pair.span, message, &format!("write it below '[{table}]'"));
                    }
                },
            }
        }
        // It names a toolbox, which may be declared later.
        project.robot = robot.and_then(|pair| self.robot(&pair, &project.toolboxes));
    }

    fn run(&mut self, run: &Pair<'_>, project: &mut Project) {
        for pair in self.table(run, "world = \"worlds/room.toml\"") {
            match pair.key {
                "world" => {
                    let what = "the world file, such as \"worlds/room.toml\"";
                    project.world = self.text(&pair, what);
                }
                "measures" => project.measures = self.texts(&pair, "names in a list, [\"wall\"]"),
                _ => self.unknown(&pair, "'[run]'", keys::RUN),
            }
        }
    }

    fn afp(&mut self, afp: &Pair<'_>) -> Option<Origin> {
        let help = "'path = \"../afp\"' takes the crates from a checkout";
        let mut origins = Vec::new();
        for pair in self.table(afp, help) {
            match self.origin(&pair) {
                Some(origin) => origins.extend(origin),
                None => self.unknown(&pair, "'[afp]'", keys::ORIGIN),
            }
        }
        self.single(afp, origins, help)
    }

    /// The only origin, or an error for several; none is valid if there is a default.
    fn single(&mut self, of: &Pair<'_>, mut all: Vec<Origin>, help: &str) -> Option<Origin> {
        if all.len() > 1 {
            let message = format!("'{}' needs exactly one of 'path', 'git' and 'version'", of.key);
            self.wrong(of.span.clone(), message, help);
        }
        all.pop()
    }

    /// A key with a crate's origin; the inner `None` is an invalid value.
    fn origin(&mut self, pair: &Pair<'_>) -> Option<Option<Origin>> {
        let (make, what): (fn(String) -> Origin, _) = match pair.key {
            "path" => (Origin::Path, "a folder in quotes"),
            "git" => (Origin::Git, "the address of a repository in quotes"),
            "version" => (Origin::Version, "a version in quotes, such as \"0.1\""),
            _ => return None,
        };
        Some(self.text(pair, what).map(make))
    }

    fn toolbox(&mut self, toolbox: &Pair<'_>) -> Option<Toolbox> {
        let name = toolbox.key;
        let example = format!("{name} = {{ path = \"{name}.afp\" }}");
        let before = self.mistakes.len();
        let (mut path, mut krate) = (None, Crate::default());
        for pair in self.table(toolbox, &example) {
            match pair.key {
                "path" => path = self.text(&pair, "the toolbox file, such as \"gripper.afp\""),
                "crate" => krate = self.krate(&pair),
                _ => self.unknown(&pair, "a toolbox", keys::TOOLBOX),
            }
        }
        if path.is_none() && self.mistakes.len() == before {
            let message = format!("the toolbox '{name}' has no 'path'");
            self.wrong(toolbox.span.clone(), message, &format!("write '{example}'"));
        }
        Some(Toolbox { name: name.to_owned(), path: path?, krate, span: toolbox.span.clone() })
    }

    fn robot(&mut self, robot: &Pair<'_>, toolboxes: &[Toolbox]) -> Option<Robot> {
        let before = self.mistakes.len();
        let mut read = Robot { span: robot.span.clone(), ..Robot::default() };
        let mut pairs = self.table(robot, "a heading '[robot]'");
        if let Some(at) = pairs.iter().position(|pair| pair.key == "profile") {
            let named = pairs.remove(at);
            let profile = self.profile(&named)?;
            pairs.retain(|pair| !self.of_every_robot(pair, &mut read));
            read.profile = Some(self.profile_robot((&named, profile), pairs));
            return Some(read);
        }
        pairs.retain(|pair| !self.of_every_robot(pair, &mut read));
        for pair in pairs {
            match pair.key {
                "toolbox" => read.toolbox = self.known_toolbox(&pair, toolboxes),
                "sim" => read.sim = self.type_path(&pair),
                "crate" => read.krate = Some(self.krate(&pair)),
                "hardware" => read.hardware = self.hardware(&pair),
                key if keys::keys(&["robot"]).iter().any(|known| known.name == key) => {
                    let message = format!("'{key}' is a key of robots with a 'profile'");
                    self.wrong(pair.span, message, "write 'profile = \"carbot\"'");
                }
                _ => self.unknown(&pair, "'[robot]'", keys::ROBOT),
            }
        }
        if read.sim.is_none() && read.hardware.is_none() && self.mistakes.len() == before {
            let help = "write 'sim = \"Vacuum\"', the Rust type that implements 'Simulated', or \
                        'profile = \"carbot\"' for a robot from parts";
            self.wrong(robot.span.clone(), "'[robot]' has no 'sim'".to_owned(), help);
        }
        Some(read)
    }

    /// Reads a key that robots with and without a profile have; returns whether it is one.
    fn of_every_robot(&mut self, pair: &Pair<'_>, robot: &mut Robot) -> bool {
        match pair.key {
            "realtime" => robot.realtime = self.realtime(pair),
            "autostart" => match pair.item.as_bool() {
                Some(autostart) => robot.autostart = autostart,
                None => self.value(pair, "true or false"),
            },
            "logs" => match pair.item.as_str().and_then(size) {
                Some(logs) => robot.logs = Some(logs),
                None => self.value(pair, "a size in quotes, from 1 MB to 1000 GB"),
            },
            _ => return false,
        }
        true
    }

    fn hardware(&mut self, hardware: &Pair<'_>) -> Option<Hardware> {
        let example = "hardware = { type = \"Board\", crate = { path = \"board\" } }";
        let before = self.mistakes.len();
        let (mut ty, mut krate, mut settings) = (None, None, Vec::new());
        for pair in self.table(hardware, example) {
            match pair.key {
                "type" => ty = self.type_path(&pair),
                "crate" => krate = Some(self.krate(&pair)),
                "settings" => settings = self.settings(&pair),
                _ => self.unknown(&pair, "'hardware'", keys::HARDWARE),
            }
        }
        if ty.is_none() && self.mistakes.len() == before {
            let help = "write 'type = \"Board\"', the Rust type that implements 'Hardware'";
            self.wrong(hardware.span.clone(), "'hardware' has no 'type'".to_owned(), help);
        }
        Some(Hardware { ty: ty?, krate, settings, span: hardware.span.clone() })
    }

    /// Names with strings, numbers or truth values, as text.
    fn settings(&mut self, settings: &Pair<'_>) -> Vec<(String, String)> {
        let mut all = Vec::new();
        for pair in self.table(settings, "settings = { port = \"/dev/ttyUSB0\" }") {
            match simple(&pair) {
                Some(value) => all.push((pair.key.to_owned(), value)),
                None => self.value(&pair, "a string in quotes, a number, true or false"),
            }
        }
        all
    }

    fn realtime(&mut self, realtime: &Pair<'_>) -> Vec<(String, String)> {
        let mut all = Vec::new();
        for pair in self.table(realtime, "stall = \"100 ms\"") {
            if !Realtime::NAMES.contains(&pair.key) {
                self.unknown(&pair, "'realtime'", keys::REALTIME);
                continue;
            }
            let value = simple(&pair).unwrap_or_default();
            match Realtime::default().set(pair.key, &value) {
                Ok(()) => all.push((pair.key.to_owned(), value)),
                Err(what) => self.value(&pair, what),
            }
        }
        all
    }

    fn known_toolbox(&mut self, pair: &Pair<'_>, toolboxes: &[Toolbox]) -> Option<String> {
        let name = self.text(pair, "the name of one of '[toolboxes]'")?;
        if toolboxes.iter().all(|toolbox| toolbox.name != name) {
            let names: Vec<_> = toolboxes.iter().map(|each| format!("'{}'", each.name)).collect();
            let help = match names.is_empty() {
                true => format!("name its file: '[toolboxes]' with '{name}.path = \"{name}.afp\"'"),
                false => format!("write {}", names.join(" or ")),
            };
            self.wrong(value_span(pair), format!("no toolbox '{name}' in '[toolboxes]'"), &help);
        }
        Some(name)
    }

    /// The path of a type in Rust, such as `Vacuum` or `sim::Vacuum`.
    fn type_path(&mut self, pair: &Pair<'_>) -> Option<String> {
        let what = "the Rust type from the root of its crate, such as \"Vacuum\"";
        let path = self.text(pair, what)?;
        let is_word = |word: &str| {
            let mut letters = word.chars();
            letters.next().is_some_and(|first| first.is_alphabetic() || first == '_')
                && letters.all(|letter| letter.is_alphanumeric() || letter == '_')
        };
        if path.split("::").all(is_word) {
            return Some(path);
        }
        self.value(pair, what);
        None
    }

    /// `"package"` or a table.
    fn krate(&mut self, krate: &Pair<'_>) -> Crate {
        if let Some(package) = krate.item.as_str() {
            return Crate { package: Some(package.to_owned()), ..Crate::default() };
        }
        let help = "\"my-gripper\", or { path = \"gripper\" }";
        let (mut read, mut origins) = (Crate::default(), Vec::new());
        for pair in self.table(krate, help) {
            match (pair.key, self.origin(&pair)) {
                (_, Some(origin)) => origins.extend(origin),
                ("package", _) => read.package = self.text(&pair, "the package's name in quotes"),
                ("module", _) => read.module = self.text(&pair, "a path such as \"gripper::fast\""),
                _ => self.unknown(&pair, "a crate", &[keys::ORIGIN, keys::CRATE].concat()),
            }
        }
        let help = "'path' names the folder of its Cargo.toml";
        Crate { origin: self.single(krate, origins, help), ..read }
    }

    fn target(&mut self, target: &Pair<'_>) -> Option<Target> {
        let mut read = Target { name: target.key.to_owned(), ..Target::default() };
        for pair in self.table(target, "tick = \"1 ms\" and capacity = 0.5") {
            match pair.key {
                "tick" => read.tick = self.time(&pair),
                "capacity" => {
                    read.capacity = self.number(&pair, 1.0, "above 0 and at most 1, such as 0.7");
                }
                "slowdown" => {
                    read.slowdown = self.number(&pair, f64::MAX, "above 0, such as 20");
                }
                "budgets" => read.budgets = self.budgets(&pair),
                _ => self.unknown(&pair, "a target", keys::TARGET),
            }
        }
        Some(read)
    }

    /// `carbot.Forward = "30 us"`
    fn budgets(&mut self, budgets: &Pair<'_>) -> BTreeMap<String, BTreeMap<String, u64>> {
        let mut read = BTreeMap::new();
        for toolbox in self.table(budgets, "budgets.carbot.Forward = \"30 us\"") {
            let of: &mut BTreeMap<_, _> = read.entry(toolbox.key.to_owned()).or_default();
            for template in self.table(&toolbox, "a template and its time: Forward = \"30 us\"") {
                of.extend(self.time(&template).map(|time| (template.key.to_owned(), time)));
            }
        }
        read
    }

    fn time(&mut self, pair: &Pair<'_>) -> Option<u64> {
        let time = pair.item.as_str().and_then(|text| duration(text).ok());
        let tick = time.map(|time| time.as_nanos()).filter(|tick| *tick > 0);
        if tick.is_none() {
            self.value(pair, "a time in quotes, such as \"100 us\"");
        }
        tick
    }

    fn number(&mut self, pair: &Pair<'_>, most: f64, what: &str) -> Option<f64> {
        let value = match pair.item.as_value() {
            Some(Value::Float(value)) => Some(*value.value()),
            Some(Value::Integer(value)) => Some(*value.value() as f64),
            _ => None,
        };
        let value = value.filter(|value| *value > 0.0 && *value <= most);
        if value.is_none() {
            self.value(pair, &format!("a number {what}"));
        }
        value
    }

    fn each<T>(&mut self, pair: &Pair<'_>, one: fn(&mut Reader, &Pair<'_>) -> Option<T>) -> Vec<T> {
        let pairs = self.table(pair, &format!("a heading '[{}]'", pair.key));
        pairs.iter().filter_map(|pair| one(self, pair)).collect()
    }

    fn table<'a>(&mut self, pair: &Pair<'a>, example: &str) -> Vec<Pair<'a>> {
        match pair.item.as_table_like() {
            Some(table) => pairs(table),
            None => {
                let help = format!("write {example}");
                self.wrong(value_span(pair), format!("'{}' is a table", pair.key), &help);
                Vec::new()
            }
        }
    }

    fn text(&mut self, pair: &Pair<'_>, what: &str) -> Option<String> {
        let text = pair.item.as_str().filter(|text| !text.is_empty());
        if text.is_none() {
            self.value(pair, what);
        }
        text.map(str::to_owned)
    }

    fn texts(&mut self, pair: &Pair<'_>, what: &str) -> Vec<String> {
        let list = pair.item.as_array().map(|list| list.iter().map(|it| it.as_str()));
        let texts = list.and_then(|list| list.map(|text| text.map(str::to_owned)).collect());
        texts.unwrap_or_else(|| {
            self.value(pair, what);
            Vec::new()
        })
    }

    /// Reports an invalid value.
    fn value(&mut self, pair: &Pair<'_>, what: &str) {
        let message = format!("'{}' cannot have this value", pair.key);
        self.wrong(value_span(pair), message, &format!("write {what}"));
    }

    fn unknown(&mut self, pair: &Pair<'_>, whose: &str, keys: &[Key]) {
        let help = instead(pair.key, keys.iter().map(|key| key.name));
        self.wrong(pair.span.clone(), format!("{whose} has no '{}'", pair.key), &help);
    }

    fn wrong(&mut self, span: Range<usize>, message: String, help: &str) {
        self.mistakes.push(Mistake::new(Some(span), message).with_help(help));
    }
}

fn pairs(table: &dyn TableLike) -> Vec<Pair<'_>> {
    let pairs = table.iter().map(|(key, item)| {
        let span = table.get_key_value(key).and_then(|(key, _)| key.span());
        Pair { key, item, span: span.or_else(|| item.span()).unwrap_or(0..0) }
    });
    pairs.collect()
}

/// A string, a number or a truth value, as text.
fn simple(pair: &Pair<'_>) -> Option<String> {
    match pair.item.as_value()? {
        Value::String(text) => Some(text.value().clone()),
        Value::Integer(number) => Some(number.value().to_string()),
        Value::Float(number) => Some(number.value().to_string()),
        Value::Boolean(truth) => Some(truth.value().to_string()),
        _ => None,
    }
}

/// A number of bytes, such as `500 MB`.
fn size(text: &str) -> Option<u64> {
    let units = [("MB", 1_000_000), ("GB", 1_000_000_000)];
    let (number, unit) =
        units.into_iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?, unit)))?;
    let size = number.trim().parse::<u64>().ok()?.checked_mul(unit)?;
    (1_000_000..=1_000_000_000_000).contains(&size).then_some(size)
}

/// A list of whole numbers as text: `5, 6`.
fn numbers(pair: &Pair<'_>) -> Option<String> {
    let all = pair.item.as_array()?.iter().map(|value| value.as_integer().map(|it| it.to_string()));
    Some(all.collect::<Option<Vec<_>>>()?.join(", "))
}

fn value_span(pair: &Pair<'_>) -> Range<usize> {
    pair.item.span().unwrap_or_else(|| pair.span.clone())
}

#[cfg(test)]
mod tests;
