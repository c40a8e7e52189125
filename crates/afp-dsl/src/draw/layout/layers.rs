//! Gives each node a layer, so that most edges lead down.

use super::Link;

/// Larger plans are improved in one round only.
const MOST_IMPROVED: usize = 60;

/// The layer of each node, counted from 0 at the top; node 0 is alone there.
///
/// The nodes get an order in which few edges lead back; edges that follow the order lead down, and
/// the longest path decides. A node that no edge reaches stands just above its successors.
pub(super) fn assign(count: usize, links: &[Link]) -> Vec<usize> {
    let edges: Vec<_> =
        links.iter().map(|link| (link.from, link.to)).filter(|(from, to)| from != to).collect();
    let order = with_fewest_back_edges(count, &edges);
    let mut rank = vec![0; count];
    for (place, node) in order.iter().enumerate() {
        rank[*node] = place;
    }
    let down = |from: usize, to: usize| rank[from] < rank[to];
    let mut layers = vec![1; count];
    if let Some(first) = layers.first_mut() {
        *first = 0;
    }
    // In this order every edge that leads down comes after all edges into its start.
    for from in &order {
        for (_, to) in edges.iter().filter(|edge| edge.0 == *from && down(edge.0, edge.1)) {
            layers[*to] = layers[*to].max(layers[*from] + 1);
        }
    }
    for node in order.iter().rev().filter(|node| **node != 0) {
        let reached = edges.iter().any(|(from, to)| to == node && down(*from, *to));
        let below = edges.iter().filter(|(from, to)| from == node && down(*from, *to));
        let nearest = below.map(|(_, to)| layers[*to]).min();
        if let (false, Some(nearest)) = (reached, nearest) {
            layers[*node] = nearest - 1;
        }
    }
    layers
}

/// An order of the nodes, 0 first, that few edges lead back in: that of a depth-first walk or that
/// of the nodes themselves, improved by moving single nodes.
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

/// Moves single nodes, never the first, as long as that turns edges round and leaves every node
/// with an edge from above; also returns how many edges lead back in the end.
fn improved(mut order: Vec<usize>, edges: &[(usize, usize)]) -> (Vec<usize>, usize) {
    let mut best = quality(&order, edges);
    for _ in 0..order.len() {
        let before = best;
        for node in order.clone().into_iter().skip(1) {
            for place in 1..order.len() {
                let mut other: Vec<_> =
                    order.iter().copied().filter(|each| *each != node).collect();
                other.insert(place, node);
                let found = quality(&other, edges);
                if found < best {
                    (order, best) = (other, found);
                }
            }
        }
        if best == before || order.len() > MOST_IMPROVED {
            break;
        }
    }
    (order, best.1)
}

/// How many nodes no edge reaches from above, and how many edges lead back.
fn quality(order: &[usize], edges: &[(usize, usize)]) -> (usize, usize) {
    let mut rank = vec![0; order.len()];
    for (place, node) in order.iter().enumerate() {
        rank[*node] = place;
    }
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

/// The nodes by the reverse of the order in which a depth-first walk leaves them.
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
        };
        assign(count, &edges.iter().map(link).collect::<Vec<_>>())
    }

    #[test]
    fn the_longest_path_decides() {
        assert_eq!(layers(4, &[(0, 1), (1, 2), (0, 2), (2, 3)]), [0, 1, 2, 3]);
    }

    #[test]
    fn cycles_and_loops_lead_up() {
        assert_eq!(layers(3, &[(0, 1), (1, 2), (2, 1), (2, 2), (2, 0)]), [0, 1, 2]);
    }

    #[test]
    fn unreached_nodes_stand_above_their_successors() {
        assert_eq!(layers(5, &[(0, 1), (1, 2), (2, 3), (4, 3)]), [0, 1, 2, 3, 2]);
        assert_eq!(layers(2, &[]), [0, 1]);
    }

    #[test]
    fn few_edges_lead_up() {
        // A walk that takes 0 1 3 2 first would turn three edges round.
        let edges = [(0, 1), (1, 3), (3, 2), (1, 2), (2, 3), (2, 4), (2, 3), (4, 3)];
        assert_eq!(layers(5, &edges), [0, 1, 2, 4, 3]);
    }
}
