//! When something that is held down has just been pressed.

/// Whether it was held at the last reading; nothing before the first one.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Press {
    held: Option<bool>,
}

impl Press {
    /// Takes note of a reading; whether a press begins with it. What is held at the first reading was pressed before,
    /// and a reading that says nothing changes nothing.
    pub(crate) fn begins(&mut self, held: Option<bool>) -> bool {
        let begins = self.held == Some(false) && held == Some(true);
        self.held = held.or(self.held);
        begins
    }
}

#[cfg(test)]
mod tests {
    use super::Press;

    #[test]
    fn a_reading_that_says_nothing_begins_and_ends_no_press() {
        let mut press = Press::default();
        let readings = [Some(false), Some(true), None, Some(true), Some(false), None, Some(true)];
        let begins = readings.map(|held| press.begins(held));
        assert_eq!(begins, [false, true, false, false, false, false, true]);
    }
}
