"""Quantities: floats in SI units with their unit.

>>> cm(30)
Quantity(0.3, 'm')
>>> cm(30) + 0.1
0.4

Entries and ports accept only quantities of their own dimension; a plain float is in SI units.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Annotated, Any, Callable

import numpy as np

__all__ = [
    "Angle",
    "AngularSpeed",
    "Duration",
    "Length",
    "Quantity",
    "Speed",
    "cm",
    "deg",
    "deg_per_s",
    "kmh",
    "m",
    "m_per_s",
    "minutes",
    "mm",
    "ms",
    "rad",
    "rad_per_s",
    "s",
]


class Quantity(float):
    """A number in an SI unit. Multiples, quotients and sums of like quantities keep the unit; other
    operations give plain floats.

    >>> 2 * cm(30)
    Quantity(0.6, 'm')
    >>> cm(30) + mm(5)
    Quantity(0.305, 'm')
    >>> cm(30) / cm(15)
    2.0

    Without a unit it is a plain float.
    """

    __slots__ = ("unit",)
    unit: str

    def __new__(cls, value: float, unit: str | None = None) -> Quantity:
        if unit is None:
            # Code that creates results of the numbers' type, such as 'statistics', gets a plain float.
            return float(value)  # type: ignore[return-value]
        self = super().__new__(cls, value)
        self.unit = unit
        return self

    def __getnewargs__(self) -> tuple[float, str]:  # type: ignore[override]
        return (float(self), self.unit)

    def __repr__(self) -> str:
        return f"Quantity({float(self)!r}, {self.unit!r})"

    def __array_ufunc__(self, function: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        """Functions of numpy: operators behave as here, others give plain numbers."""
        if method == "__call__" and not options and function in _OPERATORS and len(inputs) <= 2:
            own, turned = _OPERATORS[function]
            first, *rest = inputs
            if isinstance(first, Quantity):
                return getattr(first, own)(*rest)
            return getattr(rest[0], turned)(first)
        units = {value.unit for value in inputs if isinstance(value, Quantity)}
        if len(units) > 1 and function not in _OF_ANY_UNITS:
            one, other = sorted(units)
            raise TypeError(f"numpy.{function.__name__} takes quantities of one unit, not one in {one} and one in {other}")
        numbers = [float(value) if isinstance(value, Quantity) else value for value in inputs]
        return getattr(function, method)(*numbers, **options)

    def _like(self, value: Any, other: object) -> Any:
        """`value` in the unit, if `other` has the same; quantities with different units have no
        sum.
        """
        if not isinstance(other, Quantity):
            return value
        if other.unit != self.unit:
            raise TypeError(f"a quantity in {self.unit} and one in {other.unit} cannot be added or subtracted")
        return Quantity(value, self.unit)

    def _scaled(self, value: Any, other: object) -> Any:
        """`value` in the unit, if `other` is a plain number."""
        is_number = isinstance(other, (int, float, np.number)) and not isinstance(other, Quantity)
        return Quantity(value, self.unit) if is_number and value is not NotImplemented else value

    def __neg__(self) -> Quantity:
        return Quantity(-float(self), self.unit)

    def __abs__(self) -> Quantity:
        return Quantity(abs(float(self)), self.unit)

    def __pos__(self) -> Quantity:
        return self

    def __round__(self, digits: Any = None) -> Any:
        return round(float(self)) if digits is None else Quantity(round(float(self), digits), self.unit)

    def __add__(self, other: Any) -> Any:
        return self._like(float(self) + plain_number(other), other)

    def __radd__(self, other: Any) -> Any:
        # The start value of sum() fits every unit.
        nothing = type(other) is int and other == 0
        return self if nothing else self._like(plain_number(other) + float(self), other)

    def __sub__(self, other: Any) -> Any:
        return self._like(float(self) - plain_number(other), other)

    def __rsub__(self, other: Any) -> Any:
        return plain_number(other) - float(self)

    def __mul__(self, other: Any) -> Any:
        return self._scaled(float(self) * plain_number(other), other)

    def __rmul__(self, other: Any) -> Any:
        return self._scaled(plain_number(other) * float(self), other)

    def _comparable(self, other: object) -> float:
        """The number of `other`, unless its unit differs."""
        if isinstance(other, Quantity) and other.unit != self.unit:
            raise TypeError(f"a quantity in {self.unit} and one in {other.unit} cannot be compared")
        return plain_number(other)  # type: ignore[no-any-return]

    def __lt__(self, other: Any) -> bool:
        return float(self) < self._comparable(other)

    def __le__(self, other: Any) -> bool:
        return float(self) <= self._comparable(other)

    def __gt__(self, other: Any) -> bool:
        return float(self) > self._comparable(other)

    def __ge__(self, other: Any) -> bool:
        return float(self) >= self._comparable(other)

    def __eq__(self, other: object) -> bool:
        return float(self) == plain_number(other) and self.unit == getattr(other, "unit", self.unit)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = float.__hash__

    def __truediv__(self, other: Any) -> Any:
        return self._scaled(float(self) / plain_number(other), other)

    def __rtruediv__(self, other: Any) -> Any:
        return plain_number(other) / float(self)


_OPERATORS: dict[np.ufunc, tuple[str, str]] = {
    np.add: ("__add__", "__radd__"),
    np.subtract: ("__sub__", "__rsub__"),
    np.multiply: ("__mul__", "__rmul__"),
    np.true_divide: ("__truediv__", "__rtruediv__"),
    np.negative: ("__neg__", ""),
    np.positive: ("__pos__", ""),
    np.absolute: ("__abs__", ""),
    np.less: ("__lt__", "__gt__"),
    np.less_equal: ("__le__", "__ge__"),
    np.greater: ("__gt__", "__lt__"),
    np.greater_equal: ("__ge__", "__le__"),
}
"""Functions of numpy that are operators, by the methods of a quantity on their left and on their right."""

_OF_ANY_UNITS: frozenset[np.ufunc] = frozenset(
    (np.multiply, np.true_divide, np.floor_divide, np.power, np.float_power, np.equal, np.not_equal)
)
"""Functions of numpy that take quantities of two units."""


def _number(name: str, value: float) -> float:
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{name}() takes a number, not {value!r}")
    if isinstance(value, Quantity):
        raise TypeError(f"{name}() takes a number, not a quantity in {value.unit}")
    return value


def plain_number(value: Any) -> Any:
    """A number without its unit and its numpy type; arrays become arrays of plain numbers."""
    value = plain(value)
    return float(value) if isinstance(value, Quantity) else value


def plain(value: Any) -> Any:
    """A numpy value as a Python value; other values unchanged."""
    return value.item() if isinstance(value, np.generic) else value


def seconds(what: str, value: float) -> float:
    """A time in seconds, plain or with its unit; `what` names it in the error."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
        raise TypeError(f"{what} is a time in seconds, such as 2.5 or afp.ms(300), not {value!r}")
    if getattr(value, "unit", "s") != "s":
        raise TypeError(f"{what} is a time in seconds, not a quantity in {value.unit}")  # type: ignore[attr-defined]
    return float(value)


