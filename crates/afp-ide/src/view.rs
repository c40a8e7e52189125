//! The subject of queries: one file of a compilation, a plan file or a toolbox.

use std::cell::OnceCell;
use std::sync::Arc;

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::index::{Definition, DefinitionId, DefinitionKind, Index, Name};
use afp_dsl::outline::{Component, Outline, Plan};
use afp_dsl::toolbox::{Template, Toolbox};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::kind::Kind;
use afp_syntax::source::Span;
use afp_syntax::{Node, Parse, Token, parse};

/// A file of a compilation, with its tree.
#[derive(Clone, Debug)]
pub struct View<'a> {
    /// The compilation of the file and everything that it uses.
    pub compiled: &'a Compiled,
    /// The toolboxes that the compilation could use.
    pub toolboxes: &'a Toolboxes,
    /// The file, as in [`Span::file`].
    pub file: u16,
    /// Computed on demand.
    root: OnceCell<Node>,
}

impl<'a> View<'a> {
    /// A view of a file of a compilation; a missing one is empty.
    pub fn new(compiled: &'a Compiled, toolboxes: &'a Toolboxes, file: u16) -> View<'a> {
        View { compiled, toolboxes, file, root: OnceCell::new() }
    }

    pub fn text(&self) -> &'a str {
        self.compiled.sources.get(self.file).map_or("", |source| &source.text)
    }

    /// Whether it is a plan file; otherwise it is a toolbox.
    pub fn is_plan_file(&self) -> bool {
        self.compiled.plan_files.contains(&usize::from(self.file))
    }

    pub(crate) fn index(&self) -> &'a Index {
        &self.compiled.index
    }

    pub(crate) fn outline(&self) -> &'a Outline {
        &self.compiled.outline
    }

    pub(crate) fn root(&self) -> &Node {
        let parsed = || parse(self.text(), self.file, &mut Diagnostics::default()).root();
        self.root.get_or_init(|| self.compiled.tree(self.file).map_or_else(parsed, Parse::root))
    }

    /// The text of a place of any file.
    pub(crate) fn text_of(&self, span: Span) -> &'a str {
        self.compiled.sources.text(span)
    }

    pub(crate) fn name_of(&self, id: DefinitionId) -> &'a str {
        self.text_of(self.index().definition(id).name)
    }

    /// The name at a byte of the file.
    pub(crate) fn name_at(&self, offset: u32) -> Option<Name> {
        self.index().at(self.file, offset)
    }

    /// The meaning of the last name of a path.
    pub(crate) fn named_by(&self, path: &Node) -> Option<DefinitionId> {
        let name = tokens(path).filter(|token| token.kind() == Kind::Name).last()?;
        self.index().name(self.token_span(&name))?.meaning.definition()
    }

    /// The empty span at a byte offset.
    pub(crate) fn place(&self, offset: u32) -> Span {
        Span { file: self.file, start: offset, end: offset }
    }

    pub(crate) fn token_span(&self, token: &Token) -> Span {
        afp_syntax::token_span(token, self.file)
    }

    /// The span of a node of the file, without comments around it.
    pub(crate) fn node_span(&self, node: &Node) -> Span {
        afp_syntax::node_span(node, self.file)
    }

    /// The plan that covers a byte.
    pub(crate) fn plan_at(&self, offset: u32) -> Option<&'a Plan> {
        let place = self.place(offset);
        self.outline().plans.iter().find(|plan| plan.span.contains(place))
    }

    pub(crate) fn plans(&self) -> impl Iterator<Item = &'a Plan> {
        let file = self.file;
        self.outline().plans.iter().filter(move |plan| plan.file() == file)
    }

    pub(crate) fn component(&self, node: &Node) -> Option<&'a Component> {
        let span = self.node_span(node);
        let plan = self.plan_at(span.start)?;
        plan.components().find(|component| component.span == span)
    }

    pub(crate) fn plan(&self, node: &Node) -> Option<&'a Plan> {
        let span = self.node_span(node);
        self.plans().find(|plan| plan.span == span)
    }

    /// All toolboxes, and the computations that plan files declare for the file.
    pub(crate) fn all_toolboxes(&self) -> impl Iterator<Item = &'a Arc<Toolbox>> {
        let file = self.outline().files.iter().find(|file| file.file == self.file);
        self.toolboxes.iter().chain(file.into_iter().flat_map(|file| &file.computations))
    }

    pub(crate) fn template(
        &self,
        definition: &Definition,
    ) -> Option<(&'a Arc<Toolbox>, &'a Template)> {
        self.all_toolboxes().find_map(|toolbox| {
            let found = toolbox.templates.iter().find(|known| known.span == definition.name)?;
            Some((toolbox, found))
        })
    }

    /// The ports of a kind that a template declares.
    pub(crate) fn ports(
        &self,
        template: &Node,
        kind: DefinitionKind,
    ) -> impl Iterator<Item = (DefinitionId, &'a Definition)> {
        let name = token(template, Kind::Name).map(|name| self.token_span(&name));
        let id = name.and_then(|span| self.index().declared_at(span));
        let members = id.into_iter().flat_map(|id| self.index().members(id));
        members.filter(move |(_, member)| member.kind == kind)
    }

    /// The last solid token that ends at or before a byte.
    pub(crate) fn solid_before(&self, offset: u32) -> Option<Token> {
        let mut all = std::iter::successors(self.token_at(offset), Token::prev_token);
        all.find(|it| !it.kind().is_trivia() && u32::from(it.text_range().end()) <= offset)
    }

    /// The token that contains or ends at a byte offset.
    pub(crate) fn token_at(&self, offset: u32) -> Option<Token> {
        let at = rowan::TextSize::from(offset.min(u32::from(self.root().text_range().end())));
        self.root().token_at_offset(at).left_biased()
    }
}

/// The tokens among the children of a node.
pub(crate) fn tokens(node: &Node) -> impl Iterator<Item = Token> {
    node.children_with_tokens().filter_map(|each| each.into_token())
}

/// The first token of a kind among the children of a node.
pub(crate) fn token(node: &Node, kind: Kind) -> Option<Token> {
    tokens(node).find(|token| token.kind() == kind)
}
