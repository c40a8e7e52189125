"""The arguments of a sweep, and operations on its runs."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import afp
from afp.picture import address

from conftest import ROOT

GO = "use carbot\nplan Go { in way: length = 20 cm start go actor go: Forward(distance = way) { ForwardSuccessful -> terminate } }"


def swept(**options: Any) -> afp.Runs:
    return afp.sweep(afp.Plan(GO), **{"until": 5.0, "progress": False, **options})


def seeds(given: Any) -> list[int]:
    return [int(row["seed"]) for row in swept(seeds=given)]


def test_seeds_are_a_number_or_a_list() -> None:
    assert seeds(2) == [0, 1] and seeds([5, 1]) == [5, 1]
    assert seeds(range(0, 9, 4)) == [0, 4, 8]
    assert seeds(number for number in (2, 3)) == [2, 3]
    assert seeds(np.array([7, 6])) == [7, 6]
    with pytest.raises(ValueError, match="the seed 1 is given twice"):
        seeds([1, 1])
    with pytest.raises(ValueError, match="-1 is not a seed"):
        seeds([-1])


def test_values_are_one_or_several_of_each_type() -> None:
    def values(given: Any) -> list[float]:
        return list(swept(vary={"way": given}).columns["way_si"])

    assert values(0.1) == values(afp.cm(10)) == values("10cm") == values([0.1]) == [0.1]
    assert values(np.linspace(0.1, 0.3, 3)) == pytest.approx([0.1, 0.2, 0.3])
    assert values(value for value in (0.1, afp.cm(20))) == [0.1, 0.2]
    with pytest.raises(afp.AfpError, match="10cm..20cm"):
        values(["10cm..20cm"])


def test_worlds_may_be_built_in_the_program() -> None:
    made = [afp.World.parse(afp.World.random(seed).text) for seed in (3, 3, 4)]
    runs = swept(worlds=[*made, "random:3"])
    names = runs.columns["world"]
    assert len(set(names)) == 4 and names[3] == "random:3"
    assert runs[0]["trace"] == runs[1]["trace"] == runs[3]["trace"] and runs[0]["distance_m"] == runs[3]["distance_m"]
    assert runs[0]["command"].endswith("  # the plan has no file; the world has no file")
    again = pickle.loads(pickle.dumps(made[2]))
    assert swept(worlds=again)[0]["distance_m"] == runs[2]["distance_m"]


def test_metrics_are_columns_that_a_journal_keeps(tmp_path: Path) -> None:
    def most_left(result: afp.Result) -> float:
        return float(result.path[:, 2].max())

    def slow(result: afp.Result) -> float | None:
        return result.time if result.time > 1e3 else None

    metrics = {"most_left_m": most_left, "slow_s": slow, "steps": lambda result: len(result.events)}
    out = tmp_path / "runs.csv"
    runs = swept(seeds=4, jobs=2, metrics=metrics, out=out)
    alone = afp.Simulation(afp.Plan(GO), seed=2).run(5.0)
    assert runs[2]["most_left_m"] == most_left(alone) and runs[2]["steps"] == len(alone.events)
    assert runs.columns["slow_s"] == [None] * 4, "a column without values is one"
    called: list[str] = []
    again = swept(seeds=4, metrics=metrics, out=out, on_run=lambda row: called.append(row["trace"]))
    assert again.columns["most_left_m"] == runs.columns["most_left_m"] and not called
    with pytest.raises(afp.AfpError, match="belongs to another sweep"):
        swept(seeds=4, metrics={"most_left_m": lambda result: 0}, out=out)


def test_a_metric_without_values_is_a_column_of_every_table(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    none: dict[str, Callable[[afp.Result], None]] = {"q": lambda result: None}
    runs = swept(seeds=2, metrics=none, out=f"{tmp_path}/runs/")
    assert runs.to_pandas()["q"].isna().all() and runs.to_polars()["q"].null_count() == 2
    assert parquet.read_table(tmp_path / "runs/outcomes.parquet").column("q").null_count == 2
    assert ",q," in (tmp_path / "runs/outcomes.csv").read_text()
    assert swept(seeds=2, metrics=none, out=f"{tmp_path}/runs/") == runs
    for name, said in (("time_s", "every run has a column 'time_s'"), ("contacts_s", "every run has a result 'contacts_s'")):
        with pytest.raises(ValueError, match=said):
            swept(seeds=1, metrics={name: lambda result: None})


def test_a_failing_metric_ends_the_sweep() -> None:
    def breaks(result: afp.Result) -> float:
        raise LookupError(result.plan)

    with pytest.raises(LookupError, match="Go"):
        swept(seeds=20, metrics={"breaks": breaks})
    with pytest.raises(TypeError, match="gives a number or None, not 'a'"):
        swept(metrics={"text": lambda result: "a"})
    with pytest.raises(ValueError, match="return None if there is no number"):
        swept(metrics={"far": lambda result: float("inf")})
    with pytest.raises(ValueError, match="becomes a column"):
        swept(metrics={"a b": len})
    with pytest.raises(TypeError, match="gets a Result"):
        swept(metrics={"a": 1})
    with pytest.raises(ValueError, match="every run has a result 'contacts_s'"):
        swept(metrics={"contacts_s": lambda result: 0})
    with pytest.raises(ValueError, match="every run has a column 'time_s'"):
        swept(metrics={"time_s": lambda result: 0})


def test_each_run_is_reported_when_it_ends() -> None:
    rows: list[dict[str, Any]] = []
    runs = swept(seeds=5, jobs=2, on_run=rows.append)
    assert sorted(rows, key=lambda row: int(row["run"])) == list(runs)

    def enough(row: dict[str, Any]) -> None:
        raise InterruptedError

    with pytest.raises(InterruptedError):
        swept(seeds=5, on_run=enough)


def test_runs_are_sliced_and_filtered() -> None:
    runs = swept(seeds=4, vary={"way": [0.1, 0.2]})
    assert [row["run"] for row in runs[2:4]] == [2, 3] and len(runs[::2]) == 4
    assert runs.where(seed=3).columns["way_si"] == [0.1, 0.2]
    assert len(runs.where({"way": "0.1m"}, ending="ok")) == 4
    few = runs.filter(lambda row: row["seed"] > 1)
    assert len(few) == 4 and few.groups[0]["count"] == 4 and few.groups[0]["run"] == 2
    assert len(runs[:0]) == 0 and repr(runs[:0]) == "<Runs of Go: none>"
    with pytest.raises(KeyError, match="no column 'sed'"):
        runs.where(sed=3)
    assert "afpc run" in runs._repr_html_()


def test_runs_are_found_by_the_varied_value() -> None:
    runs = swept(seeds=2, vary={"way": [afp.cm(10), "0.2 m", 0.3]})
    for way in (afp.cm(20), afp.mm(200), 0.2, np.float64(0.2), "0.2 m", "20cm", "20 cm", "200 mm"):
        assert [row["seed"] for row in runs.where(way=way)] == [0, 1], way
    assert len(runs.where(way=afp.cm(20), seed=1)) == 1 and len(runs.where(way=afp.cm(25))) == 0
    assert len(runs.where(way="3 s")) == len(runs.where(way="far")) == 0
    for given, said in (
        ({"way": afp.s(3)}, "'way' is in m, not in s"),
        ({"way": [0.1]}, "has values such as '0.1m', not .0.1.; filter"),
        ({"seed": [0, 1]}, "the column 'seed' has values such as 0, not"),
        ({"seed": "1"}, "the column 'seed' has values such as 0, not '1'"),
        ({"ending": 3}, "the column 'ending' has values such as 'ok', not 3"),
    ):
        with pytest.raises(TypeError, match=said):
            runs.where(given)
    charges = afp.sweep(afp.Plan(GO), vary={"world.robot.charge": [0.5, 1.0]}, until=5.0, progress=False)
    assert len(charges.where({"world.robot.charge": 0.5})) == len(charges.where({"world.robot.charge": "0.50"})) == 1
    flag = "use std plan P { in on: bool = true in n: int = 0 var got: int start c computation c: Assign(value = n, result => got) { Done -> terminate } }"
    flags = afp.sweep(afp.Plan(flag), vary={"on": [True, False], "n": [1, 2]}, progress=False)
    assert [row["n"] for row in flags.where(on=True)] == ["1", "2"] and len(flags.where(n=2)) == len(flags.where(n="2")) == 2


def test_a_notebook_shows_the_first_run_of_each_group() -> None:
    runs = swept(worlds=["random:1"], vary={"way": [0.1, 20.0], "world.robot.charge": [0.5]})
    assert [group["ending"] for group in runs.groups] == ["ok", "time_limit"]
    shown = runs._repr_html_()
    assert shown.count("data:image/svg+xml;base64,") == 2
    assert address(runs.result(1).picture().svg) in shown and "run 1: time_limit" in shown
    assert "<img" not in pickle.loads(pickle.dumps(runs))._repr_html_(), "what cannot be done again is not shown"
    runs.columns["took_s"] = [100.0, 0.1]
    assert runs._repr_html_().count("<img") == 1, "what takes long is not done again"
    runs.columns["ending"] = ["not_started", "not_started"]
    assert "<img" not in runs._repr_html_()


def test_runs_with_user_components_are_not_repeated_for_display() -> None:
    tools = afp.Toolbox("tools")
    called: list[int] = []

    @tools.actor(states=["Done"])
    class Done:
        def poll(self) -> str:
            called.append(1)
            return "Done"

    plan = afp.Plan("use tools\nplan P { start go actor go: Done { Done -> terminate } }", toolboxes=[tools])
    runs = afp.sweep(plan, progress=False)
    times = len(called)
    assert "<img" not in runs._repr_html_() and len(called) == times


def test_a_row_repeats_its_run() -> None:
    runs = swept(worlds=["random:1"], seeds=[4], vary={"way": [0.1, 0.2], "world.robot.charge": [0.5]})
    result = runs.result(1)
    assert result.trace_hash == runs[1]["trace"] and result.seed == 4
    simulation = runs[1:].simulation(0)
    assert simulation["way"] == 0.2 and simulation.time == 0.0
    pickled = pickle.loads(pickle.dumps(runs))
    assert list(pickled) == list(runs)
    with pytest.raises(RuntimeError, match="only a table"):
        pickled.result(0)


def test_a_row_repeats_a_run_with_components_in_python() -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    class Breaks:
        def poll(self) -> str:
            raise RuntimeError("broken")

    plan = afp.Plan("use tools plan P { start go actor go: Breaks { Done -> terminate } }", toolboxes=[tools])
    runs = afp.sweep(plan, until=1.0, progress=False)
    assert str(runs.result(0).errors[0].error) == "broken"


def test_outcome_maps() -> None:
    pytest.importorskip("matplotlib").use("agg")
    runs = swept(seeds=2, vary={"way": [0.1, 0.2, 0.3], "world.robot.charge": [0.5, 1.0]})
    ends = runs.plot_map("way", "world.robot.charge")
    assert [text.get_text() for text in ends.texts] == ["100%"] * 6
    assert [label.get_text() for label in ends.get_xticklabels()] == ["0.1", "0.2", "0.3"]
    means = runs.plot_map("way", "world.robot.charge", "time_s")
    assert means.images[0].get_array().shape == (2, 3)
    with pytest.raises(KeyError, match="no column 'nothing'"):
        runs.plot_map("way", "nothing")


def test_an_axis_has_the_unit_of_its_entry() -> None:
    pytest.importorskip("matplotlib").use("Agg")
    plan = afp.load(ROOT / "plans/wall_following.afp")
    vary = {"walldist": ["30cm", "40cm"], "world.robot.charge": [0.5, 1.0]}
    runs = afp.sweep(plan, seeds=1, vary=vary, until=1.0, progress=False)
    axes = runs.plot("walldist", "time_s")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("walldist [m]", "time [s]")
    axes = pickle.loads(pickle.dumps(runs)).plot_map("walldist", "world.robot.charge", "distance_m")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("walldist [m]", "world.robot.charge")
    assert axes.get_title().endswith("distance [m]")
