//! Habits of other languages: a pattern, the error, and the plan text with the same meaning.
//!
//! This is the only table of habits; `words` has single words. A pattern is a list of tokens with
//! spaces between them. The parser searches it on one line if a token does not fit the grammar:
//!
//! - `NAME` is a name, `STATE` a name with a capital letter, `ENTRY` the name of an entry, and
//!   `SAME` the first name again. `NUM` is a number with its unit, `TEXT` a string without its
//!   quotes. `..` is everything up to the next token of the pattern, or to the end of the line,
//!   with brackets and braces as a whole. Each of these is captured.
//! - `GOAL` is the name of a target, with or without quotes, `.` or `#`; the name is captured.
//! - `a|b` is an alternative, which is not captured. An empty alternative, as in `|:`, is optional.
//! - Any other word or sign is itself; `PIPE` and `POWER` are '|' and '^'. A ';' is skipped unless the
//!   pattern has one. At items, a word matches in any case of letters; everywhere also the word of
//!   another natural language.
//! - `^` is the place where parsing continues, by default the end of the pattern.
//!
//! In the sentences `{1}` is a capture. Other words in braces are placeholders of `elsewhere`.

mod actions;
mod sensors;
mod sentences;
mod words;

pub(crate) use actions::action;
pub(crate) use sensors::Sensor;
use sentences::{
    ACTION, BACK, BESIDE, CALLED, CHANGED, CHOICE, CHOOSE, CHOSEN, COUNTED, COUNTS_UP,
    EDGE_OUTSIDE, FUNCTION, LATE, LIMIT, LOG, LOOP, NEXT_ELEMENT, NO_CALL, NO_CLOCK, NO_COMMA,
    NO_FORMULA_IF, NO_HISTORY, NO_HOOK, NO_IF, NO_LIST, NO_MESSAGES, NO_OBJECT, NO_SENSOR,
    PARALLEL, PLAN_OF_ITS_OWN, SEQUENCE, SET_BEFORE, SHOW, TABLE, TIME_LIMIT, TIMED, TIMED_BESIDE,
    WAITS, WATCH, WRITES,
};
pub use words::{ENDS, REACTIONS, RETURN, RETURNS, STATES, TYPES, ours};
pub(crate) use words::{WORDS, converted, english, is_foreign_for};

/// Where habits are looked for, one bit each.
pub(crate) type Places = u16;

/// Where an item of a file begins.
pub(crate) const FILE: Places = 1;
/// Where an item of a plan begins.
pub(crate) const PLAN: Places = 1 << 1;
/// Where a part of an element's body begins.
pub(crate) const BODY: Places = 1 << 2;
/// Where an edge of a supervisor begins.
pub(crate) const EVENTS: Places = 1 << 3;
/// After the arrow of an edge.
pub(crate) const TARGET: Places = 1 << 4;
/// After the target of an edge.
pub(crate) const BEHIND: Places = 1 << 5;
/// Where an operand of a formula begins.
pub(crate) const VALUE: Places = 1 << 6;
/// After an operand.
pub(crate) const OPERATOR: Places = 1 << 7;
/// After a template and its ports, before the braces.
pub(crate) const HEAD: Places = 1 << 8;
/// Where the template of an element is.
pub(crate) const TEMPLATE: Places = 1 << 9;
const EDGES: Places = BODY | EVENTS;
const ITEMS: Places = FILE | PLAN;
const INSIDE: Places = PLAN | BODY;

