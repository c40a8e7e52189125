//! From the tree to lines, in one walk.
//!
//! Comments are collected until the next token is printed, because only that token determines the
//! end of a line. A comment in the middle of an item breaks the line there.

use super::align::{Columns, Line};
use super::spacing;
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

/// The space before the next token.
#[derive(Clone, Copy, Debug)]
enum Gap {
    /// Nothing.
    Glue,
    Blank,
    /// A new line; `closes` if it closes a body, `apart` if a blank line belongs before it.
    Line {
        columns: Columns,
        closes: bool,
        apart: bool,
    },
}

/// A comment that is not yet printed.
struct Comment {
    text: String,
    /// The number of line breaks before it.
    breaks: usize,
    help: bool,
}

/// The lines so far, and the state for the next one.
#[derive(Default)]
pub(super) struct Printer {
    lines: Vec<Line>,
    indent: usize,
    /// The gap from the parent of the next token.
    gap: Option<Gap>,
    /// Whether a new cell begins with the next token.
    cell: bool,
    comments: Vec<Comment>,
    /// Line breaks since the last comment or token.
    breaks: usize,
    before: Option<Token>,
    /// Whether the current body is still empty, so that no blank line belongs here.
    fresh: bool,
}

/// The brackets of a node and the form of its contents.
struct Body {
    open: Kind,
    close: Kind,
    broken: bool,
    items: usize,
    /// The separator after each item.
    comma: Comma,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Comma {
    Never,
    Between,
    Always,
}

impl Printer {
    /// The lines of a file.
    pub fn print(mut self, root: &Node) -> Vec<Line> {
        self.fresh = true;
        let mut after_large = false;
        for element in root.children_with_tokens() {
            match element {
                rowan::NodeOrToken::Token(token) => self.trivia(&token),
                rowan::NodeOrToken::Node(node) => {
                    let large = is_large(&node);
                    let apart = large || after_large;
                    self.gap = Some(Gap::Line { columns: Columns::None, closes: false, apart });
                    after_large = large;
                    self.node(&node);
                }
            }
        }
        self.comments_before(true, false);
        self.lines
    }

    fn node(&mut self, node: &Node) {
        let body = Body::of(node);
        let mut inside = false;
        let mut printed = 0;
        let mut last = None;
        for element in node.children_with_tokens() {
            match (element, &body) {
                (rowan::NodeOrToken::Token(token), _) if token.kind().is_trivia() => {
                    self.trivia(&token);
                }
                (rowan::NodeOrToken::Token(token), _) if is_list_comma(&token) => {}
                (rowan::NodeOrToken::Token(token), Some(body)) if token.kind() == body.open => {
                    self.token(&token);
                    self.open(body);
                    inside = true;
                }
                (rowan::NodeOrToken::Token(token), Some(body)) if token.kind() == body.close => {
                    self.close(body, &token);
                    inside = false;
                }
                (rowan::NodeOrToken::Token(token), _) => {
                    self.cell |= begins_cell(node, &token, self.before.as_ref());
                    self.token(&token);
                }
                (rowan::NodeOrToken::Node(child), Some(body)) if inside => {
                    self.gap = Some(self.before_item(body, last, &child));
                    self.cell |= child.kind() == Kind::Cell && last.is_some();
                    last = Some(child.kind());
                    self.node(&child);
                    printed += 1;
                    if body.comma.follows(printed, body.items) {
                        self.append(",");
                    }
                }
                (rowan::NodeOrToken::Node(child), _) => {
                    self.cell |= matches!(child.kind(), Kind::Type | Kind::Action);
                    self.node(&child);
                }
            }
        }
    }

    fn open(&mut self, body: &Body) {
        if body.broken {
            self.indent += 1;
            self.fresh = true;
        }
    }

    fn close(&mut self, body: &Body, token: &Token) {
        self.gap = Some(if body.broken {
            self.indent -= 1;
            Gap::Line { columns: Columns::None, closes: true, apart: false }
        } else if body.items > 0 && body.close == Kind::CloseBrace {
            Gap::Blank
        } else {
            Gap::Glue
        });
        self.token(token);
    }

