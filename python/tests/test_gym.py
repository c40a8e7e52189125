"""The Gymnasium environment."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
import pytest

import afp

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402

import afp.gym  # noqa: E402


@pytest.mark.parametrize("options", [{}, {"render_mode": "rgb_array"}, {"render_mode": "rgb_array", "view": "camera"}])
def test_gymnasium_finds_nothing_wrong(options: dict[str, Any]) -> None:
    env = gymnasium.make("afp/Carbot-v0", **options)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped, skip_render_check=not options)


def drive(seed: int, world: Any = None) -> list[Any]:
    env = afp.gym.CarbotEnv(world)
    seen, _ = env.reset(seed=seed)
    env.action_space.seed(5)
    all: list[Any] = [seen.tobytes()]
    for _ in range(60):
        seen, reward, ended, cut, info = env.step(env.action_space.sample())
        all += [seen.tobytes(), reward, ended, cut, info["pose"]]
        if ended or cut:
            env.reset()
    return all


def test_a_seed_decides_the_trajectory() -> None:
    assert drive(1) == drive(1) != drive(2)


def test_the_way_ahead_is_rewarded_and_a_crash_costs() -> None:
    room = afp.World.load("random:1")
    env = afp.gym.CarbotEnv(room, time_limit=60.0)
    _, start = env.reset(seed=0)
    total, ended, cut, info = 0.0, False, False, start
    while not (ended or cut):
        _, reward, ended, cut, info = env.step(np.array([1.0, 0.0]))
        total += reward
    assert ended and info["collisions"] >= 1
    went = math.dist(start["pose"][:2], info["pose"][:2])
    assert total == pytest.approx(went + afp.gym.CRASH, abs=0.05)
    env = afp.gym.CarbotEnv(room, time_limit=0.3)
    env.reset(seed=0)
    assert [env.step(np.zeros(2))[3] for _ in range(3)] == [False, False, True]


def test_the_picture_shows_the_robot() -> None:
    env = afp.gym.CarbotEnv("random:1", render_mode="rgb_array")
    env.reset(seed=0)
    picture = env.render()
    assert picture is not None and picture.shape == (256, 256, 3)
    blue = (picture == (0, 114, 178)).all(axis=2)
    assert blue.any() and (picture == (90, 90, 90)).all(axis=2).any()
    env.step(np.array([1.0, 1.0]))
    assert (env.render() != picture).any()


def test_what_makes_no_sense_is_refused() -> None:
    with pytest.raises(ValueError, match="no render mode"):
        afp.gym.CarbotEnv(render_mode="human")
    with pytest.raises(ValueError, match="no view"):
        afp.gym.CarbotEnv(view="side")
    with pytest.raises(gymnasium.error.ResetNeeded):
        afp.gym.CarbotEnv().step(np.zeros(2))
    with pytest.raises(ValueError, match="finite"):
        afp.Carbot(afp.World.random(1)).drive(math.nan, 0.0, 1.0)


def test_echoes_at_the_range_of_the_sensor_do_not_end_an_episode() -> None:
    env = afp.gym.CarbotEnv()
    env.reset(seed=4)
    actions = np.random.default_rng(4)
    unknown = 0
    for _ in range(120):
        seen, _, ended, _, _ = env.step(actions.uniform(-1, 1, 2))
        assert env.observation_space.contains(seen)
        unknown += int(seen[1] == 0.0)
        if ended:
            break
    assert unknown > 0, "this episode has such an echo"
