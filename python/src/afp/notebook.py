"""Outputs of a notebook's cell that are drawn again and again."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

__all__ = ["Cell", "is_here"]


def is_here() -> bool:
    """Whether this runs in a notebook's kernel."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return hasattr(shell, "kernel")


class Cell:
    """One output, which what comes later replaces: printed lines would pile up in an executed notebook."""

    def __init__(self) -> None:
        self._handle: Any = None

    def show(self, bundle: Mapping[str, Any]) -> None:
        """Shows data by their media types."""
        if self._handle is not None:
            self._handle.update(bundle, raw=True)
            return
        display: Any = sys.modules["IPython"].display
        self._handle = display.display(bundle, raw=True, display_id=True)
