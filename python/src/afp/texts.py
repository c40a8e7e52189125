"""Texts of files, as they are."""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["read"]


def read(path: str | os.PathLike[str]) -> str:
    """The text of a file with its own line ends: with others it would be another plan, not saved as it was."""
    return Path(path).read_bytes().decode("utf-8")
