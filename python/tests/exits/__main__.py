"""Programs that end in the middle of something: `python tests/exits NAME SECONDS`.

Each prints `leaving` and the clock when its main thread ends, so that the parent process can
measure how long the exit takes.
"""

from __future__ import annotations

import atexit
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

import afp

FOREVER = 1e6

tools = afp.Toolbox("exits")


@tools.actor(states=["Done"])
class Sleeps:
    """An actor that sleeps in every poll."""

    def poll(self, seconds: float) -> str | None:
        time.sleep(seconds)
        return None


@tools.actor(states=["Done"])
class Computes:
    """An actor that never leaves Python."""

    def poll(self) -> str | None:
        while True:
            sum(range(100))


@tools.actor(states=["Done"])
async def Awaits() -> str:
    """An asynchronous actor that sleeps."""
    try:
        while True:
            time.sleep(0.002)
            await afp.tick()
    finally:
        time.sleep(0.002)


@tools.actor(states=["Done"])
class Nests:
    """An actor that runs another simulation with a sleeping component."""

    def poll(self) -> str | None:
        afp.Simulation(plan("Sleeps(seconds = 0.002)")).run(until=0.2)
        return None


def plan(actor: str) -> afp.Plan:
    text = f"use exits\nplan P {{ start a actor a: {actor} {{ Done -> terminate }} }}"
    return afp.Plan(text, toolboxes=[tools])


def run(actor: str) -> Callable[[], Any]:
    return lambda: afp.Simulation(plan(actor)).run(until=FOREVER)


def native() -> None:
    while True:
        afp.Simulation(afp.load("../plans/wall_following.afp")).run(until=FOREVER)


def steps() -> None:
    simulation = afp.Simulation(plan("Sleeps(seconds = 0.0005)"))
    while simulation.step():
        pass


def sweep(actor: str, **more: Any) -> Callable[[], Any]:
    return lambda: afp.sweep(plan(actor), seeds=1000, until=FOREVER, progress=False, **more)


def scenario() -> None:
    text = plan("Sleeps(seconds = 0.002)").text + '\nscenario "is long" for P {\n expect end by OK before 900 s\n until 1000 s\n}\n'
    afp.Plan(text, toolboxes=[tools]).scenarios[0].run()


def pictures() -> None:
    loaded = afp.load("../plans/wall_following.afp")
    while True:
        loaded.svg()


def vector() -> None:
    import afp.gym

    envs = afp.gym.CarbotVectorEnv(4)
    envs.reset(seed=1)
    while True:
        envs.step(envs.action_space.sample())


def slow(*_: Any) -> None:
    time.sleep(0.002)


def listened() -> None:
    afp.sweep(afp.load("../plans/wall_following.afp"), seeds=10000, until=0.5, progress=False, on_run=slow)


def measured() -> None:
    afp.sweep(
        afp.load("../plans/wall_following.afp"), seeds=10000, until=0.5, progress=False, metrics={"slow": slow}
    )


WORK: dict[str, Callable[[], Any]] = {
    "native": native,
    "sleeping": run("Sleeps(seconds = 0.002)"),
    "sleeping-long": run("Sleeps(seconds = 0.3)"),
    "sleeping-longer": run("Sleeps(seconds = 30)"),
    "computing": run("Computes"),
    "awaiting": run("Awaits"),
    "nested": run("Nests"),
    "steps": steps,
    "sweep": sweep("Sleeps(seconds = 0.002)"),
    "sweep-long": sweep("Sleeps(seconds = 0.3)"),
    "scenario": scenario,
    "pictures": pictures,
    "vector": vector,
    "listened": listened,
    "measured": measured,
}
"""Work that would last for minutes."""


def raising(number: int, _: Any) -> None:
    raise SystemExit(3)


def interrupted(work: Callable[[], Any], number: int, after: float) -> None:
    """Work in the main thread until a signal."""
    try:
        threading.Timer(after, os.kill, (os.getpid(), number)).start()
        work()
    finally:
        leave()


def last() -> None:
    """The program's own exit handler, which still runs a plan."""
    loaded = afp.Plan("use std\nplan P { start a actor a: Wait { Elapsed -> terminate } }")
    print(afp.Simulation(loaded).run().ending, flush=True)


def daemon(work: Callable[[], Any], after: float) -> None:
    threading.Thread(target=work, daemon=True).start()
    time.sleep(after)


def leave() -> None:
    print("leaving", time.monotonic(), flush=True)


def main(name: str, after: float) -> None:
    kind, _, work = name.partition(":")
    if kind == "daemon":
        daemon(WORK[work], after)
        leave()
    elif kind == "raise":
        daemon(WORK[work], after)
        leave()
        raise SystemExit(7)
    elif kind == "handler":
        atexit.register(last)
        daemon(WORK[work], after)
        leave()
    elif kind == "sigint":
        interrupted(WORK[work], signal.SIGINT, after)
    elif kind == "sigterm":
        signal.signal(signal.SIGTERM, raising)
        interrupted(WORK[work], signal.SIGTERM, after)
    else:
        raise SystemExit(f"no kind {kind}")


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]))
