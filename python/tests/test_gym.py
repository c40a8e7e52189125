"""The Gymnasium environment."""

from __future__ import annotations

import math
import copy
import io
import os
import re
import subprocess
import sys
import time
import types
import warnings
from typing import Any

import numpy as np
import pytest

import afp

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402

import afp.gym  # noqa: E402

MODES: list[dict[str, Any]] = [{}, {"render_mode": "rgb_array"}, {"render_mode": "rgb_array", "view": "camera"}]


@pytest.fixture
def window(monkeypatch: pytest.MonkeyPatch) -> list[bytes]:
    """A stand-in for a system window, and its contents."""
    shown: list[bytes] = []

    class Widget:
        asked: list[Any] = []

        def protocol(self, name: str, handler: Any) -> None:
            """Closing the window calls the handler."""
            self.asked.append(handler)

        def __init__(self, *given: Any, data: bytes = b"", **more: Any) -> None:
            if data:
                shown.append(data)

        def zoom(self, times: int) -> Widget:
            return self

        def __getattr__(self, name: str) -> Any:
            return lambda *given, **more: None

    monkeypatch.setitem(sys.modules, "tkinter", types.SimpleNamespace(Tk=Widget, Label=Widget, PhotoImage=Widget))
    return shown


@pytest.mark.parametrize("options", MODES)
@pytest.mark.parametrize("name", list(afp.gym.TASKS))
def test_gymnasium_finds_no_error(name: str, options: dict[str, Any], window: list[bytes]) -> None:
    env = gymnasium.make(name, **options)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped, skip_render_check=not options)


def test_it_is_created_without_another_import() -> None:
    code = "import gymnasium; print(gymnasium.make('afp.gym:afp/CarbotReachGoal-v0').spec.max_episode_steps)"
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert made.stdout == "600\n"


def test_with_another_robot_the_reason_is_reported() -> None:
    code = "from afp import _afp\n_afp.own_robot = 'vacuum::Vacuum'\ntry: import afp.gym\nexcept ImportError as why: print(why)"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.startswith("afp.gym is for the Carbot, and this process has another robot")


def drive(seed: int, world: Any = None) -> list[Any]:
    env = afp.gym.CarbotEnv(world)
    seen, _ = env.reset(seed=seed)
    env.action_space.seed(5)
    all: list[Any] = [seen.tobytes()]
    for _ in range(60):
        seen, reward, ended, cut, info = env.step(env.action_space.sample())
        all += [seen.tobytes(), reward, ended, cut, info["pose"].tobytes()]
        if ended or cut:
            env.reset()
    return all


def test_a_seed_decides_the_trajectory() -> None:
    assert drive(1) == drive(1) != drive(2)


def test_distance_ahead_is_rewarded_and_a_crash_is_punished() -> None:
    room = afp.World.load("random:1")
    env = afp.gym.CarbotEnv(room, time_limit=60.0)
    _, start = env.reset(seed=0)
    total, ended, cut, info = 0.0, False, False, start
    while not (ended or cut):
        _, reward, ended, cut, info = env.step(np.array([1.0, 0.0]))
        total += reward
    assert ended and info["collisions"] >= 1
    went = math.dist(start["pose"][:2], info["pose"][:2])
    assert total == pytest.approx(went - 10.0, abs=0.05)


def test_an_action_has_the_scale_of_the_constants() -> None:
    env = afp.gym.CarbotEnv("random:1", observe=["motion", "fan"], fan=[0.0])
    env.reset(seed=0)
    for share in (0.2, 0.4):
        for _ in range(8):
            seen, _, _, _, info = env.step(np.array([0.0, share]))
        assert seen[1] == pytest.approx(share * afp.gym.TURN, rel=0.05)
    assert info["time"] == pytest.approx(16 * afp.gym.STEP)
    assert env.observation_space.high[2] == afp.gym.RANGE


def test_an_episode_is_truncated() -> None:
    env = afp.gym.CarbotEnv("random:1", time_limit=0.3)
    env.reset(seed=0)
    assert [env.step(np.zeros(2))[3] for _ in range(3)] == [False, False, True]
    env = gymnasium.make("afp/Carbot-v0", max_episode_steps=2)
    env.reset(seed=0)
    assert [env.step(np.zeros(2))[3] for _ in range(2)] == [False, True]
    assert gymnasium.spec("afp/Carbot-v0").max_episode_steps == 600


