"""Values that are invalid, or just valid."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from hypothesis import strategies as st

import afp


class Planned(BaseException):
    """An exception that a test raises on purpose, and that no `except Exception` catches."""


class Evil:
    """Raises on every access."""

    def __init__(self, kind: type[BaseException]) -> None:
        self.kind = kind

    def _raise(self, *_: object) -> NoReturn:
        raise self.kind("on purpose")

    __float__ = __index__ = __str__ = __fspath__ = __iter__ = __len__ = __bool__ = __eq__ = _raise  # type: ignore[assignment]
    __getitem__ = __call__ = __hash__ = _raise  # type: ignore[assignment]

    def __getattr__(self, name: str) -> NoReturn:
        self._raise()

    def __repr__(self) -> str:
        return f"Evil({self.kind.__name__})"


class Sealed:
    """A value that nothing may touch before its use, including hypothesis."""

    def __init__(self, thing: Any) -> None:
        self.thing = thing

    def __repr__(self) -> str:
        return repr(self.thing)


def opened(value: Any) -> Any:
    """The value inside `value`."""
    return value.thing if isinstance(value, Sealed) else value


class EvilNumber(float):
    """A number whose unit raises."""

    @property
    def unit(self) -> str:
        raise Planned("unit")


NUMBERS: list[Any] = [0, 1, 3, -1, True, 0.05, -0.5, 1e-9, 2**31, 2**63, 2**64 - 1, 2**64, 10**30, 1e300]
NUMBERS += [float("nan"), float("inf"), -float("inf"), np.float32(0.25), np.int64(2)]
TEXTS: list[Any] = ["", "x", "go", "P", "go.touch", "number", "Done", "35cm", "1 s", "plan", "random:3", "\0", "\ud800"]
TEXTS += ["ultrasonic", "frozen", "distance", "ä" * 300, "use carbot", "30 cm"]
OTHERS: list[Any] = [None, b"x", [], [1], [None], ["go"], {}, {"a": 1}, {"number": 2.0}, {1: 2}, (), ("Done", {}), ...]
OTHERS += [afp.cm(30), afp.deg(3), afp.Quantity(1.0, "?"), np.zeros(0), np.ones(3), Path("nowhere"), int, len, range(3)]
OTHERS += [Sealed(Evil(kind)) for kind in (Planned, ValueError, KeyboardInterrupt)]
OTHERS += [Sealed(EvilNumber(1.0)), object(), range(0, 9, 2), afp.cm]

value = st.sampled_from([*NUMBERS, *TEXTS, *OTHERS])
"""Any of them."""
