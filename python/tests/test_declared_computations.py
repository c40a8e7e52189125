"""Computations that are declared by formulas, without a body in Python."""

from __future__ import annotations

import pickle

import pytest

import afp

STEER = """computation Steer {
    in  error: length
    in  count: int
    out turn:  angle
    out next:  int
    state Far when error > 2 cm and count < 2 {
        turn = 10 deg * (count + 1)
        next = count + 1
    }
    state Near { next = 0 }
}"""

PLAN = """plan Correct {
    in  error: length = 3 cm
    var count: int = 0
    out turn:  angle = 0 deg
    start steer
    computation steer: Steer(error, count, turn => turn, next => count) { Far -> steer, Near -> terminate }
}"""


def run(plan: afp.Plan, **entries: float) -> tuple[str, float, int]:
    result = afp.Simulation(plan, set=entries).run(until=1.0)
    assert result.ending == "ok"
    return result.trace_hash, result.entries["turn"], result.entries["count"]


@pytest.mark.parametrize("error", [0.01, 0.03])
def test_declared_computations_are_equal_in_every_notation(error: float) -> None:
    text = afp.Plan(f"use std\n{STEER}\n{PLAN}")
    built = afp.Plan(f"use std\n{PLAN}")
    assert not built.ok
    built.add_plan(STEER)
    assert built.ok and text.ok
    tools = afp.Toolbox.parse(f"toolbox tools\n{STEER}")
    shared = afp.Plan(f"use tools\n{PLAN}", toolboxes=[tools])
    assert run(built, error=error) == run(text, error=error)
    assert run(shared, error=error)[1:] == run(text, error=error)[1:]
    assert run(pickle.loads(pickle.dumps(shared)), error=error) == run(shared, error=error)
    _, turn, count = run(text, error=error)
    assert (round(turn / afp.deg(1), 6), count) == (20.0 if error > 0.02 else 0.0, 0)


def test_conditions_and_formulas_are_changed() -> None:
    plan = afp.Plan(f"use std\n\n{STEER}\n\n{PLAN}\n")
    plan.set_condition("Steer", "Far", "error > 2 cm and count < 3")
    plan.assign("Steer", "Far", "turn", afp.deg(7))
    plan.assign("Steer", "Near", "next", "7")
    assert "state Far when error > 2 cm and count < 3 {" in plan.text
    _, turn, count = run(plan)
    assert (round(turn / afp.deg(1), 6), count) == (7.0, 7)
    plan.assign("Steer", "Near", "next", None)
    assert "state Near {}" in plan.text
    assert run(plan)[2] == 3


def test_errors_are_reported_at_the_declaration() -> None:
    plan = afp.Plan(f"use std\n{STEER}\n{PLAN}")
    plan.assign("Steer", "Far", "turn", "error")
    assert [(found.code, found.line) for found in plan.diagnostics] == [("E0204", 8)]
    for wrong in ("error", "error > 2 cm {} state New when error > 1 cm"):
        with pytest.raises(afp.AfpError, match="is not a condition"):
            plan.set_condition("Steer", "Far", wrong)
    with pytest.raises(afp.AfpError, match="there is no computation 'Other'"):
        plan.set_condition("Other", "Far", None)
    with pytest.raises(afp.AfpError, match="'Steer' already exists"):
        plan.add_plan(STEER)


def test_python_cannot_implement_a_declared_computation() -> None:
    tools = afp.Toolbox.parse(f"toolbox tools\n{STEER}")
    with pytest.raises(ValueError, match="have bodies"):
        tools.implement(lambda error, count: "Near", "Steer")
