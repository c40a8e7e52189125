"""Which robot this process drives: the Carbot, or that of a project."""

from __future__ import annotations

import importlib.util
import os
import sys
from importlib.machinery import ExtensionFileLoader
from pathlib import Path

__all__ = ["use"]

_NATIVE = "afp._afp"
_VARIABLE = "AFP_PROJECT"


def use(project: str | os.PathLike[str]) -> None:
    """Links in what the project in a folder has of its own: its robot, and toolboxes written in Rust.

    A process has one robot, chosen before anything else of the package is used; the variable `AFP_PROJECT` chooses
    for programs that do not say it. The first call builds the extension, which needs Rust, and keeps it until
    something that it was built from changes. A project without such things changes nothing.
    """
    folder = Path(project).resolve()
    if not folder.is_dir():
        raise NotADirectoryError(f"there is no folder '{folder}': give that of the project's afp.toml")
    if _NATIVE in sys.modules:
        if folder == _chosen:
            return
        what = f"the project in '{_chosen}'" if _chosen else "the Carbot"
        raise RuntimeError(
            f"this process has {what} already: call afp.use() before anything else of the package, "
            "or set AFP_PROJECT before Python starts"
        )
    _link(folder)


_chosen: Path | None = None


def _link(folder: Path) -> None:
    """Puts the project's extension in the place of that of the wheel."""
    global _chosen
    from . import _afp as wheel

    try:
        built = wheel.extension(folder)
    except BaseException:
        _forget()
        raise
    _chosen = folder
    # Processes that this one starts have the same robot.
    os.environ[_VARIABLE] = str(folder)
    if built is None:
        return
    _forget()
    loader = ExtensionFileLoader(_NATIVE, str(built))
    spec = importlib.util.spec_from_file_location(_NATIVE, built, loader=loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[_NATIVE] = module
    loader.exec_module(module)
    setattr(sys.modules[__package__], "_afp", module)


def _forget() -> None:
    """Leaves the choice open again."""
    del sys.modules[_NATIVE]
    delattr(sys.modules[__package__], "_afp")


if os.environ.get(_VARIABLE):
    use(os.environ[_VARIABLE])
