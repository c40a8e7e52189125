# Stubs of the native half, `_afp`: plans, toolboxes, worlds, scenarios. It is not a module.

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, final

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Self, disjoint_base

class AfpError(Exception):
    """An error of a plan, world, log or run."""

class PlanError(AfpError):
    """A plan with errors; `diagnostics` has them."""

    diagnostics: list[Diagnostic]

@final
class Diagnostic:
    """One message of the compiler, as printed by `afpc check`."""

    @property
    def code(self) -> str:
        """Its code: `E0203`."""
    @property
    def severity(self) -> str:
        """`error`, `warning` or `note`."""
    @property
    def message(self) -> str:
        """The error."""
    @property
    def help(self) -> str:
        """A suggestion, or an empty string."""
    @property
    def file(self) -> str:
        """The file as named by the caller."""
    @property
    def line(self) -> int:
        """The line, from 1."""
    @property
    def column(self) -> int:
        """The column, from 1."""
    @property
    def fix(self) -> str | None:
        """The replacement that fixes the error, if there is one."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    @staticmethod
    def _again(
        facts: tuple[str, str, str, str, str | None], place: tuple[str, int, int]
    ) -> Diagnostic: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@disjoint_base
class Plan:
    """A plan: its text, diagnostics, drawings and changes."""

    def __new__(
        cls,
        text: str,
        path: str | os.PathLike[str] | None = None,
        *,
        name: str | None = None,
        toolboxes: Sequence[Toolbox] = ...,
    ) -> Self: ...
    @property
    def text(self) -> str:
        """The text."""
    @property
    def path(self) -> Path | None:
        """The file that it was read from and is saved to."""
    @property
    def name(self) -> str:
        """The name of the plan that runs."""
    @property
    def plans(self) -> list[str]:
        """The names of the plans in the file."""
    @property
    def toolboxes(self) -> list[Toolbox]:
        """The toolboxes given with it."""
    @property
    def diagnostics(self) -> list[Diagnostic]:
        """All diagnostics, in source order."""
    @property
    def ok(self) -> bool:
        """Whether there are no errors; warnings do not count."""
    @property
    def scenarios(self) -> list[Scenario]:
        """The scenarios of the file; empty if it has errors."""
    def _invalid(self) -> list[tuple[str, int, str]]: ...
    def check(self) -> None:
        """Raise `PlanError` if the plan has errors."""
    def report(self, *, color: bool = False) -> str:
        """The diagnostics as printed by `afpc check`."""
    def formatted(self) -> str:
        """The text in canonical form; the plan does not change."""
    def format(self) -> None:
        """Format the text."""
    def save(self, path: str | os.PathLike[str] | None = None) -> None:
        """Write the text to its file, and texts of other changed files to theirs."""
    def svg(self, *, theme: str = "auto", fold: bool = False, data: bool = True) -> str:
        """The drawing in the paper's notation as SVG, with errors marked."""
    def dot(self) -> str:
        """The drawing for GraphViz."""
    def json(self) -> str:
        """The checked graph as JSON."""
    def scxml(self) -> str:
        """The flow of action as State Chart XML."""
    def _coverage(self, log: str | os.PathLike[str]) -> str: ...
    def _change(self, kind: str, parts: Mapping[str, Any], fits: bool = False) -> None: ...
    def _repr_svg_(self) -> str | None: ...
    def _state(self) -> tuple[str, Path | None, str | None, list[Toolbox], dict[str, str]]: ...
    def _set_others(self, others: Mapping[str, str]) -> None: ...

@disjoint_base
class Toolbox:
    """A toolbox file and the Python classes that implement its templates."""

    def __new__(cls, text: str, path: str | os.PathLike[str] | None = None) -> Self: ...
    @property
    def text(self) -> str:
        """The text of the toolbox file."""
    @property
    def name(self) -> str:
        """The name after `use`."""
    @property
    def templates(self) -> list[str]:
        """The names of the templates."""
    @property
    def implemented(self) -> list[str]:
        """The names of the implemented templates."""
    def _declare(self, name: str, text: str) -> None: ...
    def _implement(self, template: str, maker: Callable[..., Any]) -> None: ...
    def _template(self, name: str) -> dict[str, Any]: ...

