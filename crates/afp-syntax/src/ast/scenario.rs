use super::bind::binds;
use super::{Bind, Formula, Name, Ref, child, children, find_token, keyword, token, tokens, views};
use crate::Node;
use crate::kind::Kind;
use afp_types::Target;

views! {
    Scenario
    Line
    Action
    Claim
    /// `always`, `once`, `within 3 ms` and others.
    Bound
    /// `a.b.c`
    Path
}

#[derive(Clone, Debug)]
pub enum LineKind {
    /// `world "file"`, quotes included.
    World(Option<Name>),
    /// `seed 7`
    Seed(Option<Name>),
    /// `over seeds 0..20`: the first seed, and the end (excluded).
    OverSeeds(Option<Name>, Option<Name>),
    /// `over worlds "file", "file"`, quotes included.
    OverWorlds(Vec<Name>),
    /// `set path = formula`
    Set(Option<Path>, Option<Formula>),
    /// `robot at (x, y) heading angle`; the angle may be missing.
    Robot(Vec<Formula>),
    /// `at time: action`
    Stimulus(Option<Formula>, Option<Action>),
    /// `expect` or `never`.
    Expect {
        /// Whether it is `never`.
        never: bool,
        claim: Option<Claim>,
        bounds: Vec<Bound>,
    },
    /// `from claim { lines }`
    Moment(Option<Claim>, Vec<Line>),
    /// `until time`
    Until(Option<Formula>),
}

#[derive(Clone, Debug)]
pub enum ClaimKind {
    /// `from -> to by cause`
    Transition {
        /// The element that ends.
        from: Path,
        /// The next element.
        to: ClaimTarget,
        /// The cause.
        by: Option<Path>,
    },
    /// `path active`
    Active(Path),
    /// `path suspended`
    Suspended(Path),
    /// `entry == formula`
    Compare(Path, Name, Option<Formula>),
    /// `running`
    Running,
    /// `end by cause`
    End(Option<Path>),
    /// `interrupt of path`
    Interrupt(Path),
    /// `commit of entry by author`; one of the two may be missing.
    Commit {
        /// The entry.
        of: Option<Path>,
        by: Option<Path>,
    },
    /// A state, an event or a fact of the world.
    Fact(Path),
    /// A claim that cannot be read; already reported.
    Hole,
}

/// The target of an element in a claim; never `ignore`.
pub type ClaimTarget = Target<Path, ()>;

impl Scenario {
    /// Its name, quotes included.
    pub fn name(&self) -> Option<Name> {
        token(&self.node, Kind::Text, self.file)
    }

    /// The plan after `for`.
    pub fn plan(&self) -> Option<Ref> {
        child(&self.node, Kind::Ref).map(|node| Ref::new(node, self.file))
    }

    pub fn lines(&self) -> Vec<Line> {
        lines(&self.node, self.file)
    }
}

fn lines(node: &Node, file: u16) -> Vec<Line> {
    let lines = node.children().filter(|node| {
        matches!(
            node.kind(),
            Kind::World
                | Kind::Seed
                | Kind::Over
                | Kind::Set
                | Kind::Robot
                | Kind::Stimulus
                | Kind::Expect
                | Kind::Moment
                | Kind::Until
        )
    });
    lines.map(|node| Line::new(node, file)).collect()
}

impl Line {
    pub fn kind(&self) -> LineKind {
        let first = || Formula::child_of(&self.node, self.file);
        match self.node.kind() {
            Kind::World => LineKind::World(self.token(Kind::Text)),
            Kind::Seed => LineKind::Seed(self.token(Kind::Int)),
            Kind::Over if self.is_over("worlds") => {
                LineKind::OverWorlds(tokens(&self.node, Kind::Text, self.file))
            }
            Kind::Over => {
                let mut seeds = tokens(&self.node, Kind::Int, self.file).into_iter();
                LineKind::OverSeeds(seeds.next(), seeds.next())
            }
            Kind::Set => LineKind::Set(path(&self.node, self.file), first()),
            Kind::Robot => LineKind::Robot(Formula::children_of(&self.node, self.file)),
            Kind::Stimulus => LineKind::Stimulus(
                first(),
                child(&self.node, Kind::Action).map(|node| Action::new(node, self.file)),
            ),
            Kind::Moment => LineKind::Moment(self.claim(), lines(&self.node, self.file)),
            Kind::Until => LineKind::Until(first()),
            _ => LineKind::Expect {
                never: keyword(&self.node) == "never",
                claim: self.claim(),
                bounds: children(&self.node, Kind::Bound)
                    .map(|node| Bound::new(node, self.file))
                    .collect(),
            },
        }
    }

