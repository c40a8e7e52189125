//! Where boxes stand: at their positions, or at the nearest free places.
//!
//! From the first edit in a drawing on every box has a position. [`Boxes`] writes them, and makes room where a box has
//! grown: then nothing else moves.

use rustc_hash::FxHashMap;

use super::{Card, Point, cards, exits, links, nodes};
use crate::Options;
use crate::layout::{self, ABOVE, LaidOut, Link};
use crate::layout_file::{Layout, Position};
use crate::sketch::Rect;
use crate::view::View;
use afp_dsl::outline::{Outline, PlanId};
use afp_syntax::item::Item;

/// Nearer than that beside one another, or one below the other, one box covers another: an edge needs so much room, and more
/// above its target.
const COVERED: (f64, f64) = (12.0, ABOVE);

/// Distance between a box that has grown and one that gives way to it.
const BELOW: f64 = 48.0;

/// The boxes of a plan, and where they stand.
pub(super) struct Standing<'a> {
    cards: Vec<Card<'a>>,
    /// The corner of each box that has its position.
    pub(super) corners: Vec<Point>,
    /// The whole layout, where it chose all places.
    pub(super) automatic: Option<Automatic>,
}

/// A layout that chose all places.
pub(super) struct Automatic {
    pub(super) links: Vec<Link>,
    pub(super) laid_out: LaidOut,
}

impl<'a> Standing<'a> {
    /// The boxes of a plan; those without a position stand as near as possible to where they are wished.
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

/// The cards of boxes that stand somewhere, with states on the side to which they lead. An edge back up leaves at the border.
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

/// Further than anything is drawn.
const FAR: f64 = 1e9;

/// Cards with states in the order of the wishes of their links.
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

/// A box and all that it takes.
#[derive(Clone, Debug)]
struct Standee {
    plan: PlanId,
    item: Item,
    at: Position,
    outer: Rect,
}

impl Boxes {
    /// The boxes as they are drawn with such positions. Those without one stand as near as possible to where they are wished.
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

    /// Gives every box its position.
    pub fn write(&self, layout: &mut Layout) {
        self.0.iter().for_each(|one| layout.set(one.item.clone(), one.at));
    }

    /// Moves what a box covers, since it has grown, down below it. A box is known by where it stood before.
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
                    // Boxes that somebody has put on one another stay so.
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
    /// How far two boxes are apart across and down; less than nothing where they overlap.
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