def test_the_picture_shows_the_robot_and_the_goal() -> None:
    env = afp.gym.CarbotEnv("random:1", task="ReachGoal", render_mode="rgb_array")
    env.reset(seed=0)
    picture = env.render()
    assert picture is not None and picture.shape == (256, 256, 3)
    for color in ((0, 114, 178), (90, 90, 90), (204, 121, 167)):
        assert (picture == color).all(axis=2).any()
    env.step(np.array([1.0, 1.0]))
    assert (env.render() != picture).any()


def test_the_picture_shows_moving_objects_at_their_places() -> None:
    hall = afp.WorldBuilder("hall", start=(1.0, 1.0)).room(4.0, 4.0)
    hall = hall.mover("walker", (1.0, 3.0), size=(0.4, 0.4), height=1.7, by=[(2.0, 0.0)], speed=0.5)
    env = afp.gym.CarbotEnv(hall.build(), render_mode="rgb_array")

    def middle() -> float:
        picture = env.render()
        assert picture is not None
        columns = (picture == (140, 120, 90)).all(axis=2).any(axis=0).nonzero()[0]
        return float(columns.mean()) / 256

    env.reset(seed=0)
    begin = middle()
    for _ in range(20):
        env.step(np.zeros(2))
    assert middle() - begin == pytest.approx(1.0 / 4.4, abs=0.03)


def test_invalid_arguments_are_refused() -> None:
    env = afp.gym.CarbotEnv
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"render_mode": "ansi"}, "no render mode 'ansi'; there are: human, rgb_array"),
        ({"view": "side"}, "no view"),
        ({"task": "Fly"}, "no task 'Fly'; there are: Roam, WallFollow"),
        ({"observe": ["sonar"]}, "no part 'sonar' of an observation; there are: distance"),
        ({"observe": ["target"]}, "'target' is observed and there is nothing to reach: set reach="),
        ({"reward": {"nearer": 1.0}}, "'nearer' is rewarded and there is nothing to reach: set reach="),
        ({"reward": {"ahead": 1.0, "reached": 1.0}}, "'reached' is rewarded and there is nothing to reach"),
        ({"ends": ["reached"]}, "'reached' ends the episode and there is nothing to reach"),
        ({"reach": "moon"}, "moon"),
        ({"fan": [0.0]}, "the fan is not observed: set observe=['fan', 'distance', 'odometry', 'bumper']"),
        ({"time_limit": 0}, "time_limit is 0; give seconds above 0"),
        ({"time_limit": -1}, "time_limit is -1; give seconds above 0"),
        ({"time_limit": math.nan}, "time_limit is nan"),
        ({"observe": ["fan"], "point": True}, "remove one of them"),
        ({"reward": {"speed": 1.0}}, "no term 'speed'; there are: ahead"),
        ({"reward": {"ahead": math.nan}}, "finite"),
        ({"ends": ["wall"]}, "'wall' ends no episode"),
    ]
    for given, text in wrong:
        with pytest.raises(ValueError, match=re.escape(text)):
            env(**given)
        if not given.keys() & {"time_limit", "render_mode", "view"}:
            with pytest.raises(ValueError, match=re.escape(text)):
                afp.gym.CarbotVectorEnv(2, **given)
    with pytest.raises(ValueError, match="at least one step"):
        afp.gym.CarbotVectorEnv(2, max_episode_steps=0)
    with pytest.raises(TypeError, match="fan is in rad, not a quantity in m"):
        env(observe=["fan"], fan=[afp.cm(3)])
    with pytest.raises(TypeError, match="lists of names"):
        env(observe="bumper")
    with pytest.raises(gymnasium.error.ResetNeeded):
        env().step(np.zeros(2))
    with pytest.raises(ValueError, match="finite"):
        afp.Carbot(afp.World.random(1)).drive(math.nan, 0.0, 1.0)
    begun = env()
    begun.reset(seed=0)
    with pytest.raises(ValueError, match="finite"):
        begun.step(np.array([math.nan, 0.0]))
    with pytest.raises(ValueError, match="must be 2 numbers"):
        begun.step(np.zeros(3))


