"""Environments that are saved, copied, described and randomised."""

from __future__ import annotations

import copy
import json
from typing import Any

import numpy as np
import pytest

import afp

gymnasium = pytest.importorskip("gymnasium")

import afp.gym  # noqa: E402

FAULTS = [afp.Fault("wheels", "slip", share=0.3, at=1.0)]


def hall() -> afp.World:
    return afp.WorldBuilder("Hall", start=(1.0, 1.0)).room(4.0, 3.0).box("crate", (2.5, 1.5), size=(0.3, 0.3), height=0.4).build()


def steps(env: Any, count: int, seed: int = 0) -> list[Any]:
    """The results of random actions, across the ends of episodes."""
    rng, told = np.random.default_rng(seed), []
    for _ in range(count):
        seen, reward, ended, late, info = env.step(rng.uniform(-1, 1, env.action_space.shape))
        told += [seen.tobytes(), np.asarray(reward).tobytes(), np.asarray(ended).tobytes(), np.asarray(late).tobytes()]
        told.append(np.asarray(info["pose"]).tobytes())
        if isinstance(env, gymnasium.Env) and (ended or late):
            told.append(env.reset()[0].tobytes())
    return told


@pytest.mark.parametrize("task", [task.name for task in afp.gym.TASKS.values()])
def test_a_restored_environment_continues_as_before(task: str) -> None:
    env = afp.gym.CarbotEnv(task=task, time_limit=4.0, faults=FAULTS)
    env.reset(seed=3)
    steps(env, 15)
    saved = env.save()
    seen, info = env.restore(saved)
    before, time = env.save(), info["time"]
    first = steps(env, 60, 1)
    again, info = env.restore(saved)
    assert (seen == again).all() and info["time"] == time
    assert steps(env, 60, 1) == first
    other = afp.gym.CarbotEnv(task=task, time_limit=4.0, faults=FAULTS)
    other.restore(before)
    assert steps(other, 60, 1) == first


@pytest.mark.parametrize("mode", list(gymnasium.vector.AutoresetMode)[:2])
def test_a_restored_vector_continues_as_before(mode: Any) -> None:
    envs = afp.gym.CarbotVectorEnv(3, max_episode_steps=20, autoreset_mode=mode)
    envs.reset(seed=3)
    steps(envs, 15)
    saved = envs.save()
    first = steps(envs, 40, 1)
    envs.restore(saved)
    assert steps(envs, 40, 1) == first
    with pytest.raises(afp.AfpError, match="the moment is of other episodes"):
        afp.gym.CarbotVectorEnv(2).restore(saved)


def test_a_running_environment_is_copied_with_its_wrappers() -> None:
    env = gymnasium.make("afp/CarbotReachGoal-v0", max_episode_steps=30)
    env.reset(seed=1)
    steps(env, 20)
    twin = copy.deepcopy(env)
    first = steps(env, 60, 1)
    assert steps(twin, 60, 1) == first


def test_only_a_begun_episode_is_saved() -> None:
    with pytest.raises(gymnasium.error.ResetNeeded):
        afp.gym.CarbotEnv().save()
    with pytest.raises(TypeError, match="a result of save\\(\\)"):
        afp.gym.CarbotEnv().restore(3)  # type: ignore[arg-type]


@pytest.mark.parametrize("world", [hall(), afp.World.random(3), "random:3", None])
def test_a_specification_is_json_that_makes_the_same_environment(world: Any) -> None:
    env = gymnasium.make("afp/CarbotReachGoal-v0", world=world, task=afp.gym.ROAM, faults=FAULTS)
    text = env.spec.to_json()
    twin = gymnasium.make(gymnasium.envs.registration.EnvSpec.from_json(text))
    assert env.reset(seed=4)[0].tobytes() == twin.reset(seed=4)[0].tobytes()
    assert steps(env, 30) == steps(twin, 30)


def test_an_info_names_a_world_that_can_be_made_again() -> None:
    env = afp.gym.CarbotEnv()
    seen, info = env.reset(seed=5)
    again, _ = afp.gym.CarbotEnv(info["world"]).reset(seed=5)
    assert info["world"].startswith("random:") and (seen == again).all()
    json.dumps({name: np.asarray(value).tolist() for name, value in info.items()})


def test_a_function_draws_each_world_and_its_robot() -> None:
    def drawn(rng: np.random.Generator) -> afp.World:
        return hall().changed({"robot.charge": rng.uniform(0.3, 1.0), "robot.sonar_m": afp.m(rng.uniform(1.0, 2.0))})

    env = afp.gym.CarbotEnv(drawn, observe=["battery"])
    shares = [float(env.reset(seed=seed)[0][1]) for seed in (1, 2, 1)]
    assert shares[0] == shares[2] != shares[1] and 0.25 < shares[1] < 1.0
    envs = afp.gym.CarbotVectorEnv(2, drawn, observe=["battery"])
    assert envs.reset(seed=1)[0][:, 1].tolist() == shares[:2]


def test_each_robot_of_a_vector_has_its_own_world_and_place() -> None:
    envs = afp.gym.CarbotVectorEnv(2)
    poses = np.array([[1.0, 1.0, 0.0], [1.5, 1.0, 1.0]])
    _, infos = envs.reset(seed=0, options={"world": [hall(), "random:7"], "pose": poses})
    assert infos["pose"] == pytest.approx(poses) and infos["world"].tolist() == ["Hall", "random:7"]
    with pytest.raises(ValueError, match="'pose' has 3 for 2 environments"):
        envs.reset(options={"pose": np.zeros((3, 3))})


def test_a_reward_is_no_function() -> None:
    with pytest.raises(TypeError, match="reward gives terms weights"):
        afp.gym.CarbotEnv(reward=lambda info: 1.0)  # type: ignore[arg-type]


@pytest.mark.parametrize("view", ["top", "camera"])
@pytest.mark.filterwarnings("ignore")
def test_gymnasium_records_a_video(view: str, tmp_path: Any) -> None:
    pytest.importorskip("moviepy")
    env = gymnasium.make("afp/Carbot-v0", render_mode="rgb_array", view=view, max_episode_steps=8)
    with gymnasium.wrappers.RecordVideo(env, str(tmp_path), episode_trigger=lambda episode: True) as recorded:
        for _ in range(2):
            recorded.reset(seed=1)
            while not any(recorded.step(np.array([0.5, 0.0]))[2:4]):
                pass
    assert [file.name for file in sorted(tmp_path.glob("*.mp4"))] == ["rl-video-episode-0.mp4", "rl-video-episode-1.mp4"]
    assert all(file.stat().st_size > 1000 for file in tmp_path.glob("*.mp4"))
