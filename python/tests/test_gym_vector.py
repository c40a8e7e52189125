"""Many robots at once give the same figures as many single environments."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
import threading
import time
import warnings
from typing import Any

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.vector import AutoresetMode  # noqa: E402

import afp.gym  # noqa: E402

COUNT = 5
ROAM = "afp/Carbot-v0"


def same(ours: Any, theirs: Any) -> bool:
    """Whether arrays, and dictionaries of them, are bit-identical."""
    if isinstance(ours, dict):
        return ours.keys() == theirs.keys() and all(same(ours[key], theirs[key]) for key in ours)
    ours, theirs = np.asarray(ours), np.asarray(theirs)
    if ours.dtype == object:
        return ours.shape == theirs.shape and all(
            same(a, b) if not isinstance(a, (str, type(None))) else a == b for a, b in zip(ours, theirs, strict=True)
        )
    return ours.dtype == theirs.dtype and ours.shape == theirs.shape and bool((ours == theirs).all())


@pytest.mark.parametrize("name", [ROAM, "afp/CarbotReachGoal-v0"])
@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_a_vector_environment_equals_its_single_environments(mode: Any, name: str) -> None:
    """Compared with Gymnasium's own vector environment of single ones, including infos."""
    ours = gymnasium.make_vec(name, num_envs=COUNT, autoreset_mode=mode, max_episode_steps=40)
    single = gymnasium.make_vec(
        name, num_envs=COUNT, vectorization_mode="sync", vector_kwargs={"autoreset_mode": mode}, max_episode_steps=40
    )
    assert isinstance(ours.unwrapped, afp.gym.CarbotVectorEnv)
    assert ours.observation_space == single.observation_space and ours.action_space == single.action_space
    ours.action_space.seed(1)
    for seed in (7, None):
        (seen, told), (theirs, their_infos) = ours.reset(seed=seed), single.reset(seed=seed)
        assert same(seen, theirs) and same(told, their_infos)
        over = 0
        for _ in range(120):
            actions = ours.action_space.sample()
            mine, its = ours.step(actions), single.step(actions)
            assert all(same(a, b) for a, b in zip(mine[:4], its[:4], strict=True))
            assert same(mine[4], its[4])
            over += int((mine[2] | mine[3]).sum())
        assert over >= 2 * COUNT, "episodes began again"


def test_a_finished_episode_waits_for_a_reset_by_default() -> None:
    env = afp.gym.CarbotVectorEnv(3, max_episode_steps=2, autoreset_mode=AutoresetMode.DISABLED)
    with pytest.raises(RuntimeError, match="reset"):
        env.step(np.zeros((3, 2)))
    env.reset(seed=0)
    env.step(np.zeros((3, 2)))
    *_, late, _ = env.step(np.zeros((3, 2)))
    assert late.all()
    with pytest.raises(gymnasium.error.ResetNeeded, match=r"\[0, 1, 2\] are over"):
        env.step(np.zeros((3, 2)))
    _, infos = env.reset(options={"reset_mask": np.array([True, False, True])})
    assert infos["_world"].tolist() == [True, False, True]
    with pytest.raises(gymnasium.error.ResetNeeded, match=r"\[1\]"):
        env.step(np.zeros((3, 2)))
    env.reset(seed=[1, 2, 3], options={"reset_mask": np.array([False, True, False])})
    assert not env.step(np.zeros((3, 2)))[3].any()
    for wrong in (np.array([True]), [True, True, True], np.zeros(3, np.bool_)):
        with pytest.raises(ValueError, match="reset_mask"):
            env.reset(options={"reset_mask": wrong})


