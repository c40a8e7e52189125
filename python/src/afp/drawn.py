"""Values, presses and faults that a sweep draws for each seed, as axes of the native half."""

from __future__ import annotations

import math
import operator
import zlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .stimuli import Fault, Faults, Press, Presses, Stimulus, several
from .units import Quantity

__all__ = ["Axis", "axes", "each", "spelled", "text_of"]

Axis = tuple[str, str | list[tuple[str, str | None]], bool]
"""A name, a range or values with their units, and whether there is one value for each seed."""


def axes(seeds: Sequence[int], draw: Mapping[str, Any] | None, presses: Presses, faults: Faults) -> list[Axis]:
    """The axes of drawn values and stimuli."""
    if not isinstance(draw, (Mapping, type(None))):
        raise TypeError(f"draw gives entries functions of a random generator, such as {{'walldist': ...}}, not {draw!r}")
    made: list[Axis] = []
    for name, given in (draw or {}).items():
        made.append((name, _points(name, given, seeds), True))
    made += _lists("press.*", Press, presses, seeds)
    made += _lists("fail.*", Fault, faults, seeds)
    return made


def _lists(name: str, kind: type[Stimulus], given: Any, seeds: Sequence[int]) -> list[Axis]:
    if not callable(given):
        return []
    every = [several(kind, drawn) for drawn in each(name, given, seeds)]
    return [(name, [(" ".join(stimulus._spelled() for stimulus in these), None) for these in every], True)]


def spelled(kind: type[Stimulus], given: Iterable[Any] | Callable[..., Any]) -> list[str]:
    """Stimuli of all runs as on the command line; drawn ones are in an axis."""
    return [] if callable(given) else [stimulus._spelled() for stimulus in several(kind, given)]


def _generator(name: str, seed: int) -> np.random.Generator:
    # Each name has its own stream, so that another draw changes nothing.
    return np.random.default_rng([zlib.crc32(name.encode()), seed])


def each(name: str, function: Callable[[np.random.Generator], Any], seeds: Sequence[int]) -> list[Any]:
    """The values that a function draws for each seed."""
    return [function(_generator(name, seed)) for seed in seeds]


def _points(name: str, given: Any, seeds: Sequence[int]) -> list[tuple[str, str | None]]:
    """The value of an axis for each seed."""
    if callable(given):
        values = each(name, given, seeds)
    elif isinstance(given, Iterable) and not isinstance(given, str):
        values = list(given)
    else:
        what = f"'{name}' is drawn by a function of a random generator, or has a list with a value for each seed"
        raise TypeError(f"{what}, not {given!r}; vary= takes values for all seeds")
    if len(values) != len(seeds):
        raise ValueError(f"'{name}' has {len(values)} values for {len(seeds)} seeds; give one for each")
    return [_point(name, value, seed) for value, seed in zip(values, seeds, strict=True)]


def _point(name: str, value: Any, seed: int) -> tuple[str, str | None]:
    try:
        return text_of(value)
    except (TypeError, ValueError) as error:
        raise type(error)(f"the draw of '{name}' for seed {seed}: {error}") from None


def text_of(value: Any) -> tuple[str, str | None]:
    """A value as a string with its unit: empty for a bare number, `None` for a string."""
    if isinstance(value, (bool, np.bool_)):
        return ("true" if value else "false", None)
    if isinstance(value, Quantity):
        return (repr(float(value)), value.unit)
    if isinstance(value, str):
        return (value, None)
    number = operator.index(value) if hasattr(value, "__index__") else float(value)
    if not math.isfinite(number):
        raise ValueError(f"{number} cannot be tried")
    return (repr(number), "")
