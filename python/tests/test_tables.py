"""Tables and pictures of runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import afp
from conftest import ROOT


@pytest.fixture
def result(wall_following: afp.Plan) -> afp.Result:
    return afp.Simulation(wall_following, seed=2).run(until=6.0)


def test_tables_agree(result: afp.Result) -> None:
    polars, pyarrow = pytest.importorskip("polars"), pytest.importorskip("pyarrow")
    pytest.importorskip("pandas")
    frame = result.to_pandas()
    assert not any(kind == object for kind in [*frame.dtypes, *afp.sweep(afp.load(ROOT / "plans/wall_following.afp"), until=0.5, progress=False).to_pandas().dtypes])
    assert list(frame["kind"]) == [event.kind for event in result.events]
    assert result.to_polars()["time"].to_list() == list(frame["time"])
    assert result.to_arrow().num_rows == len(frame)
    assert polars.DataFrame(result).height == len(frame) and pyarrow.table(result).num_rows == len(frame)


def test_tables_have_all_fields_of_events(wall_following: afp.Plan, tmp_path: Path) -> None:
    arrow = pytest.importorskip("pyarrow")
    simulation = afp.Simulation(wall_following, set={"walldist": afp.cm(35)}, log=tmp_path / "run.mcap")
    simulation.set("walldist", afp.cm(40), at=0.5)
    simulation.fail(afp.Fault("ultrasonic", "lost", at=1.0))
    simulation.press(afp.Press(at=9.0))
    result = simulation.run(until=5.0)
    log = afp.Log(tmp_path / "run.mcap")
    for table, events in ((result.to_arrow(), result.events), (log.to_arrow(), log.events)):
        attributes = {name for name in dir(afp.Event) if not name.startswith("_")}
        assert attributes <= set(table.column_names) and table.schema.field("on").type == arrow.bool_()
        for name in attributes - {"old", "value"}:
            assert table.column(name).to_pylist() == [getattr(event, name) for event in events]
        assert {"fail ultrasonic.lost", "set walldist = 0.4 m"} <= set(table.column("request").to_pylist())
        assert 0.35 in table.column("old").to_pylist() and result.fault_text in table.column("fault_text").to_pylist()
    assert log.to_pandas()["refused"].dropna().unique().tolist() == ["not reached"]


def test_pictures(result: afp.Result) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    path = result.plot_path()
    assert path.get_title() == "WallFollowing in Furnished room, seed 2"
    timeline = result.plot_timeline()
    rows = [label.get_text() for label in timeline.get_yticklabels()]
    assert rows[0] == "searchFirstWall" and not any("." in row for row in rows)
    timeline.figure.canvas.draw()
    path.figure.canvas.draw()


EXTRAS = {"pandas": "pandas", "polars": "polars", "pyarrow": "arrow", "matplotlib": "plot", "gymnasium": "gym", "ray": "ray"}
MISSING = {
    "pandas": ["result.to_pandas()", "runs.to_pandas()", "log.to_pandas()"],
    "polars": ["result.to_polars()", "runs.to_polars()", "log.to_polars()"],
    "pyarrow": ["result.to_arrow()", "runs.to_arrow()", "result.__arrow_c_stream__()"],
    "matplotlib": ["result.plot_path()", "result.plot_timeline()", "runs.plot('seed')", "log.plot_timeline()"],
    "gymnasium": ["__import__('afp.gym')"],
    "ray": ["afp.sweep(plan, backend='ray', progress=False)"],
}


@pytest.mark.parametrize("module", MISSING)
def test_missing_packages_are_reported(module: str, tmp_path: Path) -> None:
    calls = MISSING[module]
    program = f"""
import sys
sys.modules[{module!r}] = None
import afp
plan = afp.load({str(ROOT / "plans/wall_following.afp")!r})
with afp.Simulation(plan, log={str(tmp_path / "run.mcap")!r}) as simulation:
    result = simulation.run(until=0.2)
log = afp.Log({str(tmp_path / "run.mcap")!r})
runs = afp.sweep(plan, until=0.2, progress=False)
assert result.columns and runs.columns and log.events
for call in {calls!r}:
    try:
        eval(call)
    except ImportError as error:
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    said = f"this needs {module}; install it with: pip install 'action-flow-plans[{EXTRAS[module]}]'"
    assert done.stdout.splitlines() == [said] * len(calls)


def test_named_extras_exist() -> None:
    project = (ROOT / "python/pyproject.toml").read_text(encoding="utf-8")
    assert 'name = "action-flow-plans"' in project
    packages = {"matplotlib": "plot", "stable-baselines3": "sb3", **EXTRAS}
    for package, extra in packages.items():
        [line] = [line for line in project.splitlines() if line.startswith(f"{extra} = [")]
        assert f'"{package}>=' in line
