; Later patterns win: what a name names comes behind what every name is.

(name) @variable

[
  "afp" "use" "as"
  "plan" "forever" "resumable" "enum" "table" "toolbox" "version" "object" "sensor" "device" "scenario"
  "actor" "computation" "supervisor" "subplan" "supervise"
  "in" "live" "out" "var" "const" "from" "to"
  "start" "on" "every" "deadline" "budget" "stop"
  "icon" "uses" "needs" "state" "states" "of" "event" "exclusive" "once" "when" "and" "press" "fault" "signal" "truth"
  "for" "world" "seed" "over" "seeds" "worlds" "set" "robot" "at" "heading" "until"
  "expect" "never" "by" "active" "suspended" "running" "end" "interrupt" "commit"
  "always" "times" "within" "before" "after"
] @keyword

["terminate" "fail" "ignore" "resume" "suspend" "return"] @keyword

; Stimuli of scenarios; which there are, the grammar leaves open.
(action name: (name) @function)
((action name: (name) @keyword)
  (#any-of? @keyword "press" "release" "fire" "finish" "idle"))

["->" "=>" "=" "+" "-" "*" "/" "%" "^" "|" "==" "!=" "<" "<=" ">" ">=" ".."] @operator
["," ":" "."] @punctuation.delimiter
["{" "}" "(" ")"] @punctuation.bracket

[(int) (float)] @number
(unit) @type.builtin
(boolean) @constant.builtin
(string) @string
(escape) @escape
[(comment) (doc_comment)] @comment

(type (reference (name) @type))
(call function: (name) @function.builtin)

(plan name: (name) @type)
(enum name: (name) @type)
(table name: (name) @type)
(toolbox name: (name) @type)
(object name: (name) @type)
(template name: (name) @type)
(device name: (name) @type)
(use name: (name) @type)
(use alias: (name) @type)
(variant name: (name) @constant)

(element name: (name) @function)
(guard name: (name) @function)
(reactions supervisor: (name) @function)
(start target: (name) @function)
(edge target: (name) @function)
(element template: (reference (name) @type))
(guard template: (reference (name) @type))
(scenario plan: (reference (name) @type))

(bind_in port: (name) @property)
(bind_out port: (name) @property)
(in_port name: (name) @property)
(out_port name: (name) @property)
(column name: (name) @property)

(outcome name: (name) @constant)
(edge outcome: (name) @constant)
; States and events that need no declaration.
([(edge outcome: (name) @constant.builtin) (path (name) @constant.builtin)]
  (#any-of? @constant.builtin "Error" "DeadlineMissed" "Interrupted" "OK"))
