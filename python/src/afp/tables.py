"""Events as tables: lists by column, Arrow, pandas, polars."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

from ._afp import Event

COLUMNS = (
    "time",
    "kind",
    "component",
    "outcome",
    "target",
    "supervisor",
    "element",
    "on",
    "entry",
    "port",
    "unit",
    "ending",
    "fault",
    "fault_text",
    "lateness",
    "cause",
    "request",
    "refused",
)

VALUES = {"old": ("old", "old_text"), "value": ("value", "text")}
"""The columns of values of entries and inputs: for numbers, and for strings."""

NUMBERS = ("time", "lateness", "old", "value")
"""The columns of numbers,"""
TRUTHS = ("on",)
"""of truth values; all others are of strings."""


EXTRAS = {"pyarrow": "arrow", "matplotlib": "plot", "gymnasium": "gym", "stable_baselines3": "sb3"}
"""The extra of a package, if it has another name."""


def need(module: str) -> Any:
    """Import a module of another package."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        needed = module.partition(".")[0]
        extra = EXTRAS.get(needed, needed)
        raise ImportError(f"this needs {needed}; install it with: pip install 'action-flow-plans[{extra}]'") from error


def columns(events: Sequence[Event]) -> dict[str, list[Any]]:
    """The events as lists by column; values of entries and inputs have a column of numbers and one
    of strings.
    """
    table: dict[str, list[Any]] = {name: [getattr(event, name) for event in events] for name in COLUMNS}
    for name, (number, text) in VALUES.items():
        values = [getattr(event, name) for event in events]
        table[number] = [float(value) if isinstance(value, (bool, int, float)) else None for value in values]
        table[text] = [value if isinstance(value, str) else None for value in values]
    return table


def _types(table: dict[str, list[Any]], number: Any, truth: Any, text: Any) -> dict[str, Any]:
    return {name: number if name in NUMBERS else truth if name in TRUTHS else text for name in table}


def to_pandas(events: Sequence[Event]) -> Any:
    """The events as a pandas data frame."""
    table = columns(events)
    return need("pandas").DataFrame(table).astype(_types(table, "float64", "bool", "string"))


def to_polars(events: Sequence[Event]) -> Any:
    """The events as a polars data frame."""
    polars = need("polars")
    table = columns(events)
    return polars.DataFrame(table, schema=_types(table, polars.Float64, polars.Boolean, polars.String))


def to_arrow(events: Sequence[Event]) -> Any:
    """The events as an Arrow table."""
    arrow = need("pyarrow")
    table = columns(events)
    types = _types(table, arrow.float64(), arrow.bool_(), arrow.string())
    return arrow.table(table, schema=arrow.schema(list(types.items())))


class Events:
    """A mixin for tables of events."""

    events: Sequence[Event]

    @property
    def columns(self) -> dict[str, list[Any]]:
        """The events as lists by column."""
        return columns(self.events)

    def to_pandas(self) -> Any:
        """The events as a pandas data frame; needs pandas."""
        return to_pandas(self.events)

    def to_polars(self) -> Any:
        """The events as a polars data frame; needs polars."""
        return to_polars(self.events)

    def to_arrow(self) -> Any:
        """The events as an Arrow table; needs pyarrow."""
        return to_arrow(self.events)

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The events for libraries that read Arrow, as in `polars.DataFrame(result)`; needs
        pyarrow.
        """
        return self.to_arrow().__arrow_c_stream__(requested_schema)
