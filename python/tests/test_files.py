"""Reading and writing: inputs are never overwritten, and errors name the file."""

from __future__ import annotations

import errno
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

import afp
from conftest import ROOT

GO = 'use "parts.afp"\nplan P { start go subplan go: Part { OK -> terminate } }\nscenario "once" for P { world "room.toml" expect end }\n'
PART = "use carbot\nplan Part { start go actor go: Forward(distance = 10 cm) { ForwardSuccessful -> terminate } }\n"


@pytest.fixture
def plan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> afp.Plan:
    """A plan that uses another file, with a world, in the current folder."""
    monkeypatch.chdir(tmp_path)
    Path("go.afp").write_text(GO)
    Path("parts.afp").write_text(PART)
    shutil.copy(ROOT / "worlds/wall_following.toml", "room.toml")
    return afp.load("go.afp")


def test_a_log_does_not_replace_an_input(plan: afp.Plan) -> None:
    (scenario,) = plan.scenarios
    runs = afp.sweep(plan, worlds="room.toml", vary={"world.robot.charge": [0.5]}, progress=False)
    world = afp.World.load("room.toml")
    before = {path: path.read_bytes() for path in Path().iterdir()}
    tries: list[Callable[[str], object]] = [
        lambda log: afp.Simulation(plan, world, log=log),
        lambda log: afp.Simulation(plan, "room.toml", set={"world.robot.charge": 0.5}, log=log),
        lambda log: scenario.run(log=log),
        lambda log: runs.simulation(0, log=log),
    ]
    for begin in tries:
        for log in ("go.afp", "parts.afp", "../" + Path.cwd().name + "/room.toml"):
            with pytest.raises(afp.AfpError, match="is an input, so it cannot be an output"):
                begin(log)
    assert {path: path.read_bytes() for path in Path().iterdir()} == before
    assert scenario.run(log="run.mcap").passed and Path("run.mcap").is_file()


def test_a_saved_world_is_read_back(plan: afp.Plan) -> None:
    with pytest.raises(ValueError, match="a world is saved as .toml, not as 'go.afp'"):
        afp.WorldBuilder("hall", start=(1.0, 1.0)).save("go.afp")
    assert Path("go.afp").read_text() == GO


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="what never ends is a device of Linux")
def test_endless_files_are_read_up_to_a_limit() -> None:
    for read in (afp.load, afp.Toolbox.load):
        with pytest.raises(OSError, match="it is longer than 64 MiB"):
            read("/dev/full")


def test_unreadable_and_unwritable_files_are_named(plan: afp.Plan) -> None:
    Path("run.mcap").write_bytes(b"\x89MCAP0\xff")
    with pytest.raises(OSError, match="cannot read the plan: it is not UTF-8 text: 'run.mcap'"):
        afp.load("run.mcap")
    with pytest.raises(OSError, match="cannot read the toolbox: it is not UTF-8 text: 'run.mcap'"):
        afp.Toolbox.load("run.mcap")
    with pytest.raises(FileNotFoundError, match="cannot read the plan: No such file or directory: ''"):
        afp.load("")
    hall = afp.WorldBuilder("hall", start=(1.0, 1.0))
    Path("folder.toml").mkdir()
    Path("folder.svg").mkdir()
    tries: list[tuple[Callable[[], object], str]] = [
        (lambda: plan.save("."), "."),
        (lambda: afp.Simulation(plan, log="."), "."),
        (lambda: afp.load("."), "."),
        (lambda: hall.save("folder.toml"), "folder.toml"),
        (lambda: afp.Picture("<svg/>").save("folder.svg"), "folder.svg"),
    ]
    for attempt, name in tries:
        with pytest.raises(IsADirectoryError) as error:
            attempt()
        assert (error.value.errno, error.value.filename) == (errno.EISDIR, name)


def test_an_unwritable_drawing_keeps_the_old_file(plan: afp.Plan) -> None:
    afp.Picture("<svg/>").save("hall.svg")
    with pytest.raises(UnicodeEncodeError):
        afp.Picture("\ud800").save("hall.svg")
    assert Path("hall.svg").read_text() == "<svg/>"
