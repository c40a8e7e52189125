//! Assigns each node to a layer, so that most edges lead down.

use super::Link;

/// Larger plans are only improved in one round.
const MOST_IMPROVED: usize = 60;

/// The layer of each node, from 0 at the top; node 0 is alone in it.
///
/// The nodes get an order with few edges back. Edges along the order lead down, and the longest
/// path determines the layer. A node without arriving edges is directly above its successors.
pub(super) fn assign(count: usize, links: &[Link]) -> Vec<usize> {
    let edges: Vec<_> =
        links.iter().map(|link| (link.from, link.to)).filter(|(from, to)| from != to).collect();
    let order = with_fewest_back_edges(count, &edges);
    let rank = ranks(&order);
    let down = |from: usize, to: usize| rank[from] < rank[to];
    let mut layers = vec![1; count];
    if let Some(first) = layers.first_mut() {
        *first = 0;
    }
    // In this order, an edge down comes after all edges into its start.
    let around = Around::new(count, &edges);
    for from in &order {
        for to in around.out_of[*from].iter().filter(|to| down(*from, **to)) {
            layers[*to] = layers[*to].max(layers[*from] + 1);
        }
    }
    for node in order.iter().rev().filter(|node| **node != 0) {
        let reached = around.into[*node].iter().any(|from| down(*from, *node));
        let below = around.out_of[*node].iter().filter(|to| down(*node, **to));
        let nearest = below.map(|to| layers[*to]).min();
        if let (false, Some(nearest)) = (reached, nearest) {
            layers[*node] = nearest - 1;
        }
    }
    layers
}

/// An order of the nodes, 0 first, with few edges back: the order of a depth-first search or of the
/// nodes themselves, improved by moving single nodes.
fn with_fewest_back_edges(count: usize, edges: &[(usize, usize)]) -> Vec<usize> {
    let mut successors = vec![Vec::new(); count];
    for (from, to) in edges {
        successors[*from].push(*to);
    }
    let walked = finished_last_first(&successors);
    let written: Vec<_> = (0..count).collect();
    let candidates = [walked, written].map(|order| improved(order, edges));
    let [(walked, back), (written, other)] = candidates;
    if quality(&written, edges).0 == 0 && other < back { written } else { walked }
}

/// Moves single nodes, never the first, as long as this reverses edges and every node keeps an edge
/// from above. Also returns the number of edges back at the end.
fn improved(mut order: Vec<usize>, edges: &[(usize, usize)]) -> (Vec<usize>, usize) {
    let around = Around::new(order.len(), edges);
    let mut rank = ranks(&order);
    for _ in 0..order.len() {
        let mut moved = false;
        for node in order.clone().into_iter().skip(1) {
            if let Some(to) = around.better_rank(node, &order, &rank) {
                order.remove(rank[node]);
                order.insert(to, node);
                rank = ranks(&order);
                moved = true;
            }
        }
        if !moved || order.len() > MOST_IMPROVED {
            break;
        }
    }
    let back = quality(&order, edges).1;
    (order, back)
}

/// The edges into and out of each node.
struct Around {
    into: Vec<Vec<usize>>,
    out_of: Vec<Vec<usize>>,
    /// The targets of each node's edges, without duplicates.
    targets: Vec<Vec<usize>>,
}

impl Around {
    fn new(count: usize, edges: &[(usize, usize)]) -> Around {
        let (mut into, mut out_of) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        for (from, to) in edges {
            out_of[*from].push(*to);
            into[*to].push(*from);
        }
        let mut targets: Vec<Vec<usize>> = out_of.clone();
        for each in &mut targets {
            each.sort_unstable();
            each.dedup();
        }
        Around { into, out_of, targets }
    }

    /// The first rank at which a node improves the order most, if there is one.
    ///
    /// Only the node's own edges change their direction, so it is enough to pass its neighbours,
    /// one rank after the other.
    fn better_rank(&self, node: usize, order: &[usize], rank: &[usize]) -> Option<usize> {
        let own = rank[node];
        let mut best: (i64, i64, Option<usize>) = (0, 0, None);
        let (unreached, back) = self.cost(node, own, rank);
        let mut neighbours: Vec<usize> =
            self.into[node].iter().chain(&self.out_of[node]).map(|other| rank[*other]).collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        // Ranks do not count the node; all ranks between two neighbours are equal.
        let before = |other: usize| if other < own { other } else { other - 1 };
        let candidates = neighbours.into_iter().map(|other| before(other) + 1);
        for to in std::iter::once(1).chain(candidates).filter(|to| (1..order.len()).contains(to)) {
            let (other_unreached, other_back) = self.cost_at(node, to, own, rank);
            let gain = (other_unreached - unreached, other_back - back);
            if gain < (best.0, best.1) {
                best = (gain.0, gain.1, Some(to));
            }
        }
        best.2
    }