def test_a_reset_has_a_world_a_pose_a_goal_and_faults() -> None:
    env = afp.gym.CarbotEnv(task="ReachGoal")
    room = afp.World.load("random:5")
    x, y, _ = room.start
    options = {"world": room, "pose": (x, y, 1.25), "goal": (x + 0.5, y), "faults": [afp.Fault("ultrasonic", "lost")]}
    seen, info = env.reset(seed=3, options=options)
    assert info["world"] == "random:5" and info["pose"] == pytest.approx((x, y, 1.25), abs=1e-6)
    assert info["target"] == pytest.approx((x + 0.5, y))
    assert seen[:3] == pytest.approx([0.5, math.sin(-1.25), math.cos(-1.25)], abs=1e-3)
    _, info = env.reset(seed=3)
    assert info["world"] != "random:5", "the options apply only to that episode"
    inside = {"world": room, "pose": (-0.02, 1.0, 0.0)}
    with pytest.raises(afp.AfpError, match="starts inside of 'room'"):
        env.reset(options=inside)
    for wrong, text in [
        ({"wrld": 1}, "no option 'wrld' of reset; there are: world, pose, goal, faults"),
        ({"pose": (1.0, 2.0)}, "'pose' has 3 numbers, not 2"),
        ({"pose": (1.0, math.nan, 0.0)}, "pose is nan; give a finite number"),
        ({"faults": [afp.Fault("ultrasonic", "fried")]}, "fried"),
    ]:
        with pytest.raises(ValueError, match=text):
            env.reset(options=wrong)


@pytest.mark.parametrize("task", ["Roam", "FindInfrared"])
def test_a_goal_is_refused_without_a_task_that_needs_it(task: str) -> None:
    for env in (afp.gym.CarbotEnv(task=task), afp.gym.CarbotVectorEnv(2, task=task)):
        with pytest.raises(ValueError, match=f"'{task}' has no goal to drive to: make the environment with reach="):
            env.reset(seed=0, options={"goal": (1.0, 1.0)})
    env = afp.gym.CarbotEnv(task="Roam", reach="goal")
    assert env.reset(seed=0, options={"goal": (1.0, 1.0)})[1]["target"] == pytest.approx((1.0, 1.0))
    with pytest.raises(TypeError, match="goal is in m, not a quantity in rad"):
        env.reset(options={"goal": (afp.deg(3), 1.0)})


def test_the_error_for_a_missing_part_names_the_fix() -> None:
    given: dict[str, Any] = {"observe": ["target", "fan"], "reward": {"nearer": 1.0}, "ends": ["reached"], "reach": "goal", "fan": [0.0, afp.deg(45)]}
    env = gymnasium.make("afp/Carbot-v0", **given)
    assert env.reset(seed=3)[0].shape == (5,) and "target" in env.reset(seed=3)[1]
    assert gymnasium.make_vec("afp/Carbot-v0", num_envs=2, **given).reset(seed=3)[0].shape == (2, 5)


def test_a_fault_repeats_the_last_reading() -> None:
    env = afp.gym.CarbotEnv(observe=["odometry", "valid"], faults=[afp.Fault("odometry", "lost", at=1.0)])
    env.reset(seed=0)
    rows = [env.step(np.array([0.5, 0.2]))[0] for _ in range(20)]
    assert rows[8][6] == 1.0 and (rows[8] != rows[9]).any()
    assert all(row[6] == 0.0 and (row[:6] == rows[11][:6]).all() for row in rows[11:])


def test_a_function_can_draw_faults() -> None:
    drawn: list[float] = []

    def broken(rng: np.random.Generator) -> list[Any]:
        drawn.append(share := float(rng.uniform(0.1, 0.9)))
        return [afp.Fault("wheels", "slip", share=share)]

    env = afp.gym.CarbotEnv(faults=broken)
    for seed in (1, 2, 1):
        env.reset(seed=seed)
    assert drawn[0] == drawn[2] != drawn[1]


