"""Programs end in the middle of something: no abort, no hang, their own exit code.

AFP_EXITS is the number of exits of each Python; the nightly run sets 1000. Then an exit may last at
most a second longer than the program.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

EXITS = Path(__file__).parent / "exits"
CODES = {"daemon": 0, "handler": 0, "raise": 7, "sigint": -signal.SIGINT, "sigterm": 3}
THREADS = [
    "native", "sleeping", "sleeping-long", "sleeping-longer", "computing", "awaiting", "nested", "steps",
    "sweep", "sweep-long", "scenario", "pictures", "vector", "listened", "measured",
]  # fmt: skip
CASES = [
    *(f"daemon:{work}" for work in THREADS),
    *(f"{kind}:{work}" for kind in ("raise", "handler") for work in ("native", "sleeping", "sweep")),
    *(f"{kind}:{work}" for kind in ("sigint", "sigterm") for work in ("native", "sleeping", "awaiting", "nested", "steps")),
    *(f"{kind}:{work}" for kind in ("sigint", "sigterm") for work in ("sweep", "sweep-long", "scenario", "measured")),
]

COUNT = int(os.environ.get("AFP_EXITS", "0"))
LONG = 1.0 if COUNT else 20.0
"""Seconds after which an exit hangs; a busy machine may take long."""


def leaves(case: str, after: float) -> tuple[str | None, float]:
    """The failure of an exit, if there is one, and its duration in seconds."""
    command = [sys.executable, str(EXITS), case, str(after)]
    with subprocess.Popen(command, cwd=EXITS.parents[1], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        try:
            out, err = child.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            child.kill()
            return f"{case} after {after:.3f} s: no end\n{child.communicate()[1]}", 120.0
    now = time.monotonic()
    said = out.split()
    if "leaving" not in said:
        return f"{case} after {after:.3f} s: it did not get there, code {child.returncode}\n{out}{err}", 0.0
    took = now - float(said[said.index("leaving") + 1])
    wrong = child.returncode != CODES[case.partition(":")[0]] or "Fatal" in err or "panicked" in err
    wrong |= case.startswith("handler") and said[-1] != "ok"
    return (f"{case} after {after:.3f} s: code {child.returncode}\n{out}{err}" if wrong else None), took


@pytest.mark.skipif(sys.platform == "win32", reason="it sends signals")
@pytest.mark.parametrize("case", CASES if not COUNT else [])
def test_a_program_may_exit_during_a_run(case: str) -> None:
    failure, took = leaves(case, 0.3)
    assert failure is None, failure
    assert took < LONG


@pytest.mark.parametrize("name", ["sweep", "Simulation", "Plan"])
def test_a_run_begins_without_imports(name: str) -> None:
    """An import can lose the exception of a signal handler."""
    work = {
        "sweep": "afp.sweep(plan, seeds=2, until=0.1, progress=False, metrics={'t': lambda result: result.time})",
        "Simulation": "afp.Simulation(plan).run(until=0.1).path",
        "Plan": "afp.load('plans/wall_following.afp').svg()",
    }
    code = f"import sys, afp\nplan = afp.load('plans/wall_following.afp')\nknown = set(sys.modules)\n{work[name]}\nprint(set(sys.modules) - known)"
    ran = subprocess.run([sys.executable, "-c", code], cwd=EXITS.parents[2], capture_output=True, text=True, check=True)
    assert ran.stdout == "set()\n"


@pytest.mark.skipif(not COUNT, reason="AFP_EXITS is not set")
def test_many_programs_may_exit_during_a_run() -> None:
    rng = random.Random(7)
    cases = [(CASES[number % len(CASES)], rng.uniform(0.0, 0.4)) for number in range(COUNT)]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        ends = list(pool.map(lambda case: leaves(*case), cases))
    slowest = sorted(zip((took for _, took in ends), cases, strict=True), reverse=True)[:5]
    print(f"{COUNT} exits, the slowest: {slowest}")
    failures = [failure for failure, _ in ends if failure is not None]
    assert not failures, f"{len(failures)} of {COUNT}\n" + "\n".join(failures[:20])
    assert slowest[0][0] < LONG, slowest
