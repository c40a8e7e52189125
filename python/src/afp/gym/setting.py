"""The settings of an environment: observations, reward, starts of episodes."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from .._afp import Courses, World
from ..places import place_of
from ..stimuli import Fault, Faults, several
from ..tables import need
from ..units import number_in, seconds
from .tasks import Task, task_of

gymnasium = need("gymnasium")

__all__ = ["PIXELS", "RANGE", "SPEED", "STEP", "TURN", "Faults", "Setting"]

SPEED: float = Courses.speed
"""The speed of a full action, m/s."""
TURN: float = Courses.turn
"""The turn rate of a full action, rad/s."""
RANGE: float = Courses.range
"""The observed distance if the range sensor hears nothing, in metres."""
STEP: float = Courses.step_time
"""The duration of an action, in seconds."""
PIXELS = 256
"""The edge of the picture from above."""

FOREVER = 2**63
OPTIONS = ("world", "pose", "goal", "faults")

Given = World | str | os.PathLike[str] | None
"""A world, its file, the text of its file, or a random room."""
Worlds = Given | Callable[[np.random.Generator], Given]
"""A world, or a function that draws one for each episode."""
Start = tuple[
    World | None,
    int,
    int,
    tuple[float, float, float] | None,
    tuple[float, float] | None,
    list[tuple[str, str, float | None, float | None, float | None, float | None]],
]


@dataclass(frozen=True)
class Setting:
    """The settings of an environment."""

    task: Task
    world: World | Callable[[np.random.Generator], Given] | None
    faults: Faults
    point: bool
    steps: int

    @classmethod
    def of(
        cls,
        world: Worlds,
        task: Task | str | Mapping[str, Any],
        observe: Sequence[str] | None,
        reward: Mapping[str, float] | None,
        ends: Sequence[str] | None,
        reach: str | None,
        fan: Sequence[float] | None,
        faults: Faults,
        point: bool,
        steps: int | None,
    ) -> Setting:
        """Read the arguments of an environment."""
        if isinstance(observe, str) or isinstance(ends, str):
            raise TypeError("observe and ends must be lists of names, not a string")
        if reward is not None and not isinstance(reward, Mapping):
            what = "reward gives terms weights, such as {'ahead': 1.0, 'crash': -10.0}"
            raise TypeError(f"{what}, not {reward!r}; gymnasium.wrappers.TransformReward takes a function")
        bearings = None if fan is None else tuple(number_in("fan", bearing, "rad") for bearing in fan)
        weights = None if reward is None else {name: number_in(f"the weight of '{name}'", reward[name]) for name in reward}
        changed = {"observe": observe and tuple(observe), "reward": weights, "ends": None if ends is None else tuple(ends)}
        changed |= {"reach": reach, "fan": bearings}
        given = {name: value for name, value in changed.items() if value is not None}
        task = replace(task_of(task), **given)  # type: ignore[arg-type]
        if fan is not None and "fan" not in task.observe:
            raise ValueError(f"the fan is not observed: set observe={['fan', *task.observe]}")
        if steps == 0:
            raise ValueError("an episode has at least one step; give at least 1")
        if not callable(faults):
            faults = tuple(several(Fault, [Fault(**it) if isinstance(it, Mapping) else it for it in faults]))
        # Gymnasium's -1 means no limit.
        return cls(task, world if callable(world) else world_of(world), faults, point, FOREVER if steps is None or steps < 0 else steps)

    def courses(self, count: int) -> Courses:
        """Make a number of episodes."""
        task = self.task
        fan = (list(task.fan), self.point)
        return Courses(count, list(task.observe), fan, list(task.reward.items()), list(task.ends), task.reach, self.steps)

    def spaces(self, courses: Courses) -> tuple[Any, Any]:
        """The spaces of one action and one observation."""
        low, high = courses.bounds
        box = gymnasium.spaces.Box
        return box(-1.0, 1.0, (courses.commands,), np.float32), box(low, high, dtype=np.float32)

    def start(self, rng: np.random.Generator, options: Mapping[str, Any] | None) -> Start:
        """The start of the next episode."""
        options = options or {}
        unknown = [name for name in options if name not in OPTIONS]
        if unknown:
            raise ValueError(f"no option '{unknown[0]}' of reset; there are: {', '.join(OPTIONS)}")
        room, noise = (int(number) for number in rng.integers(0, 2**32, 2))
        world = options["world"] if options.get("world") is not None else self.world
        world = world_of(world(rng) if callable(world) else world)
        faults = options.get("faults", self.faults)
        drawn = faults(rng) if callable(faults) else faults
        broken = [(it.device, it.kind, it.delay, it.share, it.at, it.lasting) for it in several(Fault, drawn)]
        if options.get("goal") is not None and self.task.reach != "goal":
            raise ValueError(f"'{self.task.name}' has no goal to drive to: make the environment with reach=\"goal\"")
        return world, room, noise, _numbers("pose", options, ("m", "m", "rad")), _numbers("goal", options, ("m", "m")), broken

    def world_at(self, start: Start) -> World:
        """The room of an episode."""
        return start[0] if start[0] is not None else World.random(start[1])


def named(start: Start) -> str:
    """The room of an episode in a form that `world` takes, or else its name."""
    world = start[0]
    if world is None:
        return f"random:{start[1]}"
    return world.name if world.path is None else os.fspath(world.path)


def storable(spec: Any) -> Any:
    """Gymnasium's specification of an environment with arguments that JSON can store."""
    if spec is None:
        return None
    stored = copy(spec)
    stored.kwargs = {name: _storable(value) for name, value in spec.kwargs.items()}
    return stored


def _storable(value: Any) -> Any:
    if isinstance(value, World):
        if value.path is not None:
            return os.fspath(value.path)
        # A start that differs from its text cannot be written exactly.
        return value.text if World.parse(value.text) == value else value
    if isinstance(value, Task):
        return value._facts()
    if isinstance(value, Fault):
        return asdict(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    return [_storable(one) for one in value] if isinstance(value, (list, tuple)) else value


class Specified:
    """A mixin for the specification that Gymnasium sets; tools such as Minari store it as JSON."""

    _spec: Any = None

    @property
    def spec(self) -> Any:
        """Gymnasium's specification, with worlds, tasks and faults as JSON can store them."""
        return self._spec

    @spec.setter
    def spec(self, spec: Any) -> None:
        self._spec = storable(spec)


def world_of(world: Given) -> World | None:
    """A world, or the world of a file or of a text."""
    if isinstance(world, str) and "\n" in world:
        return World.parse(world)
    place = None if world is None else place_of(world)
    return World.load(place) if isinstance(place, str) else place


def steps_of(time_limit: float | None) -> int | None:
    """The number of steps in a time."""
    if time_limit is None:
        return None
    limit = seconds("time_limit", time_limit)
    if not (math.isfinite(limit) and limit > 0):
        raise ValueError(f"time_limit is {time_limit}; give seconds above 0, or None for episodes without end")
    return max(1, math.ceil(limit / STEP - 1e-9))


def _numbers(name: str, options: Mapping[str, Any], units: Sequence[str]) -> Any:
    given = options.get(name)
    if given is None:
        return None
    if len(given) != len(units):
        raise ValueError(f"'{name}' has {len(units)} numbers, not {len(given)}")
    return tuple(number_in(name, number, unit) for number, unit in zip(given, units, strict=True))
