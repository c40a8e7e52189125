"""Executes the notebooks beside this file; a cell that raises fails."""

from __future__ import annotations

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient


def main() -> int:
    """Runs them one after the other."""
    folder = Path(__file__).resolve().parent
    for file in sorted(folder.glob("*.ipynb")):
        print(f"executing {file.name}", flush=True)
        notebook = nbformat.read(file, as_version=4)
        NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
    return 0


if __name__ == "__main__":
    sys.exit(main())
