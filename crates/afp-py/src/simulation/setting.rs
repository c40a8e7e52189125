//! What a run begins with, and what its log says of that.

use std::path::Path;

use afp_dsl::Compiled;
use afp_dsl::graph::Graph;
use afp_log::About;
use afp_run::world::LoadedWorld;
use afp_session::{Build, Recipe, TextFile};

/// What a run begins with.
pub struct Setting<'a> {
    pub graph: &'a Graph,
    pub world: &'a LoadedWorld,
    pub seed: u64,
    pub file: &'a Path,
    /// Path and text of the plan's file and of those that it uses.
    pub texts: Vec<(String, String)>,
    /// Names and texts of the toolboxes that it uses beyond the built-in ones, those of Python, too.
    pub toolboxes: Vec<(String, String)>,
    pub log: Option<&'a Path>,
    /// Whether the log gets what the camera sees.
    pub camera: bool,
}

impl Setting<'_> {
    /// What the log says of the run.
    pub fn about(&self) -> About {
        let LoadedWorld { world, text, start, .. } = self.world;
        let mut about = About::new(&Recipe {
            plan: self.graph.main().name.clone(),
            file: self.file.display().to_string(),
            texts: text_files(&self.texts),
            toolboxes: text_files(&self.toolboxes),
            robot: "sim".to_owned(),
            world: text_file(world.name(), text),
            start: *start,
            seed: self.seed,
            build: Build::this(),
            ..Recipe::default()
        });
        about.facts.push(("clock".to_owned(), "virtual".to_owned()));
        about
    }
}

/// Names and texts of the toolboxes of a plan beyond the built-in ones: of Python, or of its project.
pub fn own_toolboxes(compiled: &Compiled) -> Vec<(String, String)> {
    let built_in = |(_, text): &(&str, &str)| afp_toolboxes::ALL.iter().any(|it| it.text == *text);
    let own = compiled.toolbox_texts().filter(|it| !built_in(it));
    own.map(|(name, text)| (name.to_owned(), text.to_owned())).collect()
}

fn text_files(files: &[(String, String)]) -> Vec<TextFile> {
    files.iter().map(|(name, text)| text_file(name, text)).collect()
}

fn text_file(name: &str, text: &str) -> TextFile {
    TextFile { name: name.to_owned(), text: text.to_owned() }
}
