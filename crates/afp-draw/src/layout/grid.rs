//! The layers with all items: nodes, and the dummy nodes of passing edges.
//!
//! Channel `c` is above layer `c`; the last channel is below all layers. An edge is a chain of
//! *nets*, each across one channel, joined by *dummy nodes*, each across one layer. Edges of a
//! bundle share their dummy nodes: each chain ends at the first existing one.

use std::collections::BTreeMap;

use super::super::router::bundles;
use super::{Exit, Link, Node};

/// Distance between parallel lines in pixels.
pub(super) const LINE: f64 = 12.0;

/// An item of a layer.
#[derive(Clone, Debug)]
pub(super) struct Item {
    pub(super) layer: usize,
    /// The node; `None` for a dummy node.
    pub(super) node: Option<usize>,
    pub(super) width: f64,
    /// Left border.
    pub(super) x: f64,
}

/// One end of a net.
#[derive(Clone, Copy, Debug)]
pub(super) struct Terminal {
    pub(super) item: usize,
    /// The offset from the item's left border; for an arrival, the middle of its range.
    pub(super) offset: f64,
    /// Whether the item is above the channel.
    pub(super) above: bool,
    /// For an arrival, the range where edges may arrive, from the left border.
    pub(super) arrival: Option<(f64, f64)>,
}

/// The part of an edge in one channel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Net {
    pub(super) ends: [Terminal; 2],
}

/// Layers, dummy nodes and nets.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub(super) items: Vec<Item>,
    pub(super) nets: Vec<Net>,
    /// The items of each layer from left to right.
    pub(super) layers: Vec<Vec<usize>>,
    /// The nets in each channel.
    pub(super) channels: Vec<Vec<usize>>,
    /// The nets of each link from start to tip.
    pub(super) chains: Vec<Vec<usize>>,
    /// For each link that leaves to the right, the place of its turn, from the node's left border.
    pub(super) turns: Vec<Option<f64>>,
}

/// The shared dummy nodes of edges, by bundle, direction and layer.
type Shared = BTreeMap<(usize, bool, usize), usize>;

impl Grid {
    /// Creates the items in the order of the nodes, every dummy node next to its start node.
    pub(super) fn new(nodes: &[Node], links: &[Link], layer_of: &[usize]) -> Grid {
        let layers = layer_of.iter().max().map_or(0, |last| last + 1);
        let (turns, widths) = turns(nodes, links, layer_of);
        let items = (0..nodes.len()).map(|node| Item {
            layer: layer_of[node],
            node: Some(node),
            width: widths[node],
            x: 0.0,
        });
        let mut grid = Grid {
            items: items.collect(),
            nets: Vec::new(),
            layers: vec![Vec::new(); layers],
            channels: vec![Vec::new(); layers + 1],
            chains: Vec::new(),
            turns,
        };
        for (item, layer) in layer_of.iter().enumerate() {
            grid.layers[*layer].push(item);
        }
        let bundles = bundles(links.iter().map(|link| (link.from, link.to, link.kind)));
        let mut shared = Shared::new();
        for (index, link) in links.iter().enumerate() {
            grid.add_chain(
                index,
                link,
                nodes,
                layer_of,
                bundles[index].map(|of| (of, &mut shared)),
            );
        }
        grid
    }

    /// The place of a terminal, before arrivals are spread.
    pub(super) fn x(&self, terminal: &Terminal) -> f64 {
        self.items[terminal.item].x + terminal.offset
    }

    /// The dummy nodes of an edge from start to tip, from its nets.
    pub(super) fn dummies(&self, chain: &[usize]) -> Vec<usize> {
        chain.iter().skip(1).map(|net| self.nets[*net].ends[0].item).collect()
    }

