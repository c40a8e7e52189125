"""Components in Python: classes, functions, coroutines; exceptions; interruption."""

from __future__ import annotations

import asyncio
import gc
import pickle
import weakref
from typing import Any, Literal

import pytest

import afp


def run(tools: afp.Toolbox, body: str, until: float = 2.0, **options: Any) -> afp.Result:
    plan = afp.Plan(f"use std\nuse carbot\nuse {tools.name}\nplan P {{ {body} }}", toolboxes=[tools])
    plan.check()
    return afp.Simulation(plan, **options).run(until=until)


def test_a_class_for_a_declared_template() -> None:
    tools = afp.Toolbox.parse(
        """toolbox hand version "1.0"
        enum Side { left, right }
        actor Creep {
            in far: length
            in side: Side = Side.left
            in live speed: speed = 0.2 m/s
            out went: length on There
            uses navigator
            every 20 ms
            state There
            state Blocked
        }
        """
    )
    seen: list[Any] = []

    @tools.implement
    class Creep:
        def __init__(self, robot: afp.Robot, far: float, side: str) -> None:
            self.far, self.robot = far, robot
            seen.append((far, side))

        def poll(self, robot: afp.Robot, speed: float) -> object:
            assert robot is self.robot and robot.time > 0.0
            robot.drive(speed)
            went = float(robot.odometry[0])
            return ("There", {"went": went}) if went >= self.far else None

    result = run(
        tools,
        "var went: length start go actor go: Creep(far = 20 cm, side = Side.right, speed = 30 cm/s, went => went)"
        "{ There -> terminate, Blocked -> terminate }",
    )
    assert result.ending == "ok" and seen == [(0.2, "right")]
    assert 0.2 <= result.entries["went"] < 0.25
    assert tools.implemented == ["Creep"]


def test_decorators_declare_templates() -> None:
    tools = afp.Toolbox("tools", doc="Made in Python.")

    @tools.actor(states={"There": {"went": afp.Length}, "Blocked": {}}, uses="navigator", every="20 ms")
    async def Creep(robot: afp.Robot, far: afp.Length, speed: afp.Speed = 0.2) -> object:
        """Creeps ahead."""
        while robot.odometry[0] < far:
            if robot.touched:
                return "Blocked"
            robot.drive(speed)
            await afp.tick()
        return "There", {"went": float(robot.odometry[0])}

    @tools.supervisor(events=["Near"], every="10 ms", deadline="10 ms")
    def CheckNear(robot: afp.Robot, distance: afp.Length) -> str | None:
        return "Near" if (robot.distance or 9.0) < distance else None

    @tools.computation(states={"Less": {"half": float}, "More": {"half": float}})
    def Halve(value: float, limit: float = 1.0) -> object:
        return "Less" if value / 2 < limit else "More", {"half": value / 2}

    assert "/// Creeps ahead." in tools.text and "in speed: speed = 0.2 m/s" in tools.text
    body = """
        var value: float = 8.0
        start halve
        computation halve: Halve(value = value, half => value) { Less -> go, More -> halve }
        actor go: Creep(far = 10 cm) {
            supervise near: CheckNear(distance = 1 mm) { Near -> terminate }
            There -> terminate
            Blocked -> terminate
        }"""
    result = run(tools, body)
    assert result.errors == [] and result.ending == "ok" and result.entries["value"] == 0.5


