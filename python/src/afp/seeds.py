"""Seeds for the native half."""

from __future__ import annotations

import operator

__all__ = ["MOST", "seed_of"]

MOST = 2**64 - 1
"""The last seed."""


def seed_of(seed: int) -> int:
    """Check a seed; an invalid one is rejected with its value."""
    try:
        number = operator.index(seed)
    except TypeError:
        raise TypeError(f"a seed is a whole number, not {seed!r}") from None
    if not 0 <= number <= MOST:
        raise ValueError(f"{number} is not a seed; seeds go from 0 to 2**64 - 1")
    return number