def test_the_fan_detects_an_object_at_the_right() -> None:
    hall = afp.WorldBuilder("hall", start=(2.0, 0.45)).room(4.0, 4.0).build()
    env = afp.gym.CarbotEnv(hall, task="WallFollow")
    env.reset(seed=0)
    for _ in range(15):
        seen, *_ = env.step(np.zeros(2))
    # From the rotator, at the robot's axis, to the wall, 5 cm from its line.
    assert seen[0] == pytest.approx(0.40, abs=0.03) and seen[2] == pytest.approx(1.85, abs=0.1)


def test_an_action_points_the_sensor() -> None:
    hall = afp.WorldBuilder("hall", start=(2.0, 1.0)).room(4.0, 4.0).build()
    env = afp.gym.CarbotEnv(hall, point=True)
    assert env.action_space.shape == (3,)
    env.reset(seed=0)
    for _ in range(10):
        seen, *_ = env.step(np.array([0.0, 0.0, -1.0]))
    assert seen[0] == pytest.approx(0.95, abs=0.05)


def test_a_wall_is_followed_at_thirty_centimetres() -> None:
    def reward(gap: float) -> float:
        # The robot's side is half its width nearer to the wall, which is 5 cm thick on this side.
        start = (2.0, 0.05 + gap + afp.Carbot.half_width)
        env = afp.gym.CarbotEnv(afp.WorldBuilder("hall", start=start).room(8.0, 4.0).build(), task="WallFollow")
        env.reset(seed=0)
        return sum(env.step(np.array([0.5, 0.0]))[1] for _ in range(30))

    best, near, far = reward(0.3), reward(0.12), reward(0.65)
    assert best > 0.55 and 0.2 * best < near < 0.7 * best and far == pytest.approx(0.0, abs=0.02)


def test_a_goal_is_reached_once() -> None:
    hall = afp.WorldBuilder("hall", start=(1.0, 2.0)).room(5.0, 4.0).build()
    env = afp.gym.CarbotEnv(hall, task="ReachGoal", ends=[])
    _, info = env.reset(seed=0, options={"goal": (2.0, 2.0)})
    rewards = [env.step(np.array([0.6, 0.0]))[1] for _ in range(40)]
    assert sum(reward > 5.0 for reward in rewards) == 1
    env = afp.gym.CarbotEnv(hall, task="ReachGoal")
    env.reset(seed=0, options={"goal": (2.0, 2.0)})
    steps = 0
    while not env.step(np.array([0.6, 0.0]))[2]:
        steps += 1
    assert steps == next(index for index, reward in enumerate(rewards) if reward > 5.0)


def test_beyond_the_sensors_range_silence_is_a_known_value() -> None:
    hall = afp.WorldBuilder("hall", start=(1.0, 2.0)).box("wall", (5.19, 2.0), size=(0.2, 20.0), height=2.0).build()
    env = afp.gym.CarbotEnv(hall, ends=[])
    for seed in range(4):
        env.reset(seed=seed)
        assert all(list(env.step(np.zeros(2))[0][:2]) == [afp.gym.RANGE, 1.0] for _ in range(40))


def random_faults(rng: np.random.Generator) -> list[Any]:
    """Random faults of all devices, each for a while."""
    return [
        afp.Fault(device, kind, at=rng.uniform(0, 20), lasting=rng.uniform(0, 20))
        for device, kind in afp.faults()
        if rng.uniform() < 0.1
    ]


