//! Units after numbers, foreign spellings included.

use super::{Lexer, is_blank, is_word, run};
use crate::diagnostics::{Code, Diagnostic};
use crate::kind::Kind;
use crate::message;
use crate::units::{FOREIGN, Unit};

impl Lexer<'_, '_> {
    /// Takes the unit after the number just taken, if it is on the same line.
    pub(super) fn unit(&mut self) {
        let rest = &self.text[self.at..];
        let blank = run(rest, |each| is_blank(each) && each != '\n');
        let behind = &rest[blank..];
        let is_ascii = behind.bytes().next().is_none_or(|byte| byte.is_ascii());
        let mut foreign = FOREIGN.iter().filter(|_| !is_ascii);
        if let Some((foreign, ours)) = foreign.find(|(sign, _)| behind.starts_with(sign)) {
            self.blank(blank);
            self.foreign(foreign, ours);
        } else if let Some((_, length)) = Unit::scan(behind)
            && !is_bound(&behind[..length], &behind[length..])
        {
            self.blank(blank);
            self.push(Kind::Unit, length);
        }
    }

    fn blank(&mut self, length: usize) {
        if length > 0 {
            self.push(Kind::Whitespace, length);
        }
    }

    fn foreign(&mut self, foreign: &str, ours: &str) {
        let rest = &self.text[self.at..];
        // '90°/s' is one unit: the rest is read as if the sign were ours.
        let tail = &rest[foreign.len()..];
        let tail = &tail[..run(tail, |each| is_word(each) || "*/^".contains(each))];
        let spelled = format!("{ours}{tail}");
        let more = Unit::scan(&spelled).map_or(0, |(_, length)| length - ours.len());
        let sign = self.span(self.at, self.at + foreign.len());
        self.push(Kind::Unit, foreign.len() + more);
        self.diags.push(
            Diagnostic::new(
                Code::E0107,
                sign,
                message!("the unit '{}' is written '{}'", foreign, ours),
            )
            .write(ours),
        );
    }
}

/// Whether a word that looks like a unit is in fact a name with a binding, after a missing comma.
fn is_bound(unit: &str, behind: &str) -> bool {
    let behind = behind.trim_start();
    let is_name = unit.chars().all(|each| is_word(each) || each.is_ascii_digit());
    is_name && behind.starts_with('=') && !behind.starts_with("==") && !behind.starts_with("=>")
}
