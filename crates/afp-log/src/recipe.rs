//! The recipe of a run in its log: facts, attachments and external inputs.

use afp_core::Instant;
use afp_session::{Build, Done, EventKind, Pose2, Recipe, TextFile};

use crate::read::LogData;
use crate::write::About;

/// The attachment with the world, in the format of the robot's worlds.
pub const WORLD: &str = "world";
/// The attachment with the project file.
const PROJECT: &str = "afp.toml";
/// The prefix of toolbox attachments.
const TOOLBOX: &str = "toolbox/";
/// The prefix for a source whose name equals that of another attachment: another spelling of the
/// same path.
const HERE: &str = "./";

fn is_taken(attachment: &str) -> bool {
    matches!(attachment, WORLD | PROJECT) || attached_toolbox(attachment).is_some()
}

fn text_attachment(file: &str) -> String {
    match is_taken(file) {
        true => format!("{HERE}{file}"),
        false => file.to_owned(),
    }
}

fn attached_text(attachment: &str) -> &str {
    attachment.strip_prefix(HERE).filter(|file| is_taken(file)).unwrap_or(attachment)
}

fn toolbox_attachment(toolbox: &str) -> String {
    format!("{TOOLBOX}{toolbox}")
}

/// The toolbox of an attachment; `None` for other attachments.
fn attached_toolbox(attachment: &str) -> Option<&str> {
    attachment.strip_prefix(TOOLBOX).filter(|name| !name.contains(['.', '/']))
}

/// The prefix of facts with a setting; a value may have line breaks.
const SETTING: &str = "set.";

const TEXT: &str = "text/plain";

impl About {
    /// The description of a run before it begins. External inputs are in its events.
    pub fn new(recipe: &Recipe) -> About {
        let until = recipe.until.map_or_else(String::new, |until| until.as_nanos().to_string());
        let set = |(n, (name, value)): (usize, &(String, String))| {
            (format!("{SETTING}{n}"), format!("{name}={value}"))
        };
        let settings = recipe.settings.iter().enumerate().map(set);
        let start = recipe.start.map_or_else(String::new, written);
        let mut facts = vec![
            ("plan", recipe.plan.clone()),
            ("plan_file", recipe.file.clone()),
            ("plan_text", recipe.texts.first().map(|it| it.name.clone()).unwrap_or_default()),
            (
                "plan_texts",
                recipe.texts.iter().map(|it| it.name.as_str()).collect::<Vec<_>>().join("\n"),
            ),
            ("robot", recipe.robot.clone()),
            ("seed", recipe.seed.to_string()),
            ("world", recipe.world.name.clone()),
            ("start_m_rad", start),
            ("measures", recipe.measures.join("\n")),
            ("until_ns", until),
            ("afp_version", recipe.build.version.clone()),
            ("afp_commit", recipe.build.commit.clone().unwrap_or_default()),
        ];
        facts.retain(|(_, value)| !value.is_empty());
        let texts =
            recipe.texts.iter().map(|it| (text_attachment(&it.name), TEXT, it.text.clone()));
        let toolboxes =
            recipe.toolboxes.iter().map(|it| (toolbox_attachment(&it.name), TEXT, it.text.clone()));
        let project = Some(&recipe.project).filter(|text| !text.is_empty());
        let project = project.map(|text| (PROJECT.to_owned(), TEXT, text.clone()));
        let world = (WORLD.to_owned(), TEXT, recipe.world.text.clone());
        let facts = facts.into_iter().map(|(key, value)| (key.to_owned(), value));
        About {
            facts: facts.chain(settings).collect(),
            attachments: texts.chain(toolboxes).chain(project).chain([world]).collect(),
        }
    }
}

