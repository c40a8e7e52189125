"""`CarbotEnv`: one robot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._afp import Courses, Moment, World
from . import picture
from .screen import Screen
from .setting import STEP, Faults, Setting, Specified, Start, Worlds, gymnasium, named, steps_of
from .tasks import ROAM, Task

__all__ = ["CarbotEnv", "Saved"]

CAMERA = (120, 160, 3)
"""The shape of the camera's pictures."""


@dataclass(frozen=True)
class Saved:
    """Episodes at a moment, from which `restore` of their environment continues any number of
    times.
    """

    moment: Moment
    starts: list[Start | None]
    rngs: list[np.random.Generator | None]
    over: list[bool]


class CarbotEnv(Specified, gymnasium.Env):  # type: ignore[misc]
    """The simulated Carbot; see `afp.gym` for actions, observations, reward and options.

    `world` is a `World`, the path of its file or the text of its file; `None` gives each episode a
    random room. A function of a random generator draws the world of each episode. `task` is
    a `Task` or its name; `observe`, `reward`, `ends`, `reach` and `fan` override the task's. With
    `point`, actions point the range sensor. `faults` apply in every episode. An episode is
    truncated after `time_limit` seconds; `gymnasium.make` sets `max_episode_steps` instead.

    `render_mode` is `rgb_array` or `human`: a window or a picture in a notebook, in real time.
    `view` selects the room from the `top`, or the picture of the robot's `camera`.
    """

    metadata: dict[str, Any] = {"render_modes": ["human", "rgb_array"], "render_fps": round(1 / STEP)}

    def __init__(
        self,
        world: Worlds = None,
        *,
        task: Task | str | Mapping[str, Any] = ROAM,
        observe: Sequence[str] | None = None,
        reward: Mapping[str, float] | None = None,
        ends: Sequence[str] | None = None,
        reach: str | None = None,
        fan: Sequence[float] | None = None,
        point: bool = False,
        faults: Faults = (),
        time_limit: float | None = None,
        render_mode: str | None = None,
        view: str = "top",
    ) -> None:
        modes = self.metadata["render_modes"]
        if render_mode not in (None, *modes):
            raise ValueError(f"no render mode '{render_mode}'; there are: {', '.join(modes)}")
        if view not in ("top", "camera"):
            raise ValueError(f"no view '{view}'; there are: top, camera")
        self._setting = Setting.of(world, task, observe, reward, ends, reach, fan, faults, point, steps_of(time_limit))
        self._courses: Courses | None = self._setting.courses(1)
        self.action_space, self.observation_space = self._setting.spaces(self._courses)
        self.render_mode = render_mode
        self._view = view
        self._screen = Screen(STEP) if render_mode == "human" else None
        self._start: Start | None = None
        self._world: World | None = None
        self._background: NDArray[np.uint8] | None = None

    @property
    def task(self) -> Task:
        """The task."""
        return self._setting.task

    @property
    def world(self) -> World:
        """The room of this episode."""
        if self._start is None:
            raise gymnasium.error.ResetNeeded("call reset() first")
        if self._world is None:
            self._world = self._setting.world_at(self._start)
        return self._world

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Put the robot at the start of its world, or of a new one."""
        super().reset(seed=seed)
        courses = self._open()
        start = self._setting.start(self.np_random, options)
        seen = courses.reset([(0, start)])[0]
        self._start, self._world, self._background = start, None, None
        self._show()
        return seen, self._info(courses, start)

    def save(self) -> Saved:
        """Save the episode: robot, room, noise and reward. `restore` goes back to it.

        `copy.deepcopy` copies a running environment with its wrappers, such as a limit of steps.
        """
        if self._start is None:
            raise gymnasium.error.ResetNeeded("call reset() before save()")
        return Saved(self._open().save(), [self._start], [deepcopy(self.np_random)], [False])

    def restore(self, saved: Saved) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Go back, or forwards, to a saved moment; return its observation and the `info` of a
        reset. The same actions then have the same results.
        """
        if not isinstance(saved, Saved):
            raise TypeError(f"an environment is restored from a result of save(), not from {saved!r}")
        courses = self._open()
        seen = courses.restore(saved.moment)[0]
        (start,), (rng,) = saved.starts, saved.rngs
        assert start is not None and rng is not None
        self.np_random = deepcopy(rng)
        self._start, self._world, self._background = start, None, None
        self._show()
        return seen, self._info(courses, start)

    def step(self, action: Any) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Drive for 100 ms."""
        if self._courses is None or self._start is None:
            raise gymnasium.error.ResetNeeded("call reset() before step()")
        stepped = self._courses.step_first(np.asarray(action, np.float64))
        if self._screen is not None:
            self._show()
        return stepped

    def render(self) -> NDArray[np.uint8] | None:
        """The room from above or the camera's picture; `None` without pictures, or if each step
        shows them.
        """
        if self.render_mode is None:
            gymnasium.logger.warn('render() shows nothing without render_mode="rgb_array" or "human"')
            return None
        if self._screen is not None:
            self._show()
            return None
        return self._picture()

    def close(self) -> None:
        """End the simulation and close the window."""
        self._courses = self._start = None
        if self._screen is not None:
            self._screen.close()

    def __getstate__(self) -> dict[str, Any]:
        # Before the first episode there is nothing to copy, and a window is not copied.
        courses = None if self._start is None else self._courses
        return {**self.__dict__, "_courses": courses, "_screen": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._screen = Screen(STEP) if self.render_mode == "human" else None

    def _open(self) -> Courses:
        if self._courses is None:
            self._courses = self._setting.courses(1)
        return self._courses

    def _show(self) -> None:
        if self._screen is not None:
            self._screen.show(self._picture())

    def _picture(self) -> NDArray[np.uint8]:
        courses = self._open()
        if self._start is None:
            raise gymnasium.error.ResetNeeded("call reset() before render()")
        if self._view == "camera":
            seen = _camera(courses)
            return np.zeros(CAMERA, np.uint8) if seen is None else seen
        if self._background is None:
            self._background = picture.draw(self.world, courses.place(0)[1], courses.moving(0))
        pose = courses.info()[1][0].tolist()
        return picture.with_robot(self._background, self.world, pose, courses.moving(0))

    @staticmethod
    def _info(courses: Courses, start: Start) -> dict[str, Any]:
        times, poses, collisions = courses.info()
        target = courses.place(0)[1]
        info = {"time": float(times[0]), "pose": poses[0], "collisions": int(collisions[0]), "world": named(start)}
        return info if target is None else {**info, "target": np.array(target)}


def _camera(courses: Courses) -> NDArray[np.uint8] | None:
    from .._afp import AfpError

    try:
        seen: NDArray[np.uint8] | None = courses.sense(0, "camera")
    except AfpError:
        # A broken camera shows nothing.
        return None
    return seen
