//! The kinds of tokens and nodes of the lossless tree.

macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident)*) => {
        /// The kind of a token or node.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u16)]
        pub enum Kind {
            $($(#[$doc])* $kind,)*
        }

        impl Kind {
            const ALL: &'static [Kind] = &[$(Kind::$kind),*];
        }
    };
}

kinds! {
    /// Spaces and line breaks.
    Whitespace
    /// `// ...` to the end of the line.
    Comment
    /// `/// ...` to the end of the line.
    Doc
    /// `/* ... */`, an error.
    BlockComment
    Name
    /// A word of the grammar where the grammar expects it.
    Keyword
    Int
    /// Digits with a point or an exponent.
    Float
    /// A unit on its number's line.
    Unit
    /// A string in double quotes.
    Text
    /// `(`
    OpenParen
    /// `)`
    CloseParen
    /// `{`
    OpenBrace
    /// `}`
    CloseBrace
    /// `[`, reserved
    OpenBracket
    /// `]`, reserved
    CloseBracket
    /// `@`, reserved
    At
    /// `,`
    Comma
    /// `:`
    Colon
    /// `.`
    Dot
    /// `=`
    Equal
    /// `=>`
    FatArrow
    /// `->`
    Arrow
    /// `+`
    Plus
    /// `-`
    Minus
    /// `*`
    Star
    /// `/`
    Slash
    /// `%`
    Percent
    /// `^`
    Caret
    /// `|`
    Pipe
    /// `==`
    EqualEqual
    /// `!=`
    NotEqual
    /// `<`
    Less
    /// `<=`
    LessEqual
    /// `>`
    Greater
    /// `>=`
    GreaterEqual
    Unknown
    /// The end of the file; never in a tree.
    End

    /// Text that fits nowhere, an error.
    Error
    File
    /// `afp 1`
    Version
    /// `use carbot as c`
    Use
    /// `as c`
    Alias
    Plan
    /// `in`, `out`, `var`, `const`
    Entry
    /// `start first`
    Start
    /// An actor, a computation or a sub-plan of a plan.
    Element
    /// A supervisor of a plan.
    Guard
    /// `on keys { Start -> drive }`
    Reactions
    /// `every 10 ms` or another time.
    Timing
    /// `State -> target`
    Edge
    /// The target of an edge or output.
    Target
    /// `(...)` after a reference.
    Args
    /// `port = formula`
    BindIn
    /// `port => entry`
    BindOut
    /// `goal`: short for `goal = goal`, or for `goal => goal` at an output
    BindSame
    /// The head and the tools of a toolbox.
    Toolbox
    /// `object Map`
    Object
    Enum
    /// A value of an enum.
    Variant
    /// A table of constants.
    Table
    Columns
    /// `name: type`
    Column
    /// A row of a table in its brackets.
    Row
    /// A value of a row.
    Cell
    Template
    /// `icon "name"`
    Icon
    /// `uses navigator`
    Uses
    /// `state S when a < b { out = formula }`, `event E when a < b` or `event E after time`
    Outcome
    /// `after time` of an event
    After
    /// `exclusive E F when a < other.b`
    Exclusive
    /// `when a < b and c == d`
    When
    /// `a < b` in a condition
    Comparison
    /// `states of port`
    StatesOf
    /// `in live port: type = formula from formula to formula`
    InPort
    /// `out port: type on S | T`
    OutPort
    /// `device wheels { ... }`, `sensor bumper { ... }` or `robot { ... }`
    Device
    /// `press left right` or `stop escape`
    Press
    /// A control after `press` or `stop`.
    Control
    /// `fault slip(...)`
    Fault
    /// `share: type = formula from formula to formula`
    Amount
    /// `signal left: type` or `truth pose: type`
    Signal
    /// `from formula to formula`
    Range
    /// `on S | T`
    On
    Scenario
    /// `world "file"`
    World
    /// `seed 7`
    Seed
    /// `over seeds 0..20` or `over worlds "file", "file"`
    Over
    /// `set path = formula`
    Set
    /// `robot at (x, y) heading angle`
    Robot
    /// `at 2 s: action`
    Stimulus
    /// `press touch`
    Action
    /// `expect` or `never` with a claim and bounds.
    Expect
    /// An expected fact.
    Claim
    /// `always`, `within 3 ms` and others.
    Bound
    /// `until 60 s`
    Until
    /// `from go active { ... }`: lines of a scenario whose times count from that moment.
    Moment
    /// `a.b.c`
    Path
    Type
    /// A factor of a type.
    Factor
    /// `name` or `home.name`
    Ref
    /// Terms with `+` and `-`.
    Sum
    /// Operands with `*`, `/` and `%`.
    Product
    /// `-operand`
    Negation
    Brackets
    /// `min(a, b)`
    Call
    /// A number, quantity, text or truth value.
    Literal
}

impl Kind {
    /// Whether a formula may begin with such a token.
    pub(crate) fn begins_formula(self) -> bool {
        matches!(self, Kind::Int | Kind::Float | Kind::Minus | Kind::Name | Kind::OpenParen)
    }

    /// Whether tokens of this kind carry no meaning.
    pub fn is_trivia(self) -> bool {
        matches!(self, Kind::Whitespace | Kind::Comment | Kind::Doc | Kind::BlockComment)
    }

    /// Whether the grammar never uses tokens of this kind.
    pub(super) fn is_passed_over(self) -> bool {
        self.is_trivia() || self == Kind::Unknown
    }

    pub(super) fn is_comparison(self) -> bool {
        use Kind::{EqualEqual, Greater, GreaterEqual, Less, LessEqual, NotEqual};
        matches!(self, EqualEqual | NotEqual | Less | LessEqual | Greater | GreaterEqual)
    }

    /// The name of an expected token in diagnostics.
    pub(super) fn describe(self) -> &'static str {
        match self {
            Kind::Name => "a name",
            Kind::Int => "a whole number",
            Kind::Text => "a string in double quotes",
            Kind::OpenParen => "'('",
            Kind::CloseParen => "')'",
            Kind::OpenBrace => "'{'",
            Kind::CloseBrace => "'}'",
            Kind::Colon => "':'",
            Kind::Comma => "','",
            Kind::Equal => "'='",
            Kind::Arrow => "'->'",
            _ => "something else",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Afp {}

impl rowan::Language for Afp {
    type Kind = Kind;

    fn kind_from_raw(raw: rowan::SyntaxKind) -> Kind {
        Kind::ALL.get(usize::from(raw.0)).copied().unwrap_or(Kind::Error)
    }

    fn kind_to_raw(kind: Kind) -> rowan::SyntaxKind {
        rowan::SyntaxKind(kind as u16)
    }
}
