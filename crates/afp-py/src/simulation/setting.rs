//! The inputs of a run, and their description in its log.

use std::path::Path;

use afp_dsl::Compiled;
use afp_dsl::graph::Graph;
use afp_log::About;
use afp_run::world::LoadedWorld;
use afp_run::{RunError, check_apart, hashes};
use afp_session::{Build, Recipe, TextFile};
use afp_syntax::source::Source;
use afp_toolboxes::project::own_toolbox_texts;

/// The inputs of a run.
pub struct Setting<'a> {
    pub compiled: &'a Compiled,
    pub graph: &'a Graph,
    pub world: &'a LoadedWorld,
    pub seed: u64,
    /// Values set before the start, with their units.
    pub settings: &'a [(String, String)],
    pub file: &'a Path,
    /// The file of the world, even if the world was changed later.
    pub world_file: Option<&'a Path>,
    pub log: Option<&'a Path>,
    /// Whether the log contains the camera's pictures.
    pub camera: bool,
}

impl Setting<'_> {
    /// Rejects a log that would overwrite an input.
    ///
    /// # Errors
    /// The log is the plan's file, the world's, or one that the plan uses.
    pub fn check_log(&self, log: &Path) -> Result<(), RunError> {
        let read = read_of(self.compiled).chain([self.file]).chain(self.world_file);
        check_apart([log], read)
    }

    /// The log's description of the run.
    pub fn about(&self) -> About {
        let LoadedWorld { world, text, start, .. } = self.world;
        let recipe = Recipe {
            plan: self.graph.main().name.clone(),
            file: self.file.display().to_string(),
            texts: text_files(self.compiled.plan_texts()),
            toolboxes: text_files(own_toolbox_texts(self.compiled, self.graph)),
            robot: Recipe::SIMULATED.to_owned(),
            world: text_file(world.name(), text),
            start: *start,
            seed: self.seed,
            settings: self.settings.to_vec(),
            build: Build::this(),
            ..Recipe::default()
        };
        let mut about = About::new(&recipe);
        about.facts.extend(hashes(&recipe).map(|(key, hash)| (key.to_owned(), hash)));
        about.facts.push(("clock".to_owned(), "virtual".to_owned()));
        about
    }
}

/// The files of a plan's compilation.
pub fn read_of(compiled: &Compiled) -> impl Iterator<Item = &Path> {
    let built_in = |source: &Source| afp_toolboxes::ALL.iter().any(|it| it.text == source.text);
    let files = compiled.sources.iter().filter(move |source| !built_in(source));
    files.map(|source| Path::new(&source.name))
}

fn text_files(
    files: impl IntoIterator<Item = (impl Into<String>, impl Into<String>)>,
) -> Vec<TextFile> {
    let file = |(name, text): (_, _)| text_file(name, text);
    files.into_iter().map(file).collect()
}

fn text_file(name: impl Into<String>, text: impl Into<String>) -> TextFile {
    TextFile { name: name.into(), text: text.into() }
}
