//! The places of boxes: their positions, or the nearest free places.
//!
//! From the first edit in a drawing on, every box has a position. [`Boxes`] writes the positions,
//! and makes room for boxes that have grown; nothing else moves.

use rustc_hash::FxHashMap;

use super::{Card, Point, cards, exits, links, nodes};
use crate::Options;
use crate::layout::{self, ABOVE, LaidOut, Link};
use crate::layout_file::{Layout, Position};
use crate::sketch::Rect;
use crate::view::View;
use afp_dsl::outline::{Outline, PlanId};
use afp_syntax::item::Item;

/// A box covers another one within these distances, horizontally and vertically: an edge needs this
/// space, and more above its target.
const COVERED: (f64, f64) = (12.0, ABOVE);

/// Distance between a grown box and a box that gives way.
const BELOW: f64 = 48.0;

/// The boxes of a plan, and their places.
pub(super) struct Standing<'a> {
    cards: Vec<Card<'a>>,
    /// The corner of each box's position.
    pub(super) corners: Vec<Point>,
    /// The whole layout, if it is fully automatic.
    pub(super) automatic: Option<Automatic>,
}

/// A fully automatic layout.
pub(super) struct Automatic {
    pub(super) links: Vec<Link>,
    pub(super) laid_out: LaidOut,
}

impl<'a> Standing<'a> {
    /// Places the boxes of a plan; boxes without a position are as near as possible to their
    /// wishes.
    pub(super) fn new(view: &View<'a>, wishes: &[(Item, Position)]) -> Standing<'a> {
        let position = |card: &Card| view.position(&card.item);
        let declared = cards(view, &|_, _| None);
        if declared.iter().all(|card| position(card).is_some()) {
            let corners = declared.iter().filter_map(position).map(point).collect();
            return Standing { cards: declared, corners, automatic: None };
        }
        let cards = ordered(view, declared, |cards, links| layout::towards(&nodes(cards), links));
        let (nodes, links) = (nodes(&cards), links(&exits(&cards)));
        let corner = |card: &Card, at: Position| {
            let (x, y) = point(at);
            (x - card.rect.x, y - card.rect.y)
        };
        let wish = |card: &Card| wishes.iter().find(|(item, _)| *item == card.item);
        let fixed: Vec<_> = cards.iter().map(|card| Some(corner(card, position(card)?))).collect();
        let wished: Vec<_> = cards.iter().map(|card| Some(corner(card, wish(card)?.1))).collect();
        let is_free = fixed.iter().chain(&wished).all(Option::is_none);
        let automatic = is_free.then(|| layout::layout(&nodes, &links));
        let corners = match &automatic {
            Some(laid_out) => laid_out.corners.clone(),
            None => layout::places(&nodes, &links, &fixed, &wished),
        };
        let rect = |(card, (x, y)): (&Card, Point)| (x + card.rect.x, y + card.rect.y);
        let corners = cards.iter().zip(corners).map(rect).collect();
        let automatic = automatic.map(|laid_out| Automatic { links, laid_out });
        Standing { cards, corners, automatic }
    }
}

fn point(at: Position) -> Point {
    (at.x.into(), at.y.into())
}

/// The cards of placed boxes, with states on the sides of their targets. An edge back up leaves at
/// the border.
pub(super) fn leading<'a>(view: &View<'a>, corners: &[Point]) -> Vec<Card<'a>> {
    ordered(view, cards(view, &|_, _| None), |cards, links| {
        let middle = |at: usize| corners[at].0 + cards[at].rect.width / 2.0;
        let wish = |link: &Link| {
            let (from, to) = (middle(link.from), middle(link.to));
            let is_below = corners[link.to].1 > corners[link.from].1;
            match is_below {
                true => to,
                false if to < from => to - FAR,
                false => to + FAR,
            }
        };
        links.iter().map(wish).collect()
    })
}

/// Farther than any drawing.
const FAR: f64 = 1e9;

