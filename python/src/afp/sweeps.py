"""Sweeps: many runs of a plan over worlds, seeds and values."""

from __future__ import annotations

import html
import importlib
import math
import operator
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from . import plots, tables
from ._afp import Plan, Sweeper, Toolbox, World
from .seeds import seed_of
from .units import Quantity, seconds

__all__ = ["Runs", "sweep"]

Place = World | str | os.PathLike[str]
Values = str | Iterable[Any]


def sweep(
    plan: Plan,
    worlds: Place | Iterable[Place] | None = None,
    seeds: int | range = 1,
    vary: Mapping[str, Values] | None = None,
    *,
    until: float = 60.0,
    jobs: int | None = None,
    progress: bool | Callable[[int, int], Any] = True,
    out: str | os.PathLike[str] | None = None,
    restart: bool = False,
    backend: str = "local",
) -> Runs:
    """Runs a plan once for every combination of world, values and seed, on all cores.

    `worlds` are files, `random:7`, or worlds that were loaded from such; without any, it is the plan's own. `seeds`
    is a `range`, or how many from 0 on. `vary` gives entries, or values of the world's file
    (`"world.robot.charge"`), the values to try: a list (`[afp.cm(30), "40cm", 0.5]`) or a range as on the command
    line (`"20cm..60cm:5cm"`). Each run is stopped at `until` seconds.

    `jobs` is the number of threads. Runs are done by the engine of `afpc sweep` while other threads of Python go on;
    components written in Python take turns for the interpreter, unless a cluster has several processes.
    `progress` shows a bar on a terminal or in a notebook, or is called with how many runs are done of how many.

    `out` (`runs.csv`, `runs.parquet`, or a folder for both) keeps each outcome as it comes: the same call goes on
    where an earlier one was stopped or killed, unless `restart` is set; `afpc sweep` goes on with it too.

    `backend="ray"` spreads the runs over a Ray cluster; it needs ray, see `afp.cluster`.
    """
    if not isinstance(plan, Plan):
        raise TypeError(f"a sweep needs a Plan, not a {type(plan).__name__}: afp.load() reads one")
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs is {jobs}; give a number of threads from 1 on, or None for all cores")
    if backend not in ("local", "ray"):
        raise ValueError(f"no backend '{backend}'; there are: local, ray")
    until = seconds("until", until)
    if not isinstance(vary, (Mapping, type(None))):
        raise TypeError(f"vary gives entries lists of values, such as {{'walldist': [afp.cm(30), afp.cm(40)]}}, not {vary!r}")
    values = [(name, _values(name, given)) for name, given in (vary or {}).items()]
    sweeper = Sweeper(
        plan,
        _worlds(worlds),
        _seeds(seeds),
        values,
        until,
        mark_of(plan.toolboxes),
    )
    if out is not None:
        sweeper.open(os.fspath(out), restart)
    left = sweeper.left()
    tell = _teller(progress, sweeper.total)
    try:
        if backend == "local":
            before = sweeper.total - len(left)
            sweeper.run(left, jobs, lambda done: tell(before + done, sweeper.total))
        else:
            from . import cluster

            spec = cluster.Spec.of(plan, _worlds(worlds), _seeds(seeds), values, until)
            cluster.run(spec, sweeper, left, lambda done: tell(done, sweeper.total))
    finally:
        tell(-1, sweeper.total)
        if out is not None:
            sweeper.write()
    return Runs(plan.name, sweeper)


def _worlds(worlds: Place | Iterable[Place] | None) -> list[str | None]:
    if worlds is None:
        return [None]
    if isinstance(worlds, (World, str, os.PathLike)):
        worlds = [worlds]
    return [_world(world) for world in worlds]


def _world(world: Place) -> str:
    if not isinstance(world, World):
        return os.fspath(world)
    if world.path is None:
        text = f"the world '{world.name}' has no file, so that no run in it could be repeated: write its text to one"
        raise ValueError(text)
    return os.fspath(world.path)


def _seeds(seeds: int | range) -> tuple[int, int]:
    if not isinstance(seeds, range):
        return (0, _count(seeds))
    if seeds.step != 1:
        raise ValueError("seeds follow one another: give a range with a step of 1")
    if not seeds:
        raise ValueError(f"there are no seeds in {seeds}")
    return (seed_of(seeds.start), seed_of(seeds.stop))


def _count(seeds: int) -> int:
    count = operator.index(seeds)
    if count < 1:
        raise ValueError(f"seeds is {count}; give how many, or a range")
    return seed_of(count)


def _values(name: str, values: Values) -> list[tuple[str, bool]]:
    """The values of an entry as texts, and whether each is a bare number."""
    if isinstance(values, str):
        return [(values, False)]
    try:
        texts = [_text(value) for value in values]
    except (TypeError, ValueError) as error:
        raise type(error)(f"the values of '{name}': {error}") from None
    if not texts:
        raise ValueError(f"'{name}' has no values")
    return texts


def _text(value: Any) -> tuple[str, bool]:
    if isinstance(value, bool):
        return ("true" if value else "false", False)
    if isinstance(value, Quantity):
        return (f"{float(value)!r}{value.unit}", False)
    if isinstance(value, str):
        return (value, False)
    number = operator.index(value) if hasattr(value, "__index__") else float(value)
    if not math.isfinite(number):
        raise ValueError(f"{number} cannot be tried")
    return (repr(number), True)


