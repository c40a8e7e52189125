"""Studies of interruptions: drawn and varied stimuli, estimates, more seeds."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import afp

GRID: dict[str, Any] = {"until": 3.0, "progress": False}


def bumps(rng: np.random.Generator) -> list[afp.Press]:
    return [afp.Press("touch", at=time) for time in rng.uniform(0.5, 2.5, rng.poisson(1.0))]


def test_a_press_can_vary_in_time(wall_following: afp.Plan) -> None:
    runs = afp.sweep(wall_following, vary={afp.Press("touch"): [0.5, 1.0]}, **GRID)
    assert runs.columns["press.touch"] == ["@0.5s", "@1s"] and runs.columns["press.touch_si"] == [0.5, 1.0]
    assert "--press touch@1s" in runs[1]["command"]
    alone = afp.Simulation(wall_following)
    alone.press(afp.Press("touch", at=1.0))
    assert runs[1]["trace"] == alone.run(until=3.0).trace_hash == runs.result(1).trace_hash


def test_a_fault_can_vary_in_time(wall_following: afp.Plan) -> None:
    slip = afp.Fault("wheels", "slip", share=0.5, lasting=1.0)
    runs = afp.sweep(wall_following, vary={slip: np.array([0.5, 1.0])}, **GRID)
    assert runs.columns["fail.wheels.slip"] == ["=0.5@0.5s..1.5s", "=0.5@1s..2s"]
    alone = afp.Simulation(wall_following)
    alone.fail(slip.starting(0.5))
    assert runs[0]["trace"] == alone.run(until=3.0).trace_hash


def test_draws_depend_only_on_the_seed(wall_following: afp.Plan) -> None:
    draw = {"walldist": lambda rng: afp.cm(rng.uniform(25, 45)), "world.robot.charge": lambda rng: rng.uniform(0.3, 1.0)}
    runs = afp.sweep(wall_following, ["random:1", "random:2"], 3, draw=draw, presses=bumps, **GRID)
    assert len(runs) == 6 and len(set(runs.columns["walldist_si"])) == 3
    by_world = runs.by("world")
    for name in ("walldist", "world.robot.charge", "press.*"):
        assert by_world["random:1"].columns[name] == by_world["random:2"].columns[name]
    alone = afp.sweep(wall_following, "random:1", [2], presses=bumps, **GRID)
    assert alone.columns["press.*"] == runs.where(world="random:1", seed=2).columns["press.*"]
    row = runs[4]
    simulation = afp.Simulation(wall_following, "random:2", seed=1, set={name: row[name] for name in draw})
    for press in bumps(np.random.default_rng([__import__("zlib").crc32(b"press.*"), 1])):
        simulation.press(press)
    assert row["trace"] == simulation.run(until=3.0).trace_hash


def test_a_journal_keeps_draws(wall_following: afp.Plan, tmp_path: Any) -> None:
    out = tmp_path / "runs.csv"
    first = afp.sweep(wall_following, seeds=3, presses=bumps, out=out, **GRID)
    assert afp.sweep(wall_following, seeds=3, presses=bumps, out=out, **GRID).columns == first.columns
    with pytest.raises(afp.AfpError):
        afp.sweep(wall_following, seeds=3, presses=lambda rng: [], out=out, **GRID)


def test_a_finished_sweep_can_get_more_seeds(wall_following: afp.Plan) -> None:
    runs = afp.sweep(wall_following, seeds=2, presses=bumps, **GRID).extended([2, 3])
    whole = afp.sweep(wall_following, seeds=4, presses=bumps, **GRID)
    assert runs.columns["run"] == [0, 1, 2, 3] and runs.columns["trace"] == whole.columns["trace"]
    assert runs.result(3).trace_hash == runs[3]["trace"]
    with pytest.raises(ValueError, match="has runs with seed 3"):
        runs.extended([3])
    table = pickle.loads(pickle.dumps(runs))
    assert len(table + table) == 8


def test_columns_are_arrays(wall_following: afp.Plan) -> None:
    runs = afp.sweep(wall_following, seeds=2, metrics={"nothing": lambda result: None}, **GRID)
    assert runs["time_s"].dtype == np.float64 and runs["seed"].tolist() == [0, 1]
    assert np.isnan(runs["nothing"]).all() and runs["ending"].tolist() == ["time_limit"] * 2


def test_estimates_have_intervals(wall_following: afp.Plan) -> None:
    metrics = {"reaction": afp.metrics.reaction, "recovery": afp.metrics.recovery("searchFirstWall")}
    presses = [afp.Press("touch", at=0.5)]
    plain = afp.sweep(wall_following, seeds=4, **GRID)
    hit = afp.sweep(wall_following, seeds=4, presses=presses, metrics=metrics, **GRID)
    assert hit.mean("reaction").value < 0.01 and hit.mean("reaction").count == 4
    share = hit.share(ending="time_limit")
    assert (share.value, share.count) == (1.0, 4) and 0.5 < share.low < share.high == 1.0
    less = plain.difference(hit, "distance_m")
    assert less.value == pytest.approx(np.mean(hit["distance_m"] - plain["distance_m"])) and less.low <= less.value <= less.high
    with pytest.raises(ValueError, match="no partner"):
        plain.difference(hit[:2], "distance_m")


def test_a_plan_shows_its_structure(wall_following: afp.Plan) -> None:
    first = wall_following.elements[0]
    assert (first.name, first.kind, first.template) == ("searchFirstWall", "actor", "Forward")
    assert first.inputs["distance"] == "10000 cm"
    assert afp.Edge("searchFirstWall.touch", "TouchSensorPressed", "backupCollision") in first.edges
    edges = wall_following.edges
    assert edges[0] == afp.Edge("", "start", "searchFirstWall") and edges[-1].target == "terminate"
    walldist = wall_following.entries[0]
    assert (walldist.name, walldist.kind, walldist.type, walldist.initial) == ("walldist", "in", "length", "30 cm")
    with pytest.raises(afp.PlanError):
        afp.Plan("plan").entries


def test_a_function_draws_a_world_for_each_seed(wall_following: afp.Plan) -> None:
    def hall(rng: np.random.Generator) -> afp.World:
        robot = {"track": rng.uniform(0.14, 0.18), "sonar": rng.uniform(1.0, 2.0)}
        return afp.WorldBuilder("Hall", start=(1.0, 1.0), **robot).room(rng.uniform(3, 5), 3.0).build()

    vary = {"walldist": [0.3, 0.4]}
    charge = {"world.robot.charge": lambda rng: rng.uniform(0.3, 1.0)}
    runs = afp.sweep(wall_following, hall, seeds=[3, 5, 8], vary=vary, draw=charge, **GRID)
    assert len(runs) == 6 and set(runs.columns["world"]) == {f"Hall of seed {seed}" for seed in (3, 5, 8)}
    near, far = runs.by("walldist").values()
    assert near.difference(far, "distance_m").count == 3
    assert runs.result(4).trace_hash == runs[4]["trace"]
    longer = runs.extended([9])
    assert longer.where(seed=9)[0]["world"] == "Hall of seed 9"
    rooms = afp.sweep(wall_following, lambda rng: f"random:{rng.integers(3)}", seeds=6, **GRID)
    assert len(rooms) == 6 and rooms[0]["command"].startswith("afpc run")
    same = afp.sweep(wall_following, rooms[2]["world"], seeds=[2], **GRID)
    assert same[0]["trace"] == rooms[2]["trace"]


def test_a_drawn_world_continues_from_its_journal(wall_following: afp.Plan, tmp_path: Any) -> None:
    def hall(rng: np.random.Generator) -> afp.World:
        return afp.WorldBuilder("Hall", start=(1.0, 1.0)).room(rng.uniform(3, 5), 3.0).build()

    out = tmp_path / "runs.csv"
    first = afp.sweep(wall_following, hall, 3, out=out, **GRID)
    assert afp.sweep(wall_following, hall, 3, out=out, **GRID).columns == first.columns
    with pytest.raises(afp.AfpError, match="a world has changed"):
        afp.sweep(wall_following, lambda rng: hall(np.random.default_rng(1)), 3, out=out, **GRID)


def test_numbers_in_a_csv_file_are_numbers(wall_following: afp.Plan, tmp_path: Any) -> None:
    out = tmp_path / "runs.csv"
    afp.sweep(wall_following, seeds=1, out=out, metrics={"five": lambda result: 5.0}, **GRID)
    head, line = out.read_text().splitlines()
    assert ",5.0," in line and "five" in head


def test_a_parquet_file_is_compressed_and_says_what_it_is_of(wall_following: afp.Plan, tmp_path: Any) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    out = tmp_path / "runs.parquet"
    afp.sweep(wall_following, seeds=[3, 5], presses=bumps, out=out, **GRID)
    file = parquet.ParquetFile(out)
    assert {file.metadata.row_group(0).column(column).compression for column in range(file.metadata.num_columns)} == {"SNAPPY"}
    facts = {key.decode(): value.decode() for key, value in file.metadata.metadata.items()}
    assert afp.__version__ in facts["afp.program"] and facts["afp.seeds"] == "3,5" and len(facts["afp.plan_hash"]) == 16


def test_each_seed_has_its_sample(wall_following: afp.Plan) -> None:
    runs = afp.sweep(wall_following, seeds=[3, 5], draw={"walldist": [afp.cm(30), 0.4]}, **GRID)
    assert runs.columns["walldist_si"] == [0.3, 0.4] and runs.columns["seed"] == [3, 5]
    with pytest.raises(ValueError, match="one for each"):
        runs.extended([7])
