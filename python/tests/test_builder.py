"""Worlds built in Python."""

from __future__ import annotations

import math
import pickle
from pathlib import Path

import pytest

import afp

EVERYTHING = (
    afp.WorldBuilder(
        'A "hall"\n\x7fä', start=(afp.cm(80), 0.8, afp.deg(20)), charge=0.9, floor="#c0c0c0", floor_texture="checks",
        length=0.3, width=0.2, track=0.16, wheelbase=0.1, steering=afp.deg(30.0), fastest=0.4, sonar=0.1, encoders=False,
    )
    .room(5.0, 4.0, texture="bricks", height=2.0)
    .wall([(3.0, 0.0), (3.0, 1.0)], name="stub", thickness=0.08, echo=0.5, mapped=False, color="#112233")
    .box("crate", (2.0, 2.0, afp.deg(10)), size=(0.4, afp.cm(40)), height=0.5, mass=1.5)
    .mover("walker", (4.0, 3.0), size=(0.3, 0.3), height=1.7, by=[(-1.0, 0.0), (-1.0, -0.5)], speed=0.3, wait=2.0, start=1.0, closed=True)
    .polygon("wedge", [(1.0, 3.0), (1.5, 3.0), (1.2, 3.4)], height=0.1)
    .patch([(2.5, 2.5), (3.0, 2.5), (3.0, 3.0)], "#ff0000", name="red")
    .infrared("beacon", (4.5, 0.5), height=1.0, strength=2.0)
)


def test_a_world_equals_the_toml_that_it_writes(tmp_path: Path) -> None:
    world = EVERYTHING.build()
    assert world == afp.World.parse(EVERYTHING.toml) == EVERYTHING.save(tmp_path / "hall.toml")
    assert (tmp_path / "hall.toml").read_text(encoding="utf-8") == EVERYTHING.toml
    assert world.name == 'A "hall"\n\x7fä'
    assert world.start == pytest.approx((0.8, 0.8, math.radians(20)), abs=1e-12)
    assert world.obstacles == ["room", "room", "room", "room", "stub", "crate", "walker", "wedge"]
    assert "pose_m_deg = [0.8, 0.8, 20.0]" in EVERYTHING.toml
    assert pickle.loads(pickle.dumps(world)) == world


def test_every_key_of_a_world_file_can_be_written() -> None:
    """Every key of the format can be written, except `map`, which only maps have."""
    written = {line.split(" = ")[0] for line in EVERYTHING.toml.splitlines() if " = " in line}
    schema = (Path(__file__).resolve().parents[1] / "worlds/world.schema.json").read_text(encoding="utf-8")
    import json

    known: set[str] = set()

    def walk(part: object) -> None:
        if isinstance(part, dict):
            known.update(part.get("properties", {}))
            for inner in part.values():
                walk(inner)
        elif isinstance(part, list):
            for inner in part:
                walk(inner)

    walk(json.loads(schema))
    tables = {"robot", "floor", "wall", "box", "polygon", "patch", "infrared", "map", "corners_m"}
    inline = {"by_m", "speed_m_s", "closed", "wait_s", "start_s"}
    assert all(f"{key} = " in EVERYTHING.toml for key in inline)
    assert known - tables - inline - {"$schema"} <= written


def test_a_builder_is_a_value() -> None:
    empty = afp.WorldBuilder("hall", start=(1.0, 1.0)).room(4.0, 4.0)
    one, two = (empty.box("crate", (x, 3.0), size=(0.4, 0.4), height=0.5) for x in (2.0, 3.0))
    assert empty.build().obstacles == ["room"] * 4
    assert one != two and one == empty.box("crate", (2.0, 3.0), size=(0.4, 0.4), height=0.5)
    assert repr(one) == "<WorldBuilder 'hall': 2 added>"
    assert one._repr_svg_() == one.build()._repr_svg_() and ">hall<" in one._repr_svg_()


def test_an_invalid_part_is_reported_when_it_is_added() -> None:
    hall = afp.WorldBuilder("hall", start=(1.0, 1.0)).room(4.0, 4.0)
    with pytest.raises(afp.AfpError, match="^the box 'crate': the robot starts inside of 'crate'$"):
        hall.box("crate", (1.0, 1.0), size=(0.4, 0.4), height=0.5)
    crowded = hall.box(None, (3.0, 3.0), size=(0.4, 0.4), height=0.5)
    with pytest.raises(afp.AfpError, match="^the box: the robot starts inside of 'box 2'$"):
        crowded.box(None, (1.0, 1.0), size=(0.4, 0.4), height=0.5)
    with pytest.raises(afp.AfpError, match="^the polygon 'dent': "):
        hall.polygon("dent", [(2.0, 2.0), (3.0, 2.0), (2.2, 2.2), (2.0, 3.0)], height=1.0)
    with pytest.raises(afp.AfpError, match="^the patch: color: 'red' is not a colour"):
        hall.patch([(2.0, 2.0), (3.0, 2.0), (2.0, 3.0)], "red")
    with pytest.raises(TypeError, match="height is in m, not a quantity in rad"):
        hall.box("crate", (2.0, 2.0), size=(0.4, 0.4), height=afp.deg(30))
    with pytest.raises(TypeError, match="at is in rad, not a quantity in m"):
        hall.box("crate", (2.0, 2.0, afp.cm(1)), size=(0.4, 0.4), height=0.5)
    with pytest.raises(ValueError, match="size has x and y"):
        hall.box("crate", (2.0, 2.0), size=(0.4, 0.4, 0.4), height=0.5)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="at has x, y and perhaps a heading"):
        hall.box("crate", (2.0,), size=(0.4, 0.4), height=0.5)
    with pytest.raises(ValueError, match="charge is inf"):
        afp.WorldBuilder("hall", start=(1.0, 1.0), charge=math.inf)


def test_each_part_is_checked_once_before_the_build(monkeypatch: pytest.MonkeyPatch) -> None:
    from afp import builder

    read: list[int] = []

    class Counted:
        @staticmethod
        def parse(text: str) -> afp.World:
            read.append(len(text))
            return afp.World.parse(text)

    monkeypatch.setattr(builder, "World", Counted)
    hall = afp.WorldBuilder("hall", start=(1.0, 1.0)).room(40.0, 40.0)
    for n in range(100):
        hall = hall.box(f"crate {n}", (2.0 + n / 4, 3.0), size=(0.1, 0.1), height=0.5)
    assert max(read) < 400 and len(hall.build().obstacles) == 104 and max(read) > 5000


def test_built_worlds_can_be_swept(wall_following: afp.Plan) -> None:
    hall = afp.WorldBuilder("hall", start=(1.0, 1.0)).room(4.0, 4.0)
    worlds = [hall.box("crate", (2.0, y), size=(0.4, 0.4), height=0.5).build() for y in (1.0, 3.0)]
    runs = afp.sweep(wall_following, seeds=2, worlds=worlds, until=5.0, progress=False)
    assert len(runs) == 4
    for index, world in enumerate(worlds):
        alone = afp.Simulation(wall_following, world, seed=1).run(until=5.0)
        assert runs.result(2 * index + 1).trace_hash == alone.trace_hash


def test_worlds_with_equal_contents_are_equal() -> None:
    assert afp.World.random(7) == afp.World.random(7) != afp.World.random(8)
    assert len({afp.World.random(7), afp.World.random(7)}) == 1
    assert afp.World.random(7) != "random:7"
