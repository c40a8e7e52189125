"""`python tests/stress [--seconds 600] [--seed 0]`: searches for failures of the package, and stops
at the first.

Without seconds it runs a fixed number of examples, always the same. The last steps are kept in the
file named by `--steps`, so that they are known even after a crash.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import shutil
import signal
import sys
import tempfile
import time
import warnings
from pathlib import Path

from hypothesis import HealthCheck, Phase, seed, settings
from hypothesis.stateful import run_state_machine_as_test

from machine import ROOT, Stress, TooLong

EXAMPLES = 20
"""For one seed."""
STUCK = 60.0
"""Seconds without progress after which all threads are shown and the process ends."""


class Watched(Stress):
    """A context with a watchdog for hanging calls."""

    def note(self, text: str, anew: bool = False) -> None:
        faulthandler.dump_traceback_later(STUCK, exit=True)
        super().note(text, anew)


def ring(*_: object) -> None:
    """Interrupt a call, like Ctrl-C."""
    raise TooLong


def main() -> int:
    """Runs the machine."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--as-found", action="store_true", help="do not look for a shorter example")
    parser.add_argument("--steps", default="stress-steps.txt")
    options = parser.parse_args()
    faulthandler.enable()
    warnings.simplefilter("ignore")
    signal.signal(signal.SIGALRM, ring)
    steps = Path(options.steps).resolve()
    folder = tempfile.mkdtemp(prefix="afp-stress-")
    shutil.copytree(ROOT / "worlds", Path(folder) / "worlds")
    os.chdir(folder)
    setting = settings(
        max_examples=EXAMPLES,
        stateful_step_count=20,
        deadline=None,
        database=None,
        suppress_health_check=list(HealthCheck),
        print_blob=False,
        phases=[Phase.generate] if options.as_found else [Phase.generate, Phase.shrink],
    )
    # Exceptions that cannot be caught, such as in __del__, are ignored.
    sys.unraisablehook = lambda *_: None
    begin, number = time.monotonic(), options.seed
    try:
        with open(steps, "w", encoding="ascii") as Watched.steps:
            while True:
                run_state_machine_as_test(seed(number)(Watched), settings=setting)
                number += 1
                if time.monotonic() - begin >= options.seconds:
                    break
    finally:
        faulthandler.cancel_dump_traceback_later()
        shutil.rmtree(folder, ignore_errors=True)
        took = time.monotonic() - begin
        print(f"seeds {options.seed} to {number}, {EXAMPLES} examples each, {took:.0f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
