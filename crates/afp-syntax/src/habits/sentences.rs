//! Sentences that several habits share: errors, and helps with the plan text.

pub(super) const TIME_LIMIT: &str = "a time limit is a supervisor of its element";
pub(super) const LIMIT: &str = "write in the element's braces: 'supervise late: CheckTimeout(duration = {ms:1}) { TimedOut -> {2} }'";
pub(super) const LATE: &str = "supervise late: CheckTimeout(duration = {ms:1}) { TimedOut -> {2} }";
pub(super) const NO_COMMA: &str = "the names of states are separated by ','";
pub(super) const CHOOSE: &str = "write '{1} -> choose', and in the plan: '{choose:2:3}'";
pub(super) const ACTION: &str = "an edge only selects the next element";
pub(super) const NO_IF: &str = "a plan has no '{word}': a computation chooses the next element";
pub(super) const NO_FORMULA_IF: &str = "formulas have no '{word}'";
pub(super) const CHOICE: &str = "write a computation, such as 'computation choose: Compare(left = {left}, right = {right}) \
                      { Less -> {here}, Equal, Greater -> terminate }'";
pub(super) const CHOSEN: &str = "branch with a computation: '{chosen}'";
pub(super) const LOOP: &str = "a plan has no '{word}': an edge leads back to an element";
pub(super) const COUNTED: &str = "declare 'var rounds: int = 0', and write 'computation again: Count(value = rounds, \
                       limit = {number:1}, next => rounds) { Again -> {here}, Done -> terminate }'";
pub(super) const BACK: &str =
    "remove it, and lead the last edge back to the first element: '-> {here}'";
pub(super) const FUNCTION: &str = "there is no '{word}': a program is a plan, and plans use plans";
pub(super) const PLAN_OF_ITS_OWN: &str = "write 'plan {Large:1} { start wait actor wait: Wait { Elapsed -> terminate } }' in the file, outside of \
                               other plans; 'subplan' uses it";
pub(super) const PARALLEL: &str =
    "only one element is active at a time; supervisors watch while it runs";
pub(super) const BESIDE: &str = "remove it, and add a supervisor to the braces of an element: 'supervise late: CheckTimeout { TimedOut -> {here} }'";
pub(super) const NO_HOOK: &str = "an element does one thing and has no '{word}' action";
pub(super) const NEXT_ELEMENT: &str = "remove it, and {act:help}";
pub(super) const SET_BEFORE: &str = "remove it, write 'computation set: Assign(value = {2}, result => {1}) { Done -> {here} }' in the plan, and lead an edge to 'set'";
pub(super) const NO_SENSOR: &str = "formulas cannot read sensors: a supervisor watches them";
pub(super) const WATCH: &str = "write an entry here, and in an element's braces: 'supervise touch: CheckTouchSensor { TouchSensorPressed -> {here} }'";
pub(super) const NO_CLOCK: &str = "formulas have no clock: a supervisor measures time";
pub(super) const TIMED: &str = "write in an element's braces: 'supervise late: CheckTimeout(duration = 3 s) { TimedOut -> {here} }'";
pub(super) const TIMED_BESIDE: &str = "write an entry here, and in an element's braces: 'supervise late: CheckTimeout(duration = 3 s) { TimedOut -> {here} }'";
pub(super) const SHOW: &str = "a plan has no '{word}': a computation shows a value in the log";
pub(super) const LOG: &str = "write 'computation show: Log(value = {shown:1}) { Done -> {here} }'";
pub(super) const WAITS: &str = "a plan has no '{word}': an actor waits";
pub(super) const WRITES: &str = "a plan has no assignment: a computation writes to an entry";
pub(super) const NO_LIST: &str = "the language has no lists: a table has constants";
pub(super) const TABLE: &str =
    "write 'table values(value: int) { (1) (2) }' in the file, and read it with 'Row' of 'std'";
pub(super) const COUNTS_UP: &str = "write '{event} -> set', and in the plan: 'computation set: Assign(value = {1} + 1, result => {1}) { Done -> {here} }'";
pub(super) const NO_HISTORY: &str =
    "a plan has no history: 'return' continues the element that 'suspend' paused";
pub(super) const NO_MESSAGES: &str =
    "plans do not send messages: an entry holds a value, and a supervisor watches it";
pub(super) const CHANGED: &str = "write the entry with 'Assign', and watch it with 'supervise changed: Changed(value = {left}) { Changed -> {here} }'";
pub(super) const EDGE_OUTSIDE: &str = "an edge belongs in the braces of the element that it leaves";
pub(super) const NO_CALL: &str = "a plan calls nothing: an edge leads to an element";
pub(super) const CALLED: &str = "{act:help}";
pub(super) const NO_OBJECT: &str =
    "a plan makes no objects: templates have the devices of the robot";
pub(super) const SEQUENCE: &str = "a plan has no '{word}': edges select the next element";