    fn before_item(&self, body: &Body, last: Option<Kind>, item: &Node) -> Gap {
        if !body.broken {
            let first = last.is_none() && body.open == Kind::OpenParen;
            return if first { Gap::Glue } else { Gap::Blank };
        }
        let pairs = matches!(item.kind(), Kind::Timing | Kind::Uses) && last == Some(item.kind());
        if pairs && self.breaks == 0 && self.comments.is_empty() && !begins_line(item) {
            return Gap::Blank;
        }
        Gap::Line { columns: columns(item), closes: false, apart: false }
    }

    fn trivia(&mut self, token: &Token) {
        if token.kind() == Kind::Whitespace {
            self.breaks += token.text().matches('\n').count();
            return;
        }
        self.comments.push(Comment {
            text: token.text().trim_end().to_owned(),
            breaks: std::mem::take(&mut self.breaks),
            help: token.kind() == Kind::Doc,
        });
    }

    /// Prints the comments before the next token; returns whether there were any.
    fn comments_before(&mut self, at_line: bool, closes: bool) -> bool {
        let comments = std::mem::take(&mut self.comments);
        let any = !comments.is_empty();
        let indent = match self.lines.last() {
            Some(line) if !at_line => line.indent + 2,
            _ => self.indent + usize::from(closes),
        };
        for (index, comment) in comments.into_iter().enumerate() {
            let beside = index == 0 && comment.breaks == 0 && !comment.help;
            match self.lines.last_mut() {
                Some(line) if beside => line.comment = Some(comment.text),
                _ => {
                    let blank = comment.breaks > 1 && !self.fresh;
                    self.push(Line {
                        indent,
                        blank,
                        columns: Columns::Comment,
                        cells: vec![comment.text],
                        comment: None,
                    });
                }
            }
        }
        any
    }

    fn push(&mut self, line: Line) {
        self.lines.push(line);
        self.fresh = false;
    }

    fn token(&mut self, token: &Token) {
        let gap = self.gap.take().unwrap_or_else(|| match &self.before {
            Some(before) if !spacing::is_apart(before, token) => Gap::Glue,
            _ => Gap::Blank,
        });
        let cell = std::mem::take(&mut self.cell);
        match gap {
            Gap::Line { columns, closes, apart } => self.line(token, columns, closes, apart),
            Gap::Glue | Gap::Blank if !self.comments.is_empty() => self.continuation(token),
            Gap::Glue => self.append(token.text()),
            Gap::Blank => {
                let columns = self.lines.last().is_some_and(|line| line.columns != Columns::None);
                match self.lines.last_mut() {
                    Some(line) if cell && columns => line.cells.push(token.text().to_owned()),
                    _ => self.append(&format!(" {}", token.text())),
                }
            }
        }
        self.breaks = 0;
        self.before = Some(token.clone());
    }

    /// Begins a line in the structure's form.
    fn line(&mut self, token: &Token, columns: Columns, closes: bool, apart: bool) {
        let at = self.lines.len();
        let fresh = self.fresh;
        self.comments_before(true, closes);
        let blank = self.breaks > 1 && !self.fresh && !closes;
        let cells = vec![token.text().to_owned()];
        self.push(Line { indent: self.indent, blank, columns, cells, comment: None });
        if let Some(line) = self.lines.get_mut(at).filter(|_| apart && !fresh) {
            line.blank = true;
        }
    }

    /// Continues an item after a comment in its middle.
    fn continuation(&mut self, token: &Token) {
        if let Some(line) = self.lines.last_mut() {
            line.columns = Columns::None;
        }
        let indent = self.lines.last().map_or(0, |line| line.indent + 2);
        let at = self.lines.len();
        self.comments_before(false, false);
        for line in &mut self.lines[at..] {
            line.blank = false;
        }
        let (columns, cells) = (Columns::None, vec![token.text().to_owned()]);
        self.push(Line { indent, blank: false, columns, cells, comment: None });
    }

