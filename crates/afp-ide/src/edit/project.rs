//! The files of a project and the meaning of their names.

use std::rc::Rc;

use super::buffer::{Splice, TextBuffer};
use super::tree;
use afp_dsl::Toolboxes;
use afp_dsl::files::joined;
use afp_dsl::graph::EntryKind;
use afp_dsl::index::{DefinitionKind, Index, Meaning};
use afp_dsl::index_files;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::kind::Kind;
use afp_syntax::source::{Source, Span};
use afp_syntax::{Node, Token};

/// The paths after `use`, as written.
pub(super) fn paths_of_uses(root: &Node) -> impl Iterator<Item = String> {
    let lines = tree::children(root, Kind::Use);
    let texts = lines.filter_map(|line| tree::tokens(&line, Kind::Text).next());
    texts.map(|text: Token| text.text().trim_matches('"').to_owned())
}

/// The files that a file uses, as normalised paths.
pub fn used_files(file: &Source) -> Vec<String> {
    let root = afp_syntax::parse(&file.text, 0, &mut Diagnostics::default()).root();
    paths_of_uses(&root).map(|written| joined(&file.name, &written)).collect()
}

/// The trees of the files, and the files visible to each.
pub(super) struct Project {
    pub roots: Vec<Node>,
    /// The files whose plans and enums a file sees, itself first.
    pub sees: Vec<Vec<usize>>,
    /// The meaning of their names.
    index: Index,
    /// The toolboxes, whose files stand before them in the index.
    toolboxes: Rc<Toolboxes>,
}

impl Project {
    pub fn alone(buffer: &TextBuffer) -> Project {
        let source = Source::new("", buffer.text());
        let toolboxes = buffer.toolboxes.clone();
        Project::new(vec![vec![0]], vec![buffer.root()], vec![source], toolboxes)
    }

    pub(super) fn new(
        sees: Vec<Vec<usize>>,
        roots: Vec<Node>,
        sources: Vec<Source>,
        toolboxes: Rc<Toolboxes>,
    ) -> Project {
        Project { sees, roots, index: index_files(&sources, &toolboxes), toolboxes }
    }

    fn span(&self, file: usize, token: &Token) -> Option<Span> {
        let range = token.text_range();
        let (start, end) = (range.start().into(), range.end().into());
        Some(Span { file: u16::try_from(self.toolboxes.sources().len() + file).ok()?, start, end })
    }

    /// The tokens that refer to a declared name, with their files.
    pub fn references(&self, file: usize, name: &Token) -> Vec<(usize, Token)> {
        let declared = self.span(file, name).and_then(|span| self.index.declared_at(span));
        let spans = declared.into_iter().flat_map(|id| self.index.references(id));
        // An arrow also refers to the state of its edge, but holds no name.
        let tokens = spans.filter_map(|span| self.token(span));
        tokens.filter(|(_, token)| token.kind() != Kind::Arrow).collect()
    }

    pub fn declaration(&self, file: usize, token: &Token) -> Option<(usize, Token)> {
        let meaning = self.index.name(self.span(file, token)?)?.meaning;
        self.token(self.index.definition(meaning.definition()?).name)
    }

    /// The name that a token of the first file refers to. A toolbox may declare it.
    pub fn declared_name(&self, token: &Token) -> Option<String> {
        let meaning = self.index.name(self.span(0, token)?)?.meaning;
        let span = self.index.definition(meaning.definition()?).name;
        match self.toolboxes.sources().text(span) {
            "" => self.token(span).map(|(_, token)| token.text().to_owned()),
            name => Some(name.to_owned()),
        }
    }

    pub fn item(&self, file: usize, token: &Token) -> Option<(usize, Node)> {
        let (file, name) = self.declaration(file, token)?;
        Some((file, name.parent()?))
    }

    pub fn entry(&self, file: usize, token: &Token) -> Option<String> {
        let (_, node) = self.item(file, token)?;
        tree::name_of(&node).filter(|_| node.kind() == Kind::Entry)
    }

    pub fn is_output(&self, file: usize, bind: &Node) -> bool {
        match bind.kind() {
            Kind::BindOut => true,
            Kind::BindSame => tree::name_token(bind).is_some_and(|name| self.is_out(file, &name)),
            _ => false,
        }
    }

    /// Whether a binding that is only a name is an output.
    fn is_out(&self, file: usize, name: &Token) -> bool {
        let meant = self.span(file, name).and_then(|span| self.index.name(span));
        let Some(Meaning::Both { port, .. }) = meant.map(|name| name.meaning) else { return false };
        matches!(
            self.index.definition(port).kind,
            DefinitionKind::Output | DefinitionKind::Column | DefinitionKind::Entry(EntryKind::Out)
        )
    }

    /// A short binding in full, with another entry.
    pub fn spelled_out(&self, file: usize, bind: &Node, entry: &str) -> Option<Splice> {
        let name = tree::name_token(bind)?;
        let sign = if self.is_output(file, bind) { "=>" } else { "=" };
        Some((tree::range(&name), format!("{} {sign} {entry}", name.text())))
    }

    fn token(&self, span: Span) -> Option<(usize, Token)> {
        let file = usize::from(span.file).checked_sub(self.toolboxes.sources().len())?;
        let found = self.roots.get(file)?.token_at_offset(rowan::TextSize::from(span.start));
        Some((file, found.right_biased()?))
    }

    /// The declaration of a name of some kind in a file, with its file.
    pub fn find(&self, file: usize, kind: Kind, name: &str) -> Option<(usize, Node)> {
        self.sees[file].iter().find_map(|seen| {
            let mut nodes = tree::children(&self.roots[*seen], kind);
            Some((*seen, nodes.find(|node| tree::is_named(node, name))?))
        })
    }
}
