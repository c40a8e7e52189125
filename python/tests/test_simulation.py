"""Simulations: equality with afpc, stimuli, entries, sensors, threads, Ctrl-C."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import afp
from conftest import PLANS, ROOT, interrupted

UNTIL = 15.0


def hash_of(afpc: str, plan: Path, seed: int) -> str:
    options = ["--seed", str(seed), "--until", f"{UNTIL}s", "--json", "--log", "none", "--svg", "none"]
    told = subprocess.run([afpc, "run", str(plan), *options], capture_output=True, text=True, check=True, cwd=ROOT)
    return str(json.loads(told.stdout.splitlines()[-1])["summary"]["trace"])


@pytest.mark.parametrize("plan", PLANS, ids=lambda plan: plan.stem)
def test_the_trace_equals_the_trace_of_afpc(afpc: str, plan: Path) -> None:
    loaded = afp.load(plan)
    with ThreadPoolExecutor(2) as pool:
        theirs = list(pool.map(lambda seed: hash_of(afpc, plan, seed), range(20)))
    for seed, told in enumerate(theirs):
        assert afp.Simulation(loaded, seed=seed).run(until=UNTIL).trace_hash == told, f"seed {seed}"


def test_a_run_in_pieces_equals_the_whole_run(wall_following: afp.Plan) -> None:
    whole = afp.Simulation(wall_following, seed=3).run(until=8.0)
    stepped = afp.Simulation(wall_following, seed=3)
    while stepped.time < 2.0:
        assert stepped.step()
    assert stepped.run_to(4.0) and stepped.time == 4.0
    heard = list(stepped.stream(until=6.0))
    assert heard and all(4.0 <= event.time <= 6.0 for event in heard)
    assert stepped.run(until=8.0).trace_hash == whole.trace_hash
    assert [str(event) for event in whole.events] == [str(event) for event in stepped.events]


def test_a_result_has_all_fields(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following, seed=7)
    result = simulation.run(until=10.0)
    assert (result.plan, result.seed, result.ending, result.stopped_by) == ("WallFollowing", 7, "time_limit", "until")
    assert result.ok and result.check() is result and result.time == 10.0
    assert result.path.shape == (501, 4) and result.path.dtype == np.float64
    assert 0.5 < result.distance < 5.0 and result.timeline
    assert result.entries["walldist"] == 0.3
    table = result.columns
    assert {len(column) for column in table.values()} == {len(result.events)}
    assert "WallFollowing" in result._repr_html_() and "time_limit" in repr(result)
    del simulation
    assert result.path[-1, 0] == 10.0


def test_an_event_has_the_active_element_and_its_reaction() -> None:
    plan = afp.Plan("""use carbot