def moment(what: str, value: float | None) -> float | None:
    """Like `seconds`, but optional."""
    return None if value is None else seconds(what, value)


def number_in(what: str, value: Any, unit: str | None = None) -> Any:
    """A finite number or `None`; a quantity with a different unit is rejected."""
    if value is None:
        return None
    if isinstance(value, Quantity) and value.unit != unit:
        wanted = "is a plain number" if unit is None else f"is in {unit}"
        raise TypeError(f"{what} {wanted}, not a quantity in {value.unit}")
    if isinstance(value, (str, bool)):
        raise TypeError(f"{what} is a number, not {value!r}")
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{what} is {number}; give a finite number")
    return number


def heading_in(what: str, value: Any) -> Any:
    """A heading in radians; a plain number of more than a turn is probably in degrees."""
    number = number_in(what, value, "rad")
    if number is not None and not isinstance(value, Quantity) and abs(number) > math.tau:
        raise ValueError(f"{what} has the heading {number:g} rad, more than a turn; write degrees as afp.deg({number:g})")
    return number


def spelled(value: object) -> str:
    """A value in plan syntax: strings are unchanged, plain numbers have no unit."""
    value = plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"a value is {float(value)}; give a finite number")
    if isinstance(value, Quantity):
        return f"{float(value)!r} {value.unit}"
    return repr(value) if isinstance(value, (int, float)) else _text(value)