def mark_of(toolboxes: Iterable[Toolbox]) -> str:
    """What tells two versions of components in Python apart."""
    return "\0".join(f"{toolbox.text}\0{getattr(toolbox, 'sources', '')}" for toolbox in toolboxes)


def _teller(progress: bool | Callable[[int, int], Any], total: int) -> Callable[[int, int], Any]:
    """What is told how many runs are done; -1 at the end."""
    if callable(progress):
        return lambda done, all: progress(done, all) if done >= 0 else None
    if progress and "ipykernel" in sys.modules:
        return Bar(_in_notebook())
    return Bar(_on_terminal) if progress and sys.stderr.isatty() else lambda done, all: None


class Bar:
    """Shows how many runs are done, at most ten times a second, and at the end."""

    EVERY = 0.1
    WIDTH = 30

    def __init__(self, show: Callable[[str, bool], None], clock: Callable[[], float] = time.monotonic) -> None:
        self._show = show
        self._clock = clock
        self._next = -math.inf
        self._line = ""

    def __call__(self, done: int, total: int) -> None:
        if done >= 0:
            full = self.WIDTH * done // max(total, 1)
            self._line = f"{'█' * full}{'░' * (self.WIDTH - full)} {done} of {total} runs"
        if done < 0 or self._clock() >= self._next:
            self._next = self._clock() + self.EVERY
            self._show(self._line, done < 0)


def _on_terminal(line: str, last: bool) -> None:
    print(f"\r{line}", end="\n" if last else "", file=sys.stderr, flush=True)


def _in_notebook() -> Callable[[str, bool], None]:
    """One output of the cell, which is replaced: lines on standard error would pile up in an executed notebook."""
    display = importlib.import_module("IPython.display").display
    shown: list[Any] = []

    def show(line: str, last: bool) -> None:
        bundle = {"text/plain": line}
        if shown:
            shown[0].update(bundle, raw=True)
        else:
            shown.append(display(bundle, raw=True, display_id=True))

    return show


class Runs:
    """The outcomes of a sweep, a row for each run."""

    columns: dict[str, list[Any]]
    """The table by column: `run`, `world`, `seed`, what was varied (numbers in SI units as `..._si` too), `ending`,
    `where`, `why`, measures, `trace`, `command` (the line that reproduces the run), `took_s`."""

    def __init__(self, plan: str, sweeper: Sweeper) -> None:
        table = sweeper.columns()
        self.plan = plan
        self.columns = {name: cells for name, (cells, _) in table.items()}
        self._kinds = {name: kind for name, (_, kind) in table.items()}
        self._groups = sweeper.groups()

    def __len__(self) -> int:
        return len(self.columns["run"])

    def __getitem__(self, row: int) -> dict[str, Any]:
        return {name: cells[row] for name, cells in self.columns.items()}

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return (self[row] for row in range(len(self)))

    @property
    def endings(self) -> dict[str, int]:
        """How many runs ended in each way."""
        endings = self.columns["ending"]
        return {ending: endings.count(ending) for ending in dict.fromkeys(endings)}

    @property
    def groups(self) -> list[dict[str, Any]]:
        """Runs that ended alike: `ending`, `where`, `why`, `count`, and the `run` that was the first; failures last."""
        return [dict(zip(("ending", "where", "why", "count", "run"), group, strict=True)) for group in self._groups]

    def to_pandas(self) -> Any:
        """The table as a pandas data frame; needs pandas."""
        kinds = {"count": "uint64", "number": "float64", "text": "string"}
        types = {name: kinds[kind] for name, kind in self._kinds.items()}
        return tables.need("pandas").DataFrame(self.columns).astype(types)

    def to_polars(self) -> Any:
        """The table as a polars data frame; needs polars."""
        polars = tables.need("polars")
        types = {"count": polars.UInt64, "number": polars.Float64, "text": polars.String}
        return polars.DataFrame(self.columns, schema={name: types[kind] for name, kind in self._kinds.items()})

    def to_arrow(self) -> Any:
        """The table as an Arrow table; needs pyarrow."""
        arrow = tables.need("pyarrow")
        types = {"count": arrow.uint64(), "number": arrow.float64(), "text": arrow.string()}
        schema = arrow.schema([(name, types[kind]) for name, kind in self._kinds.items()])
        return arrow.table(self.columns, schema=schema)

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The table for whatever reads Arrow; needs pyarrow."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def plot(self, x: str, y: str = "time_s", ax: Any = None) -> Any:
        """Draws a measure of each run over what was varied; needs matplotlib."""
        known = f"{x}_si" if f"{x}_si" in self.columns else x
        for name in (known, y):
            if name not in self.columns:
                raise KeyError(f"no column '{name}'; there are: {', '.join(self.columns)}")
        return plots.runs(self.columns[known], self.columns[y], self.columns["ending"], (known, y, self.plan), ax)

    def __repr__(self) -> str:
        endings = ", ".join(f"{count} {ending}" for ending, count in self.endings.items())
        return f"<Runs of {self.plan}: {endings or 'none'}>"

    def _repr_html_(self) -> str:
        keys = ("count", "ending", "where", "why")
        rows = ("".join(f"<td>{html.escape(str(group[key]))}</td>" for key in keys) for group in self.groups)
        body = "".join(f"<tr>{row}</tr>" for row in rows)
        return f"<table><tr><th>runs</th><th>ending</th><th>where</th><th>why</th></tr>{body}</table>"


