"""Executes the notebooks next to this file; a cell that raises fails.

They run in a copy of their files, without outcomes of earlier versions.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient


def main() -> int:
    """Run them one after the other."""
    folder = Path(__file__).resolve().parent
    root = folder.parents[1]
    with tempfile.TemporaryDirectory() as copy:
        for needed in ("plans", "worlds", "python/notebooks"):
            shutil.copytree(root / needed, Path(copy) / needed)
        for file in sorted(folder.glob("*.ipynb")):
            print(f"executing {file.name}", flush=True)
            notebook = nbformat.read(file, as_version=4)
            place = {"metadata": {"path": str(Path(copy) / "python/notebooks")}}
            NotebookClient(notebook, timeout=300, resources=place).execute()
    return 0


if __name__ == "__main__":
    sys.exit(main())
