//! The grammatical context of a place.

use crate::View;
use crate::view::{token, tokens};
use afp_dsl::index::{DefinitionId, DefinitionKind, Meaning};
use afp_syntax::kind::Kind;
use afp_syntax::source::Span;
use afp_syntax::{Node, Token};

#[derive(Debug)]
pub(super) struct Context {
    /// The whole word; empty if none has begun.
    pub word: Span,
    pub place: Place,
}

/// The owner of an edge, which decides its targets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    Event,
    Computation,
    /// An actor or a sub-plan.
    Other,
}

#[derive(Debug)]
pub(super) enum Place {
    Nothing,
    File,
    /// Toolboxes and files after `use`.
    Uses,
    Plan(Node),
    /// Supervisors and edges of an element.
    Element(Node),
    Supervisor(Node),
    /// Supervisors of the plan, after `on`.
    Watchers(Node),
    /// Edges of reactions to a supervisor of the plan.
    Reactions(Node),
    /// The template of an element or supervisor; after a `.`, one of that toolbox.
    Made(Node, Option<DefinitionId>),
    Times,
    /// Ports of an element or supervisor.
    Ports(Node),
    /// The target of an edge: of an event, of a computation, or of a state.
    Target {
        from: Origin,
    },
    Start,
    Type,
    Output {
        component: Node,
        port: String,
    },
    Value(Wanted),
    Unit(Wanted),
    /// A member, after a `.`.
    Member(Option<DefinitionId>),
    Scenario,
    /// Lines of a scenario relative to one of its moments.
    Moment,
    /// A name in a scenario, after a keyword.
    Path(String),
    /// The reason for the end of a claim's first element.
    Cause(Node),
    /// Entries that a scenario sets before or during the run.
    Set {
        /// Whether the run has started.
        later: bool,
    },
    PlanName,
    /// Parts of a template or device of a toolbox.
    Toolbox(Kind),
    /// After the name of a computation's state.
    Case,
    /// Outputs in the body of a computation's state.
    Assigned(Node),
}

#[derive(Debug)]
pub(super) enum Wanted {
    /// A port of an element or supervisor.
    Port(Node, String),
    Entry(Node),
    /// The entry named by a path of a scenario.
    Named(Node),
    Time,
    Unknown,
}

impl Context {
    pub(super) fn at(view: &View, offset: u32) -> Context {
        let nowhere = view.place(offset);
        let Some(touched) = view.token_at(offset) else {
            return Context { word: nowhere, place: Place::File };
        };
        if is_closed_text(view, &touched, offset) {
            return Context { word: nowhere, place: Place::Nothing };
        }
        let is_word = matches!(touched.kind(), Kind::Name | Kind::Keyword | Kind::Unit);
        let word = match is_word {
            true => Span { end: offset, ..view.token_span(&touched) },
            false => nowhere,
        };
        let place = match view.solid_before(word.start) {
            None => Place::File,
            Some(before) => {
                let gap = view.text().get(before.text_range().end().into()..word.start as usize);
                let same_line = !gap.unwrap_or_default().contains('\n');
                behind(view, &before, &touched, same_line, word.start)
            }
        };
        Context { word, place }
    }
}

/// Whether a byte is inside a comment or a string.
fn is_closed_text(view: &View, touched: &Token, offset: u32) -> bool {
    let span = view.token_span(touched);
    match touched.kind() {
        Kind::Comment | Kind::Doc => !touched.text().ends_with('\n'),
        Kind::BlockComment => offset < span.end,
        Kind::Text => {
            offset < span.end || !touched.text().ends_with('"') || touched.text().len() < 2
        }
        _ => false,
    }
}

fn origin(edge: &Node) -> Origin {
    let computes = |element: &Node| {
        token(element, Kind::Keyword).is_some_and(|keyword| keyword.text() == "computation")
    };
    match edge.parent() {
        Some(owner) if matches!(owner.kind(), Kind::Guard | Kind::Reactions) => Origin::Event,
        Some(owner) if computes(&owner) => Origin::Computation,
        _ => Origin::Other,
    }
}