def test_an_exception_becomes_error_with_its_traceback() -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    class Breaks:
        def poll(self, robot: afp.Robot) -> str:
            if robot.time > 0.1:
                raise ZeroDivisionError("on purpose")
            return None  # type: ignore[return-value]

    result = run(tools, "start go actor go: Breaks { Done -> terminate }")
    assert (result.ending, result.fault) == ("error", "python-exception")
    [error] = result.errors
    assert error.template == "Breaks" and 0.1 < error.time < 0.12
    assert "on purpose" in error.traceback and "test_components.py" in error.traceback
    depths = []
    for _ in range(3):
        with pytest.raises(ZeroDivisionError) as raised:
            result.check()
        depths.append(len(raised.traceback))
    assert depths[0] == depths[1] == depths[2], "each raise is told from the component on"
    caught = run(tools, "start go actor go: Breaks { Done -> terminate Error -> terminate }")
    assert caught.ending == "ok" and len(caught.errors) == 1


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ("'Nothing'", "one of Done, Told"),
        ("3", "one of Done, Told"),
        ("'Told'", "without its output"),
        ("('Told', {'value': 'x'})", "the output 'value' of 'Says': expected a float, not a str"),
        ("('Told', {'value': afp.deg(3)})", "not a quantity in rad"),
        ("('Done', {'value': 1.0})", "has no output 'value'"),
        ("('Done',)", "one of Done, Told, or a pair"),
        ("('Done', {}, 3)", "one of Done, Told, or a pair"),
        ("('Told', {'value': float('nan')})", "the output 'value' of 'Says' is NaN; outputs are finite numbers"),
        ("robot.drive(0.1)", "'Says' commands 'navigator' without saying so"),
        ("robot.point(0.1)", "'Says' commands 'rotator' without saying so"),
        ("robot.smell", "no attribute 'smell'"),
        ("robot.drive(float('inf'))", "finite"),
    ],
)
def test_invalid_results_of_components_are_reported(said: str, why: str) -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states={"Done": {}, "Told": {"value": float}})
    class Says:
        def poll(self, robot: afp.Robot) -> object:
            return eval(said, {"robot": robot, "afp": afp})

    result = run(tools, "start go actor go: Says { Done -> terminate Told -> terminate }")
    assert result.fault == "python-exception" and why in result.errors[0].traceback


def test_interruption_cancels_a_coroutine() -> None:
    tools = afp.Toolbox("tools")
    ends: list[str] = []

    @tools.actor(states=["Done"], uses="navigator")
    async def Forever(robot: afp.Robot) -> str:
        try:
            while True:
                robot.drive(0.2)
                await afp.tick()
        finally:
            ends.append("cancelled")

    body = "start go actor go: Forever { supervise t: CheckTimeout(duration = 0.5 s) { TimedOut -> rest } Done -> rest }"
    result = run(tools, body + "actor rest: Wait { Elapsed -> terminate }")
    assert ends == ["cancelled"] and result.ending == "ok"
    still = result.path[result.path[:, 0] > 1.2][:, 1:3]
    assert abs(still - still[0]).max() < 1e-3


def test_interrupt_of_a_class_is_called_once() -> None:
    tools = afp.Toolbox("tools")
    calls: list[str] = []

    @tools.actor(states=["Done"])
    class Forever:
        def poll(self) -> None:
            return None

        def interrupt(self, robot: afp.Robot) -> None:
            calls.append(f"interrupted at {robot.time}")

    body = "start go actor go: Forever { supervise t: CheckTimeout(duration = 0.5 s) { TimedOut -> terminate } Done -> terminate }"
    run(tools, body)
    assert len(calls) == 1


PAUSED = """start go
    supervise once: After(duration = 0.5 s) { Elapsed -> suspend rest }
    actor rest: Wait(duration = 1 s) { Elapsed -> return }
"""
"""An event suspends `go` for a second."""


def test_a_class_is_suspended_and_continues() -> None:
    tools = afp.Toolbox("tools")
    calls: list[str] = []

    @tools.actor(states=["There"], uses="navigator")
    class Ahead:
        def __init__(self, far: afp.Length) -> None:
            self.far = far
            calls.append("start")

        def poll(self, robot: afp.Robot) -> str | None:
            if robot.odometry[0] >= self.far:
                robot.stop()
                return "There"
            robot.drive(0.2)
            return None

        def suspend(self) -> None:
            calls.append("suspend")

        def resume(self, away: float) -> None:
            calls.append(f"resume after {away} s")

    result = run(tools, PAUSED + "actor go: Ahead(far = 30 cm) { There -> terminate }", until=5.0)
    assert "actor Ahead resumable" in tools.text
    assert calls == ["start", "suspend", "resume after 1.0 s"] and result.ending == "ok"
    moved = result.path[:, 1] - result.path[0, 1]
    assert 0.29 < moved[-1] < 0.35
    still = moved[(result.path[:, 0] > 0.9) & (result.path[:, 0] < 1.5)]
    assert 0.05 < still[0] < 0.15 and abs(still - still[0]).max() < 1e-3


