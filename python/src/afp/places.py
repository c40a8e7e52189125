"""Where a plan runs, as people give it: a file, a text such as `random:7`, or a World."""

from __future__ import annotations

import os

from ._afp import World

Place = World | str | os.PathLike[str]
"""A world, or where it is read from."""


def place_of(world: object) -> World | str:
    """The world, or the text that names it."""
    if isinstance(world, World):
        return world
    if not isinstance(world, (str, os.PathLike)):
        raise TypeError(f"a world is a file, a text such as 'random:7', or a World, not {world!r}")
    return os.fspath(world)
