"""The outcomes of a sweep as a table that can be filtered, drawn and traced back to its runs."""

from __future__ import annotations

import html
import json
import math
import operator
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from . import estimates, plots, tables
from ._afp import Plan, Sweeper, alike, number_of
from .checks import flag
from .estimates import Estimate
from .picture import address
from .result import Result
from .simulation import Simulation
from .units import UNITS, Quantity, plain, spelled

__all__ = ["Runs"]

SHOWN = 4
"""The number of runs with pictures in a notebook,"""
SHOWN_S = 2.0
"""if repeating them takes at most this time, in seconds."""
BROKEN = ("not_started", "panicked")
"""Endings of runs that cannot be repeated."""


class Runs:
    """The outcomes of a sweep, a row for each run. `runs[3]` is a row; `runs[:10]` and
    `runs.where(ending="ok")` are tables.
    """

    columns: dict[str, list[Any]]
    """The table by column: `run`, `world`, `seed`, what was varied (numbers in SI units as `..._si` too), `ending`,
    `where`, `why`, measures and metrics, `trace`, `command` (the line that reproduces the run), `took_s`."""

    def __init__(
        self,
        plan: str,
        columns: dict[str, list[Any]],
        kinds: dict[str, str],
        units: Mapping[str, str],
        again: Sequence[tuple[_Again, int]] | None = None,
    ) -> None:
        self.plan = plan
        self.columns = columns
        self._kinds = kinds
        self._units = units
        self._again = again

    @classmethod
    def of(cls, plan: Plan, sweeper: Sweeper, until: float, more: Callable[[Any], Runs]) -> Runs:
        """The outcomes of a sweep so far."""
        table = sweeper.columns()
        columns = {name: cells for name, (cells, _) in table.items()}
        kinds = {name: kind for name, (_, kind) in table.items()}
        types = {entry["name"]: entry["type"] for entry in json.loads(plan.json()).get("entries", [])}
        units = {name: UNITS[type] for name, type in types.items() if type in UNITS}
        again = _Again(plan, sweeper, until, more)
        return cls(plan.name, columns, kinds, units, [(again, run) for run in columns["run"]])

    def __len__(self) -> int:
        return len(self.columns["run"])

    @overload
    def __getitem__(self, row: int) -> dict[str, Any]: ...

    @overload
    def __getitem__(self, row: slice) -> Runs: ...

    @overload
    def __getitem__(self, row: str) -> NDArray[Any]: ...

    def __getitem__(self, row: int | slice | str) -> dict[str, Any] | Runs | NDArray[Any]:
        if isinstance(row, str):
            return self._array(row)
        if isinstance(row, slice):
            return self._only(range(len(self))[row])
        return {name: cells[row] for name, cells in self.columns.items()}

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return (self[row] for row in range(len(self)))

    def _array(self, name: str) -> NDArray[Any]:
        """A column as an array; missing numbers are not a number."""
        cells = self._column(name)
        if self._kinds[name] == "text":
            return np.array(cells, np.str_)
        if self._kinds[name] == "count" and None not in cells:
            return np.array(cells, np.uint64)
        return np.array([math.nan if cell is None else cell for cell in cells], np.float64)

    def __add__(self, other: object) -> Runs:
        """The runs of two sweeps with the same columns; runs of the second one get new numbers."""
        if not isinstance(other, Runs):
            return NotImplemented
        if self._kinds != other._kinds or self.plan != other.plan:
            differ = [name for name in {**self._kinds, **other._kinds} if self._kinds.get(name) != other._kinds.get(name)]
            raise ValueError(f"the sweeps have different columns: {', '.join(differ) or 'they are of different plans'}")
        columns = {name: [*cells, *other.columns[name]] for name, cells in self.columns.items()}
        first = max(self.columns["run"], default=-1) + 1
        columns["run"] = [*self.columns["run"], *(first + number for number in range(len(other)))]
        again = None if self._again is None or other._again is None else [*self._again, *other._again]
        return Runs(self.plan, columns, self._kinds, self._units, again)

    def extended(self, seeds: int | Iterable[int]) -> Runs:
        """These runs, and the same sweep with more seeds: `runs.extended(range(100, 200))`.

        Raises:
            ValueError: a seed was used before.
        """
        if not self._again:
            raise RuntimeError("pickled runs are only a table: sweep again")
        seeds = range(seeds) if isinstance(seeds, int) else list(seeds)
        known = set(self.columns["seed"])
        for seed in seeds:
            if seed in known:
                raise ValueError(f"the sweep has runs with seed {seed}; give other seeds")
        return self + self._again[0][0].more(seeds)

    # Statistics

    def mean(self, column: str, confidence: float = 0.95) -> Estimate:
        """The mean of a measure with its confidence interval; missing values do not count."""
        return estimates.mean(self._column(self._number(column)), confidence)

    def share(self, confidence: float = 0.95, **columns: Any) -> Estimate:
        """The share of runs with these values in these columns, as in `where`, with its confidence
        interval: `runs.share(ending="ok")` is the success rate.
        """
        tests = [self._test(name, plain(value)) for name, value in columns.items()]
        return estimates.share((all(test(row) for test in tests) for row in self), confidence)

    def difference(self, other: Runs, column: str, confidence: float = 0.95) -> Estimate:
        """The mean of `other` minus these runs, for pairs with equal world and seed.

        Raises:
            ValueError: a pair is missing, or a world and seed have several runs.
        """
        mine, others = self._paired(column), other._paired(column)
        if mine.keys() != others.keys():
            world, seed = min(mine.keys() ^ others.keys())
            raise ValueError(f"the run in the world '{world}' with seed {seed} has no partner")
        return estimates.difference(mine.values(), [others[pair] for pair in mine], confidence)

    def _paired(self, column: str) -> dict[tuple[str, int], Any]:
        pairs = zip(self.columns["world"], self.columns["seed"], self._column(self._number(column)), strict=True)
        found = {(world, seed): value for world, seed, value in pairs}
        if len(found) != len(self):
            raise ValueError("a world and seed have several runs: select one of them by where()")
        return found

    def by(self, column: str) -> dict[Any, Runs]:
        """The runs for each value of a column; varied numbers are in SI units."""
        cells = self._column(self._number(column))
        values = dict.fromkeys(cells)
        return {value: self._only(row for row, cell in enumerate(cells) if cell == value) for value in values}

    def where(self, columns: Mapping[str, Any] | None = None, /, **more: Any) -> Runs:
        """The runs with these values in these columns: `where(ending="error", seed=3)`.

        Varied values compare by number: `where(walldist=afp.cm(30))`, `where(walldist=0.3)` in SI
        units, `where(walldist="30 cm")`. For columns whose names are not Python names, give a
        dictionary: `where({"world.robot.charge": 0.5})`.
        """
        wanted = {**(columns or {}), **more}
        tests = [self._test(name, plain(value)) for name, value in wanted.items()]
        return self.filter(lambda row: all(test(row) for test in tests))

    def _test(self, name: str, value: Any) -> Callable[[dict[str, Any]], bool]:
        """Whether a row has a value in a column."""
        cells, kind, number = self._column(name), self._kinds[name], f"{name}_si"
        if kind == "text" and isinstance(value, int) and (isinstance(value, bool) or str(value) in cells):
            value = spelled(value)
        if number in self.columns and (found := self._found(name, value)) is not None:
            return lambda row: row[number] is not None and math.isclose(row[number], found, rel_tol=1e-12)
        of_kind = isinstance(value, str) if kind == "text" else isinstance(value, (int, float)) and not isinstance(value, bool)
        if value is not None and not of_kind:
            such = next((cell for cell in cells if cell is not None), "" if kind == "text" else 0)
            raise TypeError(f"the column '{name}' has values such as {such!r}, not {value!r}; filter() takes any condition")
        return lambda row: bool(row[name] == value)

    def _found(self, name: str, value: Any) -> float | None:
        """The number to find in a varied column; `None` for a column of strings."""
        unit = self._units.get(name.removeprefix("in."))
        if isinstance(value, Quantity) and unit is not None and value.unit != unit:
            raise TypeError(f"'{name}' is in {unit}, not in {value.unit}")
        if isinstance(value, str):
            return None if value in self.columns[name] else number_of(value, unit or "")
        return float(value) if isinstance(value, (int, float)) else None

    def filter(self, keep: Callable[[dict[str, Any]], Any]) -> Runs:
        """The runs for whose rows `keep` is true."""
        return self._only(number for number, row in enumerate(self) if keep(row))

    def _only(self, rows: Iterable[int]) -> Runs:
        these = list(rows)
        columns = {name: [cells[row] for row in these] for name, cells in self.columns.items()}
        again = None if self._again is None else [self._again[row] for row in these]
        return Runs(self.plan, columns, self._kinds, self._units, again)

    def _column(self, name: str) -> list[Any]:
        if name not in self.columns:
            raise KeyError(f"no column '{name}'; there are: {', '.join(self.columns)}")
        return self.columns[name]

    @property
    def endings(self) -> dict[str, int]:
        """The number of runs for each ending."""
        endings = self.columns["ending"]
        return {ending: endings.count(ending) for ending in dict.fromkeys(endings)}

    @property
    def groups(self) -> list[dict[str, Any]]:
        """Runs with equal ending, place and reason: `ending`, `where`, `why`, `count`, and the
        first `run`; failures last.
        """
        of = self.columns
        groups = alike(list(zip(of["ending"], of["where"], of["why"], of["run"], strict=True)))
        return [dict(zip(("ending", "where", "why", "count", "run"), group, strict=True)) for group in groups]

    # The runs themselves

    def simulation(self, row: int, *, log: str | os.PathLike[str] | None = None, camera: bool = False) -> Simulation:
        """The run of a row before its start, to watch, log, draw or change it."""
        if self._again is None:
            raise RuntimeError("pickled runs are only a table: sweep again, or make the simulation from the row")
        row = operator.index(row)
        again, run = self._again[row]
        return again.simulation(run, self.columns["seed"][row], log, flag("camera", camera))

    def result(self, row: int) -> Result:
        """Repeat the run of a row: its path, events and entries, which are not in the table."""
        simulation = self.simulation(row)
        assert self._again is not None
        return simulation.run(self._again[row][0].until)

    # Tables

    def to_pandas(self) -> Any:
        """The table as a pandas data frame; needs pandas."""
        kinds = {"count": "uint64", "number": "float64", "text": "string"}
        types = {name: kinds[kind] for name, kind in self._kinds.items()}
        # A run that never started has no counts.
        gaps = [name for name, kind in self._kinds.items() if kind == "count" and None in self.columns[name]]
        types |= dict.fromkeys(gaps, "UInt64")
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
        """The table for libraries that read Arrow; needs pyarrow."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    # Pictures

    def plot(self, x: str, y: str = "time_s", ax: Any = None) -> Any:
        """Draw a measure of each run over a varied value; needs matplotlib."""
        x = self._number(x)
        return plots.runs(self._column(x), self._column(y), self.columns["ending"], (self._label(x), self._label(y), self.plan), ax)

    def plot_map(self, x: str, y: str, value: str = "ending", ax: Any = None) -> Any:
        """Draw a map over two varied values; needs matplotlib.

        `value` is a measure, whose mean each cell shows, or a column of strings: then a cell has
        the colour of its runs' most frequent string, and shows that string's share.
        """
        names = (self._number(x), self._number(y), value)
        cells: dict[tuple[Any, Any], list[Any]] = {}
        for at_x, at_y, found in zip(*(self._column(name) for name in names), strict=True):
            cells.setdefault((at_x, at_y), []).append(found)
        return plots.outcome_map(cells, self._kinds[value] == "text", (*map(self._label, names), self.plan), ax)  # type: ignore[arg-type]

    def _label(self, column: str) -> str:
        return plots.label(column, self._units)

    def _number(self, column: str) -> str:
        """The column of a varied value's numbers, if it has numbers."""
        return f"{column}_si" if f"{column}_si" in self.columns else column

    # Display

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_again": None}

    def __eq__(self, other: object) -> bool:
        """Whether they are the same runs with the same outcomes, apart from durations."""
        return isinstance(other, Runs) and self.plan == other.plan and self._outcomes() == other._outcomes()

    __hash__ = None  # type: ignore[assignment]

    def _outcomes(self) -> dict[str, list[Any]]:
        return {name: cells for name, cells in self.columns.items() if name != "took_s"}

    def __repr__(self) -> str:
        endings = ", ".join(f"{count} {ending}" for ending, count in self.endings.items())
        return f"<Runs of {self.plan}: {endings or 'none'}>"

    def _repr_html_(self) -> str:
        commands = dict(zip(self.columns["run"], self.columns["command"], strict=True))
        heads = ("count", "ending", "where", "why", "the first")
        groups = self.groups
        lines = [[*(str(group[key]) for key in heads[:-1]), str(commands[group["run"]])] for group in groups]
        cells = ["".join(f"<td>{html.escape(cell)}</td>" for cell in line) for line in lines]
        head = "".join(f"<th>{head}</th>" for head in ("runs", *heads[1:]))
        table = f"<table><tr>{head}</tr>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"
        return table + "".join(self._images(groups))

    def _images(self, groups: Sequence[Mapping[str, Any]]) -> Iterator[str]:
        """The repeated first run of each group, failures first, as HTML elements; slow ones are
        left out.
        """
        if self._again is None or not all(again.is_quiet for again, _ in self._again[:1]):
            return
        left = SHOWN_S
        for group in groups[::-1][:SHOWN]:
            row = self.columns["run"].index(group["run"])
            left -= self.columns["took_s"][row]
            if left < 0:
                return
            if group["ending"] in BROKEN:
                continue
            what = html.escape(f"run {group['run']}: {group['ending']} {group['where']}".rstrip())
            image = f'<img alt="{what}" style="width:100%" src="{address(self.result(row).picture().svg)}">'
            yield f'<figure style="display:inline-block;width:320px;margin:4px">{image}<figcaption>{what}</figcaption></figure>'


class _Again:
    """Repeats runs of a sweep."""

    def __init__(self, plan: Plan, sweeper: Sweeper, until: float, more: Callable[[Any], Runs]) -> None:
        self.until = until
        self.more = more
        self._plan = plan
        self._sweeper = sweeper

    @property
    def is_quiet(self) -> bool:
        """Whether a run calls no user code, so that it may be repeated for display."""
        return self._sweeper.is_quiet

    def simulation(self, run: int, seed: int, log: str | os.PathLike[str] | None, camera: bool) -> Simulation:
        runner, world = self._sweeper.runner(run, log, camera)
        return Simulation._of(runner, self._plan, world, seed)
