"""Pictures of logs: path, sonar map, film and coverage, as drawn by `afpc log`."""

from __future__ import annotations

import pickle
import subprocess
import xml.etree.ElementTree as xml
from pathlib import Path

import pytest

import afp

from conftest import ROOT

KINDS = {"picture": "--svg", "sonar": "--sonar", "film": "--film"}


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> afp.Log:
    """A run with its camera."""
    path = tmp_path_factory.mktemp("logs") / "run.mcap"
    with afp.Simulation(afp.load(ROOT / "plans/wall_following.afp"), log=path, camera=True) as simulation:
        simulation.run(until=6.0)
    return afp.Log(path)


@pytest.mark.parametrize("kind", KINDS)
def test_a_log_is_drawn(kind: str, log: afp.Log, tmp_path: Path) -> None:
    picture = getattr(log, kind)()
    assert xml.fromstring(picture.svg).tag.endswith("svg") and picture._repr_svg_() == picture.svg
    picture.save(tmp_path / "picture.svg")
    assert (tmp_path / "picture.svg").read_text(encoding="utf-8") == picture.svg
    assert picture == getattr(log, kind)() and "kB of SVG" in repr(picture)
    with pytest.raises(ValueError, match="saved as .svg, not as '.png'"):
        picture.save(tmp_path / "picture.png")


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_drawn_like_on_the_command_line(kind: str, log: afp.Log, tmp_path: Path, afpc: str) -> None:
    subprocess.run([afpc, "log", log.file, KINDS[kind], str(tmp_path / "a.svg")], check=True, cwd=ROOT)
    assert getattr(log, kind)().svg == (tmp_path / "a.svg").read_text(encoding="utf-8")


def test_a_run_is_drawn_up_to_its_present_time(log: afp.Log, wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    before = simulation.picture()
    assert ">0.0 s<" in before.svg
    simulation.run(until=6.0)
    # A log places events between two poses at the earlier one.
    drawn = [[line for line in picture.svg.splitlines() if 'class="mark"' not in line] for picture in (simulation.picture(), log.picture())]
    assert drawn[0] == drawn[1] and simulation.picture() != before


def test_a_result_has_the_picture_of_its_log_and_shows_it(log: afp.Log, wall_following: afp.Plan) -> None:
    result = afp.Simulation(wall_following).run(until=6.0)
    assert result.picture() == log.picture()
    shown = result._repr_html_()
    assert "time_limit (until)" in shown and "data:image/svg+xml;base64," in shown
    kept = pickle.loads(pickle.dumps(result))
    assert kept == result and "<img" not in kept._repr_html_()
    with pytest.raises(afp.AfpError, match="a result that was pickled"):
        kept.picture()


def test_a_result_has_the_reason_of_a_failure() -> None:
    plan = afp.Plan("use std\nplan P { in a: float = 0 start w actor w: Wait(duration = 1 s / a) { Elapsed -> terminate } }")
    assert "is infinite; formula at plan.afp:2:" in afp.Simulation(plan).run()._repr_html_()


def test_an_empty_map_begins_at_zero(wall_following: afp.Plan) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    runs = afp.sweep(wall_following, vary={"walldist": [0.2, 0.3]}, seeds=2, until=0.5, progress=False)
    (image,) = runs.plot_map("walldist", "seed", "collisions").images
    assert image.get_clim() == (0.0, 1.0)


def test_a_film_has_the_pictures_of_the_camera(log: afp.Log, tmp_path: Path) -> None:
    assert log.film().svg.count("<image") == 12
    blind = tmp_path / "blind.mcap"
    with afp.Simulation(afp.load(ROOT / "plans/wall_following.afp"), log=blind) as simulation:
        simulation.run(until=1.0)
    with pytest.raises(afp.AfpError, match="no camera pictures"):
        afp.Log(blind).film()


def test_a_plan_shows_the_coverage_of_a_run(log: afp.Log, wall_following: afp.Plan) -> None:
    covered = wall_following.coverage(log.file)
    assert xml.fromstring(covered.svg).tag.endswith("svg") and covered.svg != wall_following.svg()
    with pytest.raises(afp.AfpError, match="from another version of this plan"):
        afp.load(ROOT / "plans/patterns.afp").coverage(log.file)


def test_the_camera_does_not_change_the_run(log: afp.Log, wall_following: afp.Plan) -> None:
    result = afp.Simulation(wall_following).run(until=6.0)
    times = [event.time for event in log.events if event.kind == "event"]
    assert times == [event.time for event in result.events if event.kind == "event"]


def test_a_missing_log_is_an_error(wall_following: afp.Plan) -> None:
    with pytest.raises(OSError):
        wall_following.coverage("nothing.mcap")
