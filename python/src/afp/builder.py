"""`WorldBuilder`: worlds for the Carbot, built in Python."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ._afp import AfpError, World, write_text
from .units import heading_in, number_in

__all__ = ["WorldBuilder"]

Point = tuple[float, float]


class WorldBuilder:
    """A world under construction. Each method returns a new builder with one more part; `build`
    returns the world.

    Lengths are metres and angles are radians, as plain numbers or as `afp.cm(30)` and
    `afp.deg(20)`. An invalid part raises at once, in its own method. `toml` is the text of the
    world's file, which reads as the same world.

    `length`, `width`, `track`, `fastest` (metres a second), `sonar` and `encoders` describe the
    robot, by default the Carbot. `wheelbase` and `steering` (an angle) make it a car.

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
        length: float | None = None,
        width: float | None = None,
        track: float | None = None,
        wheelbase: float | None = None,
        steering: float | None = None,
        fastest: float | None = None,
        sonar: float | None = None,
        encoders: bool | None = None,
        floor: str | None = None,
        floor_texture: str | None = None,
    ) -> None:
        self._name = name
        head: dict[str, Any] = {"version": 1, "name": _text("name", name)}
        robot = {
            "pose_m_deg": _pose("start", start),
            "charge": number_in("charge", charge),
            "length_m": number_in("length", length, "m"),
            "width_m": number_in("width", width, "m"),
            "track_m": number_in("track", track, "m"),
            "wheelbase_m": number_in("wheelbase", wheelbase, "m"),
            "steering_deg": None if steering is None else round(math.degrees(steering), 10),
            "fastest_m_s": number_in("fastest", fastest, "m/s"),
            "sonar_m": number_in("sonar", sonar, "m"),
            "encoders": encoders,
        }
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
        """Add a wall from point to point; `closed` connects the last one to the first."""
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
        """Add four walls, from the origin to (length, width); `more` is as for `wall`."""
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
        """Add a box at a place (x, y, optional heading). With `mass` (kg) it can be pushed; see
        `mover` for `path`.
        """
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
        """Add a box that moves to places relative to its start, there and back or, with `closed`,
        in a circle.

        It waits `wait` seconds at each place, and sets out after `start` seconds.
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
        """Add a convex polygon with these corners."""
        table = {
            "name": name,
            "points_m": _points("points", points),
            "height_m": number_in("height", height, "m"),
            "mass_kg": number_in("mass", mass),
            **_surface(color, texture, echo, mapped),
        }
        return self._with("polygon", table)

    def patch(self, points: Iterable[Point], color: str, *, name: str | None = None) -> WorldBuilder:
        """Add a patch of colour on the floor, `#rrggbb`; the last one is on top."""
        return self._with("patch", {"name": name, "points_m": _points("points", points), "color": color})

    def infrared(
        self,
        name: str | None,
        at: Point,
        *,
        height: float | None = None,
        strength: float | None = None,
    ) -> WorldBuilder:
        """Add a source of infrared light; a strength of 1 reads as 1 at a distance of one metre."""
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
        """Build the world."""
        return World.parse(self.toml)

    def save(self, path: str | os.PathLike[str]) -> World:
        """Write the world's file, for example for `afpc run --world`, and read it."""
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
        """Check only the last part with the start, so that checks of many parts take linear time."""
        start = self._parts[:2]
        try:
            World.parse("\n".join([*start, *self._parts[len(start) :][-1:]]))
        except AfpError:
            self._check_all(what)

    def _check_all(self, what: str) -> None:
        """Check the whole, with the final names of unnamed parts."""
        try:
            World.parse(self.toml)
        except AfpError as why:
            # Positions in generated text are useless.
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
    """Convert to degrees for the file, without rounding noise."""
    if len(pose) not in (2, 3):
        raise ValueError(f"{what} has x, y and perhaps a heading, not {len(pose)} numbers")
    heading = heading_in(what, pose[2]) if len(pose) == 3 else 0.0
    return [*_point(what, pose[:2]), round(math.degrees(heading), 10)]


def _text(what: str, text: Any) -> str:
    if not isinstance(text, str):
        raise TypeError(f"{what} must be a string, not {text!r}")
    return text


def _toml(value: Any) -> str:
    if isinstance(value, str):
        # As in JSON, except for the only control character that JSON allows.
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
