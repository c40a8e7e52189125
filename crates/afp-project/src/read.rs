//! From the text of a project file to its meaning; whatever is wrong is said, all at once.

use std::ops::Range;

use toml_edit::{Document, Item, TableLike, Value};

use crate::project::{Crate, Mistake, Origin, Project, Target, Toolbox};
use crate::time::duration;

/// Reads the text of an `afp.toml`. What is wrong is left out of the project and said beside it, in
/// the order of the text.
pub fn read(text: &str) -> (Project, Vec<Mistake>) {
    let mut reader = Reader { mistakes: Vec::new() };
    let mut project = Project::default();
    match Document::parse(text) {
        Ok(document) => reader.project(document.as_table(), &mut project),
        Err(error) => reader.mistakes.push(Mistake {
            span: error.span().unwrap_or(0..0),
            message: error.message().replace('\n', ", "),
            help: String::new(),
        }),
    }
    reader.mistakes.sort_by_key(|mistake| mistake.span.start);
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
        for pair in pairs(table) {
            match pair.key {
                "run" => self.run(&pair, project),
                "afp" => project.afp = self.afp(&pair),
                "toolboxes" => project.toolboxes = self.each(&pair, Reader::toolbox),
                "target" => project.targets = self.each(&pair, Reader::target),
                _ => self.unknown(
                    &pair,
                    "a project",
                    "it has '[run]', '[toolboxes]', '[target.NAME]' and '[afp]'",
                ),
            }
        }
    }

    fn run(&mut self, run: &Pair<'_>, project: &mut Project) {
        for pair in self.table(run, "world = \"worlds/room.toml\"") {
            match pair.key {
                "world" => {
                    let what = "the world file, such as \"worlds/room.toml\"";
                    project.world = self.text(&pair, what);
                }
                "measures" => project.measures = self.texts(&pair, "names in a list, [\"wall\"]"),
                _ => self.unknown(&pair, "'[run]'", "it has 'world' and 'measures'"),
            }
        }
    }

    fn afp(&mut self, afp: &Pair<'_>) -> Option<Origin> {
        let help = "'path = \"../afp\"' takes the crates from a checkout";
        let mut origins = Vec::new();
        for pair in self.table(afp, help) {
            match self.origin(&pair) {
                Some(origin) => origins.extend(origin),
                None => self.unknown(&pair, "'[afp]'", "it has 'path', 'git' or 'version'"),
            }
        }
        self.single(afp, origins, help)
    }

    /// The one origin among those written; none is fine for whoever has another way to know.
    fn single(&mut self, of: &Pair<'_>, mut all: Vec<Origin>, help: &str) -> Option<Origin> {
        if all.len() > 1 {
            let message = format!("'{}' wants exactly one of 'path', 'git' and 'version'", of.key);
            self.wrong(of.span.clone(), message, help);
        }
        all.pop()
    }

    /// A key that says where a crate comes from; the inner `None` stands for a wrong value.
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
                _ => self.unknown(&pair, "a toolbox", "it has 'path' and 'crate'"),
            }
        }
        if path.is_none() && self.mistakes.len() == before {
            let message = format!("the toolbox '{name}' has no 'path'");
            self.wrong(toolbox.span.clone(), message, &format!("write '{example}'"));
        }
        Some(Toolbox { name: name.to_owned(), path: path?, krate, span: toolbox.span.clone() })
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
                _ => self.unknown(
                    &pair,
                    "the crate of a toolbox",
                    "it has 'path', 'git' or 'version', and 'package' and 'module'",
                ),
            }
        }
        let help = "'path' names the folder of its Cargo.toml";
        Crate { origin: self.single(krate, origins, help), ..read }
    }

    fn target(&mut self, target: &Pair<'_>) -> Option<Target> {
        let mut read = Target { name: target.key.to_owned(), tick: None, capacity: None };
        for pair in self.table(target, "tick = \"1 ms\" and capacity = 0.5") {
            match pair.key {
                "tick" => read.tick = self.tick(&pair),
                "capacity" => read.capacity = self.capacity(&pair),
                _ => self.unknown(&pair, "a target", "it has 'tick' and 'capacity'"),
            }
        }
        Some(read)
    }

    fn tick(&mut self, pair: &Pair<'_>) -> Option<u64> {
        let time = pair.item.as_str().and_then(|text| duration(text).ok());
        let tick = time.map(|time| time.as_nanos()).filter(|tick| *tick > 0);
        if tick.is_none() {
            self.value(pair, "a time in quotes, such as \"100 us\"");
        }
        tick
    }

    fn capacity(&mut self, pair: &Pair<'_>) -> Option<f64> {
        let value = match pair.item.as_value() {
            Some(Value::Float(value)) => Some(*value.value()),
            Some(Value::Integer(value)) => Some(*value.value() as f64),
            _ => None,
        };
        let value = value.filter(|value| *value > 0.0 && *value <= 1.0);
        if value.is_none() {
            self.value(pair, "a number above 0 and at most 1, such as 0.7");
        }
        value
    }

    /// What each pair of a table reads as.
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

    /// A value that cannot be.
    fn value(&mut self, pair: &Pair<'_>, what: &str) {
        let message = format!("'{}' cannot have this value", pair.key);
        self.wrong(value_span(pair), message, &format!("write {what}"));
    }

    fn unknown(&mut self, pair: &Pair<'_>, whose: &str, help: &str) {
        self.wrong(pair.span.clone(), format!("{whose} has no '{}'", pair.key), help);
    }

    fn wrong(&mut self, span: Range<usize>, message: String, help: &str) {
        self.mistakes.push(Mistake { span, message, help: help.to_owned() });
    }
}

