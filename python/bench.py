"""Measures the cost of the package as ratios within one run: `python bench.py [--check] [WORDS]`;
AFPC names an optimised afpc.

Compared functions take turns, and only the best times count, so that a busy machine disturbs them
less. A figure that misses its bar is measured twice more before it counts.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from itertools import repeat
from multiprocessing import get_context
from pathlib import Path

import numpy as np

import afp
import afp.gym

ROOT = Path(__file__).resolve().parents[1]
PLAN = ROOT / "plans/wall_following.afp"
UNTIL = 300.0
ROUNDS = 7
TRIES = 3


def best(measure: Callable[[], float]) -> float:
    """The least of several."""
    return min(measure() for _ in range(ROUNDS))


def seconds(work: Callable[[], object]) -> float:
    """The duration of a call."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def rust_run() -> float:
    """Seconds in the loop of `afpc run`, as it reports them."""
    options = ["--until", f"{UNTIL}s", "--log", "none", "--svg", "none"]
    afpc = os.environ.get("AFPC", "afpc")
    told = subprocess.run([afpc, "run", str(PLAN), *options], capture_output=True, text=True, check=True, cwd=ROOT)
    speed = re.search(r'"speed":([0-9.e+]+)', told.stdout)
    assert speed is not None, told.stdout
    return UNTIL / float(speed[1])


def run_cost() -> float:
    """`run` compared with the loop of `afpc run`."""
    plan = afp.load(PLAN)

    def python_run() -> float:
        simulation = afp.Simulation(plan)
        return seconds(lambda: simulation._runner.run(UNTIL, True))

    pairs = [(python_run(), rust_run()) for _ in range(ROUNDS)]
    return min(ours for ours, _ in pairs) / min(theirs for _, theirs in pairs)


def step_cost() -> float:
    """`step` compared with `run_to` for the same steps: the sum of the best time of each piece,
    since a busy machine disturbs some of them.
    """
    plan, pieces, steps = afp.load(PLAN), 40, 500
    ours, theirs = [float("inf")] * pieces, [float("inf")] * pieces
    for _ in range(2 * ROUNDS):
        simulation, whole = afp.Simulation(plan), afp.Simulation(plan)
        step = simulation.step
        for piece in range(pieces):
            begin = time.perf_counter()
            # Like timeit: a range would create numbers.
            for _ in repeat(None, steps):
                step()
            ours[piece] = min(ours[piece], time.perf_counter() - begin)
            end = simulation.time
            theirs[piece] = min(theirs[piece], seconds(lambda: whole.run_to(end)))
    return sum(ours) / sum(theirs)


def sweep_gain() -> float:
    """A sweep compared with `afpc sweep`, per run."""
    seeds, until = 16, 60.0
    plan = afp.load(PLAN)
    afpc = os.environ.get("AFPC", "afpc")

    def pair(folder: str) -> tuple[float, float]:
        ours = seconds(lambda: afp.sweep(plan, seeds=seeds, until=until, progress=False))
        options = ["--seeds", f"0..{seeds}", "--until", f"{until}s", "--restart", "-o", f"{folder}/runs.csv"]
        command = [afpc, "sweep", str(PLAN), *options]
        return ours, seconds(lambda: subprocess.run(command, capture_output=True, check=True, cwd=ROOT))

    with tempfile.TemporaryDirectory() as folder:
        pairs = [pair(folder) for _ in range(ROUNDS)]
    return min(theirs for _, theirs in pairs) / min(ours for ours, _ in pairs)


def reset_time() -> float:
    """Milliseconds of a new episode in a given room."""
    env = afp.gym.CarbotEnv(afp.World.random(3))
    env.reset(seed=0)
    return best(lambda: seconds(lambda: [env.reset() for _ in range(50)])) / 50 * 1e3


def env_cost() -> float:
    """A step of the environment compared with the same drive of the robot without one."""
    room, steps = afp.World.random(3), 500
    env, alone = afp.gym.CarbotEnv(room, ends=[], observe=["motion"]), afp.Carbot(room)
    env.reset(seed=0)
    action = np.array([0.3, 0.3])

    def pair() -> tuple[float, float]:
        ours = seconds(lambda: [env.step(action) for _ in range(steps)])
        return ours, seconds(lambda: alone.drive(0.15, 0.6, steps * 0.1))

    pairs = [pair() for _ in range(ROUNDS)]
    return min(ours for ours, _ in pairs) / min(theirs for _, theirs in pairs)