impl LogData {
    /// The recipe for repeating the run; missing parts are empty.
    pub fn recipe(&self) -> Recipe {
        let fact = |key: &str| self.facts.get(key).map_or("", String::as_str);
        let lines = |key: &str| fact(key).lines().map(str::to_owned).collect::<Vec<_>>();
        let world = self.attachments.get(WORLD).cloned().unwrap_or_default();
        Recipe {
            plan: fact("plan").to_owned(),
            file: fact("plan_file").to_owned(),
            texts: self.texts(fact("plan_text"), &lines("plan_texts")),
            toolboxes: self.toolboxes(),
            project: self.attachments.get(PROJECT).cloned().unwrap_or_default(),
            robot: fact("robot").to_owned(),
            world: TextFile { name: fact("world").to_owned(), text: world },
            start: read(fact("start_m_rad")),
            seed: fact("seed").parse().unwrap_or_default(),
            measures: lines("measures"),
            settings: self.settings(),
            until: self
                .stopped()
                .or_else(|| fact("until_ns").parse().ok().map(Instant::from_nanos)),
            requests: self.requests(),
            build: Build {
                version: fact("afp_version").to_owned(),
                commit: self.facts.get("afp_commit").cloned(),
            },
        }
    }

    /// The plan's file, then the files that it uses, in the order of use if the log has it.
    fn texts(&self, plan: &str, order: &[String]) -> Vec<TextFile> {
        let texts = self.attachments.iter().filter(|(name, _)| !is_taken(name));
        let file = |(name, text): (&String, &String)| TextFile {
            name: attached_text(name).to_owned(),
            text: text.clone(),
        };
        let mut files: Vec<_> = texts.map(file).collect();
        let at = |file: &TextFile| order.iter().position(|name| *name == file.name);
        files.sort_by_key(|file| (file.name != plan, at(file).unwrap_or(order.len())));
        files
    }

    fn toolboxes(&self) -> Vec<TextFile> {
        let toolbox = |(name, text): (&String, &String)| {
            let name = attached_toolbox(name)?.to_owned();
            Some(TextFile { name, text: text.clone() })
        };
        self.attachments.iter().filter_map(toolbox).collect()
    }

    /// Older logs have all settings in one fact, one per line.
    fn settings(&self) -> Vec<(String, String)> {
        let older = self.facts.get("set").into_iter().flat_map(|all| all.lines());
        let each = (0..).map_while(|n| self.facts.get(&format!("{SETTING}{n}")));
        let pairs = older.chain(each.map(String::as_str)).filter_map(|it| it.split_once('='));
        pairs.map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
    }

    /// The external inputs, in the order of their execution.
    fn requests(&self) -> Vec<(Instant, afp_session::Stimulus)> {
        let made = self.events.iter().filter_map(|event| event.facts().request);
        made.map(|request| (request.at, request.what.clone())).collect()
    }

    /// Whether it names a world, which may have no text.
    pub fn has_world(&self) -> bool {
        self.attachments.contains_key(WORLD)
    }

    /// The time of a stop, or of the log's first gap or its early end.
    fn stopped(&self) -> Option<Instant> {
        let stopped = self.events.iter().find(|event| event.kind == EventKind::StopRequested);
        let stopped = stopped.map(|event| event.at);
        if let Some(missing) = self.missing.first() {
            let gap = missing.after.unwrap_or(Instant::ZERO);
            return Some(stopped.map_or(gap, |stopped| stopped.min(gap)));
        }
        let cut = self.cut_short.as_ref().and(self.span).map(|(_, last)| last);
        stopped.or(cut)
    }

    /// The hash of the run's trace; `None` for an incomplete log.
    pub fn trace(&self) -> Option<&str> {
        self.end.get("trace").filter(|_| self.cut_short.is_none()).map(String::as_str)
    }

    /// The inputs whose time came after the end of the run.
    pub fn not_reached(&self) -> impl Iterator<Item = &afp_session::Requested> {
        let requests = self.events.iter().filter_map(|event| event.facts().request);
        requests.filter(|request| request.done == Done::NotReached)
    }
}

fn written(pose: Pose2) -> String {
    format!("{} {} {}", pose.x, pose.y, pose.heading)
}

fn read(text: &str) -> Option<Pose2> {
    let mut numbers = text.split(' ').map(|number| number.parse::<f64>().ok());
    let pose = Pose2 { x: numbers.next()??, y: numbers.next()??, heading: numbers.next()?? };
    numbers.next().is_none().then_some(pose)
}
