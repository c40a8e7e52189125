use super::{MAX_DEPTH, Parser};
use crate::diagnostics::{Subject, list};
use crate::keywords::{self, LINE};
use crate::kind::Kind;
use crate::message;

const LINE_HELP: &str =
    "write 'world', 'seed', 'over', 'set', 'robot', 'at', 'from', 'expect', 'never' or 'until'";

impl Parser<'_, '_> {
    pub(super) fn scenario(&mut self) {
        self.open_item(Kind::Scenario);
        self.keyword();
        self.expect(Kind::Text, "give the scenario a name in double quotes");
        if self.eat_meant("for", |next| next == Kind::Name) {
            self.reference();
        } else {
            self.expected("'for'", "write 'for' and the name of a plan");
        }
        self.in_scenario = true;
        self.lines();
        self.in_scenario = false;
        self.close_item();
    }

    /// Whether a line of the present scenario begins here, so that a value is impossible.
    pub(super) fn begins_scenario_line(&self) -> bool {
        let goes_on = matches!(self.nth(1), Kind::Name | Kind::Text | Kind::Int | Kind::Float);
        self.in_scenario && self.at_line() && goes_on && !self.begins_line(1)
    }

    /// The lines of a scenario or of one of its moments.
    fn lines(&mut self) {
        let opened = self.here();
        if self.expect(Kind::OpenBrace, "put the scenario's lines in braces") {
            while !self.at_end() && !self.at(Kind::CloseBrace) && !self.at_top_item() {
                self.repeat(|parser| {
                    let what = "a line of the scenario";
                    if parser.at_word("always") && parser.claims_behind() {
                        parser.always_first();
                    } else if parser.action_without_its_time() || parser.time_first() {
                        // Already reported.
                    } else if parser.at_line() || parser.item_meant(what, &keywords::with(LINE)) {
                        parser.line();
                    } else {
                        parser.skip(what, LINE_HELP, |p| {
                            p.at_line() || p.at(Kind::CloseBrace) || p.at_top_item()
                        });
                    }
                });
            }
            self.close_bracket(Kind::CloseBrace, opened);
        }
    }

    pub(super) fn at_line(&self) -> bool {
        is_line(self.word(0))
    }

    fn line(&mut self) {
        let first = self.word(0);
        match first {
            "world" => {
                self.open_item(Kind::World);
                self.keyword();
                self.no_sign_behind_word();
                self.expect(Kind::Text, "write the world's file in double quotes");
            }
            "seed" => {
                self.open_item(Kind::Seed);
                self.keyword();
                self.no_sign_behind_word();
                self.whole_number("write a whole number");
            }
            "over" => self.over(),
            "set" => {
                self.open_item(Kind::Set);
                self.set();
            }
            "robot" => self.robot(),
            "at" => {
                self.open_item(Kind::Stimulus);
                self.keyword();
                self.quantity("write a time such as '2 s'");
                self.expect(Kind::Colon, "write ':' and an action");
                self.action();
            }
            "from" => self.moment(),
            "until" => {
                self.open_item(Kind::Until);
                self.keyword();
                self.no_sign_behind_word();
                self.quantity("write a time such as '60 s'");
            }
            _ => self.expectation(),
        }
        // A moment ends with its braces.
        if first != "from" {
            self.nothing_behind(first);
        }
        self.close_item();
    }

    /// `over seeds 0..20` or `over worlds "a.toml", "b.toml"`
    fn over(&mut self) {
        self.open_item(Kind::Over);
        self.keyword();
        if self.eat_meant("seeds", |next| next == Kind::Int) {
            let whole = self.whole_number("write the first seed, such as '0..20'");
            if whole && self.eat(Kind::Dot) && self.expect(Kind::Dot, "write '0..20'") {
                self.whole_number("write the number after the last seed");
            } else if whole {
                self.expected("'..'", "write the seeds as '0..20', of which the last is 19");
            }
        } else if self.eat_meant("worlds", |next| next == Kind::Text) {
            self.expect(Kind::Text, "write the worlds' files in double quotes");
            // Any other comma ends the line.
            while self.nth(1) == Kind::Text && self.eat(Kind::Comma) {
                self.eat(Kind::Text);
            }
        } else {
            self.expected("'seeds' or 'worlds'", "write 'over seeds 0..20'");
        }
    }

    /// `from go active { ... }`
    fn moment(&mut self) {
        self.open_item(Kind::Moment);
        self.keyword();
        self.open(Kind::Claim);
        self.claim();
        self.close();
        if self.depth >= MAX_DEPTH {
            return self.too_deep();
        }
        self.depth += 1;
        self.lines();
        self.depth -= 1;
    }

    fn set(&mut self) {
        self.keyword();
        self.path();
        if self.expect(Kind::Equal, "write '=' and a value") {
            self.formula();
        }
    }

    fn robot(&mut self) {
        self.open_item(Kind::Robot);
        self.keyword();
        if !self.eat_word("at") {
            self.expected("'at'", "write 'robot at (0.5 m, 2 m) heading 0 deg'");
        }
        let opened = self.here();
        let commas = self.commas_in_brackets();
        if self.expect(Kind::OpenParen, "write the place in brackets") {
            // With several commas, one separates the coordinates.
            self.with_commas(commas < 2, |parser| {
                parser.formula();
                parser.expect(Kind::Comma, "write the second coordinate after a comma");
                parser.formula();
                parser.heading_in_brackets();
            });
            self.close_bracket(Kind::CloseParen, opened);
        }
        if self.eat_meant("heading", Kind::begins_formula) {
            self.formula();
        }
    }