plan Keys {
    start wait
    supervise keys: CheckEscapeButtonClick { EscapeButtonClicked -> terminate }
    actor wait: Hold { on keys { EscapeButtonClicked -> drive } }
    actor drive: Forward { ForwardSuccessful -> drive }
}
""")
    simulation = afp.Simulation(plan)
    simulation.fire("keys", "EscapeButtonClicked", at=1.0)
    simulation.fire("keys", "EscapeButtonClicked", at=2.0)
    events = [event for event in simulation.run(until=3.0).events if event.kind == "event"]
    answers = [(event.target, event.element, event.on) for event in events]
    assert answers == [("drive", "wait", True), ("terminate", "drive", False)]


def test_stimuli(wall_following: afp.Plan) -> None:
    pressed = afp.Simulation(wall_following)
    pressed.press(afp.Press(at=1.0))
    result = pressed.run(until=5.0)
    assert result.ending == "interrupted" and result.stopped_by is None and 1.0 <= result.time < 1.1
    bumped = afp.Simulation(wall_following)
    bumped.bump(at=0.5)
    assert any(e.component.endswith("touch") and e.kind == "event" for e in bumped.stream(until=1.0))
    fired = afp.Simulation(wall_following)
    fired.fire("searchFirstWall.checkLane", "LaneNotFree", at=0.25)
    fired.run_to(0.3)
    assert fired.active == "findWallAngle"
    frozen = afp.Simulation(wall_following)
    frozen.fail(afp.Fault("ultrasonic", "lost", at=0.2))
    assert frozen.run(until=5.0).fault is not None


def test_external_inputs_are_in_the_events_and_the_timeline(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    simulation.set("walldist", afp.cm(40), at=0.2)
    simulation.fail(afp.Fault("ultrasonic", "frozen", at=0.5, lasting=1.0))
    simulation.bump(at=0.6, hold=0.1)
    requests = ["set walldist = 0.4 m", "fail ultrasonic.frozen for 1 s", "press touch.touch for 0.1 s", "release touch.touch"]
    streamed = [event.request for event in simulation.stream(until=1.0) if event.kind == "requested"]
    result = simulation.result()
    assert streamed == [event.request for event in result.events if event.request] == requests
    assert "     0.600  ● press touch.touch for 0.1 s  from outside" in result.timeline
    assert [str(event) for event in result.events if event.kind == "requested"][2] == result.timeline[-4]


def test_the_timeline_equals_the_timeline_of_the_command_line(wall_following: afp.Plan, afpc: str) -> None:
    simulation = afp.Simulation(wall_following)
    simulation.fail(afp.Fault("ultrasonic", "frozen", at=0.5, lasting=1.0))
    simulation.press(afp.Press(at=1.0))
    options = ["--fail", "ultrasonic.frozen@0.5s..1.5s", "--press", "escape@1s", "--until", "3s", "--svg", "none"]
    ran = subprocess.run([afpc, "run", str(wall_following.path), *options], capture_output=True, text=True)
    assert all(line in ran.stdout + ran.stderr for line in simulation.run(until=3.0).timeline)


def test_world_values_and_the_start_match_the_command_line(wall_following: afp.Plan, tmp_path: Path) -> None:
    log, start = tmp_path / "run.mcap", (1.0, 1.2, afp.deg(90))
    given = {"world.robot.charge": 0.5, "walldist": afp.cm(35)}
    with afp.Simulation(wall_following, "random:1", start=start, set=given, log=log) as simulation:
        result = simulation.run(until=1.0)
    world, facts = simulation.world, afp.Log(log).facts
    assert world.path is None and world.start == start and "charge = 0.5" in world.text and result.entries["walldist"] == 0.35
    assert world != afp.World.random(1) and pickle.loads(pickle.dumps(world)) == world
    assert [facts["set.0"], facts["set.1"]] == ["world.robot.charge=0.5", "walldist=0.35 m"]
    assert len(facts["plan_hash"]) == len(facts["world_hash"]) == 16
    assert afp.Log(log).simulation().run(until=1.0).trace_hash == result.trace_hash
    with pytest.raises(afp.AfpError, match="has no 'nope'"):
        afp.Simulation(wall_following, set={"world.robot.nope": 3})


def test_entries_are_in_a_simulation(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    assert "walldist" in simulation and "nothing" not in simulation and simulation.time == 0.0


def test_a_closed_simulation_accepts_no_requests(wall_following: afp.Plan, tmp_path: Path) -> None:
    simulation = afp.Simulation(wall_following, log=tmp_path / "run.mcap")
    simulation.run_to(1.0)
    simulation.close()
    asks: list[Callable[[], object]] = [
        *(lambda: simulation.set("walldist", 0.4), lambda: simulation.__setitem__("walldist", 0.4), simulation.press),
        *(simulation.bump, simulation.idle, lambda: simulation.fail(afp.Fault("ultrasonic", "frozen"))),
        *(lambda: simulation.fire("escape", "EscapeButtonPressed"), simulation.step),
    ]
    for ask in asks:
        with pytest.raises(RuntimeError, match="closed with its log"):
            ask()


def test_invalid_stimuli_are_refused(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    with pytest.raises(ValueError, match="it can be frozen, lost"):
        simulation.fail(afp.Fault("ultrasonic", "melted"))
    with pytest.raises(ValueError, match="unknown device 'hat'; there are"):
        simulation.fail(afp.Fault("hat", "lost"))
    with pytest.raises(ValueError, match="no actor or supervisor 'nobody'"):
        simulation.fire("nobody", "Done")
    with pytest.raises(ValueError, match="no control 'enter'; it has 'touch', 'escape'"):
        simulation.press(afp.Press("enter"))
    with pytest.raises(ValueError, match="not a time"):
        simulation.press(afp.Press(at=float("nan")))
    with pytest.raises(TypeError, match="needs a Plan, not a str"):
        afp.Simulation("wall.afp")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="-1 is not a seed"):
        afp.Simulation(wall_following, seed=-1)
    with pytest.raises(TypeError, match="cannot be pickled"):
        pickle.dumps(simulation)
    simulation.fire("followWall.wallTouch", "TouchSensorPressed", at=0.1)
    with pytest.raises(afp.AfpError, match="at 0.1 s: 'followWall.wallTouch' is not active"):
        simulation.run(until=1.0)
    assert simulation.run(until=1.0).time == 1.0
    with pytest.raises(RuntimeError, match="has ended"):
        simulation.set("walldist", 0.4, at=0.5)


def test_idle_actors_do_nothing(wall_following: afp.Plan) -> None:
    idle = afp.Simulation(wall_following)
    idle.idle()
    assert idle.run_to(2.0) and idle.active == "searchFirstWall" and idle.pose[:2] == pytest.approx((2.1, 1.95))
    later = afp.Simulation(wall_following, seed=7)
    later.idle("backupCollision", at=1.0)
    later.press(afp.Press("touch", at=1.5))
    assert later.run_to(10.0) and later.active == "backupCollision"
    with pytest.raises(ValueError, match="no actor or sub-plan 'searchFirstWall.touch'"):
        later.idle("searchFirstWall.touch")


def test_a_fired_outcome_has_its_outputs(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    simulation.step()
    simulation.fire("searchFirstWall.checkLane", "LaneNotFree")
    simulation.run_to(0.2)
    assert simulation.active == "findWallAngle"
    with pytest.raises(ValueError, match=r'also has the output .angle., which has no value here: give outputs={"angle": ...}'):
        simulation.fire("findWallAngle", "WallFound")
    with pytest.raises(ValueError, match="has no connected output 'size'"):
        simulation.fire("findWallAngle", "WallFound", {"angle": 0.1, "size": 3})
    with pytest.raises(TypeError, match="not a quantity in m"):
        simulation.fire("findWallAngle", "WallFound", {"angle": afp.cm(3)})
    simulation.fire("findWallAngle", "WallFound", {"angle": afp.deg(10)})
    simulation.run_to(0.4)
    assert simulation["wallangle"] == pytest.approx(0.17453, abs=1e-4) and simulation.active != "findWallAngle"


def test_entries(wall_following: afp.Plan) -> None:
    for given in (afp.cm(40), 0.4, "40 cm"):
        assert afp.Simulation(wall_following, set={"walldist": given})["walldist"] == pytest.approx(0.4)
    simulation = afp.Simulation(wall_following)
    simulation["walldist"] = afp.cm(45)
    simulation.run_to(0.5)
    assert simulation["walldist"] == 0.45 and simulation["wallangle"] is None
    simulation["walldist"] = 0.5
    simulation.step()
    assert simulation.entries == {"walldist": 0.5, "wallangle": None}
    with pytest.raises(TypeError, match="'walldist' is a length in m, not a quantity in rad"):
        simulation["walldist"] = afp.deg(30)
    with pytest.raises(TypeError, match="not a list"):
        simulation["walldist"] = [1]
    with pytest.raises(KeyError, match="there are: walldist, wallangle"):
        simulation["walldits"]
    with pytest.raises(TypeError, match="not \"40\""):
        afp.Simulation(wall_following, set={"walldist": "40"})


def test_sensors_outlive_the_simulation(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following, seed=1)
    assert simulation.sense("distance") is None
    simulation.run_to(1.0)
    camera, odometry = simulation.camera, simulation.sense("odometry")
    distance = simulation.sense("distance")
    del simulation
    assert camera is not None and camera.dtype == np.uint8 and camera.ndim == 3 and camera.shape[2] == 3
    assert camera.flags.owndata or camera.base is not None
    assert camera.max() > 0 and odometry.shape == (5,) and odometry[0] > 0.1 and distance > 0.0
    with pytest.raises(KeyError, match="its sensors are: distance"):
        afp.Simulation(wall_following).sense("smell")


def test_a_missing_input_is_named() -> None:
    plan = afp.Plan(
        "use carbot\nplan P { in far: length start go "
        "actor go: Forward(distance = far) { ForwardSuccessful -> terminate } }"
    )
    with pytest.raises(afp.AfpError, match="'far' has neither a value nor a default"):
        afp.Simulation(plan).run(until=1.0)


def test_worlds() -> None:
    world = afp.World.random(7)
    assert world.path is not None and "random:7" in str(world.path)
    assert len(world.outlines()) == len(world.obstacles) and world.outlines()[0].shape[1] == 2
    assert afp.World.parse(world.text).name == world.name
    with pytest.raises(afp.AfpError, match="1:1|1:"):
        afp.World.parse("nonsense = 1")
    named = afp.World.load(ROOT / "worlds/wall_following.toml")
    assert named.name == "Furnished room" and named.start == (2.1, 1.95, 0.0)


def test_the_interpreter_lock_is_free_while_a_plan_runs(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    counted = 0
    runner = threading.Thread(target=lambda: simulation.run(until=120.0))
    runner.start()
    busy = 0
    while runner.is_alive():
        counted += 1
        try:
            _ = simulation.entries
        except RuntimeError as error:
            assert "is running" in str(error)
            busy += 1
    assert counted > 100 and busy > 0


def test_a_run_can_be_stopped_from_another_thread(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    threading.Timer(0.2, simulation.request_stop).start()
    result = simulation.run(until=1e6)
    assert (result.ending, result.stopped_by) == ("interrupted", "stop")


def test_ctrl_c_interrupts_a_long_run(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    # The benchmark's limit is 100 ms; a busy machine gets more here.
    assert interrupted(lambda: simulation.run(until=1e6)) < 1.0
    assert simulation.ending == "running"
    assert simulation.run(until=simulation.time + 0.5).ending == "time_limit"


@pytest.mark.skipif(sys.platform == "win32", reason="there is no fork")
def test_a_forked_process_is_refused(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    child = os.fork()
    if child == 0:
        try:
            simulation.step()
        except RuntimeError as error:
            os._exit(0 if "forked" in str(error) else 1)
        os._exit(2)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


@pytest.mark.skipif(sys.platform == "win32", reason="there is no fork")
def test_a_forked_process_does_not_change_the_log(tmp_path: Path) -> None:
    code = f"""