def test_a_coroutine_learns_how_long_it_was_suspended() -> None:
    tools = afp.Toolbox("tools")
    aways: list[float] = []

    @tools.actor(states=["Done"], uses="navigator", resumable=True)
    async def Roll(robot: afp.Robot, time: afp.Duration) -> str:
        end = robot.time + time
        while robot.time < end:
            robot.drive(0.1)
            aways.append(await afp.tick())
            end += aways[-1]
        robot.stop()
        return "Done"

    result = run(tools, PAUSED + "actor go: Roll(time = 1 s) { Done -> terminate }", until=5.0)
    assert [away for away in aways if away] == [1.0]
    assert result.ending == "ok" and 2.0 <= result.time < 2.1
    still = result.path[(result.path[:, 0] > 0.9) & (result.path[:, 0] < 1.5)][:, 1]
    assert abs(still - still[0]).max() < 1e-3


def test_an_abandoned_coroutine_is_closed() -> None:
    tools = afp.Toolbox("tools")
    ends: list[str] = []

    @tools.actor(states=["Done"], uses="navigator", resumable=True)
    async def Forever(robot: afp.Robot) -> str:
        try:
            while True:
                robot.drive(0.1)
                await afp.tick()
        finally:
            ends.append("closed")

    body = PAUSED + "actor go: Forever { Done -> terminate } supervise late: CheckTimeout(duration = 1 s) { TimedOut -> terminate }"
    result = run(tools, body)
    assert ends == ["closed"] and result.ending == "interrupted" and result.time < 1.1
    assert [event.kind for event in result.events if event.component == "go"] == ["started", "suspended", "abandoned"]


def test_a_supervisor_with_resume_keeps_its_instance() -> None:
    tools = afp.Toolbox("tools")
    calls: list[str] = []

    @tools.supervisor(events=["Never"])
    class Keeps:
        def __init__(self) -> None:
            calls.append("keeps")

        def poll(self) -> None: ...

        def resume(self, robot: afp.Robot, away: float) -> None:
            calls.append(f"continues after {away} s at {robot.time} s")

    @tools.supervisor(events=["Never"])
    class Forgets:
        def __init__(self) -> None:
            calls.append("forgets")

        def poll(self) -> None: ...

    body = """actor go: Wait(duration = 1 s) {
        supervise keeps: Keeps { Never -> ignore }
        supervise forgets: Forgets { Never -> ignore }
        Elapsed -> terminate
    }"""
    result = run(tools, PAUSED + body, until=5.0)
    assert "supervisor Keeps resumable" in tools.text and "supervisor Forgets {" in tools.text
    assert result.ending == "ok"
    assert calls == ["keeps", "forgets", "continues after 1.0 s at 1.5 s", "forgets"]


def test_an_error_names_the_word_that_an_actor_lacks() -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    async def Plain() -> str:
        return "Done"

    with pytest.raises(afp.PlanError, match="E0321(.|\n)*'actor Plain resumable'"):
        run(tools, PAUSED + "actor go: Plain { Done -> terminate }")


def test_supervisors_receive_the_wanted_events() -> None:
    tools = afp.Toolbox("tools")
    told: list[set[str]] = []

    @tools.supervisor(events=["High", "Low"])
    class CheckLevel:
        def __init__(self, wanted: set[str]) -> None:
            told.append(wanted)

        def poll(self, level: float) -> str | None:
            return "High" if level > 5 else None

    body = """
        var level: float = 1.0
        start go
        actor go: Wait(duration = 1 s) {
            supervise level: CheckLevel(level = level) { High -> terminate, Low -> ignore }
            Elapsed -> terminate
        }"""
    plan = afp.Plan(f"use std\nuse tools\nplan P {{ {body.replace('supervise level', 'supervise check')} }}", toolboxes=[tools])
    simulation = afp.Simulation(plan)
    simulation.run_to(0.3)
    simulation["level"] = 6.0
    result = simulation.run(until=2.0)
    assert told == [{"High"}] and result.ending == "interrupted" and result.time < 0.4