fn pairs(table: &dyn TableLike) -> Vec<Pair<'_>> {
    let pairs = table.iter().map(|(key, item)| {
        let span = table.get_key_value(key).and_then(|(key, _)| key.span());
        Pair { key, item, span: span.or_else(|| item.span()).unwrap_or(0..0) }
    });
    pairs.collect()
}

fn value_span(pair: &Pair<'_>) -> Range<usize> {
    pair.item.span().unwrap_or_else(|| pair.span.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_file_is_read() {
        let text = "\
[run]
world = 'w.toml'
measures = ['wall']

[toolboxes]
b = { path = 'b.afp' }
a.path = 'a.afp'
a.crate = { git = 'https://x', package = 'aa', module = 'm' }
c = { path = 'c.afp', crate = 'cc' }

[target.pi]
capacity = 0.5
[target.toy]
tick = '2 ms'

[afp]
version = '0.1'
";
        let (project, mistakes) = read(text);
        assert_eq!(mistakes, []);
        assert_eq!(project.world.as_deref(), Some("w.toml"));
        assert_eq!(project.measures, ["wall"]);
        assert_eq!(project.afp, Some(Origin::Version("0.1".to_owned())));
        let names: Vec<_> = project.toolboxes.iter().map(|toolbox| &*toolbox.name).collect();
        assert_eq!(names, ["b", "a", "c"]);
        let krate = &project.toolboxes[1].krate;
        assert_eq!(krate.origin, Some(Origin::Git("https://x".to_owned())));
        assert_eq!((krate.package.as_deref(), krate.module.as_deref()), (Some("aa"), Some("m")));
        assert_eq!(project.toolboxes[2].krate.package.as_deref(), Some("cc"));
        let [pi, toy] = &project.targets[..] else { panic!("{:?}", project.targets) };
        assert_eq!((pi.tick, pi.capacity), (None, Some(0.5)));
        assert_eq!((toy.tick, toy.capacity), (Some(2_000_000), None));
        assert_eq!(read("").0, Project::default());
    }

    /// The texts that mistakes are about.
    fn wrong(text: &str) -> Vec<&str> {
        let (_, mistakes) = read(text);
        for mistake in &mistakes {
            assert!(!mistake.message.is_empty() && !mistake.message.contains('\n'), "{mistake}");
        }
        mistakes.iter().map(|mistake| &text[mistake.span.clone()]).collect()
    }

    #[test]
    fn what_is_wrong_is_named_at_its_place_all_at_once() {
        assert_eq!(wrong("run = 3\n[rum]\n[afp]\npaht = 1"), ["3", "rum", "paht"]);
        assert_eq!(wrong("[run]\nworlds = 'x'\nworld = 7"), ["worlds", "7"]);
        assert_eq!(wrong("[run]\nmeasures = 'wall'"), ["'wall'"]);
        assert_eq!(wrong("[run]\nmeasures = [1]"), ["[1]"]);
        assert_eq!(wrong("[toolboxes]\na = 1\nb = {}\nc = { crate = 'x' }"), ["1", "b", "c"]);
        assert_eq!(wrong("[toolboxes]\na = { path = 'x', crate = 3 }"), ["3"]);
        assert_eq!(wrong("[toolboxes]\na = { path = '', krate = 'x' }"), ["''", "krate"]);
        assert_eq!(
            wrong("[toolboxes]\na.path = 'x'\na.crate = { git = 1, nam = 2 }"),
            ["1", "nam"]
        );
        assert_eq!(wrong("[afp]\npath = 'x'\ngit = 'y'"), ["afp"]);
    }

    #[test]
    fn what_is_wrong_with_a_target_is_named_at_its_place() {
        assert_eq!(wrong("[target.a]\ntock = 1"), ["tock"]);
        assert_eq!(wrong("[target.a]\ntick = 1"), ["1"]);
        assert_eq!(wrong("[target.a]\ntick = \"0 s\""), ["\"0 s\""]);
        assert_eq!(wrong("[target.a]\ntick = \"3 cm\""), ["\"3 cm\""]);
        assert_eq!(wrong("[target.a]\ncapacity = 1.5\ntick = 1"), ["1.5", "1"]);
        assert_eq!(wrong("[target]\na = 3"), ["3"]);
        assert_eq!(wrong("target = 3"), ["3"]);
    }

    #[test]
    fn no_text_is_too_strange() {
        for text in ["[", "a = ", "[a]\n[a]", "\u{0}", "run.world.x = 1", "[[toolboxes]]\na = 1"] {
            let (_, mistakes) = read(text);
            assert!(!mistakes.is_empty(), "{text:?}");
            for mistake in mistakes {
                assert!(text.get(mistake.span.clone()).is_some(), "{text:?}: {mistake:?}");
            }
        }
    }
}