def test_other_threads_run_during_a_step() -> None:
    env = afp.gym.CarbotVectorEnv(64)
    env.reset(seed=0)
    turns, going = [0], [True]

    def count() -> None:
        while going[0]:
            turns[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    before, refused = turns[0], 0
    for _ in range(20):
        env.step(np.zeros((64, 2)))
    going[0] = False
    thread.join()
    assert turns[0] - before > 20 and refused == 0


def forked(result: Any) -> None:
    env = afp.gym.CarbotVectorEnv(4)
    env.reset(seed=0)
    result.put(float(env.step(np.ones((4, 2)))[1].sum()))


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_has_its_own_threads() -> None:
    env = afp.gym.CarbotVectorEnv(4)
    env.reset(seed=0)
    here = float(env.step(np.ones((4, 2)))[1].sum())
    context = multiprocessing.get_context("fork")
    result = context.Queue()
    process = context.Process(target=forked, args=(result,))
    process.start()
    assert result.get(timeout=60) == here
    process.join()


def test_impossible_arguments_are_refused() -> None:
    with pytest.raises(ValueError, match="num_envs is 0"):
        afp.gym.CarbotVectorEnv(0)
    env = afp.gym.CarbotVectorEnv(2, render_mode="rgb_array")
    with pytest.raises(ValueError, match="1 seeds for 2"):
        env.reset(seed=[1])
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.render()
    env.reset(seed=1)
    with pytest.raises(ValueError, match="2 x 2"):
        env.step(np.zeros((3, 2)))
    with pytest.raises(afp.AfpError, match="no infrared source"):
        room = afp.WorldBuilder("dark", start=(1.0, 1.0)).room(3.0, 3.0).build()
        afp.gym.CarbotVectorEnv(2, room, task="FindInfrared").reset(seed=0)
    pictures = env.render()
    assert pictures is not None and len(pictures) == 2 and (pictures[0] != pictures[1]).any()


def test_wrappers_of_gymnasium_work() -> None:
    env = gymnasium.make_vec(ROAM, num_envs=3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gymnasium.wrappers.vector.RecordEpisodeStatistics(env)
        env = gymnasium.wrappers.vector.NormalizeObservation(env)
    env.reset(seed=0)
    for _ in range(5):
        seen, *_ = env.step(env.action_space.sample())
    assert seen.shape == (3, 9)
    env.close()


def test_a_plan_is_scored_like_an_environment() -> None:
    """A plan that drives like an environment's actions gets the environment's reward."""
    room = afp.WorldBuilder("hall", start=(1.0, 2.0, 0.2)).room(6.0, 4.0).infrared("beacon", (3.0, 2.0)).build()
    plan = afp.gym.plan_of("FindInfrared")
    score = afp.gym.evaluate(plan, "FindInfrared", [0, 1], world=room)
    assert (score.rewards > 10.5).all() and (score.steps < 300).all() and score.ended.all()
    assert afp.gym.evaluate(plan, "FindInfrared", [0], world=room).rewards[0] == score.rewards[0]
    goal = afp.gym.evaluate(afp.gym.plan_of("ReachGoal"), "ReachGoal", range(2), world=room)
    assert (goal.rewards > 10.0).all()
    with pytest.raises(ValueError, match="no plan for 'Roam'"):
        afp.gym.plan_of("Roam")
    broken = [afp.Fault("infrared", "lost")]
    assert afp.gym.evaluate(plan, "FindInfrared", [0], world=room, faults=broken) != afp.gym.evaluate(plan, "FindInfrared", [0], world=room)


def test_a_vector_has_its_seed() -> None:
    envs = afp.gym.CarbotVectorEnv(2)
    envs.reset(seed=3)
    assert envs.np_random_seed == 3


def test_the_plans_of_the_package_are_valid_and_canonical() -> None:
    from afp.gym.score import PLANS

    plans = [afp.load(path) for path in sorted(PLANS.glob("*.afp"))]
    assert {plan.path.name for plan in plans if plan.path} >= {task.plan for task in afp.gym.TASKS.values() if task.plan}
    assert all(plan.ok and plan.formatted() == plan.text for plan in plans)


def test_a_policy_is_scored_in_the_episodes_of_its_seeds() -> None:
    def ahead(seen: Any) -> Any:
        return np.tile([0.4, 0.0], (len(seen), 1))

    both, one = afp.gym.evaluate(ahead, "Roam", [3, 4]), afp.gym.evaluate(ahead, "Roam", [4])
    assert both.rewards[1] == one.rewards[0] and both.steps[1] == one.steps[0]
    assert both.ended.all() and not afp.gym.evaluate(lambda seen: np.zeros((1, 2)), "Roam", [3]).ended.any()
    assert "2 episodes" in repr(both)
    random = afp.gym.evaluate(None, "Roam", range(4))
    assert random.rewards.shape == (4,) and np.isfinite(random.rewards).all()


def test_single_environments_run_in_processes_with_a_world_from_the_program() -> None:
    room = afp.WorldBuilder("hall", start=(1.0, 1.0)).room(4.0, 4.0).build()
    settings: dict[str, Any] = {"num_envs": 2, "world": room}
    ours = gymnasium.make_vec(ROAM, **settings)
    theirs = gymnasium.make_vec(ROAM, vectorization_mode="async", vector_kwargs={"context": "forkserver"}, **settings)
    try:
        assert same(ours.reset(seed=3)[0], theirs.reset(seed=3)[0])
        actions = np.array([[1.0, 0.5], [0.5, -1.0]], np.float32)
        for _ in range(5):
            assert all(same(a, b) for a, b in zip(ours.step(actions)[:4], theirs.step(actions)[:4], strict=True))
    finally:
        theirs.close()


def test_a_running_environment_is_not_pickled() -> None:
    env = afp.gym.CarbotEnv()
    env.reset(seed=0)
    with pytest.raises(TypeError, match="make the environment again"):
        pickle.dumps(env)
    task = afp.gym.REACH_GOAL
    assert pickle.loads(pickle.dumps(task)) == task == copy.deepcopy(task)