    /// Its first word.
    pub fn keyword(&self) -> String {
        keyword(&self.node)
    }

    fn claim(&self) -> Option<Claim> {
        child(&self.node, Kind::Claim).map(|node| Claim::new(node, self.file))
    }

    fn token(&self, kind: Kind) -> Option<Name> {
        token(&self.node, kind, self.file)
    }

    fn is_over(&self, word: &str) -> bool {
        tokens(&self.node, Kind::Keyword, self.file).iter().any(|token| token.text == word)
    }
}

impl Action {
    /// The word for the action.
    pub fn verb(&self) -> Option<Name> {
        token(&self.node, Kind::Keyword, self.file)
    }

    /// The object of the action.
    pub fn path(&self) -> Option<Path> {
        path(&self.node, self.file)
    }

    /// The formula of `set`.
    pub fn value(&self) -> Option<Formula> {
        Formula::child_of(&self.node, self.file)
    }

    /// The time after `for`.
    pub fn duration(&self) -> Option<Formula> {
        Formula::child_of(&self.node, self.file).filter(|_| self.has("for"))
    }

    /// The bindings in brackets.
    pub fn binds(&self) -> Vec<Bind> {
        binds(&self.node, self.file)
    }

    fn has(&self, word: &str) -> bool {
        tokens(&self.node, Kind::Keyword, self.file).iter().any(|token| token.text == word)
    }
}

impl Claim {
    pub fn paths(&self) -> Vec<Path> {
        children(&self.node, Kind::Path).map(|node| Path::new(node, self.file)).collect()
    }

    pub fn kind(&self) -> ClaimKind {
        let mut paths = children(&self.node, Kind::Path).map(|node| Path::new(node, self.file));
        let has = |word: &str| {
            tokens(&self.node, Kind::Keyword, self.file).iter().any(|token| token.text == word)
        };
        let by = has("by");
        if has("running") {
            return ClaimKind::Running;
        }
        if has("end") {
            return ClaimKind::End(paths.next());
        }
        if has("commit") {
            let of = if has("of") { paths.next() } else { None };
            let by = if by { paths.next() } else { None };
            return ClaimKind::Commit { of, by };
        }
        if has("interrupt") {
            return paths.next().map_or(ClaimKind::Hole, ClaimKind::Interrupt);
        }
        let Some(first) = paths.next() else { return ClaimKind::Hole };
        if token(&self.node, Kind::Arrow, self.file).is_some() {
            let words = [
                ("terminate", ClaimTarget::Terminate),
                ("fail", ClaimTarget::Fail(())),
                ("resume", ClaimTarget::Resume),
                ("return", ClaimTarget::Return),
            ];
            let word = words.into_iter().find(|(word, _)| has(word)).map(|(_, target)| target);
            let element = if has("suspend") { ClaimTarget::Suspend } else { ClaimTarget::Element };
            let to = word.or_else(|| paths.next().map(element));
            let by = if by { paths.next() } else { None };
            return match to {
                Some(to) => ClaimKind::Transition { from: first, to, by },
                None => ClaimKind::Hole,
            };
        }
        let comparison = find_token(&self.node, self.file, |kind, text, span| {
            kind.is_comparison().then(|| Name { text: text.to_owned(), span })
        });
        match comparison {
            Some(sign) => ClaimKind::Compare(first, sign, Formula::child_of(&self.node, self.file)),
            None if has("active") => ClaimKind::Active(first),
            None if has("suspended") => ClaimKind::Suspended(first),
            None => ClaimKind::Fact(first),
        }
    }
}

impl Bound {
    /// `always`, `once`, `times`, `within`, `before` or `after`.
    pub fn word(&self) -> String {
        keyword(&self.node)
    }

    /// The number before `times`.
    pub fn number(&self) -> Option<Name> {
        token(&self.node, Kind::Int, self.file)
    }

    pub fn time(&self) -> Option<Formula> {
        Formula::child_of(&self.node, self.file)
    }
}

impl Path {
    pub fn names(&self) -> Vec<Name> {
        tokens(&self.node, Kind::Name, self.file)
    }

    /// The names, joined by points.
    pub fn text(&self) -> String {
        self.names().iter().map(|name| name.text.as_str()).collect::<Vec<_>>().join(".")
    }
}

fn path(node: &Node, file: u16) -> Option<Path> {
    child(node, Kind::Path).map(|node| Path::new(node, file))
}
