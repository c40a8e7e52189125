//! Strongly connected components (Tarjan, 1972), with an explicit stack.

/// Numbers the components of the graph in which `edges[first[n]..first[n + 1]]` are the successors
/// of `n`. A component's number is less than those of its predecessors.
pub(crate) fn components(first: &[u32], edges: &[u32]) -> Vec<u32> {
    let count = first.len().saturating_sub(1);
    let mut search = Search {
        first,
        edges,
        index: vec![0; count],
        low: vec![0; count],
        component: vec![u32::MAX; count],
        stack: Vec::new(),
        path: Vec::new(),
        next: 1,
        found: 0,
    };
    for root in 0..count {
        if search.index[root] == 0 {
            search.run(root);
        }
    }
    search.component
}

/// For each node the start of its edges in a sorted list, followed by the list's length. `from` are
/// the origins of the edges.
pub(crate) fn first(nodes: usize, from: impl Iterator<Item = usize>) -> Vec<u32> {
    let mut first = vec![0; nodes + 1];
    from.for_each(|node| first[node + 1] += 1);
    for node in 0..nodes {
        first[node + 1] += first[node];
    }
    first
}

struct Search<'a> {
    first: &'a [u32],
    edges: &'a [u32],
    /// Order of discovery, from 1; 0 is undiscovered.
    index: Vec<u32>,
    low: Vec<u32>,
    component: Vec<u32>,
    stack: Vec<usize>,
    /// The nodes on the current path, each with its next edge.
    path: Vec<(usize, u32)>,
    next: u32,
    found: u32,
}

impl Search<'_> {
    fn discover(&mut self, node: usize) {
        self.index[node] = self.next;
        self.low[node] = self.next;
        self.next += 1;
        self.stack.push(node);
        self.path.push((node, self.first[node]));
    }

    fn run(&mut self, root: usize) {
        self.discover(root);
        while let Some((node, next)) = self.path.last_mut() {
            let node = *node;
            if *next < self.first[node + 1] {
                let to = self.edges[*next as usize] as usize;
                *next += 1;
                if self.index[to] == 0 {
                    self.discover(to);
                } else if self.component[to] == u32::MAX {
                    self.low[node] = self.low[node].min(self.index[to]);
                }
                continue;
            }
            self.path.pop();
            if let Some((above, _)) = self.path.last() {
                self.low[*above] = self.low[*above].min(self.low[node]);
            }
            if self.low[node] == self.index[node] {
                self.close(node);
            }
        }
    }

    fn close(&mut self, root: usize) {
        while let Some(node) = self.stack.pop() {
            self.component[node] = self.found;
            if node == root {
                break;
            }
        }
        self.found += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::components;

    #[test]
    fn nodes_of_one_cycle_share_a_number_and_later_nodes_have_smaller_numbers() {
        // 0 -> 1 -> 2 -> 1, 2 -> 3
        let found = components(&[0, 1, 2, 4, 4], &[1, 2, 1, 3]);
        assert_eq!(found[1], found[2]);
        assert!(found[3] < found[2] && found[2] < found[0]);
    }

    #[test]
    fn a_long_chain_needs_no_deep_stack() {
        let count = 200_000u32;
        let first: Vec<u32> = (0..=count).map(|node| node.min(count - 1)).collect();
        let edges: Vec<u32> = (1..count).collect();
        let found = components(&first, &edges);
        assert_eq!(found[0], count - 1);
    }
}
