"""Live views of runs in a notebook."""

from __future__ import annotations

import base64
import re
import sys
import time
import types
import xml.etree.ElementTree as xml
from typing import Any

import pytest

import afp
from afp import notebook, watch

from conftest import ROOT


@pytest.fixture
def cell(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, str]]:
    """The outputs of a notebook cell, in order."""
    shown: list[dict[str, str]] = []

    class Handle:
        def update(self, data: dict[str, str], raw: bool) -> None:
            shown.append(data)

    def display(data: dict[str, str], raw: bool, display_id: bool) -> Handle:
        shown.append(data)
        return Handle()

    kernel = types.SimpleNamespace(kernel=None)
    shell: Any = types.SimpleNamespace(display=types.SimpleNamespace(display=display), get_ipython=lambda: kernel)
    monkeypatch.setitem(sys.modules, "IPython", shell)
    return shown


def pictures(bundle: dict[str, str]) -> list[str]:
    """The drawings of a view."""
    return [base64.b64decode(found).decode() for found in re.findall(r"base64,([A-Za-z0-9+/=]+)", bundle["text/html"])]


def test_a_run_is_shown_while_it_continues(cell: list[dict[str, str]], wall_following: afp.Plan) -> None:
    begin = time.monotonic()
    result = afp.Simulation(wall_following, seed=7).watch(until=3.0, speed=5.0)
    assert time.monotonic() - begin >= 0.6
    assert result == afp.Simulation(wall_following, seed=7).run(until=3.0), "it is the run that nobody watches"
    assert len(cell) >= 4 and cell[0]["text/plain"] == "WallFollowing, 0.0 s, running"
    for bundle in cell:
        room, plan = pictures(bundle)
        assert xml.fromstring(room).tag.endswith("svg") and xml.fromstring(plan).tag.endswith("svg")
    assert 'data-item="WallFollowing.searchFirstWall"]>.box' in pictures(cell[1])[1]
    assert "<th>walldist</th><td>0.3</td>" in cell[-1]["text/html"]
    assert pictures(cell[0])[0] != pictures(cell[-1])[0]


def test_an_interrupted_run_continues(cell: list[dict[str, str]], monkeypatch: pytest.MonkeyPatch) -> None:
    simulation = afp.Simulation(afp.load(ROOT / "plans/wall_following.afp"))

    def interrupt(seconds: float) -> None:
        if simulation.time > 0.2:
            raise KeyboardInterrupt

    monkeypatch.setattr(watch.time, "sleep", interrupt)
    with pytest.raises(KeyboardInterrupt):
        simulation.watch(until=60.0)
    assert simulation.ending == "running" and simulation.run_to(simulation.time + 1.0)


def test_outside_of_a_notebook_the_error_names_the_fix(wall_following: afp.Plan) -> None:
    assert not notebook.is_here()
    with pytest.raises(RuntimeError, match="call run\\(\\) instead"):
        afp.Simulation(wall_following).watch()


def test_invalid_speeds_are_refused(cell: list[dict[str, str]], wall_following: afp.Plan) -> None:
    with pytest.raises(ValueError, match="speed is 0; give a multiple of real time"):
        afp.Simulation(wall_following).watch(speed=0)
