"""Logs: reading returns the written data."""

from __future__ import annotations

import gc
from pathlib import Path

import numpy as np
import pytest

import afp
from conftest import ROOT


def test_a_log_has_no_moment_before_its_start(tmp_path: Path) -> None:
    with afp.Simulation(afp.load(ROOT / "plans/wall_following.afp"), log=tmp_path / "run.mcap") as simulation:
        simulation.run(until=0.5)
    for at in (-1.0, float("nan")):
        with pytest.raises(ValueError, match="is not a time from 0 on"):
            afp.Log(tmp_path / "run.mcap").simulation(at=at)


def test_a_log_has_the_run(wall_following: afp.Plan, tmp_path: Path) -> None:
    file = tmp_path / "run.mcap"
    with afp.Simulation(wall_following, seed=5, set={"walldist": 0.35}, log=file) as simulation:
        result = simulation.run(until=6.0)
    log = afp.Log(file)
    assert log.facts["plan"] == "WallFollowing" and log.facts["seed"] == "5"
    told = [event for event in log.events if event.kind != "polled" or event.outcome]
    assert [(e.time, e.kind, e.component) for e in told] == [(e.time, e.kind, e.component) for e in result.events]
    times, values = log.entry("walldist")
    assert times[0] == 0.0 and values[0] == 0.35
    assert log.channels["/plan/events"][1] == len(log.events)
    assert log.path.shape[1] == 4 and log.cut_short is None
    assert afp.World.parse(log.attachments["world"]).name == "Furnished room"
    with pytest.raises(KeyError, match="there are:"):
        log.entry("nothing")


def test_a_truncated_log_gives_its_readable_part(wall_following: afp.Plan, tmp_path: Path) -> None:
    file = tmp_path / "run.mcap"
    with afp.Simulation(wall_following, log=file) as simulation:
        simulation.run(until=3.0)
    (tmp_path / "cut.mcap").write_bytes(file.read_bytes()[:-2000])
    assert afp.Log(tmp_path / "cut.mcap").cut_short


def test_other_files_are_not_logs(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="cannot read the log"):
        afp.Log(tmp_path / "none.mcap")
    (tmp_path / "text.mcap").write_text("hello")
    with pytest.raises(afp.AfpError):
        afp.Log(tmp_path / "text.mcap")


def test_a_log_is_complete_after_the_end_of_the_plan_or_the_simulation(tmp_path: Path, wall_following: afp.Plan) -> None:
    ended, gone, closed = (tmp_path / name for name in ("ended.mcap", "gone.mcap", "closed.mcap"))
    afp.Simulation(wall_following, log=ended).run(until=1.0)
    assert ended.exists()
    simulation = afp.Simulation(wall_following, log=gone)
    simulation.run_to(1.0)
    assert not gone.exists()
    del simulation
    gc.collect()
    assert gone.exists()
    with afp.Simulation(wall_following, log=closed) as simulation:
        simulation.run_to(1.0)
    assert afp.Log(closed).events
    with pytest.raises(RuntimeError, match="was closed with its log"):
        simulation.run_to(2.0)


def test_a_log_has_the_final_entries_like_a_result(tmp_path: Path, wall_following: afp.Plan) -> None:
    with afp.Simulation(wall_following, log=tmp_path / "run.mcap") as simulation:
        result = simulation.run(until=20.0)
    log = afp.Log(tmp_path / "run.mcap")
    assert log.entries == result.entries and len(log.configurations) > 1
    assert log.configurations[0][1] != log.entries
    assert set(log.columns) == set(result.columns)


def test_a_log_has_the_toolboxes_that_are_not_built_in(tmp_path: Path) -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    class Rest:
        """Is done at once."""

        def poll(self) -> str:
            return "Done"

    text = "use std\nuse tools\nplan P { start rest actor rest: Rest { Done -> terminate } }"
    with afp.Simulation(afp.Plan(text, toolboxes=[tools]), log=tmp_path / "run.mcap") as simulation:
        trace = simulation.run().trace_hash
    written = (tmp_path / "run.mcap").read_bytes()
    assert b"toolbox/tools" in written and b"toolbox/std" not in written
    log = afp.Log(tmp_path / "run.mcap")
    assert log.simulation(toolboxes=[tools]).run().trace_hash == trace
    hint = r"the log has the declarations of 'tools' but not the components: write log.simulation\(toolboxes=\[tools\]\)"
    with pytest.raises(ValueError, match=hint):
        log.simulation()


def test_a_log_of_a_plan_without_entries_reports_it(tmp_path: Path) -> None:
    text = "use carbot plan P { start go actor go: Forward(distance = 1 cm) { ForwardSuccessful -> terminate } }"
    with afp.Simulation(afp.Plan(text), log=tmp_path / "run.mcap") as simulation:
        simulation.run()
        with pytest.raises(KeyError, match="the plan has no entry 'x'; it has no entries"):
            simulation["x"]
    with pytest.raises(KeyError, match="the log has no entry 'x'; it has no entries"):
        afp.Log(tmp_path / "run.mcap").entry("x")


def test_a_log_has_signals_and_frames(wall_following: afp.Plan, tmp_path: Path) -> None:
    file = tmp_path / "run.mcap"
    with afp.Simulation(wall_following, seed=5, log=file, camera=True) as simulation:
        simulation.run_to(2.0)
        picture, heard = simulation.camera, simulation.sense("distance")
    log = afp.Log(file)
    assert "ultrasonic.echo" in log.signals
    times, echoes = log.signal("ultrasonic.echo")
    assert echoes.dtype == np.float64 and len(times) == len(echoes) > 20 and (np.diff(times) > 0).all()
    assert echoes[-1] == pytest.approx(heard, rel=1e-6)
    for name in log.signals:
        times, values = log.signal(name)
        assert len(times) == len(values) > 0
    times, frames = log.frames()
    assert frames.shape == (len(times), *picture.shape) and frames.dtype == np.uint8
    assert times[-1] <= 2.0 and (frames != frames[0]).any()
    with pytest.raises(KeyError, match="the log has no signal 'smell'; there are: "):
        log.signal("smell")


def test_a_log_without_pictures_has_no_frames(wall_following: afp.Plan, tmp_path: Path) -> None:
    afp.Simulation(wall_following, log=tmp_path / "run.mcap").run(until=0.2)
    with pytest.raises(ValueError, match="no pictures of the camera"):
        afp.Log(tmp_path / "run.mcap").frames()
