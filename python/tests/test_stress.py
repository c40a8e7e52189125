"""Searches for failures of the package in separate processes: even a crash is reported with its
last steps.

AFP_STRESS is the number of seconds (the nightly run sets 600), AFP_SIMULATIONS the number of
simulations after which the memory must be flat (10000). The default is a short search that is
always the same.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

STRESS = Path(__file__).parent / "stress"
GROWTH = 2.0
"""Megabytes that half of many simulations may leave behind."""


@pytest.mark.skipif(sys.platform == "win32", reason="it interrupts calls by SIGALRM, and forks")
def test_only_documented_exceptions_are_raised(tmp_path: Path) -> None:
    steps = tmp_path / "steps.txt"
    command = [sys.executable, str(STRESS), "--seconds", os.environ.get("AFP_STRESS", "0"), "--steps", str(steps)]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    print(done.stdout)
    last = "\n".join(steps.read_text(encoding="ascii").splitlines()[-60:])
    assert done.returncode == 0, f"status {done.returncode}\n{done.stderr[-6000:]}\nthe last steps:\n{last}"
    assert "panicked at" not in done.stderr, done.stderr[-6000:]


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is read from /proc")
def test_simulations_leave_no_files_or_threads() -> None:
    count = os.environ.get("AFP_SIMULATIONS", "300")
    command = [sys.executable, str(STRESS / "memory.py"), count]
    grown = float(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)
    print(f"{count} simulations, {grown} MB")
    assert grown < GROWTH
