"""Pictures of logs: path, sonar map, film, coverage, as `afpc log` draws them."""

from __future__ import annotations

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
def test_it_is_drawn_as_the_command_line_does(kind: str, log: afp.Log, tmp_path: Path, afpc: str) -> None:
    subprocess.run([afpc, "log", log.file, KINDS[kind], str(tmp_path / "a.svg")], check=True, cwd=ROOT)
    assert getattr(log, kind)().svg == (tmp_path / "a.svg").read_text(encoding="utf-8")


def test_a_run_is_drawn_as_far_as_it_has_come(log: afp.Log, wall_following: afp.Plan) -> None:
    simulation = afp.Simulation(wall_following)
    before = simulation.picture()
    assert ">0.00 m<" in before.svg
    simulation.run(until=6.0)
    # A log places what happened between two looks at the robot where it was before.
    drawn = [[line for line in picture.svg.splitlines() if 'class="mark"' not in line] for picture in (simulation.picture(), log.picture())]
    assert drawn[0] == drawn[1] and simulation.picture() != before


def test_a_film_has_the_pictures_of_the_camera(log: afp.Log, tmp_path: Path) -> None:
    assert log.film().svg.count("<image") == 12
    blind = tmp_path / "blind.mcap"
    with afp.Simulation(afp.load(ROOT / "plans/wall_following.afp"), log=blind) as simulation:
        simulation.run(until=1.0)
    with pytest.raises(afp.AfpError, match="no pictures of the camera"):
        afp.Log(blind).film()


def test_a_plan_shows_what_a_run_made_use_of(log: afp.Log, wall_following: afp.Plan) -> None:
    covered = wall_following.coverage(log.file)
    assert xml.fromstring(covered.svg).tag.endswith("svg") and covered.svg != wall_following.svg()
    with pytest.raises(afp.AfpError, match="not of this plan as it is now"):
        afp.load(ROOT / "plans/patterns.afp").coverage(log.file)


def test_the_camera_changes_nothing_of_the_run(log: afp.Log, wall_following: afp.Plan) -> None:
    result = afp.Simulation(wall_following).run(until=6.0)
    times = [event.time for event in log.events if event.kind == "event"]
    assert times == [event.time for event in result.events if event.kind == "event"]


def test_a_log_that_is_not_there_is_an_error(wall_following: afp.Plan) -> None:
    with pytest.raises(OSError):
        wall_following.coverage("nothing.mcap")
