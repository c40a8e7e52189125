//! A wheel encoder with two lines, whose edges are a quarter of a period apart.

/// A wheel encoder.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quadrature {
    levels: [bool; 2],
    count: i32,
}

impl Quadrature {
    /// An encoder whose lines have these levels.
    pub fn new(levels: [bool; 2]) -> Self {
        Quadrature { levels, count: 0 }
    }

    /// Takes an edge of the first or the second line. The first line leads if the wheel turns
    /// forwards.
    pub fn edge(&mut self, second: bool, rises: bool) {
        let level = &mut self.levels[usize::from(second)];
        // An edge was lost, and with it the direction.
        if *level == rises {
            return;
        }
        *level = rises;
        let [a, b] = self.levels;
        let is_ahead = (a != b) != second;
        self.count = self.count.wrapping_add(if is_ahead { 1 } else { -1 });
    }

    /// Takes the levels of both lines. If both have changed, the direction is lost, and neither edge
    /// counts.
    pub fn look(&mut self, levels: [bool; 2]) {
        let [a, b] = levels;
        match [self.levels[0] != a, self.levels[1] != b] {
            [true, true] => self.levels = levels,
            [false, false] => {}
            [first, _] => self.edge(!first, if first { a } else { b }),
        }
    }

    /// The edges so far, forwards up. It overflows.
    pub fn count(&self) -> i32 {
        self.count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TURN: [(bool, bool); 4] = [(false, true), (true, true), (false, false), (true, false)];

    #[test]
    fn edges_count_up_and_down_and_lost_edges_count_nothing() {
        let mut encoder = Quadrature::default();
        for (second, rises) in TURN.repeat(25) {
            encoder.edge(second, rises);
        }
        assert_eq!(encoder.count(), 100);
        for (second, rises) in TURN.repeat(10).into_iter().rev() {
            encoder.edge(second, !rises);
        }
        assert_eq!(encoder.count(), 60);
        encoder.edge(false, false);
        assert_eq!(encoder.count(), 60);
        let mut turned = Quadrature::new([true, true]);
        turned.edge(false, false);
        assert_eq!(turned.count(), 1);
        for levels in [[false, false], [true, false], [true, false], [true, true]] {
            turned.look(levels);
        }
        assert_eq!(turned.count(), 4);
        turned.look([false, false]);
        turned.look([false, true]);
        assert_eq!(turned.count(), 3);
    }
}
