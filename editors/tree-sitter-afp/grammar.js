// The grammar of docs/grammar.md for tree-sitter. As in the language, keywords are reserved only
// where the grammar expects them; if a name is possible too, the next sign decides.

/// <reference types="tree-sitter-cli/dsl" />

/** @type {(rule: RuleOrLiteral) => RepeatRule} Items, each with an optional comma. */
const items = (rule) => repeat(seq(rule, optional(',')));
/** @type {(rule: RuleOrLiteral) => SeqRule} */
const list = (rule) => seq(rule, repeat(seq(',', rule)));
/** @type {(rule: RuleOrLiteral) => SeqRule} */
const braces = (rule) => seq('{', items(rule), '}');
const range = ($) => seq('from', $._formula, 'to', $._formula);
const value = ($) => seq('=', field('value', $._formula));
const typed = ($) => seq(':', field('type', $.type));
/** A keyword that is a name here. */
const name = ($, ...words) => alias(words.length === 1 ? words[0] : choice(...words), $.name);

module.exports = grammar({
  name: 'afp',

  word: ($) => $.name,

  extras: ($) => [/\s/, $.comment, $.doc_comment],

  // A unit follows a number on its line.
  externals: ($) => [$.unit, $._error_sentinel],

  supertypes: ($) => [$._formula],

  rules: {
    file: ($) => seq(optional($.version), repeat(seq($._item, optional(',')))),

    version: ($) => seq('afp', $.int),

    _item: ($) =>
      choice($.use, $.plan, $.scenario, $.enum, $.table, $.toolbox, $.object, $.template, $.device),

    use: ($) =>
      seq('use', choice($.string, seq(field('name', $.name), optional(seq('as', field('alias', $.name)))))),

    // Plans.

    plan: ($) => seq('plan', field('name', $.name), optional('forever'), braces($._plan_item)),

    _plan_item: ($) => choice($.entry, $.start, $.guard, $.element),

    entry: ($) =>
      choice(
        seq(choice(seq('in', optional('live')), 'out', 'var', 'const'), field('name', $.name), optional(typed($)), optional(value($)), optional($.range)),
        seq('in', field('name', name($, 'live')), choice(seq(typed($), optional(value($))), value($)), optional($.range)),
      ),

    range: ($) => range($),

    start: ($) => seq('start', field('target', $.name)),

    element: ($) =>
      seq(choice('actor', 'computation', 'subplan'), $._head, choice(braces(choice($.guard, $.reactions, $.edge)), alias($._only_edge, $.edge))),

    // Short form for the only state of an element.
    _only_edge: ($) => seq('->', $._edge_target),

    guard: ($) => seq('supervise', $._head, repeat($.timing), braces($.edge)),

    _head: ($) => seq(field('name', $.name), ':', field('template', $.reference), optional($.arguments)),

    timing: ($) => seq(choice('every', 'deadline'), choice($._time, $.reference)),

    reactions: ($) => seq('on', field('supervisor', $.name), braces($.edge)),

    edge: ($) =>
      seq(
        field('outcome', choice($.name, name($, 'supervise', 'on'))),
        repeat(seq(',', field('outcome', $.name))),
        $._only_edge,
      ),

    _edge_target: ($) =>
      choice(
        field('target', $.name),
        seq('suspend', field('target', $.name)),
        'terminate',
        'ignore',
        'resume',
        'return',
        seq('fail', optional($.string)),
      ),

    arguments: ($) => seq('(', items(choice($.bind_in, $.bind_out, $.bind_same)), ')'),

    bind_in: ($) => seq(field('port', $.name), value($)),

    bind_out: ($) => seq(field('port', $.name), '=>', field('entry', $.name)),

    bind_same: ($) => field('port', $.name),

    // Tables.

    table: ($) => seq('table', field('name', $.name), '(', items($.column), ')', braces($.row)),

    column: ($) => seq(field('name', $.name), typed($)),

    row: ($) => seq('(', optional(seq(list($._formula), optional(','))), ')'),

    // Toolboxes.

    toolbox: ($) => seq('toolbox', field('name', $.name), optional(seq('version', $.string))),

    object: ($) => seq('object', field('name', $.name)),

    enum: ($) => seq('enum', field('name', $.name), braces($.variant)),

    variant: ($) => field('name', $.name),

    template: ($) => seq(choice('actor', 'supervisor', 'computation'), field('name', $.name), optional('resumable'), braces($._part)),

    _part: ($) =>
      choice($.icon, $.uses, $.outcome, $.exclusive, $.states_of, $.in_port, $.out_port, $.template_timing),

    icon: ($) => seq('icon', $.string),

    uses: ($) => seq(choice('uses', 'needs'), $.name),

    outcome: ($) =>
      choice(
        seq('state', field('name', $.name), optional(seq(optional($.condition), braces($.bind_in)))),
        seq('event', field('name', $.name), optional(choice('once', $.condition, $.after))),
      ),

    after: ($) => seq('after', $._formula),

    exclusive: ($) => seq('exclusive', field('event', $.name), field('event', $.name), optional($.condition)),

    condition: ($) => seq('when', $.comparison, repeat(seq('and', $.comparison))),

    comparison: ($) => seq($._formula, choice('==', '!=', '<', '<=', '>', '>='), $._formula),

    states_of: ($) => seq('states', 'of', field('port', $.name)),

    in_port: ($) =>
      seq(
        'in',
        choice(seq(optional('live'), field('name', $.name)), field('name', name($, 'live'))),
        typed($),
        optional(value($)),
        optional($.range),
      ),

    out_port: ($) =>
      seq('out', field('name', $.name), typed($), optional(seq('on', $.name, repeat(seq('|', $.name))))),

    template_timing: ($) => seq(choice('every', 'deadline', 'budget', 'stop'), $._time),

    device: ($) => seq(choice(seq(choice('device', 'sensor'), field('name', $.name)), seq('robot', optional(field('name', $.name)))), braces($._device_part)),

    _device_part: ($) => choice($.controls, $.signal, $.fault),

    controls: ($) => prec.right(seq(choice('press', 'stop'), $.name, repeat(seq(optional(','), $.name)))),

    signal: ($) => seq(choice('signal', 'truth'), field('name', $.name), typed($)),

    fault: ($) => seq('fault', field('name', $.name), optional(seq('(', $.amount, ')'))),

    amount: ($) => seq(field('name', $.name), typed($), optional(value($)), optional($.range)),

    // Scenarios.

    scenario: ($) => seq('scenario', field('name', $.string), 'for', field('plan', $.reference), braces($._line)),

    _line: ($) => choice($.world, $.seed, $.over, $.set, $.robot, $.stimulus, $.expectation, $.moment, $.until),

    world: ($) => seq('world', $.string),

    seed: ($) => seq('seed', $.int),

    over: ($) => prec.right(seq('over', choice(seq('seeds', $.int, '..', $.int), seq('worlds', list($.string))))),

    set: ($) => seq('set', $.path, value($)),

    robot: ($) => seq('robot', 'at', '(', $._formula, ',', $._formula, ')', optional(seq('heading', $._formula))),

    stimulus: ($) => seq('at', $._time, ':', choice($.set, $.action)),

    action: ($) =>
      seq(field('name', $.name), $.path, optional($.arguments), optional(seq('for', $._time))),

    moment: ($) => seq('from', $.claim, braces($._line)),

    expectation: ($) => seq(choice('expect', 'never'), $.claim, repeat($.bound)),

    claim: ($) =>
      choice(
        seq(
          $._claimed_path,
          '->',
          choice($.path, seq('suspend', $.path), 'terminate', 'fail', 'resume', 'return'),
          optional($._by),
        ),
        prec(-1, seq($._claimed_path, optional(choice('active', 'suspended')))),
        seq($._claimed_path, choice('==', '!=', '<', '<=', '>', '>='), $._formula),
        'running',
        seq('end', optional($._by)),
        seq('interrupt', 'of', $.path),
        seq('commit', choice(seq('of', $.path, optional($._by)), $._by)),
      ),

    // Before a point, an arrow or a comparison, every word is a name.
    _claimed_path: ($) =>
      choice(
        $.path,
        alias($._path_of_word, $.path),
      ),

    _path_of_word: ($) =>
      prec(-2, seq(name($, 'running', 'end', 'interrupt', 'commit'), repeat(seq('.', $.name)))),

    _by: ($) => seq('by', $.path),

    bound: ($) => choice('always', 'once', seq($.int, 'times'), seq(choice('within', 'before', 'after'), $._time)),

    until: ($) => seq('until', $._time),

    path: ($) => seq($.name, repeat(seq('.', $.name))),

    // Types and formulas.

    type: ($) => seq($._factor, repeat(seq(choice('*', '/'), $._factor))),

    _factor: ($) => seq(choice($.reference, $.int), optional(seq('^', optional('-'), $.int))),

    reference: ($) => seq($.name, optional(seq('.', $.name))),

    _formula: ($) =>
      choice($.sum, $.product, $.negation, $.brackets, $.call, $.reference, $.boolean, $.string, $.int, $.float, $.quantity),

    sum: ($) => prec.left(1, seq($._formula, choice('+', '-'), $._formula)),

    product: ($) => prec.left(2, seq($._formula, choice('*', '/', '%'), $._formula)),

    negation: ($) => prec(3, seq('-', $._formula)),

    brackets: ($) => seq('(', $._formula, ')'),

    call: ($) => seq(field('function', $.name), '(', optional(list($._formula)), ')'),

    boolean: () => choice('true', 'false'),

    _time: ($) => choice($.quantity, $.int, $.float, alias($._negative_time, $.negation)),

    _negative_time: ($) => seq('-', choice($.quantity, $.int, $.float)),

    quantity: ($) => seq(choice($.int, $.float), $.unit),

    int: () => /\d+/,

    float: () => /\d+(\.\d+([eE][+-]?\d+)?|[eE][+-]?\d+)/,

    string: ($) =>
      seq('"', repeat(choice(token.immediate(prec(1, /[^"\\\n]+/)), $.escape)), token.immediate('"')),

    escape: () => token.immediate(/\\[^\n]/),

    name: () => /[A-Za-z_][A-Za-z0-9_]*/,

    // Four or more slashes begin a plain comment.
    comment: () => token(choice(/\/\/([^\/\n][^\n]*)?/, /\/\/\/\/[^\n]*/)),

    doc_comment: () => /\/\/\/([^\/\n][^\n]*)?/,
  },
});