    fn cost(&self, node: usize, own: usize, rank: &[usize]) -> (i64, i64) {
        self.cost_at(node, own, own, rank)
    }

    /// The cost of a node's edges after a move from rank `own` to rank `to`: the number of
    /// unreached nodes among it and its targets, and the number of edges back.
    fn cost_at(&self, node: usize, to: usize, own: usize, rank: &[usize]) -> (i64, i64) {
        let without = |other: usize| rank[other] - usize::from(rank[other] > own);
        let is_before = |other: usize| without(other) < to;
        let back_in = self.into[node].iter().filter(|from| !is_before(**from)).count();
        let back_out = self.out_of[node].iter().filter(|to| is_before(**to)).count();
        let mut unreached = i64::from(back_in == self.into[node].len());
        for next in &self.targets[node] {
            let from_node = !is_before(*next);
            let others = self.into[*next].iter().filter(|from| **from != node);
            let reached = from_node || others.into_iter().any(|from| rank[*from] < rank[*next]);
            unreached += i64::from(!reached);
        }
        (unreached, (back_in + back_out) as i64)
    }
}

fn ranks(order: &[usize]) -> Vec<usize> {
    let mut rank = vec![0; order.len()];
    for (index, node) in order.iter().enumerate() {
        rank[*node] = index;
    }
    rank
}

/// The number of nodes without an edge from above, and the number of edges back.
fn quality(order: &[usize], edges: &[(usize, usize)]) -> (usize, usize) {
    let rank = ranks(order);
    let mut reached = vec![false; order.len()];
    let mut back = 0;
    for (from, to) in edges {
        if rank[*from] < rank[*to] {
            reached[*to] = true;
        } else {
            back += 1;
        }
    }
    (reached.iter().filter(|reached| !**reached).count(), back)
}

/// The nodes in the reverse order in which a depth-first search leaves them.
fn finished_last_first(successors: &[Vec<usize>]) -> Vec<usize> {
    let mut seen = vec![false; successors.len()];
    let mut done = Vec::new();
    for root in 0..successors.len() {
        if std::mem::replace(&mut seen[root], true) {
            continue;
        }
        let mut walk = vec![(root, 0)];
        while let Some((node, next)) = walk.pop() {
            let Some(to) = successors[node].get(next) else {
                done.push(node);
                continue;
            };
            walk.push((node, next + 1));
            if !std::mem::replace(&mut seen[*to], true) {
                walk.push((*to, 0));
            }
        }
    }
    done.reverse();
    done
}

#[cfg(test)]
mod tests {
    use super::super::{Exit, Link};
    use super::assign;

    fn layers(count: usize, edges: &[(usize, usize)]) -> Vec<usize> {
        let link = |(from, to): &(usize, usize)| Link {
            from: *from,
            to: *to,
            exit: Exit::Below(0.0, 0.0),
            kind: "",
        };
        assign(count, &edges.iter().map(link).collect::<Vec<_>>())
    }

    #[test]
    fn the_longest_path_determines_the_layer() {
        assert_eq!(layers(4, &[(0, 1), (1, 2), (0, 2), (2, 3)]), [0, 1, 2, 3]);
    }

    #[test]
    fn cycles_and_loops_lead_up() {
        assert_eq!(layers(3, &[(0, 1), (1, 2), (2, 1), (2, 2), (2, 0)]), [0, 1, 2]);
    }

    #[test]
    fn unreached_nodes_are_above_their_successors() {
        assert_eq!(layers(5, &[(0, 1), (1, 2), (2, 3), (4, 3)]), [0, 1, 2, 3, 2]);
        assert_eq!(layers(2, &[]), [0, 1]);
    }

    #[test]
    fn few_edges_lead_up() {
        // A search that takes 0 1 3 2 first would reverse three edges.
        let edges = [(0, 1), (1, 3), (3, 2), (1, 2), (2, 3), (2, 4), (2, 3), (4, 3)];
        assert_eq!(layers(5, &edges), [0, 1, 2, 4, 3]);
    }
}