def test_objects_are_passed_between_components() -> None:
    tools = afp.Toolbox.parse(
        """toolbox tools
        object Map
        computation Make { out map: Map state Made }
        computation Use { in map: Map out size: int state Used }
        """
    )

    @tools.implement
    def Make() -> object:
        return "Made", {"map": {"a": 1, "b": 2}}

    @tools.implement
    def Use(map: dict[str, int]) -> object:
        return "Used", {"size": len(map)}

    body = """
        var map: Map
        var size: int
        start make
        computation make: Make(map => map) { Made -> use }
        computation use: Use(map = map, size => size) { Used -> terminate }"""
    result = run(tools, body.replace("make: Make", "making: Make").replace("start make", "start making").replace("use: Use", "using: Use").replace("-> use", "-> using"))
    assert result.errors == [] and result.entries["size"] == 2


def test_a_component_cannot_drive_its_own_simulation() -> None:
    tools = afp.Toolbox("tools")
    kept: list[Any] = []

    @tools.actor(states=["Done"])
    class Meddles:
        def __init__(self, robot: afp.Robot) -> None:
            kept.append(robot)

        def poll(self) -> str:
            with pytest.raises(RuntimeError, match="is running"):
                kept[1].step()
            with pytest.raises(RuntimeError, match="is running"):
                kept[1].time
            return "Done"

    plan = afp.Plan("use tools\nplan P { start go actor go: Meddles { Done -> terminate } }", toolboxes=[tools])
    simulation = afp.Simulation(plan)
    simulation.step()
    kept.append(simulation)
    assert simulation.run(until=1.0).check().ending == "ok"
    with pytest.raises(RuntimeError, match="only while a component is being called"):
        kept[0].time


def test_ctrl_c_in_a_component_ends_the_run() -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    class Stops:
        def poll(self) -> str:
            raise KeyboardInterrupt

    plan = afp.Plan("use tools\nplan P { start go actor go: Stops { Done -> terminate Error -> go } }", toolboxes=[tools])
    simulation = afp.Simulation(plan)
    with pytest.raises(KeyboardInterrupt):
        simulation.run(until=5.0)
    # Previously it was reported as a panic of a component.
    result = simulation.result()
    assert (result.ending, result.fault) == ("error", "python-ended")
    with pytest.raises(afp.AfpError, match=r"after 0\.\d+ s: Ctrl-C, or another BaseException.*\(python-ended\)"):
        result.check()


def test_no_component_is_called_after_ctrl_c() -> None:
    tools = afp.Toolbox("tools")
    calls: list[str] = []

    @tools.actor(states=["Done"])
    class Blocks:
        def __init__(self) -> None:
            calls.append("start")
            if len(calls) > 1:
                raise KeyboardInterrupt

        def poll(self) -> str:
            calls.append("poll")
            raise RuntimeError("an ordinary one, which takes the edge")

        def interrupt(self) -> None:
            calls.append("interrupt")

    plan = afp.Plan("use tools\nplan P { start go actor go: Blocks { Done -> terminate Error -> go } }", toolboxes=[tools])
    with pytest.raises(KeyboardInterrupt):
        afp.Simulation(plan).run(until=5.0)
    assert calls == ["start", "poll", "interrupt", "start"]


def test_a_cell_can_be_run_twice() -> None:
    tools = afp.Toolbox("tools")
    for limit in (3, 4):

        @tools.computation(states=["Small", "Big"])
        def Size(value: int = limit) -> str:
            return "Small" if value < 4 else "Big"

        assert tools.templates == ["Size"] and f"value: int = {limit}" in tools.text
    plan = afp.Plan("use tools\nplan P { start s computation s: Size { Small -> terminate Big -> s } }", toolboxes=[tools])
    assert afp.Simulation(plan).run().fault == "livelock", "the later one counts"
    read = afp.Toolbox.parse("toolbox read\ncomputation Size { state Done }")
    with pytest.raises(afp.AfpError, match="E0212"):
        read.computation(states=["Done"], name="Size")(lambda: "Done")


