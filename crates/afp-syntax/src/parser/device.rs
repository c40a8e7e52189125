//! Devices of a toolbox: controls, faults, signals.

use super::Parser;
use crate::keywords::{self, DEVICE};
use crate::kind::Kind;

const PART_HELP: &str = "write 'press', 'stop', 'fault', 'signal' or 'truth'";

impl Parser<'_, '_> {
    pub(super) fn device(&mut self) {
        self.open_item(Kind::Device);
        let is_robot = self.word(0) == "robot";
        self.keyword();
        // A robot has no name; the checker reports one.
        if !is_robot || self.at(Kind::Name) {
            self.name("give the device a name");
        }
        let opened = self.here();
        if self.expect(Kind::OpenBrace, "put the device's parts in braces") {
            while !self.at_end() && !self.at(Kind::CloseBrace) && !self.at_tool() {
                self.repeat(|parser| {
                    let what = "a part of the device";
                    match parser.at_device_part()
                        || parser.item_meant(what, &keywords::with(DEVICE))
                    {
                        true => parser.device_part(),
                        false => parser.skip(what, PART_HELP, |p| {
                            p.at_device_part() || p.at(Kind::CloseBrace) || p.at_tool()
                        }),
                    }
                });
            }
            self.close_bracket(Kind::CloseBrace, opened);
        }
        self.close_item();
    }

    /// Whether a device begins here; its brace distinguishes it from a name.
    pub(super) fn at_device(&self) -> bool {
        match self.word(0) {
            "device" | "sensor" => self.nth(1) == Kind::Name && self.nth(2) == Kind::OpenBrace,
            "robot" => {
                let braces = 1 + usize::from(self.nth(1) == Kind::Name);
                self.nth(braces) == Kind::OpenBrace
            }
            _ => false,
        }
    }

    fn at_device_part(&self) -> bool {
        keywords::has(self.word(0), DEVICE)
    }

    /// Whether a line begins with a misspelt keyword of a part, followed by a name.
    fn at_misspelt_part(&self) -> bool {
        let named = self.nth(1) == Kind::Name;
        named && !self.on_same_line() && self.meant(&keywords::with(DEVICE)).is_some()
    }

    /// Whether a part begins where another control's name is possible; certain on a new line.
    fn ends_controls(&self) -> bool {
        let whole = match self.word(0) {
            "signal" | "truth" => self.nth(1) == Kind::Name && self.nth(2) == Kind::Colon,
            _ => self.nth(1) == Kind::Name,
        };
        self.at_device_part() && (whole || !self.on_same_line()) || self.at_misspelt_part()
    }

    fn device_part(&mut self) {
        match self.word(0) {
            "press" | "stop" => self.press(),
            "fault" => self.fault(),
            _ => {
                self.open_item(Kind::Signal);
                self.keyword();
                self.port("give the signal a name");
                self.close_item();
            }
        }
    }

    fn press(&mut self) {
        self.open_item(Kind::Press);
        self.keyword();
        // On the line of the keyword, every name is a control.
        let mut named = self.at(Kind::Name) && (self.on_same_line() || !self.ends_controls());
        if named {
            while named {
                self.open_item(Kind::Control);
                self.take_name();
                self.close_item();
                named = self.at(Kind::Name) && !self.ends_controls() && !self.at_tool();
            }
        } else {
            self.expected_name("name the controls that can be pressed, such as 'press left right'");
        }
        self.close_item();
    }

    fn fault(&mut self) {
        self.open_item(Kind::Fault);
        self.keyword();
        self.name("give the fault a name");
        let opened = self.here();
        if self.eat(Kind::OpenParen) {
            self.open(Kind::Amount);
            self.port("name the amount of the fault, such as '(share: float = 0.5 from 0 to 1)'");
            self.value_and_range();
            self.close();
            self.close_bracket(Kind::CloseParen, opened);
        }
        self.close_item();
    }
}
