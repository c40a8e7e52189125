"""Tables and pictures of runs."""

from __future__ import annotations

import builtins
from typing import Any

import pytest

import afp


@pytest.fixture
def result(wall_following: afp.Plan) -> afp.Result:
    return afp.Simulation(wall_following, seed=2).run(until=6.0)


def test_tables_agree(result: afp.Result) -> None:
    polars, pyarrow = pytest.importorskip("polars"), pytest.importorskip("pyarrow")
    pytest.importorskip("pandas")
    frame = result.to_pandas()
    assert list(frame["kind"]) == [event.kind for event in result.events]
    assert result.to_polars()["time"].to_list() == list(frame["time"])
    assert result.to_arrow().num_rows == len(frame)
    assert polars.DataFrame(result).height == len(frame) and pyarrow.table(result).num_rows == len(frame)


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


@pytest.mark.parametrize(
    ("method", "extra"),
    [("to_pandas", "pandas"), ("to_polars", "polars"), ("to_arrow", "arrow"), ("plot_path", "plot")],
)
def test_what_is_not_installed_says_so(
    result: afp.Result, method: str, extra: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    import importlib

    def missing(name: str, package: str | None = None) -> Any:
        raise builtins.ImportError(name)

    monkeypatch.setattr(importlib, "import_module", missing)
    with pytest.raises(ImportError, match=rf"pip install 'afp\[{extra}\]'"):
        getattr(result, method)()