def against_envpool() -> float:
    """Steps per second of 16 robots compared with 16 lunar landers of EnvPool, both on two threads."""
    envpool = importlib.import_module("envpool")
    many, steps = 16, 200
    landers = envpool.make("LunarLander-v2", env_type="gymnasium", num_envs=many, num_threads=2)
    robots = afp.gym.CarbotVectorEnv(many, afp.World.random(3), max_episode_steps=600)
    landers.reset()
    robots.reset(seed=0)
    rng = np.random.default_rng(0)
    buttons = rng.integers(0, 4, (steps, many)).astype(np.int32)
    actions = rng.uniform(-1.0, 1.0, (steps, many, 2))

    def pair() -> tuple[float, float]:
        theirs = seconds(lambda: [landers.step(button) for button in buttons])
        return seconds(lambda: [robots.step(action) for action in actions]), theirs

    pairs = [pair() for _ in range(ROUNDS)]
    return min(theirs for _, theirs in pairs) / min(ours for ours, _ in pairs)


def ppo_share() -> float:
    """The share of time that PPO of stable-baselines3 spends in 16 environments, with its default
    settings.
    """
    ppo = importlib.import_module("stable_baselines3").PPO
    envs = importlib.import_module("afp.gym.sb3").CarbotVecEnv(16, seed=0, max_episode_steps=600)
    step, within = envs.step_wait, [0.0]

    def timed() -> object:
        begin = time.perf_counter()
        stepped: object = step()
        within[0] += time.perf_counter() - begin
        return stepped

    envs.step_wait = timed
    model = ppo("MlpPolicy", envs, n_steps=128, seed=0, device="cpu")

    def once() -> float:
        within[0] = 0.0
        whole = seconds(lambda: model.learn(128 * 16, reset_num_timesteps=False))
        return within[0] / whole

    return statistics.median(once() for _ in range(ROUNDS))


def simulate(seed: int) -> None:
    """A run in a thread."""
    afp.Simulation(afp.load(PLAN), seed=seed).run_to(UNTIL)


def count(_: int) -> None:
    """Arithmetic in a process."""
    total = 0
    for number in range(4_000_000):
        total += number * number


def gain(pool: ThreadPoolExecutor | ProcessPoolExecutor, work: Callable[[int], None]) -> float:
    """The speed-up of two workers over one."""
    list(pool.map(work, range(2)))
    alone = seconds(lambda: list(pool.map(work, [0]))) * 2
    return alone / seconds(lambda: list(pool.map(work, range(2))))


def threads_gain() -> float:
    """The speed-up of runs on two threads, compared with that of arithmetic in two processes."""
    with ThreadPoolExecutor(2) as threads, ProcessPoolExecutor(2, mp_context=get_context("spawn")) as processes:
        pairs = [(gain(threads, simulate), gain(processes, count)) for _ in range(ROUNDS)]
    return max(ours for ours, _ in pairs) / max(theirs for _, theirs in pairs)


def robots_gain() -> float:
    """The speed-up of many robots at once, compared with that of arithmetic in two processes."""
    many, steps = 16, 25
    room = afp.World.random(3)
    one, all = afp.gym.CarbotEnv(room, ends=[]), afp.gym.CarbotVectorEnv(many, room, ends=[])
    one.reset(seed=0)
    all.reset(seed=0)
    action = np.array([0.3, 0.3])
    actions = np.tile(action, (many, 1))

    def pair(processes: ProcessPoolExecutor) -> tuple[float, float]:
        alone = seconds(lambda: [one.step(action) for _ in range(many * steps)])
        return alone / seconds(lambda: [all.step(actions) for _ in range(steps)]), gain(processes, count)

    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as processes:
        pairs = [pair(processes) for _ in range(ROUNDS)]
    return max(ours for ours, _ in pairs) / max(theirs for _, theirs in pairs)


def ended(work: Callable[[], object]) -> float:
    """Milliseconds from Ctrl-C to its exception."""
    sent = [0.0]

    def send() -> None:
        sent[0] = time.perf_counter()
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(0.2, send).start()
    try:
        work()
    except KeyboardInterrupt:
        return (time.perf_counter() - sent[0]) * 1e3
    return float("inf")


def interrupted() -> float:
    """Milliseconds from Ctrl-C in a run to its exception."""
    return statistics.median(ended(lambda: afp.Simulation(afp.load(PLAN)).run_to(1e6)) for _ in range(ROUNDS))