/// The context after a token; `at` is the start of the new word.
fn behind(view: &View, before: &Token, touched: &Token, same_line: bool, at: u32) -> Place {
    let parent = before.parent();
    let within = |kinds: &[Kind]| ancestor(before, kinds);
    match before.kind() {
        Kind::Dot => member(view, before),
        Kind::Arrow => match within(&[Kind::Edge, Kind::Claim]) {
            Some(node) if node.kind() == Kind::Claim => Place::Path("->".to_owned()),
            Some(edge) => Place::Target { from: origin(&edge) },
            None => container(before, at),
        },
        Kind::FatArrow => match (within(&[Kind::Element, Kind::Guard]), within(&[Kind::BindOut])) {
            (Some(component), Some(bind)) => Place::Output { component, port: first_name(&bind) },
            _ => Place::Nothing,
        },
        Kind::Colon => match within(&[
            Kind::Entry,
            Kind::InPort,
            Kind::OutPort,
            Kind::Amount,
            Kind::Column,
            Kind::Signal,
            Kind::Element,
            Kind::Guard,
            Kind::Stimulus,
        ]) {
            Some(node) if matches!(node.kind(), Kind::Element | Kind::Guard) => {
                Place::Made(node, None)
            }
            Some(node) if node.kind() == Kind::Stimulus => Place::Path(":".to_owned()),
            Some(_) => Place::Type,
            None => Place::Nothing,
        },
        Kind::Int | Kind::Float if touched.kind() == Kind::Unit || same_line => {
            Place::Unit(wanted(before))
        }
        Kind::Keyword if same_line => {
            keyword(before, parent.as_ref()).unwrap_or_else(|| container(before, at))
        }
        Kind::OpenParen | Kind::Comma
            if within(&[Kind::Args]).is_some() && !in_brackets(before) =>
        {
            ports(before)
        }
        Kind::Equal
        | Kind::Plus
        | Kind::Minus
        | Kind::Star
        | Kind::Slash
        | Kind::Percent
        | Kind::OpenParen
        | Kind::EqualEqual
        | Kind::NotEqual
        | Kind::Less
        | Kind::LessEqual
        | Kind::Greater
        | Kind::GreaterEqual => Place::Value(wanted(before)),
        // The rest of the line is not written yet.
        Kind::Name if same_line && before.text() == "on" && within(&[Kind::Edge]).is_some() => {
            within(&[Kind::Element]).map_or(Place::Nothing, Place::Watchers)
        }
        Kind::Name if same_line && parent.as_ref().is_some_and(is_state_of_computation) => {
            Place::Case
        }
        // An item with only a name so far.
        Kind::Name if same_line && parent.as_ref().is_some_and(names_item) => Place::Nothing,
        _ if same_line && is_head(before) => Place::Times,
        _ => container(before, at),
    }
}

/// The context after a keyword on its line.
fn keyword(word: &Token, parent: Option<&Node>) -> Option<Place> {
    let kind = parent?.kind();
    Some(match (word.text(), kind) {
        ("use", _) => Place::Uses,
        ("start", Kind::Start) | ("suspend", Kind::Target) => Place::Start,
        ("on", Kind::Reactions) => {
            ancestor(word, &[Kind::Element]).map_or(Place::Nothing, Place::Watchers)
        }
        ("every" | "deadline" | "budget" | "stop", Kind::Timing) | ("after", Kind::After) => {
            Place::Value(Wanted::Time)
        }
        ("at", Kind::Stimulus) | ("until", _) | ("within" | "before" | "after", Kind::Bound) => {
            Place::Value(Wanted::Time)
        }
        ("when" | "and", Kind::When) => Place::Value(Wanted::Unknown),
        ("for", Kind::Scenario) => Place::PlanName,
        ("for", _) => Place::Value(Wanted::Time),
        ("set", kind) => Place::Set { later: kind == Kind::Action },
        ("by", Kind::Claim) if parent.is_some_and(|claim| token(claim, Kind::Arrow).is_some()) => {
            Place::Cause(parent?.clone())
        }
        ("by", Kind::Claim) if parent.is_some_and(|claim| has_word(claim, "end")) => {
            Place::Path("end by".to_owned())
        }
        ("expect" | "never" | "of" | "by", _) => Place::Path(word.text().to_owned()),
        (_, Kind::Action) => Place::Path(word.text().to_owned()),
        ("from", Kind::Moment) => Place::Path("expect".to_owned()),
        ("from" | "to", Kind::Range) => Place::Value(wanted(word)),
        ("from" | "to" | "heading", _) => Place::Value(Wanted::Unknown),
        // A new name or a string.
        _ => Place::Nothing,
    })
}

/// The context after a name and a `.`.
fn member(view: &View, dot: &Token) -> Place {
    let before = view.solid_before(view.token_span(dot).start);
    let name = before.as_ref().and_then(|name| view.index().name(view.token_span(name)));
    let id = name.and_then(|name| match name.meaning {
        Meaning::Ambiguous(several) => view.index().candidates(several).first().copied(),
        meaning => meaning.definition(),
    });
    let id = id.or_else(|| named(view, before.as_ref()?));
    let definition = id.map(|id| view.index().definition(id));
    let home = match definition {
        Some(alias) if alias.kind == DefinitionKind::Alias => alias.made_from,
        _ => id,
    };
    let reference = dot.parent().filter(|node| node.kind() == Kind::Ref);
    let made = reference.and_then(|reference| reference.parent());
    match made.filter(|node| matches!(node.kind(), Kind::Element | Kind::Guard)) {
        Some(component) => Place::Made(component, home),
        None => Place::Member(home),
    }
}

/// The likely meaning of a name before a `.`; the check reports none while nothing follows the `.`.
fn named(view: &View, name: &Token) -> Option<DefinitionId> {
    use DefinitionKind::{Alias, Component, Device, Enum, Toolbox};

    let index = view.index();
    let aliases = index.definitions_in(view.file).filter(|(_, known)| known.kind == Alias);
    let aliases = aliases.map(|(id, _)| id);
    let has_members = |kind| matches!(kind, Component(_) | Device | Enum);
    let visible = index.visible(view.file, view.token_span(name).start, has_members);
    let toolboxes = index.definitions();
    let toolboxes = toolboxes.filter(|(_, known)| matches!(known.kind, Toolbox | Device));
    let toolboxes = toolboxes.map(|(id, _)| id);
    aliases.chain(visible).chain(toolboxes).find(|id| view.name_of(*id) == name.text())
}