@final
class World:
    """A room: the robot's start, and obstacles, floor, lights and moving things around it."""

    @staticmethod
    def load(path: str | os.PathLike[str]) -> World:
        """Read a world file, or a map_server map (`.yaml`)."""
    @staticmethod
    def random(seed: int) -> World:
        """A random room from a seed, like `--world random:7`."""
    @staticmethod
    def parse(text: str) -> World:
        """Read a world from the text of a world file."""
    @staticmethod
    def of_plan(path: str | os.PathLike[str]) -> World:
        """The default world of a plan file, as in `afpc run`."""
    def changed(self, values: dict[str, Any]) -> World:
        """A copy with changed values of its file: `world.changed({"robot.charge": 0.5})`. Quantities are
        numbers in the unit of the file's key, or strings with a unit."""
    def _changed(self, values: Sequence[tuple[str, str]], start: tuple[float, float, float] | None) -> World: ...
    @property
    def name(self) -> str:
        """Its name."""
    @property
    def text(self) -> str:
        """The text of its file."""
    @property
    def path(self) -> Path | None:
        """Its file, or `random:SEED`."""
    @property
    def start(self) -> tuple[float, float, float]:
        """The robot's start: x and y in metres, heading in radians."""
    @property
    def obstacles(self) -> list[str]:
        """The names of its obstacles."""
    def outlines(self) -> list[NDArray[np.float64]]:
        """The corners of all obstacles in metres, each an array of n x 2."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def _repr_svg_(self) -> str: ...
    def __hash__(self) -> int: ...
    @staticmethod
    def _again(
        text: str, path: str | os.PathLike[str] | None, start: tuple[float, float, float] | None
    ) -> World: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Scenario:
    """A scenario of a file: a world, actions and expectations."""

    @property
    def name(self) -> str:
        """The name."""
    @property
    def plan(self) -> str:
        """The name of its plan."""
    @property
    def path(self) -> Path:
        """Its file."""
    @property
    def line(self) -> int:
        """The line of its name, from 1."""
    @property
    def seed(self) -> int:
        """The seed of all noise."""
    @property
    def until(self) -> float:
        """Its time limit, in seconds."""
    def run(self, *, log: str | os.PathLike[str] | None = None) -> Verdict:
        """Run it; with `log`, record it there. Ctrl-C interrupts it."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Broken:
    """An unmet expectation."""

    @property
    def text(self) -> str:
        """The line of the scenario."""
    @property
    def file(self) -> str:
        """Its file."""
    @property
    def line(self) -> int:
        """Its line, from 1."""
    @property
    def column(self) -> int:
        """Its column, from 1."""
    @property
    def time(self) -> float:
        """The time when it became clear, in seconds."""
    @property
    def why(self) -> str:
        """The actual behaviour."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    @staticmethod
    def _again(text: str, place: tuple[str, int, int], time: float, why: str) -> Broken: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Verdict:
    """The verdict of a scenario."""

    @property
    def passed(self) -> bool:
        """Whether all expectations were met."""
    @property
    def broken(self) -> list[Broken]:
        """Unmet expectations, in order of time."""
    @property
    def report(self) -> str:
        """The broken lines and the timeline around the first of them, as printed by `afpc test`."""
    @property
    def time(self) -> float:
        """The length of the run, in seconds."""
    @property
    def ending(self) -> str:
        """How the plan ended: `ok`, `interrupted`, `error`; `running` if it did not."""
    @property
    def trace_hash(self) -> str:
        """The hash of the trace, as in `afpc test --json`."""
    @property
    def timeline(self) -> list[str]:
        """The timeline."""
    @property
    def command(self) -> str:
        """The command that repeats the scenario, or a note why none does."""
    def _repr_html_(self) -> str: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    @staticmethod
    def _again(facts: tuple[Any, ...]) -> Verdict: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
