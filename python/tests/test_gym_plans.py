"""Plans as environments."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

import afp

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402

import afp.gym  # noqa: E402

CHOOSES = """
use std
use carbot

plan Chooses {
    in far: length = 20 cm
    var way: length
    start choose

    supervise touch: CheckTouchSensor { TouchSensorPressed -> back }

    actor choose: Choose { Ahead -> ahead Left -> left Enough -> terminate }
    actor ahead: Forward(distance = far) { ForwardSuccessful -> choose }
    actor left: Turn(angle = 45 deg) { TurnSuccessful -> choose }
    actor back: Forward(distance = -10 cm) {
        on touch { TouchSensorPressed -> ignore }
        ForwardSuccessful -> choose
    }
}
"""


def chooses() -> afp.Plan:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Ahead", "Left", "Enough"])
    class Choose:
        """Waits for a decision."""

        def poll(self) -> None:
            return None

    return afp.Plan(CHOOSES.replace("use std\n", "use std\nuse tools\n"), toolboxes=[tools])


def env_of(kind: str, **more: Any) -> Any:
    if kind == "parameters":
        return afp.gym.PlanEnv(afp.gym.plan_of("WallFollow"), task="WallFollow", parameters={"walldist": (0.2, 0.6)}, **more)
    if kind == "decision":
        return afp.gym.PlanEnv(chooses(), decision="choose", **more)
    both = {"parameters": {"far": (0.1, 0.5)}, "decision": "choose"}
    return afp.gym.PlanEnv(chooses(), task="ReachGoal", observe=["target", "distance", "far"], **both, **more)


@pytest.mark.parametrize("kind", ["parameters", "decision", "both"])
def test_gymnasium_finds_nothing_wrong_with_a_plan(kind: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env_of(kind), skip_render_check=True)


@pytest.mark.parametrize("kind", ["parameters", "decision", "both"])
def test_the_same_seed_and_choices_give_the_same_episode(kind: str) -> None:
    def episode() -> list[Any]:
        env = env_of(kind, time_limit=20.0)
        env.action_space.seed(1)
        told: list[Any] = [env.reset(seed=5)[0].tobytes()]
        for _ in range(15):
            seen, reward, ended, late, info = env.step(env.action_space.sample())
            told += [seen.tobytes(), reward, ended, late, info["time"], info["pose"].tobytes()]
            if ended or late:
                break
        return told

    assert episode() == episode()


def test_a_decision_is_an_option_of_the_plan() -> None:
    env = env_of("decision")
    assert env.states == ["Ahead", "Enough", "Left"]
    _, info = env.reset(seed=1, options={"world": "random:1"})
    assert info["active"] == "choose" and info["time"] == 0.0
    x, y, heading = info["pose"]
    _, _, ended, late, info = env.step(2)
    assert info["pose"][2] - heading == pytest.approx(np.pi / 4, abs=0.1)
    assert not ended and not late and 0.2 < info["duration"] < 5.0
    _, reward, _, _, info = env.step(0)
    assert np.hypot(info["pose"][0] - x, info["pose"][1] - y) == pytest.approx(0.2, abs=0.05)
    assert reward == pytest.approx(0.2, abs=0.05)
    _, _, ended, _, info = env.step(1)
    assert ended and info["ending"] == "ok"
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)


def test_parameters_are_entries_of_the_plan() -> None:
    env = env_of("parameters", period=2.0)
    env.reset(seed=1)
    _, _, _, _, info = env.step(np.array([0.5]))
    assert env.simulation["walldist"] == pytest.approx(0.5) and info["duration"] == pytest.approx(2.0)
    env.step(np.array([9.0]))
    assert env.simulation["walldist"] == pytest.approx(0.6)


def test_a_plan_can_be_drawn() -> None:
    env = env_of("both", render_mode="rgb_array")
    env.reset(seed=1)
    first = env.render()
    env.step({"parameters": np.array([1.0]), "decision": 0})
    assert first.shape == (256, 256, 3) and (env.render() != first).any()


def test_faults_and_presses_are_drawn_for_each_episode() -> None:
    drawn: list[int] = []

    def bumps(rng: np.random.Generator) -> list[afp.Press]:
        drawn.append(int(rng.poisson(5.0)))
        return [afp.Press("touch", at=time) for time in rng.uniform(0.5, 5.0, drawn[-1])]

    env = env_of("decision", presses=bumps, time_limit=10.0)
    counts = []
    for seed in (1, 2, 1):
        env.reset(seed=seed)
        while not any(env.step(0)[2:4]):
            pass
        counts.append(sum(event.kind == "event" for event in env.simulation.events))
    assert drawn[0] == drawn[2] and counts[0] == counts[2] > 0


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, "nothing to choose"),
        ({"parameters": {"walldits": (0, 1)}}, "no 'in' or 'var' entry 'walldits'; there are: walldist"),
        ({"parameters": {"walldist": (1, 0)}}, "the smaller one first"),
        ({"decision": "followWal"}, "no actor 'followWal' to decide in; there are: "),
        ({"parameters": {"walldist": (0, 1)}, "observe": ["smell"]}, "nothing is called 'smell'"),
        ({"parameters": {"walldist": (0, 1)}, "observe": ["target"]}, "there is nothing to reach"),
    ],
)
def test_invalid_choices_are_refused(given: dict[str, Any], said: str, wall_following: afp.Plan) -> None:
    with pytest.raises((KeyError, ValueError)) as error:
        afp.gym.PlanEnv(wall_following, **given)
    assert said in str(error.value)
