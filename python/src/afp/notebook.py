"""Outputs of a notebook cell that are redrawn."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

__all__ = ["Cell", "is_here"]


def is_here() -> bool:
    """Whether this code runs in a notebook kernel."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return hasattr(shell, "kernel")


class Cell:
    """An output that each new one replaces; printed lines would pile up in an executed notebook."""

    def __init__(self) -> None:
        self._handle: Any = None

    def show(self, bundle: Mapping[str, Any]) -> None:
        """Show data by their media types."""
        if self._handle is not None:
            self._handle.update(bundle, raw=True)
            return
        display: Any = sys.modules["IPython"].display
        self._handle = display.display(bundle, raw=True, display_id=True)
