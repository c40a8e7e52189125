//! The greatest value over a range, with ranges raised to a value: a segment tree.

/// Values by position, all of them negative infinity at first.
#[derive(Clone, Debug)]
pub(super) struct Maxima {
    leaves: usize,
    /// The greatest value anywhere below a node.
    greatest: Vec<f64>,
    /// The least that everything below a node has been raised to.
    raised: Vec<f64>,
}

impl Maxima {
    pub(super) fn new(count: usize) -> Maxima {
        let leaves = count.max(1).next_power_of_two();
        let none = vec![f64::NEG_INFINITY; 2 * leaves];
        Maxima { leaves, greatest: none.clone(), raised: none }
    }

    /// The greatest value from `first` to `last`.
    pub(super) fn greatest(&self, first: usize, last: usize) -> f64 {
        self.look(1, (0, self.leaves - 1), (first, last))
    }

    /// Raises what is lower from `first` to `last`.
    pub(super) fn raise(&mut self, first: usize, last: usize, to: f64) {
        self.lift(1, (0, self.leaves - 1), (first, last), to);
    }

    fn look(&self, node: usize, own: (usize, usize), range: (usize, usize)) -> f64 {
        if range.1 < own.0 || own.1 < range.0 {
            return f64::NEG_INFINITY;
        }
        if range.0 <= own.0 && own.1 <= range.1 {
            return self.greatest[node];
        }
        let middle = own.0.midpoint(own.1);
        let left = self.look(2 * node, (own.0, middle), range);
        let right = self.look(2 * node + 1, (middle + 1, own.1), range);
        self.raised[node].max(left).max(right)
    }

    fn lift(&mut self, node: usize, own: (usize, usize), range: (usize, usize), to: f64) {
        if range.1 < own.0 || own.1 < range.0 {
            return;
        }
        self.greatest[node] = self.greatest[node].max(to);
        if range.0 <= own.0 && own.1 <= range.1 {
            self.raised[node] = self.raised[node].max(to);
            return;
        }
        let middle = own.0.midpoint(own.1);
        self.lift(2 * node, (own.0, middle), range, to);
        self.lift(2 * node + 1, (middle + 1, own.1), range, to);
    }
}

#[cfg(test)]
mod tests {
    use super::Maxima;

    #[test]
    fn ranges_are_raised_and_looked_at() {
        let mut maxima = Maxima::new(5);
        maxima.raise(1, 3, 2.0);
        maxima.raise(3, 4, 5.0);
        assert_eq!(maxima.greatest(0, 0), f64::NEG_INFINITY);
        assert_eq!(maxima.greatest(0, 2), 2.0);
        assert_eq!(maxima.greatest(2, 3), 5.0);
        assert_eq!(maxima.greatest(4, 4), 5.0);
    }
}