    fn append(&mut self, text: &str) {
        if let Some(cell) = self.lines.last_mut().and_then(|line| line.cells.last_mut()) {
            cell.push_str(text);
        }
    }
}

impl Body {
    fn of(node: &Node) -> Option<Body> {
        let (open, close) = match node.kind() {
            Kind::Args | Kind::Columns | Kind::Row => (Kind::OpenParen, Kind::CloseParen),
            Kind::Plan
            | Kind::Scenario
            | Kind::Moment
            | Kind::Template
            | Kind::Outcome
            | Kind::Element
            | Kind::Guard
            | Kind::Reactions
            | Kind::Device
            | Kind::Enum
            | Kind::Table => (Kind::OpenBrace, Kind::CloseBrace),
            _ => return None,
        };
        let opening = node.children_with_tokens().find(|each| each.kind() == open)?.into_token()?;
        let from = opening.text_range().end();
        let inner = || {
            let closing = node.children_with_tokens().filter(|each| each.kind() == close).last();
            let to = closing.map_or(node.text_range().end(), |each| each.text_range().start());
            let tokens = node.descendants_with_tokens().filter_map(|each| each.into_token());
            tokens.filter(move |token| {
                token.text_range().start() >= from && token.text_range().end() <= to
            })
        };
        let items = node.children().filter(|child| child.text_range().start() >= from).count();
        let commented = inner().any(|each| is_comment(each.kind()));
        let wide = matches!(node.kind(), Kind::Plan | Kind::Scenario | Kind::Template)
            || node.children().any(|child| matches!(child.kind(), Kind::Guard | Kind::Reactions));
        let broken = commented || (items > 0 && (wide || inner().any(|t| t.text().contains('\n'))));
        let comma = match node.kind() {
            Kind::Args | Kind::Columns | Kind::Row if broken => Comma::Always,
            Kind::Enum | Kind::Table => Comma::Never,
            _ if broken => Comma::Never,
            _ => Comma::Between,
        };
        Some(Body { open, close, broken, items, comma })
    }
}

impl Comma {
    fn follows(self, printed: usize, items: usize) -> bool {
        self == Comma::Always || (self == Comma::Between && printed < items)
    }
}

fn is_comment(kind: Kind) -> bool {
    kind.is_trivia() && kind != Kind::Whitespace
}

/// Whether blank lines separate an item of a file.
fn is_large(node: &Node) -> bool {
    match node.kind() {
        Kind::Plan | Kind::Scenario | Kind::Template | Kind::Toolbox => true,
        Kind::Device | Kind::Table => Body::of(node).is_some_and(|body| body.broken),
        _ => false,
    }
}

fn columns(item: &Node) -> Columns {
    let first = item.children_with_tokens().find(|each| each.kind() == Kind::Keyword);
    let is_const = first.is_some_and(|each| each.into_token().is_some_and(|t| t.text() == "const"));
    match item.kind() {
        Kind::Entry if is_const => Columns::None,
        Kind::Entry | Kind::InPort | Kind::OutPort | Kind::Signal => Columns::Entry,
        Kind::Edge => Columns::Edge,
        Kind::Stimulus => Columns::Stimulus,
        Kind::Row => Columns::Row,
        _ => Columns::None,
    }
}

fn begins_cell(node: &Node, token: &Token, before: Option<&Token>) -> bool {
    match node.kind() {
        // The token after the keyword.
        Kind::Entry | Kind::InPort | Kind::OutPort | Kind::Signal => before.is_some_and(|before| {
            before.kind() == Kind::Keyword
                && before.parent().as_ref() == Some(node)
                && before.text() != "live"
        }),
        Kind::Edge => token.kind() == Kind::Arrow,
        _ => false,
    }
}

/// Whether a comma only separates items.
fn is_list_comma(token: &Token) -> bool {
    let solid = |next: rowan::SyntaxElement<afp_syntax::Afp>| !next.kind().is_trivia();
    token.kind() == Kind::Comma
        && !std::iter::successors(token.next_sibling_or_token(), |next| {
            next.next_sibling_or_token()
        })
        .any(solid)
}

/// Whether a node has a line break or comment before its first token.
fn begins_line(node: &Node) -> bool {
    let tokens = node.descendants_with_tokens().filter_map(|each| each.into_token());
    let mut trivia = tokens.take_while(|token| token.kind().is_trivia());
    trivia.any(|token| is_comment(token.kind()) || token.text().contains('\n'))
}
