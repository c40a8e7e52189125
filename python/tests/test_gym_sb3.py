"""The environments in stable-baselines3, if it is installed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from stable_baselines3 import PPO  # noqa: E402
from stable_baselines3.common.env_checker import check_env  # noqa: E402
from stable_baselines3.common.vec_env import DummyVecEnv  # noqa: E402

import afp.gym  # noqa: E402
from afp.gym.sb3 import CarbotVecEnv  # noqa: E402


@pytest.mark.parametrize("task", [task.name for task in afp.gym.TASKS.values()])
@pytest.mark.filterwarnings("error")
def test_its_checker_finds_no_error(task: str) -> None:
    check_env(afp.gym.CarbotEnv(task=task, render_mode="rgb_array"))


def test_the_vector_equals_its_vector_of_single_environments() -> None:
    def one() -> Any:
        from gymnasium.wrappers import TimeLimit

        return TimeLimit(afp.gym.CarbotEnv(), 15)

    ours, theirs = CarbotVecEnv(3, seed=5, max_episode_steps=15), DummyVecEnv([one] * 3)
    theirs.seed(5)
    assert (ours.reset() == theirs.reset()).all()
    actions = np.random.default_rng(0)
    over = 0
    for _ in range(50):
        action = actions.uniform(-1, 1, (3, 2)).astype(np.float32)
        mine, its = ours.step(action), theirs.step(action)
        assert all((a == b).all() for a, b in zip(mine[:3], its[:3], strict=True))
        for index in np.flatnonzero(mine[2]):
            over += 1
            assert (mine[3][index]["terminal_observation"] == its[3][index]["terminal_observation"]).all()
            assert mine[3][index]["TimeLimit.truncated"] == its[3][index]["TimeLimit.truncated"]
    assert over >= 9


def test_the_same_seed_trains_the_same_policy() -> None:
    def trained() -> Any:
        envs = CarbotVecEnv(4, seed=1, task="ReachGoal", max_episode_steps=50)
        model = PPO("MlpPolicy", envs, n_steps=16, batch_size=32, n_epochs=1, seed=3, device="cpu")
        model.learn(128)
        return model.policy.state_dict()

    first, second = trained(), trained()
    assert all((first[name] == second[name]).all() for name in first)
