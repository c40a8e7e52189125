//! The rules of plain English that a pattern can find.

use regex::Regex;

/// The advice, words of which every hit contains one, a pattern of right words, and patterns of
/// wrong words.
type Row = (&'static str, &'static [&'static str], &'static str, &'static [&'static str]);

/// The rules that every sentence must keep.
const BLOCKING: &[Row] = &[
    (
        "name who reports what",
        &["told", "said"],
        "",
        &[
            r"\b(?:is|are|was|were|be|been|being|gets?) (?:also |only |not |still )?(?:told|said)\b",
            r"\bunless (?:told|said) otherwise\b",
            r"\bnot said\b",
        ],
    ),
    (
        "use a noun: the file, the caller, the value",
        &["what", "who", "which"],
        "",
        &[
            r"^(?:what|whatever|whoever|whom|who)\b",
            r"(?:; |: )(?:who|what|whoever|whatever) (?:is|are|was|were|has|have|had|can|cannot|must|may|does|do|did|[a-z]+s)\b",
            r"\b(?:of|by|for|with|from|beside|behind|than|round|and|or|that|is|are) (?:whoever|whatever|whichever|who|what)\b",
            r"\bwhoever\b",
            r"\bwhatever (?:is|was|stands|runs|reads|else|they|it|happens|comes)\b",
        ],
    ),
    (
        "write 'only' before the noun",
        &["alone"],
        r"\b(?:leave|leaves|leaving|left|it|them|robot) alone\b",
        &[r"\balone\b *(?:[.,;:)|]|$|(?:can|may|is|are|has|have)\b)"],
    ),
    (
        "write 'is available', 'exists', or name the place",
        &["there"],
        "",
        &[
            r"\b(?:is|are|was|were) there (?:where|in|on|at|twice|several|everywhere|by|for|before|already)\b",
            r"\b(?:that|which|who) (?:is|are|was|were) (?:not )?there\b",
            r"\b(?:it|they|one) (?:is|are|was|were) (?:not )?there\b",
            r"\bthat there (?:is|are)(?: not)?\b",
        ],
    ),
    (
        "write 'a different X', 'anything other than'",
        &["other"],
        "",
        &[r"\b(?:for )?another than\b", r"\bother ones\b"],
    ),
    (
        "use the everyday word",
        &[
            "shall",
            "anew",
            "afresh",
            "by and by",
            "so much as",
            "without a word",
            "but for",
            "need be",
            "choice",
            "for ever",
            "for good",
            "no news",
            "the like",
            "any more",
            "turn and",
            "lie",
            "to be",
            "that is to",
        ],
        "",
        &[
            r"\b(?:shall|anew|afresh|by and by|so much as|without a word|but for|need be)\b",
            r"\b(?:at your choice|for ever|for good|no news|the like|any more|turn and turn)\b",
            r"\blies? (?:in|on|outside|among|below|where)\b",
            r"\b(?:is|are|was|were) to be\b",
            r"\bthat is to\b",
        ],
    ),
    (
        "write 'generated' or 'random'",
        &["made up", " up"],
        "",
        &[r"\brooms? (?:that (?:is|are) )?made up\b", r"\bmakes? [a-z]+ up\b", r"\bmade up from\b"],
    ),
    (
        "state the rule instead",
        &["as "],
        r"\bas (?:it|they) (?:is|are) (?:possible|if)\b",
        &[
            r"\bas (?:people|beginners|programs|plans|a plan|the page|others|everybody|one) (?:writes?|likes?|knows?|have|has|does|do)\b",
            r"\bas (?:it|they) (?:is|are|was|were|stands?|comes?|goes?|knows?|would|lies)\b",
            r"\bas the (?:name|names|reader|reader's|file)[a-z '-]* (?:ends?|says|likes)\b",
            r"\bas (?:its|their) [a-z]+ (?:says|say|ends?|do|does)\b",
        ],
    ),
];

