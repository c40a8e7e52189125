"""Misbehaving components, in an order that the test decides."""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import afp
from values import Planned

if TYPE_CHECKING:
    from machine import Stress

TEXT = """
use carbot
use tools
plan P {{
    var number: float = 1.0
    in far: length = 20 cm
    start first
    supervise watch: Watch(limit = far) {{ Seen -> ask }}
    computation first: Compute(value = number, told => number) {{ Done -> go Told -> ask }}
    actor go: Act(far = far, live_far = far, told => number) {{ Done -> ask Told -> first {error} }}
    actor ask: Ask(told => number) {{
        supervise touch: CheckTouchSensor {{ TouchSensorPressed -> go }}
        Done -> go Told -> terminate {error}
    }}
}}
"""
ERRORS = ["", "Error -> ask", "Error -> terminate", "Error -> first"]

RAISED: dict[str, Callable[[], BaseException]] = {
    "raise ValueError": lambda: ValueError("on purpose"),
    "raise StopIteration": lambda: StopIteration("on purpose"),
    "raise MemoryError": lambda: MemoryError("on purpose"),
    "raise AfpError": lambda: afp.AfpError("on purpose"),
    "raise SystemExit": lambda: SystemExit(3),
    "raise KeyboardInterrupt": KeyboardInterrupt,
    "raise GeneratorExit": GeneratorExit,
    "raise Planned": lambda: Planned("on purpose"),
}
SAID: dict[str, Any] = {
    "go on": None,
    "done": "Done",
    "seen": "Seen",
    "told": ("Told", {"told": 2.0}),
    "told a text": ("Told", {"told": "x"}),
    "told infinity": ("Told", {"told": float("inf")}),
    "told nothing": "Told",
    "say a number": 3,
    "say a list": ["Done"],
    "say too much": ("Done", {"told": 1.0}, 3),
    "say bytes": b"Done",
}


def own(machine: Stress) -> afp.Simulation:
    """The simulation of this component."""
    if not machine.driven:
        raise ValueError("no simulation is being driven")
    return machine.driven[-1]


def thread(work: Callable[[], object]) -> None:
    """Do something in another thread, which raises its own exceptions."""

    def quietly() -> None:
        try:
            work()
        except machine_exceptions:
            pass

    worker = threading.Thread(target=quietly)
    worker.start()
    worker.join()


machine_exceptions = (Exception, Planned, KeyboardInterrupt, SystemExit, GeneratorExit)


def forget(machine: Stress) -> None:
    """Drop everything that the test holds."""
    machine.sims.clear()
    machine.plans.clear()
    machine.results.clear()
    gc.collect()


def nested(machine: Stress) -> None:
    """Run another simulation of some plan."""
    if machine.nested > 0 and machine.plans:
        machine.nested -= 1
        machine.drive(afp.Simulation(machine.plans[0], seed=1), lambda sim: sim.run(until=0.03))


def redefine(machine: Stress) -> None:
    """Replace the running implementation."""
    machine.tools[-1].implement(lambda value: "Done", "Compute")


DEEDS: dict[str, Callable[[Stress, Any], object]] = {
    "step own": lambda machine, robot: own(machine).step(),
    "run own": lambda machine, robot: own(machine).run(until=1.0),
    "look at own": lambda machine, robot: (own(machine).time, own(machine).camera),
    "write own": lambda machine, robot: own(machine).set("number", 2.0),
    "fire own": lambda machine, robot: own(machine).fire("go", "Done"),
    "iterate own": lambda machine, robot: next(iter(own(machine))),
    "close own": lambda machine, robot: own(machine).close(),
    "errors of own": lambda machine, robot: own(machine).errors,
    "stop own": lambda machine, robot: own(machine).request_stop(),
    "own in a thread": lambda machine, robot: thread(lambda: own(machine).run(until=1.0)),
    "robot in a thread": lambda machine, robot: thread(lambda: robot.drive(0.1)),
    "forget": lambda machine, robot: forget(machine),
    "another": lambda machine, robot: nested(machine),
    "another in a thread": lambda machine, robot: thread(lambda: nested(machine)),
    "redefine": lambda machine, robot: redefine(machine),
    "change the plan": lambda machine, robot: machine.plans[0].set_entry_value("number", "3.0"),
    "sweep": lambda machine, robot: afp.sweep(machine.plans[0], until=0.1, progress=False),
    "drive": lambda machine, robot: robot.drive(0.3, -1.0),
    "drive wrong": lambda machine, robot: robot.drive("fast"),
    "drive far too fast": lambda machine, robot: robot.drive(float("inf")),
    "sense": lambda machine, robot: (robot.camera, robot.odometry, robot.distance, robot.battery),
    "sense wrong": lambda machine, robot: robot.smell,
    "keep the robot": lambda machine, robot: machine.robots.append(robot),
    "use a kept robot": lambda machine, robot: [kept.time for kept in machine.robots[-3:]],
}
# Computations have no robot.
WITH_ROBOT = {"drive", "drive wrong", "drive far too fast", "sense", "sense wrong", "keep the robot", "robot in a thread"}
ACTIONS = [*SAID, *RAISED, *DEEDS]


class Script:
    """The actions of a plan's callbacks, in a loop."""

    def __init__(self, machine: Stress, actions: list[str]) -> None:
        self.machine = machine
        self.actions = actions
        self.next = 0

    def act(self, robot: Any = None) -> Any:
        """Do the next action."""
        action = self.actions[self.next % len(self.actions)]
        self.next += 1
        self.machine.told += 1
        if self.machine.told < 100:
            self.machine.note(f"    {action}")
        if action in RAISED:
            error = RAISED[action]()
            self.machine.raised.add(type(error))
            raise error
        if action in WITH_ROBOT and robot is None:
            return None
        if action in DEEDS:
            DEEDS[action](self.machine, robot)
            return None
        return SAID[action]


def toolbox(machine: Stress, actions: list[str]) -> afp.Toolbox:
    """Components of every kind that follow one script."""
    script = Script(machine, actions)
    tools = afp.Toolbox("tools")

    @tools.actor(states={"Done": {}, "Told": {"told": float}}, uses=["navigator", "rotator"])
    class Act:
        def __init__(self, robot: afp.Robot, far: afp.Length) -> None:
            self.robot, self.tools = robot, tools
            script.act(robot)

        def poll(self, live_far: afp.Length) -> Any:
            return script.act(self.robot)

        def interrupt(self, robot: afp.Robot) -> None:
            script.act(robot)

        def __del__(self) -> None:
            machine.gone += 1

    @tools.actor(states={"Done": {}, "Told": {"told": float}}, uses=["navigator", "rotator"])
    async def Ask(robot: afp.Robot) -> Any:
        try:
            while True:
                said = script.act(robot)
                if said is not None:
                    return said
                await afp.tick()
        finally:
            script.act(robot)

    @tools.supervisor(events=["Seen"], every="20 ms")
    def Watch(robot: afp.Robot, limit: afp.Length, wanted: Any) -> Any:
        return script.act(robot)

    @tools.computation(states={"Done": {}, "Told": {"told": float}})
    def Compute(value: float) -> Any:
        return script.act() or "Done"

    return tools
