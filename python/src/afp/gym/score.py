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
from ..plan import load
from ..seeds import seed_of
from ..simulation import Simulation
from .setting import STEP, Given, Setting, gymnasium
from .tasks import Task, task_of
from .vector import CarbotVectorEnv

__all__ = ["Score", "evaluate", "run_plan"]

PLANS = Path(__file__).resolve().parents[1] / "plans"
"""The plans written by hand."""


@dataclass(frozen=True)
class Score:
    """The rewards of some episodes."""

    rewards: NDArray[np.float64]
    """The reward of each episode."""
    steps: NDArray[np.int64]
    """How many steps each took."""
    ended: NDArray[np.bool_]
    """Whether a term of the task ended it: what there was to reach was reached, or, in `Roam`, it ran into something."""

    @property
    def mean(self) -> float:
        """The mean reward."""
        return float(self.rewards.mean())

    @property
    def error(self) -> float:
        """The standard error of the mean."""
        return float(self.rewards.std(ddof=1) / math.sqrt(len(self.rewards))) if len(self.rewards) > 1 else math.nan

    def __repr__(self) -> str:
        return f"<Score {self.mean:.2f} ± {self.error:.2f}, {len(self.rewards)} episodes>"


def evaluate(
    policy: Callable[[NDArray[np.float32]], Any] | None,
    task: Task | str,
    seeds: Iterable[int] = range(100),
    *,
    world: Given = None,
    **settings: Any,
) -> Score:
    """Score a policy with one episode per seed; without a policy, score random actions.

    The policy receives the observations of all episodes, a row each, and returns an action for
    each. `settings` are those of the environment.
    """
    task, seeds = task_of(task), _several(seeds)
    most = round(task.seconds / STEP)
    env = CarbotVectorEnv(
        len(seeds), world, task=task, max_episode_steps=most, autoreset_mode=gymnasium.vector.AutoresetMode.NEXT_STEP, **settings
    )
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


def run_plan(task: Task | str, seeds: Iterable[int] = range(100), *, world: Given = None) -> Score:
    """Score the handwritten plan for a task in the same episodes.

    For each seed it begins like the environment, in the same room with the same noise, and is
    judged every 100 ms. If the plan ends before the episode, the robot stays where it is.
    """
    task = task_of(task)
    if task.plan is None:
        raise ValueError(f"there is no plan for '{task.name}'")
    setting = Setting.of(world, task, None, None, None, None, None, (), False, None)
    plan = load(PLANS / task.plan)
    rewards, steps, ended = zip(*(_run(plan, setting, seed) for seed in _several(seeds)), strict=True)
    return Score(np.array(rewards), np.array(steps, np.int64), np.array(ended, np.bool_))


def _several(seeds: Iterable[int]) -> list[int]:
    """Check that there is at least one seed."""
    if not isinstance(seeds, Iterable) or isinstance(seeds, str):
        raise TypeError(f"seeds are several whole numbers, such as range(10), not {seeds!r}")
    these = [seed_of(seed) for seed in seeds]
    if not these:
        raise ValueError(f"there are no seeds in {seeds!r}")
    return these


def _run(plan: Any, setting: Setting, seed: int) -> tuple[float, int, bool]:
    """One episode."""
    task = setting.task
    rng, _ = gymnasium.utils.seeding.np_random(seed)
    start = setting.start(rng, None)
    room, noise = setting.world_at(start), start[2]
    reach = None if task.reach is None else (task.reach, target(room, task.reach, noise))
    given = {} if task.reach != "goal" or reach is None else _way(room, reach[1])
    simulation = Simulation(plan, room, seed=noise, set=given)
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