/// The rules with occasional wrong hits; the number of hits may only fall.
const COUNTED: &[Row] = &[
    (
        "split sentences of more than 30 words",
        &[" "],
        "",
        &[r"(?:\b[a-z][a-z'-]*(?u-i:[^a-zA-Z]+)){30}[a-z]"],
    ),
    (
        "repeat the noun",
        &["ones", "that", "those", "one"],
        "",
        &[
            r"\b(?:the|those|these|other|further|failed|global|local|inner|new|old|nested|kept|several|wrong|right|missing|real|such|later|older|generated) ones\b",
            r"(?:^|[,;:] )(?:that|those) of\b",
            r"\b(?:is|are|as|like|with|to|from) (?:that|those) (?:of|that|which|with|who)\b",
            r"\b(?:is|are|was) one (?:that|which|with)\b",
        ],
    ),
    (
        "write 'is written', 'comes', 'has stopped'",
        &["stand", "stood"],
        r"\b(?:stands?|stood) in the (?:way|lane)\b|\b(?:stands?|stood) [a-z]+ for\b",
        &[
            r"\b(?:stands?|stood) (?:in|at|behind|before|above|below|beside|there|here|between|outside|for itself|alone|on|twice)\b",
            r"\bwhere (?:it|they|nothing|something) stands?\b",
        ],
    ),
    (
        "write 'is not a', 'has no'",
        &["no"],
        r"\b(?:is|are|was|were) no (?:longer|more|need)\b|\bthere (?:is|are|was|were) no\b",
        &[r"\b(?:is|are|was|were) (?:no|none|nobody's)\b", r": none\b"],
    ),
    (
        "tools print, report or show",
        &["say", "tell", "know", "speak", "ask"],
        "",
        &[
            r"\b(?:page|file|line|table|message|column|help|code|log|summary|studio|plan|check|program|adapter|template|toolbox|robot|world|run|row|board|device|sensor|server|client|declaration|signal)s? (?:says?|tells?|knows?|speaks of|asks)\b",
            r"\b(?:says?|tells?) (?:so|nothing|something|which|what|how|whose|where|when|of)\b",
        ],
    ),
    (
        "use the usual word",
        &["mend", "text", "figures", "round", "way", "place", "blank", "beside", " on"],
        "",
        &[
            r"\b(?:mends?|mended|figures|texts|blanks?)\b",
            r"\bround (?:what|whatever|it|the|a)\b",
            r"\b(?:on (?:every|some|one|each)|every) way\b",
            r"\bin place of\b",
            r"\bbeside (?:the|it|its|a)\b",
            r"\b(?:go|goes|going|went|gone) on\b",
        ],
    ),
];

struct Rule {
    advice: &'static str,
    triggers: &'static [&'static str],
    right: Option<Regex>,
    wrong: Regex,
}

pub struct Rules(Vec<Rule>);

impl Rules {
    pub fn blocking() -> Self {
        Self::of(BLOCKING)
    }

    pub fn counted() -> Self {
        Self::of(COUNTED)
    }

    fn of(rows: &[Row]) -> Self {
        let pattern = |text: &str| Regex::new(&format!("(?i-u:{text})")).unwrap();
        let rule = |&(advice, triggers, right, wrong): &Row| Rule {
            advice,
            triggers,
            right: (!right.is_empty()).then(|| pattern(right)),
            wrong: pattern(&wrong.join("|")),
        };
        Self(rows.iter().map(rule).collect())
    }

    /// The advice and the words of each rule that a sentence breaks. A question breaks none.
    pub fn hits(&self, sentence: &str) -> Vec<(&'static str, String)> {
        if sentence.ends_with('?') {
            return Vec::new();
        }
        let lower = sentence.to_lowercase();
        let rules =
            self.0.iter().filter(|rule| rule.triggers.iter().any(|word| lower.contains(word)));
        rules.filter_map(|rule| Some((rule.advice, rule.words(sentence)?))).collect()
    }
}

impl Rule {
    fn words(&self, sentence: &str) -> Option<String> {
        let left = self.right.as_ref().map(|right| right.replace_all(sentence, ""));
        let text = left.as_deref().unwrap_or(sentence);
        let found = self.wrong.find(text)?;
        Some(found.as_str().trim().to_owned())
    }
}

#[test]
fn each_rule_finds_its_example() {
    let rules = Rules::blocking();
    let wrong = [
        "An unknown lamp is told first.",
        "Who has the pen may save.",
        "It is written on some states alone.",
        "A file that is not there.",
        "For another than the first.",
        "A lamp that shall blink.",
        "Rooms made up from a seed.",
        "Distances are written as people write them.",
    ];
    for sentence in wrong {
        assert_eq!(rules.hits(sentence).len(), 1, "{sentence}: {:?}", rules.hits(sentence));
    }
    let long = "Long ".repeat(31);
    let counted = Rules::counted();
    let wrong = [
        "The missing ones.",
        "It stands behind it.",
        "A is no B.",
        "The log says so.",
        "It mends it.",
        long.as_str(),
    ];
    for sentence in wrong {
        assert_eq!(counted.hits(sentence).len(), 1, "{sentence}: {:?}", counted.hits(sentence));
    }
    for sentence in ["What next?", "Leave the robot alone.", "As fast as it is possible."] {
        assert_eq!(rules.hits(sentence), [], "{sentence}");
    }
}
