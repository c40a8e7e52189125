"""`PlanEnv`: a plan whose parameters and decisions a policy chooses, as options of a semi-Markov
process.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._afp import AfpError, Judge, target
from ..checks import text
from ..plan import Plan
from ..simulation import Simulation
from ..stimuli import Fault, Press, Presses, several
from ..units import UNITS, number_in, seconds
from . import picture
from .setting import RANGE, STEP, Faults, Setting, Worlds, gymnasium
from .tasks import ROAM, Task

__all__ = ["PlanEnv"]

SIZES = {"distance": 1, "bearing": 1, "odometry": 5, "touched": 1, "escape": 1, "battery": 2, "color": 3, "glow": 2}
"""The sensors that can be observed, and how many numbers each has."""
BEGINS = {"started", "resumed"}
"""The events with which an actor becomes active."""
NUMBERS = {"bool", "int", "float", *UNITS}
"""The types of entries that can be observed."""
FAR = 1e4
"""The largest observed number."""
TARGET = "target"


class PlanEnv(gymnasium.Env):  # type: ignore[misc]
    """A plan as an environment: the policy chooses, and the plan drives.

    `parameters` maps `in` and `var` entries of the plan to ranges in SI units: `{"walldist": (0.2,
    0.6)}`. A step sets them and runs the plan for `period` seconds.

    `decision` is the path of an actor, such as a `Wait`, whose states are the policy's choices. The
    plan waits there; a step makes the actor report the chosen state and lasts until the plan is
    there again. Its states bring no outputs.

    An action is a `Box` with a number for each parameter, from -1 for the lower end of its range to
    1 for the upper end. For a decision it is the number of a state in `states`, and with both a
    dictionary of `parameters` and `decision`. An observation has the numbers of each sensor or entry
    in `observe`, followed by 1 if they are known, else 0: names of `SIZES`, signals such as
    `bumper.left`, entries of the plan, and `target` (distance, sine and cosine of its bearing, by
    the odometry).

    Reward, target, end and duration are those of the `task`. An episode also ends with the plan.
    `info` has `time`, `pose`, `collisions`, the `duration` of the step, the plan's `ending` and its
    `active` element. `faults` and `presses` are lists, or functions of a random generator.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": round(1 / STEP)}

    def __init__(
        self,
        plan: Plan,
        world: Worlds = None,
        *,
        task: Task | str = ROAM,
        parameters: Mapping[str, tuple[float, float]] | None = None,
        decision: str | None = None,
        period: float = 1.0,
        observe: Iterable[str] = ("distance", "odometry", "touched"),
        reward: Mapping[str, float] | None = None,
        ends: Iterable[str] | None = None,
        reach: str | None = None,
        faults: Faults = (),
        presses: Presses = (),
        time_limit: float | None = None,
        render_mode: str | None = None,
    ) -> None:
        if not isinstance(plan, Plan):
            raise TypeError(f"an environment of a plan needs a Plan, not a {type(plan).__name__}: afp.load() reads one")
        plan.check()
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"no render mode '{render_mode}' of a plan; there is: rgb_array")
        ends = None if ends is None else list(ends)
        self._setting = Setting.of(world, task, None, reward, ends, reach, None, faults, False, None)
        self._plan = plan
        self._presses = presses if callable(presses) else tuple(several(Press, presses))
        self._limit = self._setting.task.seconds if time_limit is None else seconds("time_limit", time_limit)
        self._period = seconds("period", period)
        if not self._period > 0:
            raise ValueError(f"period is {period}; give seconds above 0")
        self._ranges = {name: self._range(name, pair) for name, pair in (parameters or {}).items()}
        self._decision = None if decision is None else text("a decision", decision)
        self._states = self._states_of(self._decision)
        if not self._ranges and not self._states:
            raise ValueError("the policy has nothing to choose: give parameters, a decision or both")
        self._observe = [(text("a part of an observation", name), self._size(name)) for name in observe]
        size = sum(size + 1 for _, size in self._observe)
        self.observation_space = gymnasium.spaces.Box(-FAR, FAR, (size,), np.float32)
        self.action_space = self._actions()
        self.render_mode = render_mode
        self._simulation: Simulation | None = None
        self._target: tuple[float, float] | None = None
        self._background: NDArray[np.uint8] | None = None

    @property
    def plan(self) -> Plan:
        """The plan."""
        return self._plan

    @property
    def states(self) -> list[str]:
        """The states among which the policy decides, by number: in alphabetical order."""
        return list(self._states)

    @property
    def simulation(self) -> Simulation:
        """The running simulation of this episode."""
        if self._simulation is None:
            raise gymnasium.error.ResetNeeded("call reset() first")
        return self._simulation

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Start the plan, up to its first decision."""
        super().reset(seed=seed)
        start = self._setting.start(self.np_random, options)
        room, noise = self._setting.world_at(start), start[2]
        task, pose = self._setting.task, start[3]
        reach = None if task.reach is None else (task.reach, start[4] or target(room, task.reach, noise))
        simulation = Simulation(self._plan, room, seed=noise, start=pose)
        for device, kind, delay, share, at, lasting in start[5]:
            simulation.fail(Fault(device, kind, at=at, lasting=lasting, delay=delay, share=share))
        drawn = self._presses(self.np_random) if callable(self._presses) else self._presses
        for press in several(Press, drawn):
            simulation.press(press)
        self._judge = Judge(simulation._runner, list(task.reward.items()), list(task.ends), reach, room)
        self._simulation, self._target, self._background = simulation, None if reach is None else reach[1], None
        self._seen: dict[str, list[float]] = {}
        if self._decision is not None:
            simulation.idle(self._decision)
            self._to_decision(0)
        return self._look(), self._info(0.0)

    def step(self, action: Any) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Choose, and run the plan to its next decision or for a period."""
        simulation = self.simulation
        if simulation.ending != "running":
            raise gymnasium.error.ResetNeeded("the plan has ended: call reset()")
        begin, events = simulation.time, simulation._runner.event_count
        values, state = self._chosen(action)
        for name, value in values.items():
            simulation.set(name, value)
        if state is not None and simulation.active == self._decision:
            assert self._decision is not None
            simulation.fire(self._decision, state)
            self._to_decision(events)
        else:
            simulation.run_to(min(begin + self._period, self._limit))
        reward, over = self._judge.look(simulation._runner)
        over |= simulation.ending != "running"
        late = not over and simulation.time >= self._limit
        return self._look(), reward, over, late, self._info(simulation.time - begin)

    def render(self) -> NDArray[np.uint8] | None:
        """The room from above."""
        if self.render_mode is None:
            gymnasium.logger.warn('render() shows nothing without render_mode="rgb_array"')
            return None
        simulation = self.simulation
        if self._background is None:
            self._background = picture.draw(simulation.world, self._target, [])
        return picture.with_robot(self._background, simulation.world, simulation.pose, [])

    def close(self) -> None:
        """End the simulation."""
        self._simulation = None

    # The plan

    def _range(self, name: str, pair: tuple[float, float]) -> tuple[float, float]:
        entry = next((entry for entry in self._plan.entries if entry.name == name), None)
        if entry is None or entry.kind not in ("in", "var"):
            known = ", ".join(entry.name for entry in self._plan.entries if entry.kind in ("in", "var"))
            raise KeyError(f"the plan has no 'in' or 'var' entry '{name}'; there are: {known or 'none at all'}")
        if np.shape(pair) != (2,):
            raise ValueError(f"the range of '{name}' has two numbers, such as (0.2, 0.6), not {pair!r}")
        low, high = (float(number) for number in pair)
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise ValueError(f"the range of '{name}' is {low} to {high}; give two finite numbers, the smaller one first")
        return low, high

    def _states_of(self, decision: str | None) -> list[str]:
        if decision is None:
            return []
        element = next((element for element in self._plan.elements if element.name == decision), None)
        if element is None or element.kind != "actor":
            known = ", ".join(element.name for element in self._plan.elements if element.kind == "actor")
            raise ValueError(f"the plan has no actor '{decision}' to decide in; there are: {known or 'none'}")
        return sorted(edge.outcome for edge in element.edges if edge.source == decision)

    def _to_decision(self, seen: int) -> None:
        """Run to the next start of the deciding actor."""
        simulation = self.simulation
        while True:
            running = simulation._runner.listen(seen, self._limit)
            news = simulation._runner.events(seen)
            seen += len(news)
            if not running or any(event.kind in BEGINS and event.component == self._decision for event in news):
                return
            if simulation.time >= self._limit:
                return

    def _chosen(self, action: Any) -> tuple[dict[str, float], str | None]:
        both = bool(self._ranges) and bool(self._states)
        numbers = action["parameters"] if both else action
        values: dict[str, float] = {}
        if self._ranges:
            given = np.asarray(numbers, np.float64).reshape(-1)
            if len(given) != len(self._ranges):
                raise ValueError(f"an action has {len(self._ranges)} parameters, not {len(given)}")
            for (name, (low, high)), number in zip(self._ranges.items(), given.tolist(), strict=True):
                share = (min(max(number_in(name, number), -1.0), 1.0) + 1.0) / 2.0
                values[name] = low + share * (high - low)
        state = self._states[int(action["decision"] if both else action)] if self._states else None
        return values, state

    def _actions(self) -> Any:
        spaces = gymnasium.spaces
        box = spaces.Box(-1.0, 1.0, (len(self._ranges),), np.float32) if self._ranges else None
        states = spaces.Discrete(len(self._states)) if self._states else None
        if box is not None and states is not None:
            return spaces.Dict({"parameters": box, "decision": states})
        return states if box is None else box

    # Observations

    def _size(self, name: str) -> int:
        entries = {entry.name: entry.type for entry in self._plan.entries if entry.type in NUMBERS}
        if name == TARGET:
            if self._setting.task.reach is None:
                raise ValueError("'target' is observed and there is nothing to reach: say reach=\"goal\" or reach=\"light\"")
            return 3
        if name in SIZES:
            return SIZES[name]
        if name in entries or "." in name:
            return 1
        raise ValueError(f"nothing is called '{name}'; observe {', '.join([*SIZES, TARGET, *entries])}, or a signal")

    def _look(self) -> NDArray[np.float32]:
        parts: list[float] = []
        for name, size in self._observe:
            numbers = self._value(name)
            known = numbers is not None
            if numbers is not None:
                self._seen[name] = numbers
            parts += [*self._seen.get(name, [0.0] * size), float(known)]
        return np.clip(np.array(parts, np.float32), -FAR, FAR)

    def _value(self, name: str) -> list[float] | None:
        """The numbers of a part; `None` if they are unknown."""
        simulation = self.simulation
        if name == TARGET:
            return self._to_target()
        try:
            value = simulation[name] if name in simulation else simulation.sense(name)
        except AfpError:
            # A broken device keeps its last value.
            return None
        if value is None:
            return None
        numbers = [float(number) for number in np.atleast_1d(np.asarray(value, np.float64))]
        return [RANGE if math.isinf(number) else number for number in numbers]

    def _to_target(self) -> list[float] | None:
        moved = self._value("odometry")
        if moved is None or self._target is None:
            return None
        x, y, heading = self.simulation.world.start
        dx, dy = self._target[0] - x, self._target[1] - y
        along, aside = dx * math.cos(heading) + dy * math.sin(heading), dy * math.cos(heading) - dx * math.sin(heading)
        bearing = math.atan2(aside - moved[1], along - moved[0]) - moved[2]
        return [math.hypot(along - moved[0], aside - moved[1]), math.sin(bearing), math.cos(bearing)]

    def _info(self, duration: float) -> dict[str, Any]:
        simulation = self.simulation
        return {
            "time": simulation.time,
            "pose": np.array(simulation.pose),
            "collisions": len(simulation._runner.collisions),
            "duration": duration,
            "ending": simulation.ending,
            "active": simulation.active,
            "world": os.fspath(simulation.world.path or simulation.world.name),
        }