    fn add_chain(
        &mut self,
        index: usize,
        link: &Link,
        nodes: &[Node],
        layer_of: &[usize],
        mut bundle: Option<(usize, &mut Shared)>,
    ) {
        let (from, to) = (layer_of[link.from], layer_of[link.to]);
        let down = to > from;
        let leaves_up = !down && self.turns[index].is_some();
        let offset = match (link.exit, self.turns[index]) {
            (Exit::Below(x, _), _) => x,
            (Exit::Right(..), turn) => turn.unwrap_or(0.0),
        };
        let mut end = Terminal { item: link.from, offset, above: !leaves_up, arrival: None };
        let mut channel = if leaves_up { from } else { from + 1 };
        let passed: Vec<_> = match (down, leaves_up) {
            (true, _) => (from + 1..to).collect(),
            (false, false) => (to..=from).rev().collect(),
            (false, true) => (to..from).rev().collect(),
        };
        let mut chain = Vec::new();
        for layer in passed {
            let place = bundle.as_ref().map(|(bundle, _)| (*bundle, down, layer));
            let known = bundle.as_ref().and_then(|(_, shared)| shared.get(&place?).copied());
            let item = known.unwrap_or_else(|| self.add_dummy(layer));
            let dummy = |above| Terminal { item, offset: 0.0, above, arrival: None };
            chain.push(self.add_net(channel, end, dummy(!down)));
            if known.is_some() {
                self.chains.push(chain);
                return;
            }
            if let (Some(place), Some((_, shared))) = (place, &mut bundle) {
                shared.insert(place, item);
            }
            channel = if down { layer + 1 } else { layer };
            end = dummy(down);
        }
        let entry = nodes[link.to].entry;
        let middle = (entry.0 + entry.1) / 2.0;
        let tip = Terminal { item: link.to, offset: middle, above: false, arrival: Some(entry) };
        chain.push(self.add_net(channel, end, tip));
        self.chains.push(chain);
    }

    fn add_dummy(&mut self, layer: usize) -> usize {
        self.items.push(Item { layer, node: None, width: 0.0, x: 0.0 });
        self.layers[layer].push(self.items.len() - 1);
        self.items.len() - 1
    }

    fn add_net(&mut self, channel: usize, start: Terminal, end: Terminal) -> usize {
        self.nets.push(Net { ends: [start, end] });
        self.channels[channel].push(self.nets.len() - 1);
        self.nets.len() - 1
    }

    /// The minimum distance between the borders of neighbours.
    pub(super) fn gap(&self, left: usize, right: usize) -> f64 {
        match (self.items[left].node, self.items[right].node) {
            (Some(_), Some(_)) => 4.0 * LINE,
            (None, None) => LINE,
            _ => 1.5 * LINE,
        }
    }
}

/// The turns of edges that leave to the right, and the nodes' widths with these turns.
///
/// Of the edges down, the highest turns last; of the edges up, the lowest turns last. Therefore
/// none of them cross.
fn turns(nodes: &[Node], links: &[Link], layer_of: &[usize]) -> (Vec<Option<f64>>, Vec<f64>) {
    let mut turns = vec![None; links.len()];
    let mut widths: Vec<_> = nodes.iter().map(|node| node.width).collect();
    for (node, width) in widths.iter_mut().enumerate() {
        let leaving = links.iter().enumerate().filter(|(_, link)| link.from == node);
        let mut right: Vec<(usize, bool, f64)> = leaving
            .filter_map(|(index, link)| match link.exit {
                Exit::Right(_, y) => Some((index, layer_of[link.to] > layer_of[node], y)),
                Exit::Below(..) => None,
            })
            .collect();
        let key = |(_, down, y): &(usize, bool, f64)| if *down { -*y } else { *y };
        right.sort_by(|a, b| {
            (a.1, key(a)).partial_cmp(&(b.1, key(b))).unwrap_or(std::cmp::Ordering::Equal)
        });
        for (index, ..) in right {
            *width += LINE;
            turns[index] = Some(*width);
        }
    }
    (turns, widths)
}
