"""Checks of arguments, with errors in the caller's words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from . import _afp
from .units import plain

__all__ = ["flag", "keys", "text", "toolboxes_of"]


def text(what: str, value: Any) -> str:
    """Check that an argument is a string; `what` names it in the error."""
    if not isinstance(value, str):
        raise TypeError(f"{what} must be a string, not {value!r}")
    return value


def flag(what: str, value: Any) -> bool:
    """Check that an argument is a boolean."""
    truth = plain(value)
    if not isinstance(truth, bool):
        raise TypeError(f"{what} is True or False, not {value!r}")
    return truth


def keys(what: str, values: Mapping[str, Any] | None, does: str) -> dict[str, Any]:
    """Check that an argument is a mapping with string keys; `None` counts as empty."""
    if values is None:
        return {}
    if not isinstance(values, Mapping):
        raise TypeError(f"{what} {does}, not {values!r}")
    return {text(f"a name in {what}", name): value for name, value in values.items()}


def toolboxes_of(toolboxes: Any) -> list[_afp.Toolbox]:
    """Check that an argument is a list of toolboxes."""
    if isinstance(toolboxes, _afp.Toolbox):
        raise TypeError(f"toolboxes must be a list, also with one item: toolboxes=[{toolboxes.name}]")
    if isinstance(toolboxes, str) or not isinstance(toolboxes, Sequence):
        raise TypeError(f"toolboxes must be a list of Toolbox, not {toolboxes!r}")
    for toolbox in toolboxes:
        if not isinstance(toolbox, _afp.Toolbox):
            raise TypeError(f"toolboxes must contain Toolbox, not {toolbox!r}")
    return list(toolboxes)
