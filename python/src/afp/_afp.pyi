# The native half of the package. Its stubs are in two parts, which are not modules.

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._afp_plans import AfpError, Broken, Diagnostic, Plan, PlanError, Scenario, Toolbox, Verdict, World
from ._afp_runs import Carbot, Courses, Driven, Event, Judge, Moment, Names, Robot, Runner, Sweeper

__version__: str
own_robot: str | None
__all__ = [
    "AfpError",
    "Broken",
    "Carbot",
    "Courses",
    "Diagnostic",
    "Driven",
    "Event",
    "Judge",
    "Moment",
    "Names",
    "Plan",
    "PlanError",
    "Robot",
    "Runner",
    "Scenario",
    "Sweeper",
    "Toolbox",
    "Verdict",
    "World",
    "__version__",
    "alike",
    "draw_log",
    "extension",
    "faults",
    "number_of",
    "own_robot",
    "pixels",
    "read_log",
    "read_recipe",
    "read_text",
    "target",
    "write_text",
]

def extension(folder: str | os.PathLike[str]) -> str | None:
    """The extension with the robot and the toolboxes of the project in a folder, built on demand;
    `None` if the project has neither."""

def alike(runs: list[tuple[str, str, str, int]]) -> list[tuple[str, str, str, int, int]]:
    """Group runs, given as endings, places, reasons and numbers: returns each group with its number of
    runs and the first of them; failures last."""

def target(world: World, reach: str, seed: int) -> tuple[float, float]:
    """The target of a world: the first infrared source (`light`), or a random `goal` from a seed."""

def draw_log(path: str | os.PathLike[str], what: str) -> str:
    """A picture of a log as SVG: `path`, `sonar` or `film`."""

def faults() -> list[tuple[str, str]]:
    """Every fault for `fail`: device and kind."""

def number_of(text: str, unit: str) -> float | None:
    """The SI value of a string with a unit of that kind: `30 cm` is 0.3 in metres."""

def pixels(file: bytes) -> NDArray[np.uint8] | None:
    """The pixels of a camera's picture from a log, as rows x columns x 3; `None` for another file."""

def read_log(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read a log into a dictionary, up to its first defect."""

def read_recipe(path: str | os.PathLike[str]) -> tuple[list[tuple[str, str]], str, World, int]:
    """The inputs of a logged run."""

def read_text(what: str, path: str | os.PathLike[str]) -> str:
    """Read a file with its own line ends; `what` describes the failed action in an error."""

def write_text(what: str, path: str | os.PathLike[str], text: str) -> None:
    """Write a file atomically."""
