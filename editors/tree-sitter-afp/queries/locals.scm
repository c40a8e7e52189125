[(plan) (scenario)] @local.scope

(entry name: (name) @local.definition)
(element name: (name) @local.definition)
(guard name: (name) @local.definition)

(start target: (name) @local.reference)
(edge target: (name) @local.reference)
(reactions supervisor: (name) @local.reference)
(bind_out entry: (name) @local.reference)
(reference . (name) @local.reference)
