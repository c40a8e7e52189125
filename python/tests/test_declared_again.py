"""Plans, scenarios and sweeps after a change of their toolbox, for example by a repeated notebook
cell.
"""

from __future__ import annotations

import copy

import pytest

import afp

PLAN = """use tools
plan P {
    in n: int = 3
    in word: string = "hello"
    var got: string
    start a
    actor a: A(n = n, word = word, got => got) { Good -> terminate, Bad -> b }
    actor b: A(n = n, word = word, got => got) { Good -> b, Bad -> terminate }
}
scenario "once" for P { expect end }
"""


def declare(tools: afp.Toolbox, *states: str) -> None:
    """Declare the template with its states in this order; its component always reports `Good`."""

    @tools.actor(states={state: {"got": str} for state in states})
    async def A(n: int, word: str) -> tuple[str, dict[str, str]]:
        return "Good", {"got": f"{n} {word}"}


def states(plan: afp.Plan) -> list[str | None]:
    return [event.outcome for event in afp.Simulation(plan).run().events if event.outcome]


def test_a_plan_uses_the_current_toolbox() -> None:
    tools = afp.Toolbox("tools")
    declare(tools, "Good", "Bad")
    plan = afp.Plan(PLAN, toolboxes=[tools])
    assert states(plan) == ["Good"]
    declare(tools, "Bad", "Good")
    assert states(plan) == states(copy.copy(plan)) == ["Good"]
    assert set(afp.sweep(plan, seeds=2, progress=False).columns["where"]) == {"a"}

    @tools.actor(states={"Good": {"got": str}, "Bad": {"got": str}})
    async def A(word: str, n: int) -> tuple[str, dict[str, str]]:
        return "Good", {"got": f"{n} {word}"}

    assert afp.Simulation(plan).run().entries["got"] == "3 hello"


def test_a_plan_that_does_not_match_its_toolbox_reports_the_reason() -> None:
    tools = afp.Toolbox("tools")
    declare(tools, "Good", "Bad")
    plan = afp.Plan(PLAN, toolboxes=[tools])
    assert plan.ok
    declare(tools, "Good")
    assert not plan.ok
    with pytest.raises(afp.PlanError, match="'A' has no state 'Bad'"):
        afp.Simulation(plan)
    plan.disconnect("a", "Bad")
    plan.disconnect("b", "Bad")
    assert states(plan) == ["Good"]

    @tools.actor(states={"Good": {"got": str}})
    async def A(n: afp.Length, word: str) -> tuple[str, dict[str, str]]:
        return "Good", {"got": f"{n} {word}"}

    with pytest.raises(afp.PlanError, match="expected a length, found a bare number"):
        afp.Simulation(plan)


def test_objects_from_an_older_toolbox_are_refused() -> None:
    tools = afp.Toolbox("tools")
    declare(tools, "Good", "Bad")
    plan = afp.Plan(PLAN, toolboxes=[tools])
    (scenario,) = plan.scenarios
    runs = afp.sweep(plan, progress=False)
    declare(tools, "Good", "Bad")
    assert scenario.run().passed and runs.result(0).ending == "ok", "what does something else is no other declaration"
    declare(tools, "Bad", "Good")
    for again in (scenario.run, lambda: runs.simulation(0)):
        with pytest.raises(afp.AfpError, match="the toolbox 'tools' has changed since"):
            again()
    assert plan.scenarios[0].run().passed
