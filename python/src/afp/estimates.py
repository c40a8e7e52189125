"""Means, shares and paired differences with confidence intervals."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np

__all__ = ["Estimate", "difference", "mean", "share"]


@dataclass(frozen=True)
class Estimate:
    """An estimated number with its confidence interval."""

    value: float
    """The estimate; not a number without observations."""
    low: float
    """The lower end of the interval."""
    high: float
    """The upper end of the interval."""
    count: int
    """The number of observations."""

    @property
    def bars(self) -> tuple[float, float]:
        """The distances of both ends from the estimate, for error bars."""
        return self.value - self.low, self.high - self.value

    def __repr__(self) -> str:
        return f"<Estimate {self.value:.3g} [{self.low:.3g}, {self.high:.3g}] of {self.count}>"


def mean(values: Iterable[Any], confidence: float = 0.95) -> Estimate:
    """The mean of independent values, with Student's interval; missing values do not count.

    >>> mean([1.0, 2.0, 3.0, 4.0, None])
    <Estimate 2.5 [0.446, 4.55] of 4>
    """
    _check(confidence)
    found = _numbers(values)
    found = found[~np.isnan(found)]
    count = len(found)
    if count < 2:
        value = float(found[0]) if count else math.nan
        return Estimate(value, -math.inf if count else math.nan, math.inf if count else math.nan, count)
    value, error = float(found.mean()), float(found.std(ddof=1)) / math.sqrt(count)
    width = _student(1 - (1 - confidence) / 2, count - 1) * error
    return Estimate(value, value - width, value + width, count)


def share(hits: Iterable[Any], confidence: float = 0.95) -> Estimate:
    """The share of true values, with Wilson's interval, such as a success rate.

    >>> share([True, True, False, True])
    <Estimate 0.75 [0.301, 0.954] of 4>
    """
    _check(confidence)
    found = [bool(hit) for hit in hits]
    count = len(found)
    if not count:
        return Estimate(math.nan, math.nan, math.nan, 0)
    z = NormalDist().inv_cdf(1 - (1 - confidence) / 2)
    value = sum(found) / count
    middle = (value + z * z / (2 * count)) / (1 + z * z / count)
    width = z / (1 + z * z / count) * math.sqrt(value * (1 - value) / count + z * z / (4 * count * count))
    return Estimate(value, max(0.0, middle - width), min(1.0, middle + width), count)


def difference(first: Iterable[Any], second: Iterable[Any], confidence: float = 0.95) -> Estimate:
    """The mean difference `second - first` of paired values, such as results for equal seeds.

    A pair with a missing value does not count.

    >>> difference([1.0, 2.0, 4.0], [1.5, 2.5, 5.0]).value
    0.6666666666666666
    """
    before, after = _numbers(first), _numbers(second)
    if len(before) != len(after):
        raise ValueError(f"these are {len(before)} and {len(after)} values, and pairs need equally many")
    return mean(after - before, confidence)


def _numbers(values: Iterable[Any]) -> Any:
    return np.array([math.nan if value is None else float(value) for value in values])


def _check(confidence: float) -> None:
    if not 0 < confidence < 1:
        raise ValueError(f"confidence is {confidence}; give a number between 0 and 1, such as 0.95")


def _student(probability: float, freedom: int) -> float:
    """The quantile of Student's distribution, by bisection of its distribution function."""
    low, high = 0.0, 1e6
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if _below(middle, freedom) < probability else (low, middle)
    return (low + high) / 2


def _below(t: float, freedom: int) -> float:
    """The distribution function of Student's distribution for t from 0 on (Abramowitz and Stegun,
    26.7.3 and 26.7.4).
    """
    angle = math.atan(t / math.sqrt(freedom))
    cos, sin = math.cos(angle), math.sin(angle)
    odd = freedom % 2 == 1
    term, total = (cos, 0.0) if odd else (1.0, 0.0)
    for step in range(1 if not odd else 2, freedom, 2):
        total += term
        term *= cos * cos * step / (step + 1)
    if odd:
        inside = 2 / math.pi * (angle + sin * (total if freedom > 1 else 0.0))
    else:
        inside = sin * total
    return 0.5 + inside / 2