/// The action of a help.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Write {
    /// Replaces the pattern by this text.
    Edit(&'static str),
    /// Shows this text.
    Say(&'static str),
    /// Removes the pattern, and shows this text.
    Drop(&'static str),
}
use Write::{Drop, Edit, Say};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Habit {
    pub at: Places,
    pub pattern: &'static str,
    /// The error.
    pub says: &'static str,
    pub write: Write,
}

const fn habit(at: Places, pattern: &'static str, says: &'static str, write: Write) -> Habit {
    Habit { at, pattern, says, write }
}

pub(crate) const GUARD: &str = "an edge has no condition: lead it to a computation that chooses";

/// Where a sign of a choice is written that no plan text can be given for.
pub(crate) const BRANCH: &str =
    "let a computation such as 'Compare' or 'Is' of 'std' choose the way";

/// Every habit; of those that fit the first counts.
#[rustfmt::skip]
pub(crate) const HABITS: &[Habit] = &[
    // Times.
    habit(INSIDE, "delay ( NUM )", WAITS, Say("write 'actor wait: Wait(duration = {ms:1}) { Elapsed -> {here} }' in the plan")),
    habit(BODY, "after|at|tm|timeout ( NUM , s|sec|second|seconds ) ->|=>|: GOAL", TIME_LIMIT, Edit("supervise late: CheckTimeout(duration = {s:1}) { TimedOut -> {2} }")),
    habit(BODY, "after|at|tm|timeout ( NUM , ms|msec ) ->|=>|: GOAL", TIME_LIMIT, Edit(LATE)),
    habit(BODY, "after|at|tm|timeout |: |( NUM |) ->|=>|: GOAL", TIME_LIMIT, Edit(LATE)),
    habit(BODY, "after |: |{ NUM : GOAL |}", TIME_LIMIT, Edit(LATE)),
    habit(BODY, "after NUM / .. ->|=> NAME", TIME_LIMIT, Edit("supervise late: CheckTimeout(duration = {ms:1}) { TimedOut -> {3} }")),
    habit(PLAN | EVENTS, "after |: NUM ->|=>|: GOAL", TIME_LIMIT, Say(LIMIT)),
    habit(BODY, "after|at |: [ { delay : NUM , target : GOAL ..", TIME_LIMIT, Edit(LATE)),
    habit(BODY, "after|at |: { NUM : { target : GOAL ..", TIME_LIMIT, Edit(LATE)),
    habit(BODY, "after|at ( NUM , s|sec|second|seconds ) [ .. ] ->|=> GOAL", TIME_LIMIT, Say("write 'supervise late: CheckTimeout(duration = {s:1}) { TimedOut -> choose }', and in the plan: '{choose:2:3}'")),
    habit(BODY, "after|at |( NUM |) / .. ->|=> GOAL", TIME_LIMIT, Edit("supervise late: CheckTimeout(duration = {ms:1}) { TimedOut -> {3} }")),
    habit(BODY, "every|temporalCount ( NUM , .. ) ->|=> GOAL", "a plan has no '{word}' edge: a supervisor reports repeatedly", Edit("supervise tick: Every(period = {s:1}) { Due -> {3} }")),
    habit(BODY, "after|timeout|delay |: ..", TIME_LIMIT, Say(TIMED)),
    habit(PLAN, "timer|every |: |( NUM |) ->|=>|: GOAL", "a plan has no '{word}': a supervisor reports repeatedly", Edit("supervise tick: Every(period = {ms:1}) { Due -> {2} }")),
    habit(INSIDE, "timeout ( NUM ) ..", TIME_LIMIT, Say("write in the element's braces: 'supervise late: CheckTimeout(duration = {1}) { TimedOut -> {here} }'")),
    habit(PLAN, "timeout|after ..", TIME_LIMIT, Say(TIMED)),
    habit(PLAN, "timer|every NAME : NUM ..", "a plan has no '{word}': a supervisor reports repeatedly", Say("write 'supervise {1}: Every(period = {2}) { Due -> {here} }'")),
    habit(PLAN, "rate NUM ..", "a plan has no '{word}': a supervisor reports repeatedly", Say("write 'supervise tick: Every(period = 1 / {1}) { Due -> {here} }'")),

    habit(HEAD, "timeout_ms|timeoutMs |:|=|( NUM |)", TIME_LIMIT, Drop("remove it, and write in the braces: 'supervise late: CheckTimeout(duration = {ms:1}) { TimedOut -> terminate }'")),
    habit(HEAD, "timeout|within|for|max |:|=|( NUM |)", TIME_LIMIT, Drop("remove it, and write in the braces: 'supervise late: CheckTimeout(duration = {s:1}) { TimedOut -> terminate }'")),
    habit(HEAD, "&|&&|+|and NAME ( .. )", PARALLEL, Drop("remove it; for both, watch with a supervisor such as 'Blink' in the braces")),
    habit(HEAD, "&|&&|+|and NAME", PARALLEL, Drop("remove it; for both, watch with a supervisor such as 'Blink' in the braces")),
    habit(PLAN, "timeout ( NUM ) ^ actor|subplan NAME", TIME_LIMIT, Drop("remove it, and write in the braces of '{2}': 'supervise late: CheckTimeout(duration = {s:1}) { TimedOut -> terminate }'")),

    // Conditions.
    habit(PLAN, "when|on|if started|start|begin|run ->|:|then NAME", "a plan begins with 'start'", Edit("start {1}")),
    habit(PLAN, "when|on|if |green flag|program|run|script clicked|starts|started|begins ..", "a plan begins with 'start'", Say("remove it: 'start' names the first element")),
    habit(PLAN, "match|switch |( NAME |) { NAME -> .. }", NO_IF, Edit("computation choose: Switch(value = {1}) { {2} -> {3} }")),
    habit(EDGES, "NAME PIPE PIPE NAME ->|=> NAME", NO_COMMA, Edit("{1}, {2} -> {3}")),
    habit(EDGES, "NAME && NAME ->|=> NAME", NO_COMMA, Edit("{1}, {2} -> {3}")),
    habit(EDGES, "NAME PIPE PIPE NAME PIPE PIPE NAME ->|=> NAME", NO_COMMA, Edit("{1}, {2}, {3} -> {4}")),
    habit(BODY, "STATE : TEXT", "'->' leads from a state or event to its target", Edit("{1} -> {2}")),
    habit(EDGES, "STATE < - NAME", "'->' leads from a state or event to its target", Edit("{1} -> {2}")),
    habit(EDGES, "always |: [| { target : GOAL , guard|cond : .. } ..", GUARD, Say("remove it, lead the edges that lead here to 'choose', and write in the plan: '{choose:2:1}'")),
    habit(EDGES, "always |: [| { guard|cond : .. , target : GOAL } ..", GUARD, Say("remove it, lead the edges that lead here to 'choose', and write in the plan: '{choose:1:2}'")),
    habit(BODY, "[ .. ] ->|=> NAME", GUARD, Say("lead the edges that lead here to 'choose', and write in the plan: '{choose:1:2}'")),
    habit(EDGES, "-|*|+ NAME -> NAME", "an edge begins with its state or event", Edit("{1} -> {2}")),
    habit(EDGES, "NAME [ .. ] { .. } ->|=> NAME", GUARD, Say("write '{1} -> choose', and in the plan: '{choose:2:4}'")),
    habit(PLAN | EDGES, "if|when |( .. ) { start|goto|go|run|-> NAME }", NO_IF, Say("write '{choose:1:2}'")),
    habit(EDGES, "NAME when|if|unless|where|while .. ->|=> NAME", GUARD, Say(CHOOSE)),
    habit(EDGES, "always [ .. ] ->|=>|: NAME", GUARD, Say("lead the edges that lead here to 'choose', and write in the plan: '{choose:1:2}'")),
    habit(EDGES, "NAME [ else|otherwise ] ->|=> GOAL", "each state and event has its own edge, without 'else'", Edit("{1} -> {2}")),
    habit(EDGES, "NAME [ .. ] ->|=> NAME", GUARD, Say(CHOOSE)),
    habit(EDGES, "NAME [ .. ] / .. ->|=> NAME", GUARD, Say("write '{1} -> choose', and in the plan: '{choose:2:4}'")),
    habit(EDGES, "NAME |, guard|cond|condition|provided |: .. ->|=> NAME", GUARD, Say(CHOOSE)),
    habit(EDGES, "NAME / .. ->|=> NAME", ACTION, Say("write '{1} -> pause', and in the plan: 'actor pause: Wait(duration = 1 s) { Elapsed -> {3} }'")),
    habit(BEHIND, "[ .. ]", GUARD, Say("write '{event} -> choose', and in the plan: '{choose:1:target}'")),
    habit(BEHIND, "when|if|unless|where ..", GUARD, Say("write '{event} -> choose', and in the plan: '{choose:1:target}'")),
    habit(EDGES, "NAME ( NAME => NAME ) -> NAME", "outputs follow the template, not its events", Say("write '{template}({2} => {3})' and '{1} -> {4}'")),
    habit(EDGES, "NAME ( .. ) ->|=> NAME", GUARD, Say(CHOOSE)),
    habit(EDGES, "guard|cond|condition : .. , NAME -> NAME", GUARD, Say("write '{2} -> choose', and in the plan: '{choose:1:3}'")),
    habit(EDGES, "guard|cond|condition : ..", GUARD, Say("write a computation in the plan: '{choose:1:here}'")),
    habit(PLAN, "[ .. ] { .. }", GUARD, Say("write a computation in the plan: '{choose:1:here}'")),
    habit(PLAN | EDGES, "else if .. : ..", NO_IF, Say("write '{choose:1:here}'")),
    habit(PLAN | EDGES, "else if .. { ..", NO_IF, Say("write '{choose:1:here}'")),
    habit(PLAN | EDGES, "else if ..", NO_IF, Say("write '{choose:1:here}'")),
    habit(EDGES, "/ NAME ->|=> NAME", "supervisors watch sensors, not topics", Say("write an event of '{template}' before '-> {2}'")),
    habit(PLAN, "guard NAME |: .. ", GUARD, Say("write a computation in the plan: '{choose:2:here}'")),
    habit(PLAN | EDGES, "if|when|unless .. then|->|=> NAME ..", NO_IF, Say("write '{choose:1:2}'")),
    habit(PLAN | EDGES, "if|when|unless .. then|->|=> NAME", NO_IF, Say("write '{choose:1:2}'")),
    habit(PLAN, "choice|decision|junction|condition NAME : ..", NO_IF, Say("write '{choose:2:here}'")),
    habit(PLAN, "switch|match NAME", NO_IF, Say("write 'computation choose: Compare(left = {1}, right = 3) { Less -> {here}, Equal, Greater -> terminate }', or 'Switch' for an enum")),
    habit(PLAN, "if|elif|switch|case|match|when|else|choice|condition|decision|unless true|True|false|False|{ ..", NO_IF, Say(CHOICE)),
    habit(PLAN, "switch|case|match ( .. ) ..", NO_IF, Say("write 'computation choose: Compare(left = {1}, right = 3) { Less -> {here}, Equal, Greater -> terminate }', or 'Switch' for an enum")),
    habit(PLAN | EDGES, "if|elif|switch|case|match|when|condition|unless ( .. ) ..", NO_IF, Say("write '{choose:1:here}'")),
    habit(PLAN | EDGES, "if|elif|switch|case|match|when|condition|unless .. { ..", NO_IF, Say("write '{choose:1:here}'")),
    habit(PLAN | EDGES, "if|elif|switch|case|match|when|condition|unless .. : GOAL", NO_IF, Say("write '{choose:1:2}'")),
    habit(PLAN | EDGES, "if|elif|switch|case|match|when|condition|unless .. : ..", NO_IF, Say("write '{choose:1:here}'")),
    habit(PLAN | EDGES, "if|elif|switch|case|match|when|condition|unless ..", NO_IF, Say("write '{choose:1:here}'")),
    habit(PLAN, "else|choice|decision|junction ..", NO_IF, Say(CHOICE)),
    habit(EDGES, "if|elif|else|switch|case|match|when|unless (|{|NAME ..", NO_IF, Say(CHOICE)),
    habit(EDGES, "NAME => { NAME }", "an edge has '->' and its target without braces", Edit("{1} -> {2}")),
    habit(VALUE, "if .. then|: .. else ..", NO_FORMULA_IF, Say("branch before it: '{choose:1:here}'")),
    habit(VALUE, "NAME ==|!=|<|>|<=|>= .. ? .. : ..", "formulas have no '?'", Say(CHOSEN)),
    habit(OPERATOR, "==|!=|<|>|<=|>= .. ? .. : ..", "formulas have no '?'", Say(CHOSEN)),
    habit(OPERATOR, "if .. else ..", NO_FORMULA_IF, Say("branch before it: '{choose:1:here}'")),
    habit(OPERATOR, "&&|&|or|and|xor|is|if|?|PIPE ..", NO_FORMULA_IF, Say(CHOSEN)),
    habit(OPERATOR, "~ = ..", NO_FORMULA_IF, Say(CHOICE)),
    habit(OPERATOR, "==|!=|~=|<|>|<=|>= ..", NO_FORMULA_IF, Say(CHOSEN)),
    habit(VALUE, "not|! NAME", NO_FORMULA_IF, Say("branch with 'computation choose: Is(value = {1}, equals = true) { Yes -> {here}, No -> terminate }'")),
    habit(VALUE, "not|! (", NO_FORMULA_IF, Say(CHOICE)),

    // Actions of states.
    habit(BODY, "entry|exit|onEntry|onExit|onentry|onexit|on_entry|on_exit|enter|leave|do|during|en|ex|du :|/ NAME |: = .. ; ..", NO_HOOK, Say(SET_BEFORE)),
    habit(BODY, "entry|exit|onEntry|onExit|onentry|onexit|on_entry|on_exit|enter|leave|do|during|en|ex|du :|/ |[ assign ( { NAME : .. } ) ..", NO_HOOK, Say(SET_BEFORE)),
    habit(BODY, "entry|exit|onEntry|onExit|onentry|onexit|on_entry|on_exit|enter|leave|do|during|en|ex|du :|/ |[ assign ( NAME = .. ) ..", NO_HOOK, Say(SET_BEFORE)),
    habit(BODY, "entry|exit|onEntry|onExit|onentry|onexit|on_entry|on_exit|enter|leave|do|during|en|ex|du :|/ NAME + +", NO_HOOK, Say("remove it, write 'computation set: Assign(value = {1} + 1, result => {1}) { Done -> {here} }' in the plan, and lead an edge to 'set'")),
    habit(BODY, "entry|exit|onEntry|onExit|onentry|onexit|on_entry|on_exit|enter|leave|do|during|en|ex|du |: { NAME = .. }", NO_HOOK, Say(SET_BEFORE)),
    habit(BODY, "entry|exit|onEntry|onExit|onentry|onexit|on_entry|on_exit|enter|leave|do|during|en|ex|du :|/ NAME |: = ..", NO_HOOK, Say(SET_BEFORE)),
    habit(BODY, "entry|exit|onEntry|onExit|onentry|onexit|on_entry|on_exit|enter|leave|do|during|en|ex|du :|/|(|{|->|=>|NAME ..", NO_HOOK, Say(NEXT_ELEMENT)),
    habit(EDGES, "pass|nop|noop|skip", "an edge needs no empty statement", Edit("")),
    habit(BODY, "tags|tag|meta|description|id|label|type : ..", "an element has no '{word}'", Edit("")),
    habit(EDGES, "defer NAME", "events are not deferred: a supervisor reports a condition for as long as it watches", Edit("")),
    habit(EDGES, "tick|Running|RUNNING|running ->|=>|: NAME", "an element that runs stays active without an edge", Edit("")),
    habit(BODY, "cancel|cancelled|canceled|preempted|preempt|interrupted ->|=>|: NAME", "an interrupted element takes no edge: the event's edge is taken", Edit("")),
    habit(EDGES, "NAME < - NAME", "an edge leads from a state to its target", Edit("{2} -> {1}")),

    // Loops.
    habit(PLAN, "retry|repeat|loop |( NUM |) ^ actor|subplan NAME", LOOP, Drop("remove it; to come back, declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = {number:1}, next => rounds) { Again -> {2}, Done -> terminate }'")),
    habit(HEAD, "with|using|@| retry|retries|repeat|times|loop|attempts|Retry|Repeat |:|=|( |NAME |= NUM |)", LOOP, Drop("remove it; to come back, declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = {number:1}, next => rounds) { Again -> {here}, Done -> terminate }'")),
    habit(INSIDE, "repeat|loop|retry|for |( NUM |) |times { NAME }", LOOP, Say("declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = {number:1}, next => rounds) { Again -> {2}, Done -> terminate }'")),
    habit(INSIDE, "repeat|loop|retry|for |( NUM |) |times { NAME , ..", LOOP, Say("declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = {number:1}, next => rounds) { Again -> {2}, Done -> terminate }'")),
    habit(INSIDE, "retry|retryuntilsuccessful|repeat|repeater|loop ( NAME = NUM ) { NAME ..", LOOP, Say("declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = {number:2}, next => rounds) { Again -> {3}, Done -> terminate }'")),
    habit(PLAN, "@ retry|repeat|times |( |NAME |= NUM |)", LOOP, Drop("remove it; to come back, declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = {number:1}, next => rounds) { Again -> {here}, Done -> terminate }'")),
    habit(INSIDE, "repeat until ..", LOOP, Say("write '{choose:1:here}'")),
    habit(INSIDE, "repeat until .. { ..", LOOP, Say("write '{choose:1:here}'")),
    habit(INSIDE, "repeat|loop|times|retry|for |( NUM ..", LOOP, Say(COUNTED)),
    habit(INSIDE, "for NAME =|in NUM : NUM ..", LOOP, Say("declare 'var {1}: int = 0', and write 'computation again: Count(value = {1}, limit = {3}, next => {1}) { Again -> {here}, Done -> terminate }'")),
    habit(INSIDE, "for NAME =|in range ( NUM ) ..", LOOP, Say("declare 'var {1}: int = 0', and write 'computation again: Count(value = {1}, limit = {2}, next => {1}) { Again -> {here}, Done -> terminate }'")),
    habit(INSIDE, "for ( int|let|var|auto| NAME = NUM ; NAME < NUM ..", LOOP, Say("declare 'var {1}: int = 0', and write 'computation again: Count(value = {1}, limit = {4}, next => {1}) { Again -> {here}, Done -> terminate }'")),
    habit(INSIDE, "repeat|for|foreach ..", LOOP, Say("declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = 3, next => rounds) { Again -> {here}, Done -> terminate }'")),
    habit(INSIDE, "while ( 1|true|True|TRUE ) ..", LOOP, Say(BACK)),
    habit(INSIDE, "while 1|true|True|TRUE ..", LOOP, Say(BACK)),
    habit(INSIDE, "while|until ( .. ) ..", LOOP, Say("write '{choose:1:here}'")),
    habit(INSIDE, "while|until .. : ..", LOOP, Say("write '{choose:1:here}'")),
    habit(INSIDE, "while|until .. { ..", LOOP, Say("write '{choose:1:here}'")),
    habit(INSIDE, "forever|loop|do|while|until ..", LOOP, Say(BACK)),
    habit(FILE, "forever ^ plan NAME {", "'forever' follows the name of the plan", Edit("plan {1} forever {")),

    // Waiting and showing.
    habit(INSIDE, "rate|loop_rate|r . sleep ( )", "a plan has no rate: 'every' of a supervisor is the period of its polls", Edit("")),
    habit(PLAN, "wait until .. ", WAITS, Say("write 'actor wait: Idle { supervise value: CheckValue(value = {left:1}, limit = {right:1}) { Above -> {here}, Below -> ignore } }'")),
    habit(INSIDE, "sleep|pause|wait ( NUM )", WAITS, Say("write 'actor wait: Wait(duration = {wait:1}) { Elapsed -> {here} }' in the plan")),
    habit(INSIDE, "time . sleep ( NUM )", WAITS, Say("write 'actor wait: Wait(duration = {s:1}) { Elapsed -> {here} }' in the plan")),
    habit(INSIDE, "delay|sleep|pause|wait NUM", WAITS, Say("write 'actor wait: Wait(duration = {s:1}) { Elapsed -> {here} }' in the plan")),
    habit(INSIDE, "print|println|printf|fprintf|disp|display|log|echo|puts|ROS_INFO|ROS_WARN|RCLCPP_INFO|loginfo|log_info ( .. )", SHOW, Say(LOG)),
    habit(INSIDE, "Serial|console . NAME ( .. )", SHOW, Say("write 'computation show: Log(value = {shown:2}) { Done -> {here} }'")),
    habit(INSIDE, "tic|toc|millis|clock |( ..", NO_CLOCK, Say(TIMED)),
    habit(INSIDE, "digitalWrite|analogWrite|pinMode|tone ( ..", "a plan has no '{word}': actors of a toolbox drive its devices", Say("write an actor, such as 'actor show: Signal { Signalled -> {here} }'")),
    habit(PLAN, "play|glide|bounce|beep|blink|turn|rotate|spin|point NAME ..", "a plan has no '{word}': actors of a toolbox drive the robot", Say(CALLED)),
    habit(PLAN, "beep|turn|rotate|spin NUM ..", "a plan has no '{word}': actors of a toolbox drive the robot", Say(CALLED)),
    habit(INSIDE, "move|drive|turn|go|glide|forward|backward|left|right |by|for |( NUM ..", "a plan has no '{word}': actors of a toolbox drive the robot", Say("write an actor, such as 'actor drive: Forward(distance = 10 cm) { ForwardSuccessful -> {here} }'")),

    habit(PLAN, "go|glide|goto |( to ..", "a plan has no '{word}': actors of a toolbox drive the robot", Say("write an actor, such as 'actor there: DriveTo(x = 1 m, y = 1 m, heading = 0 deg) { Arrived, PathLost -> {here} }'")),
    habit(INSIDE, "say|think|speak .. for ..", SHOW, Say(LOG)),
    habit(INSIDE, "say|think|speak ..", SHOW, Say(LOG)),
    habit(INSIDE, "set|let|change ENTRY to .. ", WRITES, Say("write 'computation set: Assign(value = {2}, result => {1}) { Done -> {here} }'")),
    habit(INSIDE, "change|increase|increment ENTRY by .. ", WRITES, Say("write 'computation set: Assign(value = {1} + {2}, result => {1}) { Done -> {here} }'")),

    // Sensors and clocks in formulas.
    habit(VALUE, "millis|micros|clock|now|time|toc|tic ( ..", NO_CLOCK, Say(TIMED_BESIDE)),
    habit(VALUE, "NAME . time|now|ticks_ms|monotonic ( ..", NO_CLOCK, Say(TIMED_BESIDE)),
    habit(VALUE, "digitalRead|analogRead|pulseIn|readSensor|getDistance|read ( ..", NO_SENSOR, Say(WATCH)),
    habit(VALUE, "ultrasonic|sensor|bumper|lidar|sonar|encoder . NAME ..", NO_SENSOR, Say("write an entry here, and in an element's braces: 'supervise near: CheckDistance(distance = 30 cm) { Nearer -> {here}, Farther -> ignore }'")),
    habit(VALUE, "len|size|length|count ( ..", "there are no lists, so nothing has a length", Say("read a 'table' with 'Row' of 'std': its state 'End' follows the last row")),

    habit(VALUE, "str|string|String|to_string|num2str|toString|repr ( .. )", "a string joins its values with '+'", Edit("\"\" + {1}")),
    habit(VALUE, "int|float|double|Number ( NAME )", "a value needs no conversion: its port decides", Edit("{1}")),
    habit(VALUE, "NAME . NAME . NAME ..", "formulas read no messages: an entry holds a value", Say("declare 'in value: float = 0', and write 'value'")),
    habit(VALUE, "msg|message . NAME ..", "formulas read no messages: an entry holds a value", Say("declare 'in value: float = 0', and write 'value'")),
    habit(VALUE, "Duration|duration|seconds|Seconds|secs|timedelta ( NUM )", "a time is a number with its unit", Edit("{s:1}")),
    habit(VALUE, "milliseconds|millis|ms|Millis ( NUM )", "a time is a number with its unit", Edit("{ms:1}")),
    habit(VALUE, "/ ..", "formulas read no topics: an entry holds a value", Say("declare 'in value: float = 0', and write 'value'")),

    // Lists.
    habit(VALUE, "[ ..", NO_LIST, Say(TABLE)),
    habit(OPERATOR, "[ .. ] ..", NO_LIST, Say(TABLE)),
    habit(INSIDE, "NAME = [ ..", NO_LIST, Say("write 'table {1}(value: int) { (1) (2) }' in the file, and read it with 'Row' of 'std'")),
    habit(INSIDE, "NAME [ .. ] = ..", NO_LIST, Say(TABLE)),

    // Signs in formulas.
    habit(VALUE, "{ NAME }", "a name has no braces", Edit("{1}")),
    habit(OPERATOR, "POWER 2", "formulas have no '^'", Say("write '{left} * {left}'")),
    habit(OPERATOR, ". *", "formulas have no '.*'", Edit(" *")),
    habit(OPERATOR, ". /", "formulas have no './'", Edit(" /")),
    habit(OPERATOR, ". POWER ..", "formulas have no '.^'", Say("write a product, such as '{left} * {left}'")),

    // Actions.
    habit(TARGET, "{ NAME = .. ; NAME }", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {3} }'")),
    habit(TARGET, "{ NAME = .. }", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {here} }'")),
    habit(TARGET, "[| { target : GOAL , guard|cond|in : .. } ..", GUARD, Say("write '{event} -> choose', and in the plan: '{choose:2:1}'")),
    habit(TARGET, "{ actions|action : .. , target : GOAL ..", ACTION, Edit("{2}")),
    habit(TARGET, "history|deepHistory|shallowHistory ( .. )", NO_HISTORY, Say(RETURN)),
    habit(TARGET, "[ { target : GOAL .. } ..", "an edge leads to one element", Edit("{1}")),
    habit(TARGET, ". NAME", "a target is the name of an element", Edit("{1}")),
    habit(TARGET, "# NAME . NAME", "a target is the name of an element", Edit("{2}")),
    habit(TARGET, "< < final|end|exit|terminate|finalState > >", "a plan has no final state: an edge ends it", Edit("terminate")),
    habit(TARGET, "< < NAME > >", "a target has no brackets", Edit("{1}")),
    habit(TARGET, "NAME .|: |: SUCCESS|Success|success|COMPLETED", "a target is an element or an end of the plan", Edit("terminate")),
    habit(TARGET, "NAME .|: |: FAILURE|Failure|failure|ABORTED", "a target is an element or an end of the plan", Edit("fail")),
    habit(TARGET, "NAME . NAME ( ..", ACTION, Say("write '{event} -> {act:name}', and in the plan: '{act}'")),
    habit(TARGET, "{ target : GOAL }", "a target has no braces", Edit("{1}")),
    habit(TARGET, "{ target : GOAL ..", ACTION, Edit("{1}")),
    habit(TARGET, "send|raise|emit|broadcast|publish|dispatch|trigger|notify ( STATE )", NO_MESSAGES, Edit("terminate")),
    habit(TARGET, "send|raise|emit|broadcast|publish|dispatch|trigger|notify |( NAME |)", "an edge cannot send an event", Edit("{1}")),
    habit(TARGET, "{ NAME + + }", ACTION, Say(COUNTS_UP)),
    habit(TARGET, "[ NAME , .. ]", "an edge leads to one element", Edit("{1}")),
    habit(TARGET, "# NAME", "a target is the name of an element", Edit("{1}")),
    habit(BEHIND, "( NAME = .. ) , NAME", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {3} }'")),
    habit(BEHIND, "( { NAME : .. } ) ..", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {here} }'")),
    habit(BEHIND, "{ [ .. ] -> GOAL ..", GUARD, Say("write '{event} -> choose', and in the plan: '{choose:1:2}'")),
    habit(BEHIND, ", guard|cond|actions|action : ..", GUARD, Say("write '{event} -> choose', and in the plan: '{choose:1:target}'")),
    habit(BEHIND, "( NAME = .. ) -> NAME", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {3} }'")),
    habit(BEHIND, "( NAME = .. )", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {here} }'")),
    habit(BEHIND, "( .. ) -> NAME", ACTION, Say("write '{event} -> pause', and in the plan: 'actor pause: Wait(duration = 1 s) { Elapsed -> {2} }'")),
    habit(BEHIND, "( .. )", ACTION, Say("write '{event} -> pause', and in the plan: 'actor pause: Wait(duration = 1 s) { Elapsed -> {here} }'")),
    habit(BEHIND, "*", NO_HISTORY, Say(RETURN)),
    habit(TARGET, "push|preempt|pushd NAME", "'suspend' pauses the active element", Edit("suspend {1}")),
    habit(TARGET, "suspend ( NAME )", "'suspend' has no brackets", Edit("suspend {1}")),
    habit(TARGET, "{ NAME }", "a target has no braces", Edit("{1}")),
    habit(TARGET, "[ * ]", "a plan has no final state: an edge ends it", Edit("terminate")),
    habit(BEHIND, ". history|hist|last ..", NO_HISTORY, Say(RETURN)),
    habit(BEHIND, "/ NAME = ..", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {target} }'")),
    habit(BEHIND, "{ NAME = .. }", ACTION, Say("write '{event} -> set', and in the plan: 'computation set: Assign(value = {2}, result => {1}) { Done -> {target} }'")),
    habit(BEHIND, "/|{|do ..", ACTION, Say("lead it to an element that does it: 'actor pause: Wait(duration = 1 s) { Elapsed -> {target} }'")),
    habit(BEHIND, "&|&&|+ NAME", "one element is active at a time", Edit("")),
    habit(BODY, "internal ..", ACTION, Say(NEXT_ELEMENT)),
    habit(BODY, "actions|action|invoke|activity : ..", NO_HOOK, Say(NEXT_ELEMENT)),
    habit(PLAN, "invoke|activity|do|call : NAME ..", "an element runs when an edge leads to it", Say("write 'actor {1}: Wait(duration = 1 s) { Elapsed -> {here} }'")),

    // States and events.
    habit(BODY, "< transition event = TEXT target = TEXT / >", "an edge is 'State -> target'", Edit("{1} -> {2}")),
    habit(BODY, "< ..", "plans are not XML: an edge is 'State -> target'", Say("write '{state:here} -> terminate' instead")),
    habit(BODY, "on |: { NAME : GOAL |, }", "edges are written without 'on'", Say("{on:1:2}")),
    habit(BODY, "on |: { NAME : [| { target : GOAL ..", "edges are written without 'on'", Say("{on:1:2}")),
    habit(BODY, "on : ..", "edges are written without 'on'", Say("write '{state:here} -> {here}'; an event belongs in the braces of its supervisor")),
    habit(PLAN, "on |: { ..", "a plan has no 'on': a supervisor watches", Say("write 'supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }'")),
    habit(EDGES, "target : NAME", "an edge begins with its state or event", Say("write '{state:here} -> {1}'")),
    habit(EDGES, "always ->|=>|: NAME", "edges have no 'always': an element that takes no time is not needed", Say("remove it, and lead the edges that lead here to '{1}'")),
    habit(PLAN, "initial|init|begin|root|entry |:|=|-> NAME", "a plan begins with 'start'", Edit("start {1}")),
    habit(PLAN, "[ * ] |- -> NAME", "a plan begins with 'start'", Edit("start {1}")),
    habit(PLAN, "[ .. ] ->|=> GOAL", GUARD, Say("write a computation in the plan: '{choose:1:2}'")),
    habit(ITEMS, "states|nodes|steps|tasks :|=|{ ..", "elements are not listed: each is an item of the plan", Say("write each as 'actor idle: Wait(duration = 1 s) { Elapsed -> {here} }'")),
    habit(PLAN, "parallel|concurrent|fork|join|region|orthogonal ..", PARALLEL, Say(BESIDE)),
    habit(PLAN, "type : ..", PARALLEL, Say(BESIDE)),
    habit(ITEMS, "parallel ..", PARALLEL, Say(BESIDE)),
    habit(PLAN, "final state NAME", "a plan has no final state: an edge ends it", Say("write '-> terminate' where an edge leads to '{1}'")),
    habit(PLAN, "final|final_state NAME", "a plan has no final state: an edge ends it", Say("write '-> terminate' where an edge leads to '{1}'")),
    habit(PLAN, "state|node NAME < < fork|join > > ..", PARALLEL, Say(BESIDE)),
    habit(PLAN, "state|node NAME < < choice|junction > > ..", NO_IF, Say(CHOICE)),
    habit(PLAN, "state|node NAME < < NAME > > ..", "an edge begins and ends a plan", Say("remove it; write 'start {here}', or '-> terminate' where an edge leads to '{1}'")),
    habit(PLAN, "NAME : { type : \"history\"|'history' ..", NO_HISTORY, Say("remove it; to pause an element, lead an event to 'suspend pause', and an edge of 'pause' to 'return'")),
    habit(PLAN, "NAME : { type : TEXT |, }", "a plan has no final state: an edge ends it", Say("remove it, and write '-> terminate' where an edge leads to '{1}'")),
    habit(PLAN, "NAME : { .. }", "a state of a plan is an actor, made from a template", Say("write 'actor {1}: Wait(duration = 1 s) { Elapsed -> {here} }'")),
    habit(PLAN, "state|composite NAME { actor|state|initial|start ..", "an element that contains elements is a plan", Say("write 'plan {Large:1} { start wait actor wait: Wait { Elapsed -> terminate } }' in the file, and 'subplan {1}: {Large:1} { OK -> {here} }'")),
    habit(PLAN, "state|action|step|task|behavior|behaviour NAME { ..", "a state of a plan is an actor, made from a template", Say("write 'actor {1}: Wait(duration = 1 s) { Elapsed -> {here} }'")),
    habit(PLAN, "history ..", NO_HISTORY, Say("remove it; to pause an element, lead an event to 'suspend pause', and an edge of 'pause' to 'return'")),
    habit(PLAN, "context|data|variables|vars|userdata|blackboard |:|= { NAME :|= .. }", "each entry is a separate item", Say("write 'var {1}: int = {2}'")),
    habit(PLAN, "blackboard|userdata|context|data NAME : NAME", "a plan has no '{word}': an entry holds a value", Edit("var {1}: {2}")),
    habit(PLAN, "delay|timeout NAME |:|= NUM", "an entry that never changes begins with 'const'", Edit("const {1} = {2}")),
    habit(PLAN, "transition|edge| NAME to NAME on|when|if NAME", EDGE_OUTSIDE, Say("write '{3} -> {2}' in the braces of '{1}'")),
    habit(PLAN, "STATE ->|=> NAME", EDGE_OUTSIDE, Say("write '{1} -> {2}' in the braces of '{here}'")),
    habit(PLAN, "NAME |- -> [ * ] ..", EDGE_OUTSIDE, Say("write '{state:1} -> terminate' in the braces of '{1}'")),
    habit(PLAN, "NAME |- -> NAME : NAME [ .. ] ..", EDGE_OUTSIDE, Say("write '{3} -> choose' in the braces of '{1}', and in the plan: '{choose:4:2}'")),
    habit(PLAN, "NAME |- -> NAME : NAME ..", EDGE_OUTSIDE, Say("write '{3} -> {2}' in the braces of '{1}'")),
    habit(PLAN, "NAME - -> NAME", EDGE_OUTSIDE, Say("write '{state:1} -> {2}' in the braces of '{1}'")),
    habit(PLAN, "transition|edge NAME : NAME -> NAME", EDGE_OUTSIDE, Say("write '{1} -> {3}' in the braces of '{2}'")),
    habit(PLAN, "transition|edge| NAME -> NAME", EDGE_OUTSIDE, Say("write '{state:1} -> {2}' in the braces of '{1}'")),
    habit(PLAN, "NAME - - -> NAME", EDGE_OUTSIDE, Say("write '{state:1} -> {2}' in the braces of '{1}'")),
    habit(INSIDE, "raise|throw|throws NAME ( ..", "a plan has no '{word}': an edge fails", Say("remove it, and lead an edge to 'fail'")),
    habit(INSIDE, "send|raise|emit|trigger|broadcast|notify|publish|dispatch ..", NO_MESSAGES, Say(CHANGED)),
    habit(INSIDE, "goto|goTo|transition_to|next NAME", "a plan has no '{word}': an edge selects the next element", Say("write 'State -> {1}' in the braces of an element")),
    habit(INSIDE, "break|continue|return|stop|exit|end |NAME ..", "a plan has no '{word}': an edge selects the next element or ends the plan", Say("write '{state:here} -> terminate' in the braces of '{here}', or return a value in an 'out' entry")),

    // Behaviour trees.
    habit(ITEMS, "sequence|seq|chain|fallback|selector |NAME { actor|action|condition|state|task ..", "a plan has no '{word}': edges select the next element", Say("write each of its parts as an item of the plan, and '{state:here} -> NAME' in the braces of the part before it")),
    habit(TEMPLATE, "sequence|seq|chain|then (|{ NAME |,|-> NAME ..", SEQUENCE, Say("remove the element, and write '{state:1} -> {2}' in the braces of '{1}'")),
    habit(TEMPLATE, "fallback|selector|priority (|{ NAME |, NAME ..", "a plan has no '{word}': an 'Error' edge leads to the alternative", Say("remove the element, and write 'Error -> {2}' in the braces of '{1}'")),
    habit(TEMPLATE, "parallel|concurrent|all (|{ NAME |, NAME ..", PARALLEL, Say("remove the element, and add a supervisor to the braces of another element: 'supervise late: CheckTimeout { TimedOut -> {1} }'")),
    habit(TEMPLATE, "retry|repeat|retryuntilsuccessful|loop ( |NAME |= NUM ) { NAME }", LOOP, Say("remove the element, declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = {number:1}, next => rounds) { Again -> {2}, Done -> terminate }'")),
    habit(TEMPLATE, "retry|repeat|retryuntilsuccessful|loop (|{ NAME |, ..", LOOP, Say("remove the element, declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, limit = 3, next => rounds) { Again -> {1}, Done -> terminate }'")),
    habit(TEMPLATE, "inverter|invert|forcesuccess|forcefailure (|{ NAME |)|}", "a plan has no '{word}': each state has its own edge", Say("remove the element, and write 'Error -> terminate' in the braces of '{1}'")),
    habit(ITEMS, "sequence|seq|chain |NAME |: |{|( NAME |,|-> NAME ..", SEQUENCE, Say("write '{state:1} -> {2}' in the braces of '{1}'")),
    habit(ITEMS, "fallback|selector |NAME |: |{|( NAME |, NAME ..", "a plan has no '{word}': an 'Error' edge leads to the alternative", Say("write 'Error -> {2}' in the braces of '{1}'")),
    habit(PLAN, "reactivesequence|reactivefallback|whiledoelse|ifthenelse ..", "a plan has no '{word}' nodes: a supervisor watches while an element runs", Say("write in the element's braces: 'supervise near: CheckDistance { Nearer -> {here}, Farther -> ignore }'")),
    habit(PLAN, "repeat_until_failure|repeatuntilfailure|repeat_until_success|keeprunninguntilfailure ..", LOOP, Say(BACK)),
    habit(ITEMS, "reactive|memory|async|parallel sequence|fallback|selector ..", "a plan has no '{word}' nodes: a supervisor watches while an element runs", Say("write in the element's braces: 'supervise near: CheckDistance { Nearer -> {here}, Farther -> ignore }'")),
    habit(ITEMS, "decorator ..", "a plan has no decorators: each state has its own edge", Say("connect each state to its own target: 'Error -> {here}'")),
    habit(FILE, "< ..", "plans are not XML: each leaf of a tree is an element", Say("write 'plan Tree { start step actor step: Wait { Elapsed -> terminate } }' instead; each leaf is such an element")),
    habit(PLAN, "< ..", "plans are not XML: each leaf of a tree is an element", Say("write 'actor step: Forward { ForwardSuccessful -> {here} }' for a leaf, and '->' to the next element")),
    habit(ITEMS, "sequence|seq|chain|fallback|selector ..", SEQUENCE, Say("write 'State -> {here}' in the braces of the element before it")),
    habit(PLAN, "inverter|invert|force_success|force_failure|forcesuccess|forcefailure|succeeder|alwayssuccess (|{| NAME |}|)", "a plan has no '{word}': each state has its own edge", Say("remove it, and write 'Error -> {here}' in the braces of '{1}'")),
    habit(PLAN, "inverter|invert|force_success|force_failure|forcesuccess|forcefailure|succeeder|alwayssuccess|keeprunninguntilfailure ..", "a plan has no '{word}': each state has its own edge", Say("remove it, and write 'Error -> {here}' in the braces of an element")),
    habit(PLAN, "subtree|submachine|sub NAME ..", "a plan in a plan is a 'subplan'", Say("write 'subplan {1}: {Large:1} { OK -> {here} }'")),

    // ROS.
    habit(PLAN, "topic NAME : NAME", "a plan has no topics: an entry holds a value", Say("write 'in {1}: {2}', and a value after it")),
    habit(PLAN, "subscribe|subscriber|callback|listen|on_message|onmessage|on_receive|on_event|handler|wait_for_message|wait_for_service ..", "a plan has no '{word}': a supervisor watches", Say("write in an element's braces or in the plan: 'supervise near: CheckDistance { Nearer -> {here}, Farther -> ignore }'")),
    habit(PLAN, "publisher|advertise|topic ..", NO_MESSAGES, Say(CHANGED)),
    habit(PLAN, "service|rosservice|action_client|action_server ..", "a plan has no '{word}': plans use other plans", Say("write a separate plan, and use it with 'subplan'")),
    habit(PLAN, "remap ..", "a plan has no '{word}': each element names the entries that it reads and writes", Say("write it in the parentheses of the element: 'port = entry' or 'port => entry'")),
    habit(ITEMS, "launch|roslaunch ..", "a plan starts nothing: 'afpc run' starts it", Edit("")),
    habit(PLAN, "spin|spinOnce|ros|rclpy |( ..", "a plan runs by itself", Say("remove it")),
    habit(BODY, "feedback|result ..", "outputs go to entries, in the brackets of the template", Say("write 'driven => {left}' in the brackets after '{template}'")),

    // Declarations.
    habit(PLAN, "static|const|constexpr const|int|long|float|double|bool|byte |int|long|float NAME = NUM", "an entry that never changes begins with 'const'", Edit("const {1} = {2}")),
    habit(PLAN, "unsigned|signed|volatile|static |unsigned int|long|short|char NAME = NUM", "an entry begins with 'var', and its type follows the name", Edit("var {1}: int = {2}")),
    habit(PLAN, "unsigned|long |int|long NAME = millis|micros ..", NO_CLOCK, Say(TIMED)),
    habit(PLAN, "int|long|short|uint8_t|int32 NAME = NUM", "an entry begins with 'var', and its type follows the name", Edit("var {1}: int = {2}")),
    habit(PLAN, "float|double|real NAME = NUM", "an entry begins with 'var', and its type follows the name", Edit("var {1}: float = {2}")),
    habit(PLAN, "String|string|str|char |* NAME = TEXT", "an entry begins with 'var', and its type follows the name", Edit("var {1}: string = {last}")),
    habit(PLAN, "bool|boolean NAME = true|false", "an entry begins with 'var', and its type follows the name", Edit("var {1}: bool = {last}")),
    habit(PLAN, "let|auto|local|global|val|def|my|private|public|static|readonly|persistent mut|const|static|var| NAME = ..", "an entry begins with 'var'", Edit("var {1} = {2}")),
    habit(PLAN, "let|auto|local|global|val|def|my|private|public|static|readonly|persistent mut|const|static|var| NAME : ..", "an entry begins with 'var'", Edit("var {1}: {2}")),
    habit(ITEMS, "export| default| const|let|var NAME = NAME |. |NAME ( ..", FUNCTION, Say(PLAN_OF_ITS_OWN)),
    habit(FILE, "const|let|var|static NAME = ..", "entries belong in the braces of a plan", Say("move it into the plan, as 'const {small:1}: int = {2}'")),
    habit(PLAN, "ENTRY = ..", WRITES, Say("write 'computation set: Assign(value = {2}, result => {1}) { Done -> {here} }'")),
    habit(INSIDE, "ENTRY + = ..", WRITES, Say("write 'computation set: Assign(value = {1} + {2}, result => {1}) { Done -> {here} }' in the plan")),
    habit(INSIDE, "ENTRY - = ..", WRITES, Say("write 'computation set: Assign(value = {1} - {2}, result => {1}) { Done -> {here} }' in the plan")),
    habit(INSIDE, "ENTRY * = ..", WRITES, Say("write 'computation set: Assign(value = {1} * {2}, result => {1}) { Done -> {here} }' in the plan")),
    habit(INSIDE, "ENTRY / = ..", WRITES, Say("write 'computation set: Assign(value = {1} / {2}, result => {1}) { Done -> {here} }' in the plan")),
    habit(INSIDE, "ENTRY + +", WRITES, Say("write 'computation set: Assign(value = {1} + 1, result => {1}) { Done -> {here} }' in the plan")),
    habit(INSIDE, "ENTRY - -", WRITES, Say("write 'computation set: Assign(value = {1} - 1, result => {1}) { Done -> {here} }' in the plan")),
    habit(BODY, "ENTRY = ENTRY +|-|*|/ ..", WRITES, Say("write 'computation set: Assign(value = {written:2}, result => {1}) { Done -> {here} }' in the plan")),
    habit(PLAN, "NAME = SAME +|-|*|/ ..", WRITES, Say("declare 'var {1}: int = 0', and write 'computation set: Assign(value = {written:2}, result => {1}) { Done -> {here} }'")),
    habit(PLAN, "self|this|const|var|auto| |. NAME = |new NAME ( ..", NO_OBJECT, Drop("remove it; to use the device, {act:help}")),
    habit(PLAN, "self|this| |. NAME = NAME . NAME ( ..", NO_OBJECT, Drop("remove it; to use the device, {act:help}")),
    habit(PLAN, "self|this . ENTRY = ..", WRITES, Say("write 'computation set: Assign(value = {2}, result => {1}) { Done -> {here} }'")),
    habit(PLAN, "self|this . NAME = ..", "an entry begins with 'var'", Edit("var {1} = {2}")),
    habit(PLAN, "NAME : NAME = ..", "an entry begins with 'var'", Edit("var {1}: {2} = {3}")),
    habit(PLAN, "NAME = ..", "an entry begins with 'var'", Edit("var {1} = {2}")),

    habit(PLAN, "param|parameter|input|argument NAME : NUM", "an entry that is set from outside begins with 'in', and has a type", Edit("in {1}: {type:2} = {2}")),
    habit(PLAN, "param|parameter|input|argument NAME = NUM", "an entry that is set from outside begins with 'in', and has a type", Edit("in {1}: {type:2} = {2}")),

    // Functions, classes and files.
    habit(INSIDE, "\"\" TEXT \"\"", "help text begins with '///'", Edit("/// {1}")),
    habit(ITEMS, "void|int|fn|func|function|def|sub|proc|async loop|Loop ( ) ..", FUNCTION, Say("write 'plan Loop forever { start wait actor wait: Wait { Elapsed -> wait } }' in the file, outside of other plans")),
    habit(ITEMS, "async|static|public| void|int|fn|func|function|def|sub|proc|async NAME ( ..", FUNCTION, Say(PLAN_OF_ITS_OWN)),
    habit(ITEMS, "function NAME = NAME ( ..", FUNCTION, Say("write 'plan {Large:2} { start wait actor wait: Wait { Elapsed -> terminate } }' in the file; 'subplan' uses it")),
    habit(PLAN, "lambda ..", "there is no '{word}': a formula is written where its value is needed", Say("write it at the port, such as 'Wait(duration = 1 s * 2)'")),
    habit(ITEMS, "@ NAME |( ..", "items have no decorators", Edit("")),
    habit(ITEMS, "class|module|namespace|program|main NAME ..", FUNCTION, Say(PLAN_OF_ITS_OWN)),
    habit(ITEMS, "struct|record|type NAME ..", "there are no structs: each field is an entry", Say("declare each field in the plan, such as 'var x: length = 0 m'")),
    habit(PLAN, "import|include|from|require|using ..", "'use' stands at the top of the file", Say("remove it, and write 'use std' there")),
    habit(FILE, "import|include|from|require|using std|carbot", "a file names its toolboxes with 'use'", Edit("use {last}")),
    habit(FILE, "import|include|from|require|using ..", "a file names its toolboxes with 'use'", Say("write 'use std' or 'use carbot'")),
    habit(PLAN, "NAME ( .. ) . NAME ( ..", NO_CALL, Say(CALLED)),
    habit(PLAN, "NAME . NAME . NAME ..", NO_CALL, Say(CALLED)),
    habit(PLAN, "NAME . NAME (|= ..", NO_CALL, Say(CALLED)),
    habit(PLAN, "NAME ( .. )", NO_CALL, Say(CALLED)),
    habit(BODY, "NAME ( ..", "an element does one thing: another action is another element", Say(NEXT_ELEMENT)),
    habit(BODY, "NAME . NAME ( ..", "an element does one thing: another action is another element", Say(NEXT_ELEMENT)),
    habit(INSIDE, "try|catch|except|finally|throw ..", "a plan has no '{word}': a failure takes the 'Error' edge", Say("write 'Error -> {here}' in the braces of the element")),
];