def test_no_fault_raises_an_exception() -> None:
    """`AFP_GYM_STEPS` sets the number of steps; the nightly run takes a million."""
    steps, count = int(os.environ.get("AFP_GYM_STEPS", "12000")), 16
    parts = ["distance", "odometry", "motion", "bumper", "fan", "target", "glow", "color", "battery", "valid"]
    settings: dict[str, Any] = {"task": "ReachGoal", "observe": parts, "faults": random_faults}
    env = afp.gym.CarbotVectorEnv(count, max_episode_steps=200, **settings)
    seen, _ = env.reset(seed=11)
    env.action_space.seed(11)
    known = set()
    for _ in range(steps // count):
        seen, rewards, *_ = env.step(env.action_space.sample())
        assert np.isfinite(seen).all() and env.observation_space.contains(seen) and np.isfinite(rewards).all()
        known |= {tuple(row) for row in seen[:, -5:]}
    assert len(known) > 5, "sensors answer and do not"


def test_a_window_shows_each_step(window: list[bytes]) -> None:
    env = afp.gym.CarbotEnv("random:1", render_mode="human")
    env.reset(seed=0)
    env.step(np.array([1.0, 0.0]))
    assert env.render() is None
    env.close()
    assert len(window) == 3 and window[0].startswith(b"P6 256 256 255\n") and window[0] != window[1]
    assert len(window[0]) == len(b"P6 256 256 255\n") + 256 * 256 * 3


def test_a_closed_window_stays_closed(window: list[bytes]) -> None:
    env = afp.gym.CarbotEnv("random:1", render_mode="human")
    env.reset(seed=0)
    sys.modules["tkinter"].Tk.asked[-1]()
    env.step(np.array([1.0, 0.0]))
    assert len(window) == 1
    env.close()
    env.reset(seed=0)
    assert len(window) == 2, "the next window is a new one"


def test_without_a_display_the_error_names_the_fix(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "tkinter", None)
    env = afp.gym.CarbotEnv("random:1", render_mode="human")
    with pytest.warns(UserWarning, match="shows nothing without a display"):
        env.reset(seed=0)
    env.step(np.array([1.0, 0.0]))
    env.close()


def test_the_camera_has_one_size() -> None:
    env = afp.gym.CarbotEnv("random:1", render_mode="rgb_array", view="camera")
    env.reset(seed=0)
    shapes = {env.render().shape}
    for _ in range(10):
        env.step(np.array([0.5, 0.0]))
        shapes.add(env.render().shape)
    assert shapes == {(120, 160, 3)}


def test_an_environment_can_be_copied_before_its_first_episode() -> None:
    env = copy.deepcopy(afp.gym.CarbotEnv("random:1"))
    assert (env.reset(seed=1)[0] == afp.gym.CarbotEnv("random:1").reset(seed=1)[0]).all()


def test_tasks_and_scores_can_be_compared_and_hashed() -> None:
    assert len({afp.gym.ROAM, afp.gym.ROAM, afp.gym.REACH_GOAL}) == 2
    scores = [afp.gym.evaluate(None, "Roam", range(2)) for _ in range(2)]
    assert scores[0] == scores[1] and len(set(scores)) == 1
    assert scores[0] != afp.gym.evaluate(None, "Roam", range(1, 3))


def test_a_notebook_cell_is_redrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[bytes] = []

    class Handle:
        def update(self, data: dict[str, bytes], raw: bool) -> None:
            shown.append(data["image/png"])

    def first(data: dict[str, bytes], raw: bool, display_id: bool) -> Handle:
        shown.append(data["image/png"])
        return Handle()

    display = types.SimpleNamespace(display=first)
    kernel = types.SimpleNamespace(kernel=None)
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(display=display, get_ipython=lambda: kernel))
    env = afp.gym.CarbotEnv("random:1", render_mode="human")
    begin = time.monotonic()
    env.reset(seed=0)
    for _ in range(3):
        env.step(np.array([1.0, 0.0]))
    assert time.monotonic() - begin >= 0.29, "it is shown in real time"
    env.close()
    assert len(shown) == 4 and all(picture.startswith(b"\x89PNG") for picture in shown) and shown[0] != shown[3]


def test_a_picture_is_a_png() -> None:
    image = pytest.importorskip("matplotlib.image")
    from afp.gym.screen import png

    picture = np.random.default_rng(0).integers(0, 256, (7, 5, 3)).astype(np.uint8)
    read = image.imread(io.BytesIO(png(picture)), format="png")
    assert (np.round(read[:, :, :3] * 255) == picture).all()


def test_episodes_have_seeds() -> None:
    for judge in (lambda seeds: afp.gym.evaluate(afp.gym.plan_of("WallFollow"), "WallFollow", seeds), lambda seeds: afp.gym.evaluate(None, "WallFollow", seeds)):
        for seeds, kind, said in (([], ValueError, r"there are no seeds in \[\]"), (3, TypeError, "seeds are several whole numbers"), ([-1], ValueError, "-1 is not a seed")):
            with pytest.raises(kind, match=said):
                judge(seeds)
