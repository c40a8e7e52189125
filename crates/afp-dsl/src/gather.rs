//! Collects the files of a compilation: toolboxes, the main plan file, and directly or indirectly
//! used files.
//!
//! Each file is read once. Files may use each other in a circle; only recursive plans are invalid.

mod toolboxes;

use std::sync::Arc;

use crate::files::{Files, joined, normalised};
use afp_syntax::ast::{File, Item, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use afp_syntax::message;
use afp_syntax::source::{Source, Sources, Span};
use afp_syntax::unquote;
use afp_syntax::{Parse, parse};
use rustc_hash::FxHashMap;

pub(crate) use toolboxes::ToolboxFile;
pub use toolboxes::Toolboxes;

pub(crate) struct PlanFile {
    /// Its normalised path.
    pub path: String,
    /// Further paths by which it is used.
    pub further: Vec<String>,
    pub source: Arc<Source>,
    pub parse: Parse,
    pub tree: File,
    /// Its index among the sources.
    pub index: u16,
    /// The used files as indices of gathered files, in source order.
    pub uses: Vec<usize>,
    /// The paths after `use` that lead to files, with their indices.
    pub paths: Vec<(Span, usize)>,
    /// Whether a used file is missing.
    pub incomplete: bool,
}

impl PlanFile {
    /// Whether one of its paths leaves the base folder.
    pub fn leads_out(&self) -> bool {
        let mut paths = self.further.iter().chain([&self.path]);
        paths.any(|path| path.starts_with("../"))
    }

    /// The span of the whole text.
    pub fn whole(&self) -> Span {
        let end = u32::try_from(self.source.text.len()).unwrap_or(u32::MAX);
        Span { file: self.index, start: 0, end }
    }
}

/// Collects the files, the main one first, then as found; their texts are added to `sources`.
pub(crate) fn gather(
    source: &Source,
    files: &dyn Files,
    toolboxes: &Toolboxes,
    sources: &mut Sources,
    diags: &mut Diagnostics,
) -> Vec<PlanFile> {
    let mut gathering = Gathering::new(files, toolboxes, sources, diags);
    gathering.first(source);
    let mut next = 0;
    while next < gathering.found.len() {
        gathering.follow(next);
        next += 1;
    }
    gathering.found
}

/// Collects a complete set of files: used files are among them or missing.
pub(crate) fn gather_all(
    files: &[Source],
    toolboxes: &Toolboxes,
    sources: &mut Sources,
    diags: &mut Diagnostics,
) -> Vec<PlanFile> {
    let none = |_: &str| Err("it is not among the files".to_owned());
    let mut gathering = Gathering::new(&none, toolboxes, sources, diags);
    files.iter().for_each(|source| gathering.first(source));
    for file in 0..gathering.found.len() {
        gathering.follow(file);
    }
    gathering.found
}

struct Gathering<'a> {
    files: &'a dyn Files,
    toolboxes: &'a Toolboxes,
    sources: &'a mut Sources,
    diags: &'a mut Diagnostics,
    found: Vec<PlanFile>,
    /// The result of each path: an index in `found`, or an error.
    known: FxHashMap<String, Result<usize, Unusable>>,
    /// Files in `found` by identity; empty before the first `use`.
    identities: FxHashMap<String, usize>,
}

#[derive(Clone)]
enum Unusable {
    Unread(String),
    /// It is a toolbox with that name.
    Toolbox(String),
}

