//! A segment tree: the maximum over a range, and raising a range to a value.

/// Values by position, negative infinity at first.
#[derive(Clone, Debug)]
pub(super) struct Maxima {
    leaves: usize,
    /// The maximum below a node.
    greatest: Vec<f64>,
    /// The minimum value of everything below a node.
    raised: Vec<f64>,
}

impl Maxima {
    pub(super) fn new(count: usize) -> Maxima {
        let leaves = count.max(1).next_power_of_two();
        let none = vec![f64::NEG_INFINITY; 2 * leaves];
        Maxima { leaves, greatest: none.clone(), raised: none }
    }

    /// The maximum from `first` to `last`.
    pub(super) fn greatest(&self, first: usize, last: usize) -> f64 {
        let (mut left, mut right) = (self.leaves + first, self.leaves + last);
        let mut found = self.greatest[left].max(self.greatest[right]);
        // From both ends up: ancestors of an end apply to it, and siblings are in between.
        while left > 1 {
            let between = left / 2 != right / 2;
            if between && left.is_multiple_of(2) {
                found = found.max(self.greatest[left + 1]);
            }
            if between && !right.is_multiple_of(2) {
                found = found.max(self.greatest[right - 1]);
            }
            (left, right) = (left / 2, right / 2);
            found = found.max(self.raised[left]).max(self.raised[right]);
        }
        found
    }

    /// Raises lower values from `first` to `last`.
    pub(super) fn raise(&mut self, first: usize, last: usize, to: f64) {
        let (mut left, mut right) = (self.leaves + first, self.leaves + last);
        self.lift(left, to);
        self.lift(right, to);
        while left > 1 {
            let between = left / 2 != right / 2;
            if between && left.is_multiple_of(2) {
                self.lift(left + 1, to);
            }
            if between && !right.is_multiple_of(2) {
                self.lift(right - 1, to);
            }
            (left, right) = (left / 2, right / 2);
            self.greatest[left] = self.greatest[left].max(to);
            self.greatest[right] = self.greatest[right].max(to);
        }
    }

    /// Raises everything below a node.
    fn lift(&mut self, node: usize, to: f64) {
        self.greatest[node] = self.greatest[node].max(to);
        self.raised[node] = self.raised[node].max(to);
    }
}

#[cfg(test)]
mod tests {
    use super::Maxima;

    #[test]
    fn ranges_are_raised_and_queried() {
        let mut maxima = Maxima::new(5);
        maxima.raise(1, 3, 2.0);
        maxima.raise(3, 4, 5.0);
        assert_eq!(maxima.greatest(0, 0), f64::NEG_INFINITY);
        assert_eq!(maxima.greatest(0, 2), 2.0);
        assert_eq!(maxima.greatest(2, 3), 5.0);
        assert_eq!(maxima.greatest(4, 4), 5.0);
    }
}
