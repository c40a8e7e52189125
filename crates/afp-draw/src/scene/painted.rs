//! Fragments of a plan, painted only if they differ from the previous scene.
//!
//! Painting dominates the time of a small change, and such a change leaves nearly all fragments
//! unchanged.

use std::sync::Arc;

use super::{DrawnEdge, EdgeScene, ElementScene, PieceScene, PlanScene, Point};
use crate::card::Card;
use crate::sketch::{Arrow, Rect};
use crate::svg::paint::{self, Painter};
use afp_dsl::outline::Part;
use afp_syntax::item::Item;
use rustc_hash::FxHashMap;

/// The already painted parts of a plan.
#[derive(Default)]
pub(super) struct Painted<'s> {
    elements: FxHashMap<&'s Item, &'s ElementScene>,
    edges: FxHashMap<(&'s Item, &'s Part), &'s EdgeScene>,
}

impl<'s> Painted<'s> {
    /// The parts of the previous scene; empty without one.
    pub(super) fn of(plan: Option<&'s PlanScene>) -> Painted<'s> {
        let Some(plan) = plan else { return Painted::default() };
        Painted {
            elements: plan.elements.iter().map(|known| (&known.item, known)).collect(),
            edges: plan.edges.iter().map(|known| ((&known.item, &known.part), known)).collect(),
        }
    }

    /// A card at its place.
    pub(super) fn element(&self, card: Card<'_>, at: Point, painter: &mut Painter) -> ElementScene {
        let Card { item, rect, width, height, mut sketch, .. } = card;
        let pieces = std::mem::take(&mut sketch.pieces);
        let content = painter.content(sketch);
        let known = self.elements.get(&item);
        let known = known.filter(|known| {
            paint::alike((known.outer.x, known.outer.y), at) && *known.content == content
        });
        let (svg, content) = match known {
            Some(known) => (Arc::clone(&known.svg), Arc::clone(&known.content)),
            None => (paint::element(&item, &content, at).into(), Arc::new(content)),
        };
        let piece = |piece: crate::sketch::Piece| PieceScene {
            item: piece.item,
            part: piece.part,
            rect: piece.rect.moved(at),
            severity: piece.severity,
            tag: piece.tag.map(|tag| tag.moved(at)),
        };
        ElementScene {
            rect: rect.moved(at),
            outer: Rect { x: at.0, y: at.1, width, height },
            pieces: pieces.into_iter().map(piece).collect(),
            item,
            svg,
            content,
        }
    }

    /// An edge that shares this length with another one before its target; `None` if it has no
    /// target element.
    pub(super) fn edge(&self, edge: DrawnEdge, joined: f64) -> Option<EdgeScene> {
        let DrawnEdge { item, part, to, class, severity, points } = edge;
        let to = to?;
        let known = self.edges.get(&(&item, &part));
        let known = known.filter(|known| {
            known.points == points && (known.class, known.joined) == (class, joined)
        });
        let arrow = Arrow { joined, ..Arrow::flow(points, class) };
        let svg = match known {
            Some(known) => Arc::clone(&known.svg),
            None => paint::edge(&item, &part, &arrow).into(),
        };
        let (kind, points) = (class.name, arrow.points);
        Some(EdgeScene { item, part, to, kind, points, severity, svg, class, joined })
    }
}