impl<'a> Gathering<'a> {
    fn new(
        files: &'a dyn Files,
        toolboxes: &'a Toolboxes,
        sources: &'a mut Sources,
        diags: &'a mut Diagnostics,
    ) -> Gathering<'a> {
        let (known, identities) = (FxHashMap::default(), FxHashMap::default());
        Gathering { files, toolboxes, sources, diags, found: Vec::new(), known, identities }
    }

    fn first(&mut self, source: &Source) {
        let source = Arc::new(source.clone());
        // With more than 65,536 files spans would be ambiguous, so there are no diagnostics.
        let index = self.sources.add(source.clone()).unwrap_or(u16::MAX);
        let tree = parse(&source.text, index, self.diags);
        self.add(normalised(&source.name), source, index, tree);
    }

    fn add(&mut self, path: String, source: Arc<Source>, index: u16, parse: Parse) -> usize {
        let place = self.found.len();
        self.known.entry(path.clone()).or_insert(Ok(place));
        let (tree, uses, paths) = (parse.file(), Vec::new(), Vec::new());
        let (further, incomplete) = (Vec::new(), false);
        let file = PlanFile { path, further, source, parse, tree, index, uses, paths, incomplete };
        self.found.push(file);
        place
    }

    /// Finds the files that a gathered file uses.
    fn follow(&mut self, user: usize) {
        let mut lines: Vec<(usize, Span)> = Vec::new();
        for item in self.found[user].tree.items() {
            let Item::Use(line) = item else { continue };
            let Some(written) = line.path() else { continue };
            let Some(used) = self.used(user, &written) else {
                self.found[user].incomplete = true;
                continue;
            };
            self.found[user].paths.push((written.span, used));
            if let Some((_, first)) = lines.iter().find(|(known, _)| *known == used) {
                let message = message!("{} is used twice", Words(written.text.replace('"', "'")));
                self.diags.push(
                    Diagnostic::new(Code::E0212, line.span(), message)
                        .note(*first, "first used here")
                        .help("remove one of the lines"),
                );
                continue;
            }
            lines.push((used, line.span()));
            self.found[user].uses.push(used);
        }
    }

    /// The file of a `use`; reports an unusable one.
    fn used(&mut self, user: usize, written: &Name) -> Option<usize> {
        let mut wrong = Diagnostics::default();
        // A path has no escapes: a backslash separates folders.
        let text = match written.text.trim_matches('"') {
            path if path.contains('\\') => path.replace("\\\\", "\\"),
            _ => unquote(written, &mut wrong),
        };
        if wrong.is_empty()
            && let Some(error) = path_error(&text, written.span)
        {
            wrong.push(match self.toolboxes.get(&text) {
                Some(_) => {
                    Diagnostic::new(error.code, error.span, "write only the name of a toolbox")
                        .help(message!("write 'use {}'", text))
                        .replace(text.clone())
                }
                None => error,
            });
        }
        if !wrong.is_empty() {
            self.diags.extend(wrong);
            return None;
        }
        let path = joined(&self.found[user].source.name, &text);
        let known = match self.known.get(&path) {
            Some(known) => known.clone(),
            None => {
                let found = self.find(&path);
                if let Ok(place) = found
                    && self.found[place].path != path
                {
                    self.found[place].further.push(path.clone());
                }
                self.known.insert(path.clone(), found.clone());
                found
            }
        };
        if path == self.found[user].path || known.as_ref().is_ok_and(|used| *used == user) {
            self.diags.push(
                Diagnostic::new(Code::E0507, written.span, "the file uses itself")
                    .help("remove the line; plans of one file see each other"),
            );
            return None;
        }
        known.map_err(|why| self.diags.push(self.unusable(&why, &path, written.span))).ok()
    }

    /// The file of a new path: one already read by another path, or a new one.
    fn find(&mut self, path: &str) -> Result<usize, Unusable> {
        if self.identities.is_empty() {
            let identity =
                |(place, file): (usize, &PlanFile)| (self.files.identity(&file.path), place);
            self.identities = self.found.iter().enumerate().map(identity).collect();
        }
        let identity = self.files.identity(path);
        if let Some(place) = self.identities.get(&identity) {
            return Ok(*place);
        }
        let place = self.read(path)?;
        self.identities.insert(identity, place);
        Ok(place)
    }

    fn read(&mut self, path: &str) -> Result<usize, Unusable> {
        let text = self.files.read(path).map_err(Unusable::Unread)?;
        let source = Arc::new(Source::new(path, text));
        let mut diags = Diagnostics::default();
        let next = u16::try_from(self.sources.len()).unwrap_or(u16::MAX);
        let tree = parse(&source.text, next, &mut diags);
        let heads = tree.file().items().into_iter().filter_map(|item| match item {
            Item::Toolbox(head) => Some(head),
            _ => None,
        });
        if let Some(head) = heads.into_iter().next() {
            let name = head.name().map(|name| name.text).unwrap_or_default();
            return Err(Unusable::Toolbox(name));
        }
        let too_many = || Unusable::Unread("there are too many files".to_owned());
        let index = self.sources.add(source.clone()).ok_or_else(too_many)?;
        self.diags.extend(diags);
        Ok(self.add(path.to_owned(), source, index, tree))
    }

    fn unusable(&self, why: &Unusable, path: &str, span: Span) -> Diagnostic {
        match why {
            Unusable::Unread(reason) => Diagnostic::new(
                Code::E0506,
                span,
                message!("cannot read '{}': {}", path, Words(reason)),
            )
            .help("write the path of a plan file, relative to this file's folder"),
            Unusable::Toolbox(name) => {
                let message =
                    message!("'{}' is the toolbox '{}', which is used by its name", path, name);
                let error = Diagnostic::new(Code::E0508, span, message);
                if self.toolboxes.get(name).is_some() {
                    return error.help(message!("write 'use {}'", name)).replace(name);
                }
                error.help(message!("write 'use {}', and list it in afp.toml: '[toolboxes] {} = {{ path = \"...\", crate = \"...\" }}'", name, name))
            }
        }
    }
}

/// Reports an invalid path.
fn path_error(path: &str, span: Span) -> Option<Diagnostic> {
    let refused = |message: Message| Diagnostic::new(Code::E0507, span, message);
    let quoted = |path: &str| format!("\"{path}\"");
    if path.trim().is_empty() {
        let error = refused("the path is empty".into());
        return Some(error.help("write the path of a plan file, such as \"avoid.afp\""));
    }
    if path.starts_with(['/', '\\']) || path.get(1..2) == Some(":") {
        let help = "write the path relative to this file's folder";
        return Some(refused(message!("'{}' is an absolute path", path)).help(help));
    }
    if path.contains('\\') {
        let right = quoted(&path.replace('\\', "/"));
        let error = refused("separate the parts of a path by '/'".into());
        return Some(error.help(message!("write {}", Words(&right))).replace(right));
    }
    let name = path.rsplit('/').next().unwrap_or(path);
    if name.ends_with(".afp") && name != ".afp" {
        return None;
    }
    let error = refused(message!("'{}' does not end in '.afp'", path));
    if name.contains('.') || name.is_empty() {
        return Some(error.help("write the path of a plan file"));
    }
    let right = quoted(&format!("{path}.afp"));
    Some(error.help(message!("write {}", Words(&right))).replace(right))
}