def test_an_exception_names_its_element_and_its_time() -> None:
    tools = afp.Toolbox("tools")

    @tools.computation(states=["Done"])
    def Fails() -> str:
        raise ValueError("no")

    inner = "plan Inner { start c computation c: Fails { Done -> terminate } }"
    text = f"use std\nuse tools\nplan P {{ start w actor w: Wait(duration = 1 s) {{ Elapsed -> s }} subplan s: Inner {{ OK -> terminate Error -> c }} computation c: Fails {{ Done -> terminate }} }}\n{inner}"
    result = afp.Simulation(afp.Plan(text, toolboxes=[tools])).run()
    assert [(each.time, each.element, each.template) for each in result.errors] == [(1.0, "s.c", "Fails"), (1.0, "c", "Fails")]
    with pytest.raises(ValueError, match="no"):
        result.check()
    again = pickle.loads(pickle.dumps(result.errors[0]))
    assert (again.element, str(again.error), again.traceback) == ("s.c", "no", result.errors[0].traceback)


def test_a_toolbox_is_pickled_with_its_components() -> None:
    again = pickle.loads(pickle.dumps(PICKLED))
    assert again.text == PICKLED.text and again.implemented == ["Greater"] and again == PICKLED
    text = "use hand plan P { var by: float start go computation go: Greater(a = 3, by => by) { Yes -> terminate } }"
    assert afp.Simulation(afp.Plan(text, toolboxes=[again])).run().entries["by"] == 3.0


PICKLED = afp.Toolbox("hand")


def greater(a: float) -> Any:
    return "Yes", {"by": a}


PICKLED.computation(states={"Yes": {"by": float}}, name="Greater")(greater)


def test_invalid_declarations_are_reported() -> None:
    tools = afp.Toolbox("tools")
    with pytest.raises(TypeError, match="'far' of '.*Go' needs a type hint"):

        @tools.actor(states=["Done"])
        async def Go(far) -> str:  # type: ignore[no-untyped-def]
            return "Done"

    with pytest.raises(TypeError, match="must be a class with 'poll', or 'async def'"):

        @tools.actor(states=["Done"])
        def Sit() -> str:
            return "Done"

    with pytest.raises(ValueError, match="no template 'Fly' in the toolbox"):
        tools.implement(lambda: "Done", "Fly")
    with pytest.raises(afp.AfpError, match="E0"):
        afp.Toolbox.parse("toolbox t actor A {")
    plan = afp.Plan(
        "use hand\nplan P { start go actor go: Wave { Done -> terminate } }",
        toolboxes=[afp.Toolbox.parse("toolbox hand actor Wave { state Done }")],
    )
    with pytest.raises(afp.AfpError, match=r"no implementation of 'hand.Wave' is registered\n  help: implement it"):
        afp.Simulation(plan)


def test_components_are_freed_with_their_simulation() -> None:
    tools = afp.Toolbox("tools")
    kept: list[weakref.ref[Any]] = []

    @tools.actor(states=["Done"])
    class Waits:
        def __init__(self) -> None:
            kept.append(weakref.ref(self))

        def poll(self) -> None:
            return None

    run(tools, "start go actor go: Waits { Done -> terminate }", until=0.1)
    gc.collect()
    assert kept[0]() is None


def test_an_actor_that_awaits_asyncio_gets_an_explanation() -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    async def Sleepy() -> str:
        await asyncio.sleep(0.1)
        return "Done"

    text = "use tools plan P { start a actor a: Sleepy { Done -> terminate } }"
    with pytest.raises(TypeError, match=r"an actor can only await afp.tick\(\); asyncio's event loop"):
        afp.Simulation(afp.Plan(text, toolboxes=[tools])).run(until=1.0).check()


def test_a_return_annotation_declares_the_states() -> None:
    tools = afp.Toolbox("tools")

    @tools.computation()
    def Parity(value: int) -> Literal["Odd", "Even"]:
        return "Odd" if value % 2 else "Even"

    @tools.actor()
    class Go:
        def poll(self, robot: afp.Robot) -> Literal["There"] | None:
            return "There"

    assert "state Odd\n    state Even" in tools.text and "state There" in tools.text
    with pytest.raises(TypeError, match=r"the computation 'Nothing' needs states=\[...\], or a return annotation"):

        @tools.computation()
        def Nothing(value: int) -> str:
            return "Odd"
