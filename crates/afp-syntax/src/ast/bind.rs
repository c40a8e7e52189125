//! Bindings of components, and the assignments of declared computations.

use super::{Formula, Name, child, span_of, token};
use crate::Node;
use crate::kind::Kind;
use crate::source::Span;

/// A port bound to a formula or an entry.
///
/// A single name is read as an input, see [`Bind::is_alone`].
#[derive(Clone, Debug)]
pub enum Bind {
    /// `port = formula`
    In {
        port: Name,
        /// The `=`.
        sign: Span,
        formula: Option<Formula>,
    },
    /// `port => entry`
    Out {
        port: Name,
        /// The `=>`.
        sign: Span,
        /// The entry that takes the value.
        entry: Option<Name>,
        /// An invalid formula instead of the entry.
        formula: Option<Formula>,
    },
}

impl Bind {
    pub fn port(&self) -> &Name {
        let (Bind::In { port, .. } | Bind::Out { port, .. }) = self;
        port
    }

    /// Whether it is only a name, for both the port and the entry: `goal` is `goal = goal`, or
    /// `goal => goal` if the port is an output.
    pub fn is_alone(&self) -> bool {
        match self {
            // A comparison of the starts is cheap and decides most cases.
            Bind::In { port, formula: Some(formula), .. } => {
                formula.starts_by(port.span.start) && formula.span() == port.span
            }
            Bind::Out { port, entry: Some(entry), .. } => entry.span == port.span,
            _ => false,
        }
    }

    /// The same name, if the port is an output.
    #[must_use]
    pub fn as_output(&self) -> Bind {
        let port = self.port().clone();
        Bind::Out { sign: port.span.after(), entry: Some(port.clone()), formula: None, port }
    }
}

pub(super) fn binds(node: &Node, file: u16) -> Vec<Bind> {
    let Some(args) = child(node, Kind::Args) else { return Vec::new() };
    args.children().filter_map(|node| bind(&node, file)).collect()
}

pub(super) fn bind(node: &Node, file: u16) -> Option<Bind> {
    let same = child(node, Kind::Ref).filter(|_| node.kind() == Kind::BindSame);
    let port = token(same.as_ref().unwrap_or(node), Kind::Name, file)?;
    let sign = |kinds: &[Kind]| {
        let sign = kinds.iter().find_map(|kind| span_of(node, *kind, file));
        sign.unwrap_or(port.span.after())
    };
    match node.kind() {
        Kind::BindIn => Some(Bind::In {
            sign: sign(&[Kind::Equal]),
            formula: Formula::child_of(node, file),
            port,
        }),
        Kind::BindOut => {
            let target = child(node, Kind::Target);
            let entry = target.as_ref().and_then(|target| token(target, Kind::Name, file));
            Some(Bind::Out {
                sign: sign(&[Kind::FatArrow, Kind::Arrow]),
                entry,
                formula: target.and_then(|target| Formula::child_of(&target, file)),
                port,
            })
        }
        Kind::BindSame => {
            Some(Bind::In { sign: port.span.after(), formula: Formula::child_of(node, file), port })
        }
        _ => None,
    }
}
