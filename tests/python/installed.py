"""Prints the results of runs of a plan with an installed package; they are equal on every machine: `python installed.py PLAN`."""

import sys

import afp

plan = afp.load(sys.argv[1])
plan.check()
for seed in range(3):
    result = afp.Simulation(plan, seed=seed).run(until=20.0)
    print(seed, result.ending, result.trace_hash, result.path[-1].tolist())
