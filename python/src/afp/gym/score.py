"""Scores of a policy, or of a handwritten plan, for a task."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._afp import Judge, World, target
from ..estimates import Estimate, mean, share
from ..plan import Plan, load
from ..seeds import seed_of
from ..simulation import Simulation
from ..stimuli import Fault, Faults
from .setting import STEP, Setting, Worlds, gymnasium
from .tasks import Task, task_of
from .vector import CarbotVectorEnv

__all__ = ["Score", "evaluate", "plan_of"]

PLANS = Path(__file__).resolve().parents[1] / "plans"
"""The plans written by hand."""


@dataclass(frozen=True, eq=False)
class Score:
    """The rewards of some episodes. Scores with equal episodes are equal."""

    rewards: NDArray[np.float64]
    """The reward of each episode."""
    steps: NDArray[np.int64]
    """The number of steps of each episode."""
    ended: NDArray[np.bool_]
    """Whether a term of the task ended the episode: the robot reached its target or, in `Roam`, had a collision."""

    @property
    def mean(self) -> float:
        """The mean reward."""
        return float(self.rewards.mean())

    @property
    def error(self) -> float:
        """The standard error of the mean."""
        return float(self.rewards.std(ddof=1) / math.sqrt(len(self.rewards))) if len(self.rewards) > 1 else math.nan

    def interval(self, confidence: float = 0.95) -> Estimate:
        """The mean reward with its confidence interval."""
        return mean(self.rewards, confidence)

    def success(self, confidence: float = 0.95) -> Estimate:
        """The share of episodes that a term of the task ended, with its confidence interval."""
        return share(self.ended, confidence)

    def _key(self) -> tuple[bytes, bytes, bytes]:
        return self.rewards.tobytes(), self.steps.tobytes(), self.ended.tobytes()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Score) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __repr__(self) -> str:
        return f"<Score {self.mean:.2f} ± {self.error:.2f}, {len(self.rewards)} episodes>"


def evaluate(
    policy: Callable[[NDArray[np.float32]], Any] | Plan | None,
    task: Task | str,
    seeds: Iterable[int] = range(100),
    *,
    world: Worlds = None,
    faults: Faults = (),
    **settings: Any,
) -> Score:
    """Score a policy or a plan with one episode per seed; `None` scores random actions.

    The policy receives the observations of all episodes, a row each, and returns an action for
    each. `faults` and `settings` are those of the environment.

    A plan has no settings. For each seed it begins like the environment, in the same room with the
    same noise and the same faults, and is judged every 100 ms. If it has the inputs `bearing` and
    `way`, they receive the direction and distance of the goal. If the plan ends before the episode,
    the robot stays where it is.
    """
    task, seeds = task_of(task), _several(seeds)
    if isinstance(policy, Plan):
        if settings:
            raise TypeError(f"a plan observes and acts by itself; it has no '{next(iter(settings))}'")
        setting = Setting.of(world, task, None, None, None, None, None, faults, False, None)
        policy.check()
        rewards, steps, ended = zip(*(_run(policy, setting, seed) for seed in seeds), strict=True)
        return Score(np.array(rewards), np.array(steps, np.int64), np.array(ended, np.bool_))
    return _play(policy, task, seeds, world, {"faults": faults, **settings})


def _play(policy: Any, task: Task, seeds: list[int], world: Worlds, settings: dict[str, Any]) -> Score:
    """Score a policy; without one, random actions."""
    most = round(task.seconds / STEP)
    mode = gymnasium.vector.AutoresetMode.NEXT_STEP
    env = CarbotVectorEnv(len(seeds), world, task=task, max_episode_steps=most, autoreset_mode=mode, **settings)
    seen, _ = env.reset(seed=seeds)
    env.action_space.seed(0)
    rewards, steps, done = np.zeros(len(seeds)), np.zeros(len(seeds), np.int64), np.zeros(len(seeds), np.bool_)
    going = ~done
    for _ in range(most):
        actions = env.action_space.sample() if policy is None else policy(seen)
        seen, reward, ended, late, _ = env.step(actions)
        rewards[going] += reward[going]
        steps[going] += 1
        done |= going & ended
        going &= ~(ended | late)
        if not going.any():
            break
    return Score(rewards, steps, done)


def plan_of(task: Task | str) -> Plan:
    """The plan that was written by hand for a task.

    Raises:
        ValueError: the task has no plan.
    """
    task = task_of(task)
    if task.plan is None:
        raise ValueError(f"there is no plan for '{task.name}'")
    return load(PLANS / task.plan)


def _several(seeds: Iterable[int]) -> list[int]:
    """Check the seeds; at least one is needed."""
    if not isinstance(seeds, Iterable) or isinstance(seeds, str):
        raise TypeError(f"seeds are several whole numbers, such as range(10), not {seeds!r}")
    these = [seed_of(seed) for seed in seeds]
    if not these:
        raise ValueError(f"there are no seeds in {seeds!r}")
    return these


def _run(plan: Plan, setting: Setting, seed: int) -> tuple[float, int, bool]:
    """One episode."""
    task = setting.task
    rng, _ = gymnasium.utils.seeding.np_random(seed)
    start = setting.start(rng, None)
    room, noise = setting.world_at(start), start[2]
    reach = None if task.reach is None else (task.reach, target(room, task.reach, noise))
    given = {} if task.reach != "goal" or reach is None else _way(room, reach[1])
    inputs = {entry.name for entry in plan.entries if entry.kind == "in"}
    simulation = Simulation(plan, room, seed=noise, set={name: given[name] for name in given if name in inputs})
    for device, kind, delay, share, at, lasting in start[5]:
        simulation.fail(Fault(device, kind, at=at, lasting=lasting, delay=delay, share=share))
    judge = Judge(simulation._runner, list(task.reward.items()), list(task.ends), reach, room)
    total, most = 0.0, round(task.seconds / STEP)
    for step in range(1, most + 1):
        going = simulation.run_to(step * STEP)
        reward, ended = judge.look(simulation._runner)
        total += reward
        if ended or not going:
            return total, step, ended
    return total, most, False


def _way(room: World, goal: tuple[float, float]) -> dict[str, float]:
    """The plan's inputs for a goal: bearing and distance from the start."""
    x, y, heading = room.start
    dx, dy = goal[0] - x, goal[1] - y
    bearing = math.remainder(math.atan2(dy, dx) - heading, math.tau)
    return {"bearing": bearing, "way": math.hypot(dx, dy)}
