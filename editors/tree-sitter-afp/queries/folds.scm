[
  (plan)
  (element)
  (guard)
  (reactions)
  (enum)
  (table)
  (template)
  (device)
  (scenario)
  (moment)
] @fold
