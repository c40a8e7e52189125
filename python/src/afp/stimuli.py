"""Stimuli as values: faults of devices, and presses of controls.

The same values describe the events of a simulation, in every run of a sweep, in a scored plan and
in the episodes of an environment.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, TypeVar

import numpy as np

from .checks import text
from .units import moment, number_in, seconds

__all__ = ["Fault", "Faults", "Press", "Presses", "several"]

HOLD = 0.2
"""The duration of a press, in seconds."""


@dataclass(frozen=True)
class Fault:
    """A fault of a device, permanently or for a while: `Fault("wheels", "slip", share=0.3, at=2.0)`.

    `afp.faults()` lists all pairs of device and kind.
    """

    device: str
    """The device."""
    kind: str
    """The kind of fault."""
    _: KW_ONLY
    at: float | None = None
    """When it begins, in seconds since the start; by default now or at the start."""
    lasting: float | None = None
    """How long it lasts, in seconds; by default to the end of the run."""
    delay: float | None = None
    """The delay in seconds, for `delayed` and `slow`."""
    share: float | None = None
    """The share from 0 to 1, for `slip` and `low`."""

    def __post_init__(self) -> None:
        _set(self, device=text("a device", self.device), kind=text("a kind", self.kind))
        _set(self, **{name: moment(name, getattr(self, name)) for name in ("at", "lasting", "delay")})
        _set(self, share=None if self.share is None else number_in("share", self.share))

    def starting(self, at: float) -> Fault:
        """The same fault at another time, in seconds since the start."""
        return replace(self, at=at)

    @property
    def _axis(self) -> str:
        return f"fail.{self.device}.{self.kind}"

    def _point(self) -> str:
        """The part of the command-line syntax after the fault's name."""
        begin = self.at or 0.0
        amount = f"={_shown(self.delay)}s" if self.delay is not None else "" if self.share is None else f"={_shown(self.share)}"
        end = "" if self.lasting is None else f"..{_shown(begin + self.lasting)}s"
        return f"{amount}@{_shown(begin)}s{end}"

    def _spelled(self) -> str:
        return f"{self.device}.{self.kind}{self._point()}"


@dataclass(frozen=True)
class Press:
    """A press of a control: `Press("touch", at=1.5)`; the default is the control that ends a run.

    The Carbot has the button `escape` and the bumper, `touch`.
    """

    control: str | None = None
    """The control."""
    _: KW_ONLY
    at: float | None = None
    """When it begins, in seconds since the start; by default now or at the start."""
    hold: float = HOLD
    """How long it lasts, in seconds."""

    def __post_init__(self) -> None:
        _set(self, control=None if self.control is None else text("a control", self.control))
        _set(self, at=moment("at", self.at), hold=seconds("hold", self.hold))

    def starting(self, at: float) -> Press:
        """The same press at another time, in seconds since the start."""
        return replace(self, at=at)

    @property
    def _axis(self) -> str:
        return f"press.{self._name()}"

    def _point(self) -> str:
        return f"@{_shown(self.at or 0.0)}s"

    def _spelled(self) -> str:
        return f"{self._name()}{self._point()}"

    def _name(self) -> str:
        """The control for a sweep, which needs its name and knows one duration."""
        if self.hold != HOLD:
            raise ValueError(f"a sweep holds controls for {HOLD} s, not for {self.hold} s")
        if self.control is None:
            raise ValueError('name the control in a sweep: afp.Press("escape")')
        return self.control


Stimulus = TypeVar("Stimulus", Fault, Press)

Faults = Iterable[Fault] | Callable[[np.random.Generator], Iterable[Fault]]
"""Faults, or a function that draws them from a random generator."""
Presses = Iterable[Press] | Callable[[np.random.Generator], Iterable[Press]]
"""Presses, or a function that draws them from a random generator."""


def several(kind: type[Stimulus], given: Any) -> list[Stimulus]:
    """Check a list of faults or presses."""
    if isinstance(given, kind):
        raise TypeError(f"give a list, also for one {kind.__name__}: [{given!r}]")
    if not isinstance(given, Iterable) or isinstance(given, str):
        raise TypeError(f"give a list of afp.{kind.__name__}, not {given!r}")
    these = list(given)
    for one in these:
        if not isinstance(one, kind):
            such = 'afp.Fault("wheels", "slip", share=0.5)' if kind is Fault else 'afp.Press("touch", at=1.0)'
            raise TypeError(f"give an afp.{kind.__name__}, such as {such}, not {one!r}")
    return these


def _set(stimulus: object, **values: Any) -> None:
    for name, value in values.items():
        object.__setattr__(stimulus, name, value)


def _shown(number: float) -> str:
    """A number without an exponent."""
    return f"{number:.9f}".rstrip("0").rstrip(".")
