"""`WorldBuilder`: worlds for the Carbot, put together in the program."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ._afp import AfpError, World, write_text
from .units import number_in

__all__ = ["WorldBuilder"]

Point = tuple[float, float]


class WorldBuilder:
    """A world that is being put together. Each method gives a new one with something more in it; `build` gives the world.

    Lengths are metres and angles radians, plain or as `afp.cm(30)` and `afp.deg(20)`. What is wrong is said at once, by the
    method that adds it. `toml` is the text of the world's file; the world that is read from it is the same.

    >>> hall = WorldBuilder("Hall", start=(0.8, 0.8)).room(5.0, 4.0).box("crate", (2.0, 2.0), size=(0.4, 0.4), height=0.5)
    >>> hall.build()
    <World 'Hall', 5 obstacles>
    >>> World.parse(hall.toml) == hall.build()
    True
    """

    def __init__(
        self,
        name: str,
        *,
        start: Sequence[float],
        charge: float | None = None,
        floor: str | None = None,
        floor_texture: str | None = None,
    ) -> None:
        self._name = name
        head: dict[str, Any] = {"version": 1, "name": _text("name", name)}
        robot = {"pose_m_deg": _pose("start", start), "charge": number_in("charge", charge)}
        look = {"color": floor, "texture": floor_texture}
        self._parts: tuple[str, ...] = (_lines(head), _table("[robot]", robot))
        if any(look.values()):
            self._parts += (_table("[floor]", look),)
        self._check(f"the world '{name}'")

    def wall(
        self,
        points: Iterable[Point],
        *,
        name: str | None = None,
        closed: bool = False,
        thickness: float | None = None,
        height: float | None = None,
        color: str | None = None,
        texture: str | None = None,
        echo: float | None = None,
        mapped: bool | None = None,
    ) -> WorldBuilder:
        """A wall from point to point; `closed` leads back to the first."""
        table = {
            "name": name,
            "points_m": _points("points", points),
            "closed": closed or None,
            "thickness_m": number_in("thickness", thickness, "m"),
            "height_m": number_in("height", height, "m"),
            **_surface(color, texture, echo, mapped),
        }
        return self._with("wall", table)

    def room(self, length: float, width: float, *, name: str = "room", **more: Any) -> WorldBuilder:
        """Four walls, from the origin to (length, width); `more` is as for `wall`."""
        far = [number_in("length", length, "m"), number_in("width", width, "m")]
        corners = [(0.0, 0.0), (far[0], 0.0), (far[0], far[1]), (0.0, far[1])]
        return self.wall(corners, name=name, closed=True, **more)

    def box(
        self,
        name: str | None,
        at: Sequence[float],
        *,
        size: Point,
        height: float,
        mass: float | None = None,
        path: Mapping[str, Any] | None = None,
        color: str | None = None,
        texture: str | None = None,
        echo: float | None = None,
        mapped: bool | None = None,
    ) -> WorldBuilder:
        """A box around a place (x, y, perhaps heading). With `mass` (kg) it can be pushed; see `mover` for `path`."""
        table = {
            "name": name,
            "pose_m_deg": _pose("at", at),
            "size_m": _point("size", size),
            "height_m": number_in("height", height, "m"),
            "mass_kg": number_in("mass", mass),
            "path": path,
            **_surface(color, texture, echo, mapped),
        }
        return self._with("box", table)

    def mover(
        self,
        name: str | None,
        at: Sequence[float],
        *,
        size: Point,
        height: float,
        by: Iterable[Point],
        speed: float,
        closed: bool = False,
        wait: float | None = None,
        start: float | None = None,
        **more: Any,
    ) -> WorldBuilder:
        """A box that goes its own way: to places seen from its start, there and back or, `closed`, round and round.

        It waits `wait` seconds at each place, and sets out after `start`.
        """
        path = {
            "by_m": _points("by", by),
            "speed_m_s": number_in("speed", speed, "m/s"),
            "closed": closed or None,
            "wait_s": number_in("wait", wait, "s"),
            "start_s": number_in("start", start, "s"),
        }
        return self.box(name, at, size=size, height=height, path=path, **more)

    def polygon(
        self,
        name: str | None,
        points: Iterable[Point],
        *,
        height: float,
        mass: float | None = None,
        color: str | None = None,
        texture: str | None = None,
        echo: float | None = None,
        mapped: bool | None = None,
    ) -> WorldBuilder:
        """Something with these corners, which must be convex."""
        table = {
            "name": name,
            "points_m": _points("points", points),
            "height_m": number_in("height", height, "m"),
            "mass_kg": number_in("mass", mass),
            **_surface(color, texture, echo, mapped),
        }
        return self._with("polygon", table)

    def patch(self, points: Iterable[Point], color: str, *, name: str | None = None) -> WorldBuilder:
        """A patch of colour on the floor, `#rrggbb`; the last one lies on top."""
        return self._with("patch", {"name": name, "points_m": _points("points", points), "color": color})

    def infrared(
        self,
        name: str | None,
        at: Point,
        *,
        height: float | None = None,
        strength: float | None = None,
    ) -> WorldBuilder:
        """A source of infrared light; one of strength 1 reads as 1 at one metre."""
        table = {
            "name": name,
            "position_m": _point("at", at),
            "height_m": number_in("height", height, "m"),
            "strength": number_in("strength", strength),
        }
        return self._with("infrared", table)

    @property
    def toml(self) -> str:
        """The text of the world's file."""
        return "\n".join(self._parts)

    def build(self) -> World:
        """The world."""
        return World.parse(self.toml)

    def save(self, path: str | os.PathLike[str]) -> World:
        """Writes the world's file, for `afpc run --world` and the like, and reads it."""
        if os.path.splitext(os.fspath(path))[1] != ".toml":
            raise ValueError(f"a world is saved as .toml, not as {os.fspath(path)!r}")
        write_text("cannot write the world", path, self.toml)
        return World.load(path)

    def _with(self, kind: str, table: Mapping[str, Any]) -> WorldBuilder:
        more = WorldBuilder.__new__(WorldBuilder)
        more._name = self._name
        more._parts = (*self._parts, _table(f"[[{kind}]]", table))
        more._check(f"the {kind} '{table['name']}'" if table.get("name") else f"the {kind}")
        return more

    def _check(self, what: str) -> None:
        """Reads the last part with the start alone, so that many things take no time by the square of their number."""
        start = self._parts[:2]
        try:
            World.parse("\n".join([*start, *self._parts[len(start) :][-1:]]))
        except AfpError:
            self._check_all(what)

    def _check_all(self, what: str) -> None:
        """Says what is wrong, by the names that unnamed things have in the whole."""
        try:
            World.parse(self.toml)
        except AfpError as why:
            # The place in a text that nobody wrote says nothing.
            message = str(why).split(": ", 1)[-1]
            raise AfpError(f"{what}: {message}") from None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, WorldBuilder) and other.toml == self.toml

    def __hash__(self) -> int:
        return hash(self.toml)

    def _repr_svg_(self) -> str:
        return self.build()._repr_svg_()

    def __repr__(self) -> str:
        return f"<WorldBuilder '{self._name}': {len(self._parts) - 2} added>"


