"""The picture of a room from above, with the robot in it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .._afp import Carbot, World
from .setting import PIXELS

__all__ = ["draw", "with_robot"]

GOAL = (204, 121, 167)
WALL = (90, 90, 90)
MOVES = (140, 120, 90)

Moving = Sequence[tuple[int, NDArray[np.float64]]]
"""The moving obstacles: their numbers and current corners."""


def _frame(world: World) -> tuple[float, float, float]:
    """The lower left corner and metres per pixel, so that everything fits with a margin."""
    points = np.vstack([*world.outlines(), [world.start[:2]]])
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max()) * 1.04 + 0.1
    left, bottom = (low + high) / 2 - size / 2
    return float(left), float(bottom), size / PIXELS


def _centres(world: World) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The middle of each pixel, with rows from the top."""
    left, bottom, metres = _frame(world)
    along = (np.arange(PIXELS) + 0.5) * metres
    x, y = np.meshgrid(left + along, bottom + along[::-1])
    return x, y


def draw(world: World, target: tuple[float, float] | None, moving: Moving) -> NDArray[np.uint8]:
    """The room without moving things, with the target."""
    left_out = {number for number, _ in moving}
    picture = np.full((PIXELS, PIXELS, 3), 245, np.uint8)
    x, y = _centres(world)
    for number, corners in enumerate(world.outlines()):
        if number not in left_out:
            picture[_inside(corners, x, y)] = WALL
    if target is not None:
        picture[np.hypot(x - target[0], y - target[1]) < 0.12] = GOAL
    return picture


def _inside(
    corners: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """The points inside a polygon, which have an odd number of edges to their right."""
    inside = np.zeros(x.shape, np.bool_)
    for (x1, y1), (x2, y2) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if y1 != y2:
            spans = (y1 > y) != (y2 > y)
            inside ^= spans & (x < x1 + (y - y1) * (x2 - x1) / (y2 - y1))
    return inside


def with_robot(
    background: NDArray[np.uint8], world: World, pose: Sequence[float], moving: Moving
) -> NDArray[np.uint8]:
    """The picture with the moving things and the robot: its body, with a brighter front."""
    picture = background.copy()
    x, y = _centres(world)
    for _, corners in moving:
        picture[_inside(corners, x, y)] = MOVES
    dx, dy = x - pose[0], y - pose[1]
    ahead = dx * math.cos(pose[2]) + dy * math.sin(pose[2])
    aside = dy * math.cos(pose[2]) - dx * math.sin(pose[2])
    length, width = Carbot.half_length, Carbot.half_width
    body = (abs(ahead) <= length) & (abs(aside) <= width)
    picture[body] = (0, 114, 178)
    picture[body & (ahead > length / 2)] = (213, 94, 0)
    return picture
