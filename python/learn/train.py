"""Trains a policy for a task of `afp.gym`, and compares it with the handwritten plan.

    pip install stable-baselines3
    python train.py ReachGoal --steps 300000 --seed 0

PPO trains the policy in random rooms from one range of seeds. The policy, the plan and random
actions are judged in rooms from a different range. The same seed gives the same policy on the same
machine and versions.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecMonitor, VecNormalize

from afp.gym import TASKS, Score, evaluate, plan_of
from afp.gym.sb3 import CarbotVecEnv

ENVIRONMENTS = 16
JUDGED = range(1_000_000, 1_000_100)
"""The seeds of the episodes that are judged; no training comes so far."""


def policy_of(model: PPO, envs: VecNormalize) -> Callable[[NDArray[np.float32]], Any]:
    """The trained policy without exploration, from plain observations to actions."""
    return lambda seen: model.predict(envs.normalize_obs(seen), deterministic=True)[0]


def train(task: str, steps: int, seed: int) -> Callable[[NDArray[np.float32]], Any]:
    """Train a policy."""
    # Two threads would slow down so small a network.
    torch.set_num_threads(1)
    seconds = next(known.seconds for known in TASKS.values() if known.name == task)
    raw = CarbotVecEnv(ENVIRONMENTS, seed=seed * 10_000, task=task, max_episode_steps=round(seconds * 10))
    envs = VecNormalize(VecMonitor(raw), gamma=0.99)
    sizes = {"n_steps": 256, "batch_size": 512, "n_epochs": 6}
    tuned = {"learning_rate": lambda left: 4e-4 * left + 2e-5, "ent_coef": 0.003, "gamma": 0.99, "gae_lambda": 0.95}
    net = {"net_arch": [64, 64], "log_std_init": -0.5}
    model = PPO("MlpPolicy", envs, seed=seed, device="cpu", policy_kwargs=net, verbose=0, **sizes, **tuned)
    model.learn(steps)
    envs.training = False
    return policy_of(model, envs)


def shown(name: str, score: Score) -> None:
    """Print a score."""
    print(f"  {name:<16} {score.mean:7.2f} ± {score.error:.2f}   {score.ended.mean():4.0%} ended by the task", flush=True)


def main() -> None:
    """Train and compare."""
    names = [task.name for task in TASKS.values()]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=names)
    parser.add_argument("--steps", type=int, default=300_000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    task = next(known for known in TASKS.values() if known.name == given.task)
    print(f"{task.name}: mean reward of {len(JUDGED)} episodes ± its standard error", flush=True)
    shown("random", evaluate(None, task, JUDGED))
    if task.plan is not None:
        shown("plan", evaluate(plan_of(task), task, JUDGED))
    begin = time.perf_counter()
    policy = train(task.name, given.steps, given.seed)
    took = time.perf_counter() - begin
    shown("trained", evaluate(policy, task, JUDGED))
    print(f"  {given.steps} steps of training took {took:.0f} s, {given.steps / took:.0f} a second")


if __name__ == "__main__":
    main()