    fn action(&mut self) {
        self.open(Kind::Action);
        if self.at_word("set") {
            self.set();
        } else if self.at(Kind::Name) && (self.on_same_line() || !self.at_line()) {
            self.keyword();
            self.path();
            if self.at(Kind::OpenParen) {
                self.args(false);
            }
            if self.eat_word("for") {
                self.quantity("write a time such as '500 ms'");
            }
        } else {
            self.expected(
                "an action",
                "write an action, such as 'idle all' or 'press' and a control",
            );
        }
        self.close();
    }

    fn expectation(&mut self) {
        let first = self.at;
        self.open_item(Kind::Expect);
        self.keyword();
        self.misplaced_word();
        self.claim_with_bounds();
        self.never_behind(first);
    }

    fn claim_with_bounds(&mut self) {
        self.open(Kind::Claim);
        self.claim();
        self.close();
        loop {
            match self.word(0) {
                // On a new line it begins another claim, with the word in the wrong place.
                "always" if !self.on_same_line() && self.claims_behind() => break,
                "always" | "once" => {
                    self.open(Kind::Bound);
                    self.keyword();
                    self.close();
                }
                _ if self.at(Kind::Int) && self.word(self.tokens_of_number()) == "times" => {
                    self.open(Kind::Bound);
                    self.whole_number("write a whole number");
                    self.keyword();
                    self.close();
                }
                "within" | "before" | "after" => {
                    self.open(Kind::Bound);
                    self.keyword();
                    self.quantity("write a time such as '3 ms'");
                    self.close();
                }
                _ if self.bound_meant() => {}
                _ => break,
            }
        }
    }

    /// `befor 3 s`: reports a misspelt word and reads it as the correct one. Returns whether it
    /// did.
    fn bound_meant(&mut self) -> bool {
        let before_time = matches!(self.nth(1), Kind::Int | Kind::Float) && !self.begins_line(1);
        let known: &[&'static str] = match before_time {
            true => &["within", "before", "after"],
            false => &["always", "once"],
        };
        let meant = known.iter().copied().find(|word| self.at_slip(word));
        let Some(meant) = meant.filter(|_| !self.at_line()) else { return false };
        self.read_as(meant, message!("{}", list(known.iter().copied(), "or")));
        true
    }

    /// Reports a misplaced word before a claim: `expect never end`.
    fn misplaced_word(&mut self) {
        let help = match self.word(0) {
            "never" | "not" => "write 'never' instead of 'expect'",
            "always" | "once" => "write it after the claim",
            "expect" => "write either 'expect' or 'never'",
            _ => return,
        };
        let goes_on = ["active", "always", "once", "within", "before", "after", "by"];
        let claimed = self.nth(1) == Kind::Name && !is_line(self.word(1));
        if claimed && self.on_same_line() && !goes_on.contains(&self.word(1)) {
            match self.word(0) {
                "never" | "not" => {
                    let place = self.place_between(self.at.saturating_sub(1), self.at + 1);
                    let error = self.instead_of(self.next_span(), "a claim");
                    self.error(error.help(help).fix(place, "never"));
                }
                _ => self.expected("a claim", help),
            }
            self.keyword();
        }
    }

    /// Whether a claim follows the present word on its line.
    fn claims_behind(&self) -> bool {
        self.nth(1) == Kind::Name && !self.begins_line(1) && !is_line(self.word(1))
    }

    /// `always x > 1`, by analogy with `never x > 1`.
    fn always_first(&mut self) {
        self.open_item(Kind::Expect);
        let help = "write 'expect' instead, and 'always' after the claim";
        self.missing(self.next_span(), "'expect'", help, Subject::Other);
        self.keyword();
        self.claim_with_bounds();
        self.close_item();
    }

    fn claim(&mut self) {
        let is_active = self.word(1) == "active" && !self.begins_line(1);
        let is_path = is_active
            || matches!(self.nth(1), Kind::Dot | Kind::Arrow)
            || self.nth(1).is_comparison();
        if !is_path && self.at_word("running") {
            return self.keyword();
        }
        if !is_path && self.eat_word("end") {
            return self.by();
        }
        match (self.word(0), self.word(1)) {
            ("interrupt", "of") => {
                self.keyword();
                self.keyword();
                return self.path();
            }
            ("commit", "of" | "by") => {
                self.keyword();
                if self.eat_word("of") {
                    self.path();
                }
                return self.by();
            }
            _ => {}
        }
        self.path();
        if self.eat(Kind::Arrow) {
            let words = ["terminate", "fail", "resume", "return"];
            if self.eat_word("suspend") || !words.iter().any(|word| self.eat_word(word)) {
                self.path();
            }
            self.by();
        } else if self.unequal_meant() {
            self.formula();
        } else if self.nth(0).is_comparison() || self.comparison_meant() {
            // '=' is read as '=='.
            self.bump_as(if self.at(Kind::Equal) { Kind::EqualEqual } else { self.nth(0) });
            self.formula();
        } else if !self.eat_word("suspended") {
            self.eat_meant("active", |_| true);
        }
    }

    fn by(&mut self) {
        if self.eat_word("by") {
            self.path();
        }
    }
}

pub(super) fn is_line(word: &str) -> bool {
    keywords::has(word, LINE)
}