def interrupted_sweep() -> float:
    """Milliseconds from Ctrl-C to its exception in a sweep on two cores with hanging components."""
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    class Hangs:
        def poll(self) -> str:
            while True:
                pass

    plan = afp.Plan("use tools\nplan P { start go actor go: Hangs { Done -> terminate } }", toolboxes=[tools])
    return statistics.median(ended(lambda: afp.sweep(plan, seeds=8, jobs=2, progress=False)) for _ in range(ROUNDS))


def supervised() -> float:
    """The speed as a multiple of real time of a plan with a Python supervisor polled every
    millisecond.
    """
    tools = afp.Toolbox("tools")

    @tools.supervisor(events=["Near"], every="1 ms")
    def CheckNear(robot: afp.Robot, distance: afp.Length) -> str | None:
        return "Near" if robot.time > 1e9 and robot.touched else None

    text = PLAN.read_text().replace("use carbot", "use carbot\nuse tools", 1)
    plan = afp.Plan(text, toolboxes=[tools])
    plan.add("supervise near: CheckNear(distance = 1 cm) { Near -> terminate }")
    plan.check()
    return 20.0 / best(lambda: seconds(lambda: afp.Simulation(plan).run_to(20.0)))


def interruptions() -> float:
    """A sweep of 10,000 runs with random bumps and a metric, compared with one of plain runs, in
    processor time.
    """
    plan, pieces, seeds, until = afp.load(PLAN), 20, 500, 5.0

    def bumps(rng: np.random.Generator) -> list[afp.Press]:
        return [afp.Press("touch", at=time) for time in rng.uniform(0.5, 4.5, rng.poisson(1.0))]

    def spent(first: int, **more: object) -> float:
        begin = time.process_time()
        afp.sweep(plan, seeds=range(first, first + seeds), until=until, progress=False, **more)  # type: ignore[arg-type]
        return time.process_time() - begin

    metrics = {"reaction_s": afp.metrics.reaction}
    pairs = [(spent(piece * seeds, presses=bumps, metrics=metrics), spent(piece * seeds)) for piece in range(pieces)]
    return sum(ours for ours, _ in pairs) / sum(theirs for _, theirs in pairs)


BARS: list[tuple[str, Callable[[], float], str, float]] = [
    ("run, against the loop of afpc run", run_cost, "<=", 1.2),
    ("step(), against run_to", step_cost, "<=", 1.1),
    ("sweep, against afpc sweep", sweep_gain, ">=", 0.95),
    ("two threads' gain, against two processes'", threads_gain, ">=", 0.9),
    ("16 robots' gain, against two processes'", robots_gain, ">=", 0.9),
    ("a step of an environment, against driving", env_cost, "<=", 1.3),
    ("a new episode, ms", reset_time, "<=", 0.2),
    ("16 robots, against EnvPool's landers", against_envpool, ">=", 0.7),
    ("16 robots in PPO, their part of the time", ppo_share, "<=", 0.333),
    ("Ctrl-C to its exception, ms", interrupted, "<=", 100.0),
    ("Ctrl-C in a sweep that hangs, ms", interrupted_sweep, "<=", 100.0),
    ("10,000 interrupted runs, against plain", interruptions, "<=", 1.2),
    ("supervisor at 1 kHz, times real time", supervised, ">=", 20.0),
]

# The large packages needed for comparisons.
WANTS: dict[Callable[[], float], str] = {against_envpool: "envpool", ppo_share: "stable_baselines3"}


def main() -> int:
    """Print the figures; with `--check`, fail if one misses its bar."""
    # A shell that starts this in the background ignores Ctrl-C.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    failed = 0
    wanted = [word for word in sys.argv[1:] if not word.startswith("-")]
    for name, measure, relation, bar in BARS:
        if wanted and not any(word in name for word in wanted):
            continue
        wants = WANTS.get(measure)
        if wants is not None and importlib.util.find_spec(wants) is None:
            print(f"{name:<42} skipped: pip install {wants}")
            continue
        for _ in range(TRIES):
            value = measure()
            kept = value <= bar if relation == "<=" else value >= bar
            if kept:
                break
        failed += not kept
        print(f"{name:<42} {value:8.2f}  {relation} {bar:<6g} {'ok' if kept else 'MISSED'}", flush=True)
    return 1 if failed and "--check" in sys.argv[1:] else 0


if __name__ == "__main__":
    sys.exit(main())
