"""Saved moments, and simulations that are read while another thread drives them."""

from __future__ import annotations

import copy
import pickle
import threading
import time
from pathlib import Path

import pytest

import afp

STOPPED = 20.0


def hash_at_the_end(simulation: afp.Simulation) -> str:
    return simulation.run(STOPPED).trace_hash


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("at", [0.0, 1.234, 7.5])
def test_a_restored_run_continues_like_the_original(wall_following: afp.Plan, seed: int, at: float) -> None:
    whole = afp.Simulation(wall_following, seed=seed)
    whole.bump(at=9.0)
    wanted = whole.run(STOPPED)
    simulation = afp.Simulation(wall_following, whole.world, seed=seed)
    simulation.bump(at=9.0)
    simulation.run_to(at)
    saved, twin = simulation.save(), simulation.clone()
    first = simulation.run(STOPPED)
    assert saved.time == twin.time < first.time
    simulation.restore(saved)
    assert simulation.time == saved.time and simulation.ending == "running"
    again = simulation.run(STOPPED)
    for result in (first, again, twin.run(STOPPED), copy.copy(whole).result()):
        assert result.trace_hash == wanted.trace_hash
        assert result.timeline == wanted.timeline and (result.path == wanted.path).all()


def test_a_moment_may_lead_to_several_futures(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following, seed=1)
    simulation.run_to(2.0)
    saved = simulation.save()
    hashes = []
    for at in (3.0, 4.0):
        simulation.restore(saved)
        simulation.bump(at=at)
        hashes.append(hash_at_the_end(simulation))
    assert len(set(hashes)) == 2


def test_unsavable_simulations_report_the_reason(wall_following: afp.Plan, tmp_path: Path) -> None:
    simulation = afp.Simulation(wall_following)
    saved = simulation.save()
    assert "Snapshot of WallFollowing" in repr(saved) and "at 0.000 s" in repr(saved)
    with pytest.raises(TypeError, match="cannot be pickled"):
        pickle.dumps(saved)
    with pytest.raises(TypeError, match="from a result of save"):
        simulation.restore(simulation)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="belongs to another simulation"):
        afp.Simulation(wall_following, simulation.world, seed=1).restore(saved)
    with afp.Simulation(wall_following, simulation.world, log=tmp_path / "a.mcap") as logged:
        with pytest.raises(RuntimeError, match="log, which cannot be taken back"):
            logged.restore(saved)
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    class Waits:
        def poll(self) -> None: ...

    plan = afp.Plan("use tools plan P { start go actor go: Waits { Done -> terminate } }", toolboxes=[tools])
    driven = afp.Simulation(plan)
    driven.run_to(0.1)
    with pytest.raises(afp.AfpError, match="cannot be copied"):
        driven.save()


def test_other_threads_read_during_a_run(wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following, seed=3)
    driving = threading.Thread(target=lambda: simulation.run(5000.0))
    driving.start()
    times = [0.0]
    while driving.is_alive() and len(times) < 50:
        times.append(simulation.time)
        assert len(simulation.pose) == 3 and simulation.ending in ("running", "time_limit", "ok")
        assert simulation.active is None or isinstance(simulation.active, str)
        assert repr(simulation).startswith("<Simulation of WallFollowing in ")
        time.sleep(0.005)
    simulation.request_stop()
    driving.join()
    assert times == sorted(times) and times[-1] > 0.0
    assert simulation.time >= times[-1]


def test_a_simulation_starts_from_a_moment_of_a_log(tmp_path: Path, wall_following: afp.Plan) -> None:
    file = tmp_path / "run.mcap"
    first = afp.Simulation(wall_following, seed=3, set={"walldist": afp.cm(40)}, log=file)
    first.bump(at=1.0)
    first.fail(afp.Fault("ultrasonic", "frozen", at=2.0, lasting=1.0))
    first.run_to(1.5)
    first["walldist"] = afp.cm(35)
    moment = first.pose
    result = first.run(until=6.0)
    again = afp.Log(file).simulation(at=1.5)
    assert (again.time, again.pose, again["walldist"]) == (1.5, moment, 0.4)
    assert again.run(until=6.0).trace_hash == result.trace_hash
    other = afp.Log(file).simulation(at=1.5)
    other.press(afp.Press(at=4.0))
    assert other.run(until=6.0).trace_hash != result.trace_hash


def test_a_log_has_the_plan_of_its_run(tmp_path: Path) -> None:
    (tmp_path / "part.afp").write_text("use carbot\nplan Part { start go actor go: Forward(distance = 20 cm) { ForwardSuccessful -> terminate } }\n")
    (tmp_path / "whole.afp").write_text('use "part.afp"\nplan Whole { start part subplan part: Part { OK -> terminate } }\n')
    plan = afp.load(tmp_path / "whole.afp")
    plan.check()
    with afp.Simulation(plan, log=tmp_path / "run.mcap") as simulation:
        result = simulation.run(until=5.0)
    (tmp_path / "part.afp").unlink()
    (tmp_path / "whole.afp").unlink()
    assert afp.Log(tmp_path / "run.mcap").simulation().run(until=5.0).trace_hash == result.trace_hash


def test_a_log_without_a_description_is_reported(tmp_path: Path) -> None:
    with pytest.raises(OSError):
        afp.Log(tmp_path / "nothing.mcap").simulation()