import os, sys, afp
simulation = afp.Simulation(afp.load({str(ROOT / "plans/wall_following.afp")!r}), log="run.mcap")
with simulation:
    simulation.run_to(1.0)
    if os.fork() == 0:
        del simulation
        sys.exit(0)
    assert os.wait()[1] == 0
if os.fork() == 0:
    sys.exit(0)
assert os.wait()[1] == 0 and afp.Log("run.mcap").cut_short is None
"""
    ran = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (0, "")


def test_a_simulation_can_be_subclassed(wall_following: afp.Plan) -> None:
    class Counted(afp.Simulation):
        def __init__(self, steps: int) -> None:
            if steps:
                super().__init__(wall_following, seed=steps)
            self.steps = 0

        def step(self) -> bool:
            self.steps += 1
            return super().step()

    counted = Counted(3)
    assert counted.step() and counted.step() and (counted.steps, counted.seed) == (2, 3)
    with pytest.raises(RuntimeError, match="cannot be initialized twice"):
        counted.__init__(4)  # type: ignore[misc]
    with pytest.raises(RuntimeError, match="has not been made"):
        Counted(0).step()
    assert "next step" in (afp.Simulation.step.__doc__ or "")


def test_single_steps_equal_the_steps_of_a_run(tmp_path: Path) -> None:
    plan = afp.Plan("use carbot\nplan P { start go actor go: Forward(distance = 5 cm) { ForwardSuccessful -> terminate } }")
    whole = afp.Simulation(plan).run(until=30.0)
    with afp.Simulation(plan, log=tmp_path / "run.mcap") as simulation:
        while simulation.step():
            pass
        assert simulation.result().trace_hash == whole.trace_hash and simulation.ending == "ok"
        assert not simulation.step() and simulation.time == whole.time
    assert len(afp.Log(tmp_path / "run.mcap").events) > 2
    stopped = afp.Simulation(plan)
    stopped.step()
    stopped.request_stop()
    assert not stopped.step() and stopped.result().stopped_by == "stop"


def test_a_stopped_plan_does_not_continue(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following, "random:1", seed=np.int64(3), start=np.array([1.0, 1.2, 0.0]))
    assert type(simulation.seed) is int
    assert simulation.run(until=1.0) == simulation.run(until=1.0)
    with pytest.raises(RuntimeError, match="was stopped at 1 s and does not continue to 5 s"):
        simulation.run(until=5.0)