def _surface(color: str | None, texture: str | None, echo: float | None, mapped: bool | None) -> dict[str, Any]:
    return {"color": color, "texture": texture, "echo": number_in("echo", echo), "mapped": mapped}


def _point(what: str, point: Sequence[float]) -> list[Any]:
    numbers = [number_in(what, number, "m") for number in point]
    if len(numbers) != 2:
        raise ValueError(f"{what} has x and y, two numbers, not {len(numbers)}")
    return numbers


def _points(what: str, points: Iterable[Sequence[float]]) -> list[list[Any]]:
    return [_point(what, point) for point in points]


def _pose(what: str, pose: Sequence[float]) -> list[Any]:
    """Degrees in the file, without the last digits of the conversion."""
    if len(pose) not in (2, 3):
        raise ValueError(f"{what} has x, y and perhaps a heading, not {len(pose)} numbers")
    heading = number_in(what, pose[2], "rad") if len(pose) == 3 else 0.0
    return [*_point(what, pose[:2]), round(math.degrees(heading), 10)]


def _text(what: str, text: Any) -> str:
    if not isinstance(text, str):
        raise TypeError(f"{what} is a text, not {text!r}")
    return text


def _toml(value: Any) -> str:
    if isinstance(value, str):
        # As in JSON, but for the one control character that JSON lets through.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        inner = ", ".join(f"{key} = {_toml(part)}" for key, part in value.items() if part is not None)
        return f"{{ {inner} }}"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(_toml(part) for part in value)}]"
    return repr(value)


def _lines(table: Mapping[str, Any]) -> str:
    return "".join(f"{key} = {_toml(value)}\n" for key, value in table.items() if value is not None)


def _table(head: str, table: Mapping[str, Any]) -> str:
    return f"{head}\n{_lines(table)}"
