"""`python tests/stress [--seconds 600] [--seed 0]`: looks for what breaks the package, and stops at the first thing.

Without seconds it does a fixed number of examples, the same each time. The last steps are kept in the file that
`--steps` names, so that even a crash can be told.
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
    """With somebody who notices when nothing happens any more."""

    def note(self, text: str, anew: bool = False) -> None:
        faulthandler.dump_traceback_later(STUCK, exit=True)
        super().note(text, anew)


def ring(*_: object) -> None:
    """Interrupts a call, as Ctrl-C does."""
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
    # What callbacks raise where nobody can catch it, such as in __del__, is told to nobody.
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
