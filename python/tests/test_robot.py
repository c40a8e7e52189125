"""A project's robot: chosen first, built and cached, and driven like the Carbot."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import afp
from conftest import ROOT

VACUUM = ROOT / "examples/vacuum"

DRIVE = """
import json, pickle, tempfile, afp
afp.use("VACUUM")
afp.use("VACUUM")
plan = afp.load("plans/clean.afp")
plan.check()
sim = afp.Simulation(plan, seed=3, set={"time": 60.0})
sim.fail(afp.Fault("wheels", "slip", share=0.9, at=5.0, lasting=1.0))
sim.press(afp.Press("bumper.left", at=8.0))
result = sim.run(until=70.0)
found = {
    "time": result.time, "ending": result.ending,
    "cleaned": sim.sense("robot.cleaned"), "pose": sim.pose, "left": sim.sense("bumper.left"),
    "faults": afp.faults(), "world": sim.world.name, "path": len(sim.path),
}
again = afp.Simulation(plan, seed=3, set={"time": 60.0})
again.fail(afp.Fault("wheels", "slip", share=0.9, at=5.0, lasting=1.0))
again.press(afp.Press("bumper.left", at=8.0))
found["again"] = again.run(until=70.0).trace_hash == result.trace_hash
log = tempfile.mkdtemp() + "/run.mcap"
with afp.Simulation(plan, seed=3, log=log) as logged:
    trace = logged.run(until=10.0).trace_hash
found["from_log"] = afp.Log(log).simulation().run(until=10.0).trace_hash == trace
halted = afp.Simulation(plan)
halted.press(afp.Press(at=1.0))
found["halted"] = halted.run(until=10.0).time
found["scenarios"] = {each.name: each.run().passed for each in afp.load("plans/tests/clean.afp").scenarios}
runs = afp.sweep(plan, worlds=["random:0", "random:1"], seeds=2, until=10.0, progress=False)
found["runs"] = len(runs)
found["pickled"] = pickle.loads(pickle.dumps(plan)).ok

tools = afp.Toolbox("tools")
seen = []

@tools.actor(states=["Done"])
async def Look(robot: afp.Robot):
    await afp.tick()
    seen.append((robot.time, robot.sense("cliff.drop"), robot.sense("dirt.level")))
    for wrong in ("robot.pose", "distance", "bumper.middle"):
        try:
            robot.sense(wrong)
        except (KeyError, ValueError) as error:
            seen.append(error.args[0])
    return "Done"

mixed = afp.Plan("use vacuum\\nuse tools\\nplan P { start look actor look: Look { Done -> begin } "
    "actor begin: Suction(on = true) { Set -> terminate } }", "plans/mixed.afp", toolboxes=[tools])
found["mixed"] = afp.Simulation(mixed).run(until=1.0).check().ending
found["seen"] = seen
try:
    afp.Carbot
except AttributeError as error:
    found["carbot"] = str(error)
print(json.dumps(found))
"""


built = pytest.mark.skipif(
    "AFP_ROBOT" not in os.environ, reason="it builds for a minute: 'cargo xtask gate \"python robot\"' does"
)


def python(text: str, folder: Path = VACUUM, **variables: str) -> subprocess.CompletedProcess[str]:
    """A new process, since each has one robot."""
    text = text.replace("VACUUM", str(VACUUM))
    environment = {name: value for name, value in os.environ.items() if name != "AFP_PROJECT"}
    return subprocess.run(
        [sys.executable, "-c", text], cwd=folder, env={**environment, **variables}, capture_output=True, text=True
    )


@built
def test_a_project_has_its_robot() -> None:
    run = python(DRIVE)
    assert run.returncode == 0, run.stderr
    found = json.loads(run.stdout)
    assert found["ending"] == "ok" and 60.0 <= found["time"] < 61.0
    assert 0.0 < found["cleaned"] < 1.0 and found["left"] is False and found["path"] > 2900
    assert ["wheels", "slip"] in found["faults"] and ["ultrasonic", "frozen"] not in found["faults"]
    assert found["again"] and found["halted"] < 1.2
    assert found["from_log"], "the log carries the linked toolbox, and needs no other"
    assert found["scenarios"] and all(found["scenarios"].values()), found["scenarios"]
    assert found["runs"] == 4 and found["pickled"] and found["mixed"] == "ok"
    (time, drop, level), truth, other, middle = found["seen"]
    assert 0 < time < 0.1 and drop is False and level >= 0.0
    assert "which components cannot read" in truth
    assert "the robot has no 'distance'; its sensors are: " in other and "cliff.drop" in other
    assert "robot.pose" not in middle and "bumper.left" in middle
    assert found["carbot"] == "'afp.Carbot' is for the Carbot, and this process has another robot"


@built
def test_the_variable_selects_the_robot_and_later_processes_reuse_the_build() -> None:
    run = python("import afp; print(afp.faults()[0], afp._afp.own_robot)", AFP_PROJECT=str(VACUUM), CARGO="/nowhere")
    assert run.stdout.split() == ["('wheels',", "'blocked')", "vacuum::Vacuum"], run.stderr
    assert run.stderr == ""


def test_without_cargo_the_error_explains_it(tmp_path: Path) -> None:
    nowhere = {"CARGO": str(tmp_path / "cargo"), "CARGO_TARGET_DIR": str(tmp_path)}
    run = python("import afp; afp.use('VACUUM')", **nowhere)
    assert run.returncode == 1
    assert "the plan needs the robot 'vacuum::Vacuum' with the toolbox 'vacuum'" in run.stderr
    assert "is not installed" in run.stderr and "install Rust from https://rustup.rs" in run.stderr


def test_a_robot_is_selected_once_and_first() -> None:
    for text, said in [
        ("afp.World; afp.use('VACUUM')", "this process has the Carbot already: call afp.use() before anything else"),
        ("afp.use('VACUUM/afp.toml')", "does not exist"),
        ("afp.use('..'); afp.World; afp.use('..'); afp.use('VACUUM')", "already: call afp.use() before anything else"),
    ]:
        run = python(f"import afp; {text}")
        assert run.returncode == 1 and said in run.stderr, run.stderr


def test_a_plan_for_another_robot_is_refused() -> None:
    plan = afp.load(VACUUM / "plans/clean.afp")
    scenarios = afp.load(VACUUM / "plans/tests/clean.afp").scenarios
    assert plan.ok and scenarios
    tries = [
        lambda: afp.Simulation(plan),
        lambda: afp.Simulation(plan, afp.World.random(1)),
        lambda: scenarios[0].run(),
        lambda: afp.sweep(plan, progress=False),
    ]
    for drive in tries:
        with pytest.raises(afp.AfpError, match="the plan is for 'vacuum::Vacuum', and this process has the Carbot") as error:
            drive()
        assert "call afp.use(" in str(error.value)


def test_all_names_of_the_package_exist() -> None:
    assert set(afp.__all__) <= set(dir(afp))
    assert all(getattr(afp, name) is not None for name in afp.__all__)
    with pytest.raises(AttributeError, match="has no attribute 'Carbott'"):
        afp.Carbott
    assert afp.plots.__name__ == "afp.plots"
