"""`CarbotVectorEnv`: many robots, each in its own episode, stepped on all cores."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import picture
from .env import Saved
from .setting import Faults, Setting, Specified, Start, Worlds, gymnasium, named
from .tasks import ROAM, Task

__all__ = ["CarbotVectorEnv"]

AutoresetMode = gymnasium.vector.AutoresetMode


class CarbotVectorEnv(Specified, gymnasium.vector.VectorEnv):  # type: ignore[misc]
    """Many simulated Carbots; see `afp.gym`. Each gives the same results as a `CarbotEnv` with its
    seed.

    A step simulates all of them on all cores, without Python in between and with the interpreter
    released. `autoreset_mode` is Gymnasium's: a new episode begins with the step after the last
    (`NEXT_STEP`), with the last step (`SAME_STEP`, with `final_obs` and `final_info` in `infos`),
    or on request (`DISABLED`, with `options={"reset_mask": ...}` of `reset`).
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10, "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        num_envs: int = 1,
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
        max_episode_steps: int | None = None,
        autoreset_mode: Any = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
    ) -> None:
        if num_envs < 1:
            raise ValueError(f"num_envs is {num_envs}; give at least 1")
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"no render mode '{render_mode}' of many; there is: rgb_array")
        self._setting = Setting.of(world, task, observe, reward, ends, reach, fan, faults, point, max_episode_steps)
        self._courses = self._setting.courses(num_envs)
        self._mode = AutoresetMode(autoreset_mode)
        self.metadata = {**self.metadata, "autoreset_mode": self._mode}
        self.render_mode = render_mode
        self.num_envs = num_envs
        self.single_action_space, self.single_observation_space = self._setting.spaces(self._courses)
        batch = gymnasium.vector.utils.batch_space
        self.action_space = batch(self.single_action_space, num_envs)
        self.observation_space = batch(self.single_observation_space, num_envs)
        self._rngs: list[np.random.Generator | None] = [None] * num_envs
        self._starts: list[Start | None] = [None] * num_envs
        self._over = np.zeros(num_envs, np.bool_)
        self._backgrounds: dict[int, tuple[Any, NDArray[np.uint8]]] = {}

    @property
    def task(self) -> Task:
        """The task."""
        return self._setting.task

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Start all episodes, or those of `options["reset_mask"]`; `seed` is the first seed, or one
        for each. `world`, `pose` and `goal` in `options` are for all, or lists with one for each.
        """
        super().reset(seed=int(seed) if isinstance(seed, (int, np.integer)) else None)
        options = dict(options or {})
        which = self._masked(options.pop("reset_mask", None))
        seeds = self._seeds(seed)
        for index in which:
            if seeds[index] is not None or self._rngs[index] is None:
                self._rngs[index], _ = gymnasium.utils.seeding.np_random(seeds[index])
        seen = self._courses.reset([(index, self._begin(index, self._own(options, index))) for index in which])
        self._over[which] = False
        infos: dict[str, Any] = {}
        times, poses, collisions = self._courses.info()
        for index in which:
            figures = {"time": float(times[index]), "pose": poses[index], "collisions": int(collisions[index])}
            infos = self._add_info(infos, {**figures, **self._place(index)}, index)
        return seen, infos

    def step(
        self, actions: Any
    ) -> tuple[NDArray[np.float32], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Drive all of them for 100 ms."""
        again: list[int] = []
        if self._over.any():
            if self._mode != AutoresetMode.NEXT_STEP:
                over = np.flatnonzero(self._over).tolist()
                raise gymnasium.error.ResetNeeded(f"the episodes {over} are over: reset them with 'reset_mask'")
            again = np.flatnonzero(self._over).tolist()
        starts = [(index, self._begin(index, None)) for index in again]
        seen, rewards, ended, late = self._courses.step(np.asarray(actions, np.float64), starts)
        self._over = ended | late
        infos: dict[str, Any] = {}
        for index in again:
            infos = self._add_info(infos, self._place(index), index)
        if self._mode == AutoresetMode.SAME_STEP and self._over.any():
            seen = self._begin_again(seen, infos)
        return seen, rewards, ended, late, {**infos, **self._figures()}

    def save(self) -> Saved:
        """Save all episodes: robots, rooms, noise and rewards. `restore` goes back to them."""
        if any(rng is None for rng in self._rngs):
            raise gymnasium.error.ResetNeeded("call reset() before save()")
        return Saved(self._courses.save(), list(self._starts), deepcopy(self._rngs), self._over.tolist())

    def restore(self, saved: Saved) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Go back, or forwards, to a saved moment; return its observations and the `infos` of a
        reset. The same actions then have the same results.
        """
        if not isinstance(saved, Saved):
            raise TypeError(f"environments are restored from a result of save(), not from {saved!r}")
        seen = self._courses.restore(saved.moment)
        self._starts, self._rngs, self._over = list(saved.starts), deepcopy(saved.rngs), np.array(saved.over)
        self._backgrounds = {}
        infos: dict[str, Any] = self._figures()
        for index in range(self.num_envs):
            infos = self._add_info(infos, self._place(index), index)
        return seen, infos

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """The rooms from above."""
        if self.render_mode is None:
            return None
        return tuple(self._picture(index) for index in range(self.num_envs))

    def close_extras(self, **_: Any) -> None:
        """End the simulations."""
        self._courses = self._setting.courses(self.num_envs)
        self._starts = [None] * self.num_envs

    def _begin_again(self, seen: NDArray[np.float32], infos: dict[str, Any]) -> NDArray[np.float32]:
        """Start finished episodes again within the same step."""
        which = np.flatnonzero(self._over).tolist()
        times, poses, collisions = self._courses.info()
        for index in which:
            figures = {"time": float(times[index]), "pose": poses[index], "collisions": int(collisions[index])}
            self._add_info(infos, {"final_obs": seen[index], "final_info": figures}, index)
        seen = self._courses.reset([(index, self._begin(index, None)) for index in which])
        for index in which:
            self._add_info(infos, self._place(index), index)
        self._over = np.zeros(self.num_envs, np.bool_)
        return seen

    def _begin(self, index: int, options: Mapping[str, Any] | None) -> Start:
        """The start of the next episode of one of them."""
        rng = self._rngs[index]
        if rng is None:
            raise gymnasium.error.ResetNeeded("call reset() before step()")
        start = self._setting.start(rng, options)
        self._starts[index] = start
        return start

    def _own(self, options: Mapping[str, Any], index: int) -> dict[str, Any]:
        """The options of one of them."""
        own = dict(options)
        for name, dimensions in (("world", 1), ("pose", 2), ("goal", 2)):
            given = options.get(name)
            many = isinstance(given, (list, tuple)) if name == "world" else given is not None and np.ndim(given) == dimensions
            if given is None or not many:
                continue
            if len(given) != self.num_envs:
                raise ValueError(f"'{name}' has {len(given)} for {self.num_envs} environments; give one for each")
            own[name] = given[index]
        return own

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        if seed is None:
            return [None] * self.num_envs
        if isinstance(seed, (int, np.integer)):
            return [int(seed) + index for index in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise ValueError(f"{len(seed)} seeds for {self.num_envs} environments; give one for each")
        return list(seed)

    def _masked(self, mask: Any) -> list[int]:
        if mask is None:
            return list(range(self.num_envs))
        if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_ or mask.shape != (self.num_envs,):
            raise ValueError(f"'reset_mask' must be an array of {self.num_envs} truth values")
        if not mask.any():
            raise ValueError("'reset_mask' names no environment")
        if any(rng is None for rng, asked in zip(self._rngs, mask, strict=True) if not asked):
            raise gymnasium.error.ResetNeeded("the first reset() must reset all environments")
        return [int(index) for index in np.flatnonzero(mask)]

    def _place(self, index: int) -> dict[str, Any]:
        start, target = self._starts[index], self._courses.place(index)[1]
        world = {} if start is None else {"world": named(start)}
        return world if target is None else {**world, "target": np.array(target)}

    def _figures(self) -> dict[str, Any]:
        times, poses, collisions = self._courses.info()
        all = np.ones(self.num_envs, np.bool_)
        figures = {"time": times, "pose": poses, "collisions": collisions}
        return {**figures, **{f"_{name}": all for name in figures}}

    def _picture(self, index: int) -> NDArray[np.uint8]:
        start = self._starts[index]
        if start is None:
            raise gymnasium.error.ResetNeeded("call reset() before render()")
        known, moving = self._backgrounds.get(index), self._courses.moving(index)
        if known is None or known[0][0] is not start:
            world = self._setting.world_at(start)
            known = ((start, world), picture.draw(world, self._courses.place(index)[1], moving))
            self._backgrounds[index] = known
        pose = self._courses.info()[1][index].tolist()
        return picture.with_robot(known[1], known[0][1], pose, moving)