/// The ports of the component whose parentheses contain a token.
fn ports(token: &Token) -> Place {
    match ancestor(token, &[Kind::Element, Kind::Guard, Kind::Action]) {
        Some(node) if node.kind() != Kind::Action => Place::Ports(node),
        _ => Place::Value(Wanted::Unknown),
    }
}

/// Whether a token is inside the parentheses of a formula, not of bindings.
fn in_brackets(token: &Token) -> bool {
    let nearest = ancestor(token, &[Kind::Args, Kind::Brackets]);
    nearest.is_some_and(|node| node.kind() == Kind::Brackets)
}

fn wanted(token: &Token) -> Wanted {
    let Some(node) = ancestor(
        token,
        &[
            Kind::BindIn,
            Kind::Entry,
            Kind::Timing,
            Kind::Set,
            Kind::Action,
            Kind::Claim,
            Kind::Stimulus,
            Kind::Bound,
            Kind::Until,
        ],
    ) else {
        return Wanted::Unknown;
    };
    match node.kind() {
        Kind::BindIn => match ancestor(token, &[Kind::Element, Kind::Guard]) {
            Some(component) => Wanted::Port(component, first_name(&node)),
            None => Wanted::Unknown,
        },
        Kind::Entry => Wanted::Entry(node),
        Kind::Action if !has_word(&node, "set") => Wanted::Time,
        Kind::Set | Kind::Action | Kind::Claim => {
            let path = node.children().find(|child| child.kind() == Kind::Path);
            path.map_or(Wanted::Unknown, Wanted::Named)
        }
        _ => Wanted::Time,
    }
}

fn has_word(node: &Node, word: &str) -> bool {
    tokens(node).any(|token| token.kind() == Kind::Keyword && token.text() == word)
}

fn first_name(node: &Node) -> String {
    token(node, Kind::Name).map(|token| token.text().to_owned()).unwrap_or_default()
}

fn ancestor(token: &Token, kinds: &[Kind]) -> Option<Node> {
    token.parent_ancestors().find(|node| kinds.contains(&node.kind()))
}

fn names_item(node: &Node) -> bool {
    use Kind::{Element, Entry, Enum, Guard, Plan, Reactions, Table, Template, Toolbox, Use};
    matches!(
        node.kind(),
        Element | Entry | Enum | Guard | Plan | Reactions | Table | Template | Toolbox | Use
    )
}

/// Whether a node is a state of a template for computations.
fn is_state_of_computation(node: &Node) -> bool {
    let word = |node: &Node, word| {
        token(node, Kind::Keyword).is_some_and(|keyword| keyword.text() == word)
    };
    let template = node.parent().filter(|parent| parent.kind() == Kind::Template);
    node.kind() == Kind::Outcome
        && word(node, "state")
        && template.is_some_and(|it| word(&it, "computation"))
}

/// Whether a token ends the head of a supervisor without a body.
fn is_head(token: &Token) -> bool {
    let Some(guard) = ancestor(token, &[Kind::Guard]) else { return false };
    let inside = ancestor(token, &[Kind::Ref, Kind::Args, Kind::Timing, Kind::Guard]);
    let open = self::token(&guard, Kind::OpenBrace).map(|brace| brace.text_range().start());
    let ended = inside.is_some_and(|node| {
        node.kind() != Kind::Guard && node.text_range().end() >= token.text_range().end()
    });
    ended && open.is_none_or(|open| open >= token.text_range().end())
}

/// The context in the body of the smallest open item around a place.
fn container(before: &Token, at: u32) -> Place {
    let at = rowan::TextSize::from(at);
    for node in before.parent_ancestors() {
        if !holds(&node, at) {
            continue;
        }
        return match node.kind() {
            Kind::Plan => Place::Plan(node),
            Kind::Element => Place::Element(node),
            Kind::Guard => Place::Supervisor(node),
            Kind::Reactions => Place::Reactions(node),
            Kind::Scenario => Place::Scenario,
            Kind::Moment => Place::Moment,
            Kind::Template | Kind::Device => Place::Toolbox(node.kind()),
            Kind::Outcome => Place::Assigned(node),
            Kind::Args => ports(before),
            Kind::Enum | Kind::Table => Place::Nothing,
            _ => continue,
        };
    }
    Place::File
}

/// Whether a place is between the brackets of a node; the closing one may be missing.
fn holds(node: &Node, at: rowan::TextSize) -> bool {
    let (open, close) = match node.kind() {
        Kind::Args => (Kind::OpenParen, Kind::CloseParen),
        _ => (Kind::OpenBrace, Kind::CloseBrace),
    };
    let begins = token(node, open).is_some_and(|open| open.text_range().end() <= at);
    let ends = tokens(node).filter(|token| token.kind() == close).last();
    begins && ends.is_none_or(|close| close.text_range().start() >= at)
}
