"""Components that run simulations themselves, reference cycles, and the delay of interruptions."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import afp
from conftest import interrupted

GO = "use tools\nplan P { start go actor go: Go { Done -> terminate } }"


def tools_with(poll: Callable[..., Any]) -> afp.Toolbox:
    """A toolbox with an actor that has this poll."""
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"], name="Go")
    class Go:
        def poll(self, robot: afp.Robot) -> Any:
            return poll(robot)

    return tools


def test_a_component_may_run_another_simulation(wall_following: afp.Plan) -> None:
    hashes: list[str] = []

    def poll(robot: afp.Robot) -> str:
        hashes.append(afp.Simulation(wall_following, seed=3).run(until=2.0).trace_hash)
        return "Done"

    plan = afp.Plan(GO, toolboxes=[tools_with(poll)])
    assert afp.Simulation(plan).run(until=1.0).check().ending == "ok"
    assert hashes == [afp.Simulation(wall_following, seed=3).run(until=2.0).trace_hash]


def test_simulations_inside_components_have_a_limit() -> None:
    deep: list[int] = []

    def poll(robot: afp.Robot) -> str:
        deep.append(1)
        return afp.Simulation(plan).run(until=1.0).check().ending and "Done"

    plan = afp.Plan(GO, toolboxes=[tools_with(poll)])
    said: list[BaseException] = []

    def work() -> None:
        try:
            afp.Simulation(plan).run(until=1.0).check()
        except RuntimeError as error:
            said.append(error)

    before = threading.stack_size(512 * 1024)
    try:
        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
    finally:
        threading.stack_size(before)
    assert len(deep) == 8 and "inside one another's components" in str(said[0])


def test_a_component_cannot_sweep() -> None:
    plan = afp.Plan(GO, toolboxes=[tools_with(lambda robot: afp.sweep(plan, progress=False))])
    with pytest.raises(RuntimeError, match="a component cannot run a sweep"):
        afp.Simulation(plan).run(until=1.0).check()


def test_circles_of_references_are_freed() -> None:
    class Mark:
        pass

    def once(breaks: bool) -> weakref.ref[Mark]:
        kept: list[Any] = [Mark()]

        def poll(robot: afp.Robot) -> None:
            assert kept
            if breaks and robot.time > 0.03:
                raise ValueError("on purpose")

        tools = tools_with(poll)
        plan = afp.Plan(GO, toolboxes=[tools])
        simulation = afp.Simulation(plan)
        kept += [tools, plan, simulation, simulation.run_to(0.05), simulation.run(until=0.1), plan.scenarios]
        return weakref.ref(kept[0])

    marks = [once(breaks) for breaks in (False, True)]
    gc.collect()
    assert [mark() for mark in marks] == [None, None]


def test_a_value_may_look_at_its_simulation(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)

    class Asks:
        def __float__(self) -> float:
            return 0.4 + simulation.time

    simulation["walldist"] = Asks()
    assert simulation["walldist"] == 0.4

    class Ends:
        def __float__(self) -> float:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        simulation["walldist"] = Ends()


def test_ctrl_c_interrupts_a_scenario() -> None:
    quiet = "use carbot\nplan P { start go actor go: Turn(angle = 90 deg) { TurnSuccessful -> go } }"
    plan = afp.Plan(f'{quiet}\nscenario "long" for P {{ never collision after 1 s until 1 h }}')
    assert plan.ok, plan.report()
    assert interrupted(plan.scenarios[0].run) < 1.0


def test_ctrl_c_interrupts_a_robot_that_drives() -> None:
    robot = afp.Carbot(afp.World.random(1))
    assert interrupted(lambda: robot.drive(0.0, 0.5, 1e6)) < 1.0
    assert robot.time > 0.0


def test_an_exit_of_the_program_ends_a_sweep_at_once() -> None:
    def poll(robot: afp.Robot) -> None:
        raise SystemExit(3)

    plan = afp.Plan(GO, toolboxes=[tools_with(poll)])
    begin = time.perf_counter()
    with pytest.raises(SystemExit):
        afp.sweep(plan, seeds=1_000_000, until=100.0, progress=False)
    assert time.perf_counter() - begin < 10.0


def test_a_scenario_raises_an_exit_of_the_program() -> None:
    def poll(robot: afp.Robot) -> None:
        raise SystemExit(3)

    plan = afp.Plan(f'{GO}\nscenario "one" for P {{ expect running until 1 s }}', toolboxes=[tools_with(poll)])
    with pytest.raises(SystemExit):
        plan.scenarios[0].run()


@pytest.mark.skipif(sys.platform == "win32", reason="it sends a signal")
def test_a_signal_handler_sees_the_running_simulation(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    seen: list[tuple[float, str, str | None]] = []

    def look(*_: object) -> None:
        seen.append((simulation.time, simulation.ending, simulation.active))
        simulation.request_stop()

    before = signal.signal(signal.SIGUSR1, look)
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGUSR1)).start()
    try:
        result = simulation.run(until=1e6)
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert result.stopped_by == "stop"
    (time, ending, active) = seen[0]
    assert 0.0 <= time <= result.time and ending == "running" and active


def test_the_thread_that_imports_the_package_is_the_main_thread() -> None:
    code = "import sys, afp; afp.__version__; assert 'threading' in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