def spelled_time(value: str | float) -> str:
    """A time in plan syntax: a string such as `20 ms`, or seconds."""
    if isinstance(value, str):
        return value
    time = seconds("a time", value)
    if not math.isfinite(time):
        raise ValueError(f"a time is {time}; give a finite number of seconds")
    return f"{time!r} s"


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError(f"expected a string, a number or a quantity, not {value!r}")
    return value


def _in_si(value: float, scale: Fraction) -> float:
    """A number times a scale, computed like a literal in a plan: in decimals, rounded once."""
    value = float(value)
    return float(Fraction(repr(value)) * scale) if math.isfinite(value) else value


def _unit(name: str, unit: str, scale: Fraction | int, what: str) -> Callable[[float], Quantity]:
    def make(value: float) -> Quantity:
        return Quantity(_in_si(_number(name, value), Fraction(scale)), unit)

    make.__name__ = make.__qualname__ = name
    make.__doc__ = what
    return make


m = _unit("m", "m", 1, "A length in metres.")
cm = _unit("cm", "m", Fraction(1, 100), "A length in centimetres, as metres.")
mm = _unit("mm", "m", Fraction(1, 1000), "A length in millimetres, as metres.")
s = _unit("s", "s", 1, "A time in seconds.")
ms = _unit("ms", "s", Fraction(1, 1000), "A time in milliseconds, as seconds.")
minutes = _unit("minutes", "s", 60, "A time in minutes, as seconds.")
rad = _unit("rad", "rad", 1, "An angle in radians.")
m_per_s = _unit("m_per_s", "m/s", 1, "A speed in metres per second.")
rad_per_s = _unit("rad_per_s", "rad/s", 1, "A turn rate in radians per second.")


def deg(value: float) -> Quantity:
    """An angle in degrees, as radians."""
    return Quantity(math.radians(_number("deg", value)), "rad")


def deg_per_s(value: float) -> Quantity:
    """A turn rate in degrees per second, as radians per second."""
    return Quantity(math.radians(_number("deg_per_s", value)), "rad/s")


def kmh(value: float) -> Quantity:
    """A speed in kilometres per hour, as metres per second."""
    return Quantity(_in_si(_number("kmh", value), Fraction(10, 36)), "m/s")


# Type hints for ports of components: the types of the language.
UNITS = {
    "length": "m",
    "angle": "rad",
    "duration": "s",
    "speed": "m/s",
    "angular_speed": "rad/s",
    "acceleration": "m/s^2",
    "mass": "kg",
    "force": "N",
    "voltage": "V",
    "temperature": "K",
    "frequency": "Hz",
}
"""The SI units of the types of quantities."""

Length = Annotated[float, "length"]
"""A port of type `length`, metres."""
Duration = Annotated[float, "duration"]
"""A port of type `duration`, seconds."""
Angle = Annotated[float, "angle"]
"""A port of type `angle`, radians."""
Speed = Annotated[float, "speed"]
"""A port of type `speed`, metres a second."""
AngularSpeed = Annotated[float, "angular_speed"]
"""A port of type `angular_speed`, radians a second."""
