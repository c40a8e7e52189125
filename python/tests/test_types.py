"""The types from the point of view of a user's program."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import afp
from conftest import ROOT

pytest.importorskip("mypy")
pytest.importorskip("gymnasium")

NOTEBOOKS = sorted((ROOT / "python/notebooks").glob("*.ipynb"))

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
faults = [afp.Fault("wheels", "slip", share=0.5)]
env = afp.gym.CarbotEnv(hall.build(), task=afp.gym.REACH_GOAL, reward={"nearer": 1.0}, faults=faults)
envs = afp.gym.CarbotVectorEnv(4, faults=lambda rng: [afp.Fault("wheels", "slip")])
seen, infos = envs.reset(seed=[1, 2, None, 4])
mean: float = afp.gym.evaluate(lambda seen: seen[:, :2], "Roam", range(3), world=hall.build()).mean

afp.use("project")
known: list[tuple[str, str]] = afp.faults()
version: str = afp.__version__
table: afp.Runs = runs.filter(lambda row: row["seed"] == 1)
picture: afp.Picture = simulation.picture()
picture = simulation.result().picture()
log: afp.Log = afp.Log("a.mcap")
moment: afp.Snapshot = log.simulation(at=afp.ms(300)).save()
simulation.restore(moment)
watched: afp.Result = simulation.clone().watch(until=afp.minutes(1), speed=2.0)
again: afp.Simulation = runs.simulation(0, log="b.mcap", camera=True)
collisions: list[afp.Collision] = watched.collisions
errors: list[afp.ComponentError] = watched.errors
said: list[afp.Diagnostic] = plan.diagnostics
scenario: afp.Scenario = plan.scenarios[0]
came: afp.Verdict = scenario.run(log="c.mcap")
line: str = came.command
runs_on: bool = simulation.step()
broken: list[afp.Broken] = came.broken
quantities: list[afp.Quantity] = [afp.m(1), afp.mm(1), afp.s(1), afp.rad(1), afp.kmh(1), afp.rad_per_s(1), afp.deg_per_s(1)]
far: afp.Quantity = afp.m(2) * 2 + afp.cm(3)
carbot = afp.Carbot(afp.World.load("hall.toml"), 3)
carbot.drive(0.2, 0.0, 1.0)
square: afp.Plan = afp.new_plan("Square", use=["carbot"])
square.bind("ahead", "distance", far)
try:
    square.check()
except afp.PlanError as error:
    print(error.diagnostics[0].fix)
except afp.AfpError as error:
    print(error)
toolbox = afp.Toolbox("more", version="1.0")
ending: afp.Ending = result.ending
elements: list[afp.Element] = plan.elements
entries: list[afp.Entry] = plan.entries
edges: list[afp.Edge] = plan.edges
hit = afp.sweep(plan, seeds=3, vary={afp.Press("touch"): [1.0, 2.0]}, draw={"walldist": lambda rng: rng.uniform(0.2, 0.4)})
success: afp.Estimate = hit.share(ending="ok")
simulation.press(afp.Press(at=1.0))
simulation.fail(afp.Fault("wheels", "slip", share=0.3))


@toolbox.actor(states={"There": {"went": afp.Length}}, uses=["navigator"])
async def Creep(robot: afp.Robot, far: afp.Length, speed: afp.Speed = afp.m_per_s(0.1)) -> tuple[str, dict[str, float]]:
    while robot.odometry[0] < far:
        robot.drive(speed, 0.0)
        await afp.tick()
    return "There", {"went": robot.odometry[0]}


@toolbox.supervisor(events=["Turned"], every=afp.ms(20))
def CheckTurned(robot: afp.Robot, angle: afp.Angle, rate: afp.AngularSpeed, time: afp.Duration) -> str | None:
    return "Turned" if robot.odometry[2] > angle + rate * time else None
"""


def test_the_program_uses_every_name_of_the_package() -> None:
    unused = [name for name in afp.__all__ if not re.search(rf"\bafp\.{name}\b", PROGRAM)]
    assert not unused


def test_a_program_passes_strict_type_checks(tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(program)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert checked.returncode == 0, checked.stdout


def code_of(notebook: Path) -> str:
    """The code of a notebook as a program."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code") + "\n"


@pytest.fixture
def notebooks(tmp_path: Path) -> list[str]:
    """Programs with the code of the notebooks."""
    programs = [tmp_path / f"{notebook.stem}.py" for notebook in NOTEBOOKS]
    for notebook, program in zip(NOTEBOOKS, programs, strict=True):
        program.write_text(code_of(notebook), encoding="utf-8")
    return [str(program) for program in programs]


def test_the_code_of_notebooks_is_clean_in_strict_mode(notebooks: list[str], tmp_path: Path) -> None:
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), *notebooks]
    checked = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert checked.returncode == 0, checked.stdout


@pytest.mark.skipif(not os.environ.get("AFP_PYRIGHT"), reason="AFP_PYRIGHT is not set; pyright loads Node.js packages")
def test_pyright_finds_no_error(notebooks: list[str], tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM)
    command = [sys.executable, "-m", "pyright", "--level", "error", "--pythonpath", sys.executable, *notebooks, str(tmp_path / "program.py")]
    checked = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert checked.returncode == 0, checked.stdout
