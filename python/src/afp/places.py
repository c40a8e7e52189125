"""The world argument of a run: a file, a string such as `random:7`, or a World."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from ._afp import World
from .units import heading_in, number_in, plain, spelled

Place = World | str | os.PathLike[str]
"""A world, or where it is read from."""


def place_of(world: object) -> World | str:
    """The world, or the string that names it."""
    if isinstance(world, World):
        return world
    if hasattr(world, "build"):
        raise TypeError(f"call build() of {world!r} to make a world")
    if not isinstance(world, (str, os.PathLike)):
        raise TypeError(f"a world must be a file, a string such as 'random:7', or a World, not {world!r}")
    return os.fspath(world)


OF_WORLD = "world."
"""The prefix of values of the world's file, to distinguish them from entries."""


def changed(
    world: World, values: dict[str, Any], start: Sequence[float] | None
) -> tuple[World, dict[str, Any], list[tuple[str, str]]]:
    """Split values into those of the world and those of entries: returns the changed world with its
    start, the entries' values, and all values for the log.
    """
    own = [(name.removeprefix(OF_WORLD), spelled(values[name])) for name in values if _is_of_world(name)]
    if own or start is not None:
        world = world._changed(own, None if start is None else _pose(start))
    entries = {name: value for name, value in values.items() if not _is_of_world(name)}
    return world, entries, [(name, _shown(value)) for name, value in values.items()]


def _pose(start: Sequence[float]) -> tuple[float, float, float]:
    if isinstance(start, str) or not isinstance(start, (Sequence, np.ndarray)) or len(start) not in (2, 3):
        raise TypeError(f"start is x, y and perhaps a heading, such as (1.0, 2.0, afp.deg(90)), not {start!r}")
    x, y, heading = [*start, 0.0][:3]
    return number_in("start", x, "m"), number_in("start", y, "m"), heading_in("start", heading)


def _shown(value: Any) -> str:
    try:
        text = spelled(value) if isinstance(plain(value), (str, int, float)) else str(value)
    except ValueError:
        text = str(value)
    # The plan reports an invalid text.
    return text.encode("utf-8", "replace").decode()


def _is_of_world(name: object) -> bool:
    return isinstance(name, str) and name.startswith(OF_WORLD)
