"""The Python blocks of the documentation, with one session per page at the root of a copy of the
plans; cells of notebooks.
"""

from __future__ import annotations

import doctest
import json
import re
import shutil
from pathlib import Path

import pytest

from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "python/notebooks").glob("*.ipynb"))
PAGES = [ROOT / "docs/python.md", ROOT / "docs/research.md", ROOT / "docs/research-recipes.md"]
NEEDS = {"research-recipes.md": ["minari", "optuna", "pyarrow", "scipy"]}
"""The packages of a page's examples."""
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_output_in_the_pages_is_correct(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for package in NEEDS.get(page.name, []):
        pytest.importorskip(package)
    for folder in ("plans", "worlds"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    monkeypatch.chdir(tmp_path)
    text = page.read_text(encoding="utf-8")
    # Text outside the blocks becomes empty lines, so that a failure has the line of the page.
    lines = [""] * len(text.splitlines())
    for block in BLOCK.finditer(text):
        first = text[: block.start(1)].count("\n")
        for number, line in enumerate(block[1].splitlines()):
            lines[first + number] = line
    test = doctest.DocTestParser().get_doctest("\n".join(lines) + "\n", {}, page.name, str(page), 0)
    assert test.examples
    failures: list[str] = []
    doctest.DocTestRunner(optionflags=FLAGS).run(test, out=failures.append)
    assert not failures, "".join(failures)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
def test_the_cells_of_notebooks_run(notebook: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As a program by default; as a notebook at night, if there is a kernel."""
    pytest.importorskip("matplotlib").use("Agg")
    for folder in ("plans", "worlds"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    (tmp_path / "python/notebooks").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "python/notebooks")
    known = {"__name__": "__main__"}
    for number, cell in enumerate(json.loads(notebook.read_text(encoding="utf-8"))["cells"]):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{notebook.name}, cell {number}", "exec"), known)