/// Cards with states in the order of their links' wishes.
fn ordered<'a>(
    view: &View<'a>,
    declared: Vec<Card<'a>>,
    wishes: impl Fn(&[Card], &[Link]) -> Vec<f64>,
) -> Vec<Card<'a>> {
    let exits = exits(&declared);
    let wishes = wishes(&declared, &links(&exits));
    let wishes: FxHashMap<_, _> = exits
        .iter()
        .zip(wishes)
        .map(|((_, exit), wish)| ((&exit.item, &exit.part), wish))
        .collect();
    cards(view, &|item, part| wishes.get(&(item, part)).copied())
}

/// The boxes of the plans of a file.
#[derive(Clone, Debug)]
pub struct Boxes(Vec<Standee>);

/// A box with its bounds.
#[derive(Clone, Debug)]
struct Standee {
    plan: PlanId,
    item: Item,
    at: Position,
    outer: Rect,
}

impl Boxes {
    /// The boxes in a drawing with these positions. Boxes without a position are as near as
    /// possible to their wishes.
    pub fn new(
        outline: &Outline,
        file: u16,
        layout: &Layout,
        wishes: &[(Item, Position)],
    ) -> Boxes {
        let mut positions = vec![Layout::default(); usize::from(file)];
        positions.push(layout.clone());
        let options = Options { positions: &positions, ..Options::default() };
        let own = (0..).map(PlanId).zip(&outline.plans).filter(|(_, plan)| plan.file() == file);
        let all = own.flat_map(|(plan, _)| {
            let Standing { cards, corners, .. } =
                Standing::new(&View::new(outline, plan, &options), wishes);
            let standee = move |(card, (x, y)): (Card, Point)| Standee {
                plan,
                at: Position { x: x.round() as i32, y: y.round() as i32 },
                outer: Rect {
                    x: x - card.rect.x,
                    y: y - card.rect.y,
                    width: card.width,
                    height: card.height,
                },
                item: card.item,
            };
            cards.into_iter().zip(corners).map(standee).collect::<Vec<_>>()
        });
        Boxes(all.collect())
    }

    /// Writes the position of every box.
    pub fn write(&self, layout: &mut Layout) {
        self.0.iter().for_each(|one| layout.set(one.item.clone(), one.at));
    }

    /// Moves covered boxes down below a grown box. A box is identified by its previous place.
    pub fn make_room(&mut self, before: &Boxes) {
        let stood: FxHashMap<_, _> =
            before.0.iter().map(|one| ((one.at.x, one.at.y), one)).collect();
        let known: Vec<_> =
            self.0.iter().map(|one| stood.get(&(one.at.x, one.at.y)).copied()).collect();
        let has_grown =
            |at: &usize| known[*at].is_some_and(|was| !was.outer.holds(&self.0[*at].outer));
        let mut growing: Vec<usize> = (0..self.0.len()).filter(has_grown).collect();
        while let Some(one) = growing.pop() {
            for other in (0..self.0.len()).filter(|other| *other != one) {
                let (across, down) = self.0[one].apart(&self.0[other]);
                let is_nearer = known[one].zip(known[other]).is_none_or(|(one, other)| {
                    let was = one.apart(other);
                    // Boxes that a user has put on one another stay.
                    let by_hand = was.0 < 0.0 && was.1 < 0.0;
                    !by_hand && (across < was.0 - 0.5 || down < was.1 - 0.5)
                });
                let is_covered = across < COVERED.0 && down < COVERED.1;
                if self.0[one].plan != self.0[other].plan || !is_covered || !is_nearer {
                    continue;
                }
                let down = self.0[one].outer.bottom() + BELOW - self.0[other].outer.y;
                self.0[other].lower(down.ceil() as i32);
                growing.push(other);
            }
        }
    }
}

impl Standee {
    /// The horizontal and vertical distance of two boxes; negative if they overlap.
    fn apart(&self, other: &Standee) -> (f64, f64) {
        let (one, two) = (&self.outer, &other.outer);
        let across = (two.x - one.right()).max(one.x - two.right());
        (across, (two.y - one.bottom()).max(one.y - two.bottom()))
    }

    fn lower(&mut self, by: i32) {
        self.at.y += by;
        self.outer.y += f64::from(by);
    }
}
