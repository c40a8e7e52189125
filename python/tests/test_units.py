"""Quantities match the literals in plans."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import afp

UNITS = [
    (afp.m, "m", "length"),
    (afp.cm, "cm", "length"),
    (afp.mm, "mm", "length"),
    (afp.s, "s", "duration"),
    (afp.ms, "ms", "duration"),
    (afp.minutes, "min", "duration"),
    (afp.deg, "deg", "angle"),
    (afp.m_per_s, "m/s", "speed"),
    (afp.kmh, "km/h", "speed"),
    (afp.deg_per_s, "deg/s", "angular_speed"),
]


@pytest.mark.parametrize(("make", "unit", "kind"), UNITS, ids=lambda it: it if isinstance(it, str) else "")
def test_a_number_in_a_unit_equals_the_literal(make: Callable[[float], float], unit: str, kind: str) -> None:
    numbers = [hundredths / 100 for hundredths in (*range(1, 400), *range(3500, 3600))]
    entries = "".join(f"    in e{at}: {kind} = {number!r} {unit}\n" for at, number in enumerate(numbers))
    plan = f"use std\nplan P {{\n{entries}    start w\n    actor w: Wait(duration = 1 s) {{ Elapsed -> terminate }}\n}}\n"
    simulation = afp.Simulation(afp.Plan(plan))
    simulation.step()
    assert simulation.entries == {f"e{at}": float(make(number)) for at, number in enumerate(numbers)}


def test_numbers_without_a_decimal_form_do_not_change() -> None:
    assert afp.cm(float("inf")) == float("inf") and afp.minutes(-0.03) == -1.8
    assert afp.kmh(36) == 10 and afp.cm(35.1) == 0.351 and str(afp.ms(0)) == "Quantity(0.0, 's')"
