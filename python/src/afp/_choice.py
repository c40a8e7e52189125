"""The robot of this process: the Carbot, or a project's robot."""

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
    """Use a project's own robot and its toolboxes written in Rust.

    A process has one robot. Choose it before you use anything else of the package, or set the
    variable `AFP_PROJECT`. The first call builds the extension, which needs Rust. It is built again
    only after a change of its sources. For a project without Rust, the call has no effect.
    """
    folder = Path(project).resolve()
    if not folder.is_dir():
        raise NotADirectoryError(f"the folder '{folder}' does not exist: give the folder of the project's afp.toml")
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
    """Replace the wheel's extension with the project's."""
    global _chosen
    from . import _afp as wheel

    try:
        built = wheel.extension(folder)
    except BaseException:
        _forget()
        raise
    _chosen = folder
    # Child processes use the same robot.
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
    """Reset the choice."""
    del sys.modules[_NATIVE]
    delattr(sys.modules[__package__], "_afp")


if os.environ.get(_VARIABLE):
    use(os.environ[_VARIABLE])
