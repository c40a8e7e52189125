"""The types as a program of a user sees them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy")
pytest.importorskip("gymnasium")

PROGRAM = """
import afp
import afp.gym
import numpy as np
from numpy.typing import NDArray

plan = afp.load("plan.afp")
runs = afp.sweep(plan, seeds=[1, 5], vary={"walldist": [afp.cm(30)]}, worlds=[afp.World.random(1)], until=5.0)
for row in runs:
    print(row["ending"], runs[:2].where(ending="ok").columns)
hall = afp.WorldBuilder("h", start=(1.0, 1.0, afp.deg(3))).room(4.0, 4.0)
hall = hall.mover("w", (2.0, 2.0), size=(0.3, 0.3), height=1.0, by=[(1.0, 0.0)], speed=afp.m_per_s(0.3))
simulation = afp.Simulation(plan, hall.build(), set={"walldist": "30cm"}, log="a.mcap", camera=True)
time: float = simulation.time
result = simulation.run(until=2.0)
events: list[afp.Event] = result.events
path: NDArray[np.float64] = result.path
afp.Log("a.mcap").film().save("film.svg")
plan.coverage("a.mcap").save("plan.svg")
tools: tuple[afp.Toolbox, ...] = (afp.Toolbox("tools"),)
afp.Plan("", toolboxes=tools)
verdict = plan.scenarios[0].run()
whys: list[str] = [broken.why for broken in verdict.broken]
faults = [("wheels", "slip", {"share": 0.5})]
env = afp.gym.CarbotEnv(hall.build(), task=afp.gym.REACH_GOAL, reward={"nearer": 1.0}, faults=faults)
envs = afp.gym.CarbotVectorEnv(4, faults=lambda rng: [("wheels", "slip")])
seen, infos = envs.reset(seed=[1, 2, None, 4])
mean: float = afp.gym.evaluate(lambda seen: seen[:, :2], "Roam", range(3), world=hall.build()).mean
"""


def test_a_program_is_clean_in_strict_mode(tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(program)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert checked.returncode == 0, checked.stdout
