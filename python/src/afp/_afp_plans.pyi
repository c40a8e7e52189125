# Stubs of the native half, `_afp`: plans, toolboxes, worlds, scenarios. There is no such module.

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, final

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Self, disjoint_base

class AfpError(Exception):
    """What goes wrong with plans, worlds, logs and runs."""

class PlanError(AfpError):
    """A plan with errors; `diagnostics` has them."""

    diagnostics: list[Diagnostic]

@final
class Diagnostic:
    """One thing the compiler has to say, as `afpc check` says it."""

    @property
    def code(self) -> str:
        """Which rule it is about: `E0203`."""
    @property
    def severity(self) -> str:
        """`error`, `warning` or `note`."""
    @property
    def message(self) -> str:
        """What is wrong."""
    @property
    def help(self) -> str:
        """What to do, perhaps empty."""
    @property
    def file(self) -> str:
        """The file, as it was named."""
    @property
    def line(self) -> int:
        """The line, from 1."""
    @property
    def column(self) -> int:
        """The column, from 1."""
    @property
    def fix(self) -> str | None:
        """The text that mends it in place of what is wrong, where there is one."""
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
    """A plan: its text, what the compiler says of it, its drawings, and changes of it."""

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
        """The file that it came from and is saved to."""
    @property
    def name(self) -> str:
        """The name of the plan that runs."""
    @property
    def plans(self) -> list[str]:
        """The names of the plans of the file."""
    @property
    def toolboxes(self) -> list[Toolbox]:
        """The toolboxes that were given with it."""
    @property
    def diagnostics(self) -> list[Diagnostic]:
        """Everything the compiler has to say, in the order of the text."""
    @property
    def ok(self) -> bool:
        """Whether there are no errors; warnings do not count."""
    @property
    def scenarios(self) -> list[Scenario]:
        """The scenarios of the file; none while it has errors."""
    def _invalid(self) -> list[tuple[str, int, str]]: ...
    def check(self) -> None:
        """Raises `PlanError` if the plan has errors."""
    def report(self, *, color: bool = False) -> str:
        """The diagnostics as `afpc check` prints them."""
    def formatted(self) -> str:
        """The text in canonical form; the plan stays as it is."""
    def format(self) -> None:
        """Brings the text into canonical form."""
    def save(self, path: str | os.PathLike[str] | None = None) -> None:
        """Writes the text, and those of other files that a change has reached, to their files."""
    def svg(self, *, theme: str = "auto", fold: bool = False, data: bool = True) -> str:
        """The drawing in the notation of the paper, as SVG, with what is wrong marked where it is."""
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
        """The name behind `use`."""
    @property
    def templates(self) -> list[str]:
        """The names of the templates."""
    @property
    def implemented(self) -> list[str]:
        """The names of the templates that have an implementation."""
    def _declare(self, name: str, text: str) -> None: ...
    def _implement(self, template: str, maker: Callable[..., Any]) -> None: ...
    def _template(self, name: str) -> dict[str, Any]: ...

@final
class World:
    """A room: where the robot starts and what stands, lies, shines and moves around it."""

    @staticmethod
    def load(path: str | os.PathLike[str]) -> World:
        """Reads a world file, or a map of map_server (`.yaml`)."""
    @staticmethod
    def random(seed: int) -> World:
        """A room made up from a seed, as `--world random:7` is."""
    @staticmethod
    def parse(text: str) -> World:
        """Reads a world from the text of its file."""
    @staticmethod
    def of_plan(path: str | os.PathLike[str]) -> World:
        """The world that `afpc run` would take for the plan of this file."""
    def _changed(self, values: Sequence[tuple[str, str]], start: tuple[float, float, float] | None) -> World: ...
    @property
    def name(self) -> str:
        """What it is called."""
    @property
    def text(self) -> str:
        """The text of its file."""
    @property
    def path(self) -> Path | None:
        """Its file, or `random:SEED`."""
    @property
    def start(self) -> tuple[float, float, float]:
        """Where the robot starts: x and y in metres, heading in radians."""
    @property
    def obstacles(self) -> list[str]:
        """The names of what stands in it."""
    def outlines(self) -> list[NDArray[np.float64]]:
        """The corners of everything that stands in it, metres, each an array of n x 2."""
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
    """A scenario of a file: a world, what happens, what is expected."""

    @property
    def name(self) -> str:
        """Its name."""
    @property
    def plan(self) -> str:
        """The name of its plan."""
    @property
    def path(self) -> Path:
        """The file in which it stands."""
    @property
    def line(self) -> int:
        """The line of its name, from 1."""
    @property
    def seed(self) -> int:
        """The seed of all noise."""
    @property
    def until(self) -> float:
        """When it ends at the latest, seconds."""
    def run(self, *, log: str | os.PathLike[str] | None = None) -> Verdict:
        """Runs it; with `log`, records it there. Ctrl-C interrupts it."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Broken:
    """An expectation that was not met."""

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
        """When it became clear, seconds."""
    @property
    def why(self) -> str:
        """What happened instead."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    @staticmethod
    def _again(text: str, place: tuple[str, int, int], time: float, why: str) -> Broken: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Verdict:
    """What a scenario came to."""

    @property
    def passed(self) -> bool:
        """Whether everything was as expected."""
    @property
    def broken(self) -> list[Broken]:
        """What was not as expected, in order of time."""
    @property
    def report(self) -> str:
        """What broke, and the timeline around the first of it, as `afpc test` prints it."""
    @property
    def time(self) -> float:
        """How long it ran, seconds."""
    @property
    def ending(self) -> str:
        """How the plan ended: `ok`, `interrupted`, `error`; `running` if it did not."""
    @property
    def trace_hash(self) -> str:
        """The hash of the trace, as `afpc test --json` tells it."""
    @property
    def timeline(self) -> list[str]:
        """The timeline."""
    @property
    def command(self) -> str:
        """The line that runs the scenario again; it says where none does."""
    def _repr_html_(self) -> str: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    @staticmethod
    def _again(facts: tuple[Any, ...]) -> Verdict: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
