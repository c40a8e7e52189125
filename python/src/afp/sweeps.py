"""Sweeps: many runs of a plan over worlds, seeds and values."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import components, drawn
from ._afp import Plan, Runner, Sweeper, Toolbox, World
from .fingerprint import Fingerprint, digest, fingerprint
from .places import Place, place_of
from .progress import teller
from .result import Result
from .runs import Runs
from .seeds import seed_of
from .stimuli import Fault, Faults, Press, Presses
from .units import seconds

__all__ = ["Runs", "sweep"]

Metric = Callable[[Result], float | None]
Draw = Callable[[np.random.Generator], Any]
DrawWorld = Callable[[np.random.Generator], Place]

MOST_RUNS = 10_000_000
"""The maximum number of runs of a sweep."""


def sweep(
    plan: Plan,
    worlds: Place | Iterable[Place] | DrawWorld | None = None,
    seeds: int | Iterable[int] = 1,
    vary: Mapping[str | Fault | Press, Any] | None = None,
    *,
    draw: Mapping[str, Draw | Iterable[Any]] | None = None,
    until: float = 60.0,
    presses: Presses = (),
    faults: Faults = (),
    metrics: Mapping[str, Metric] | None = None,
    on_run: Callable[[dict[str, Any]], Any] | None = None,
    jobs: int | None = None,
    progress: bool | Callable[[int, int], Any] = True,
    out: str | os.PathLike[str] | None = None,
    restart: bool = False,
    backend: str = "local",
) -> Runs:
    """Run a plan once for every combination of world, values and seed, on all cores.

    `worlds` are files, `random:7`, or `World` objects; the default is the plan's world. A function
    of a `numpy.random.Generator` draws one world for each seed, with its robot. `seeds` is
    a number of seeds from 0 on, or the seeds: `range(0, 100, 10)`, `[1, 5]`. `vary` maps entries,
    or values of the world's file (`"world.robot.charge"`), to values: one (`afp.cm(30)`), several
    (`[afp.cm(30), "40cm", 0.5]`, an array) or a range as on the command line (`"20cm..60cm:5cm"`).
    Each run is stopped at `until` seconds.

    `presses` and `faults` apply to each run: `[afp.Press("escape", at=1.0)]`,
    `[afp.Fault("ultrasonic", "frozen", at=5.0, lasting=2.0)]`. A stimulus in `vary` is tried at
    several times: `{afp.Press("touch"): [1.0, 2.0, 3.0]}`.

    `draw` maps entries, or values of the world's file, to functions of a `numpy.random.Generator`:
    `{"world.robot.charge": lambda rng: rng.uniform(0.2, 1.0)}`. `presses` and `faults` may be such
    functions, too. Each is called once for each seed, with a generator of its own, so that runs with
    equal seeds have equal draws in every world and for all varied values. `draw` also takes lists
    with a value for each seed, such as the samples of a design of experiments.

    `metrics` adds columns: functions that take the `Result` of a run and return a number or `None`.
    `on_run` receives the row of each finished run. Both are called in the calling thread.

    `jobs` is the number of threads. The engine of `afpc sweep` does the runs while other Python
    threads continue. Components written in Python take turns for the interpreter; a cluster has
    several processes. `progress` shows a bar on a terminal or in a notebook, or is a function of
    the finished and the total number of runs.

    `out` (`runs.csv`, `runs.parquet`, or a folder for both) keeps each outcome immediately. The
    same call resumes a stopped or killed sweep, unless `restart` is set; `afpc sweep` can resume
    it, too.

    `backend="ray"` distributes the runs over a Ray cluster; it needs ray, see `afp.cluster`.
    """
    if not isinstance(plan, Plan):
        raise TypeError(f"a sweep needs a Plan, not a {type(plan).__name__}: afp.load() reads one")
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs is {jobs}; give at least 1 thread, or None for all cores")
    if backend not in ("local", "ray"):
        raise ValueError(f"no backend '{backend}'; there are: local, ray")
    until = seconds("until", until)
    if on_run is not None and not callable(on_run):
        raise TypeError(f"on_run is a function that gets the row of a run, not {on_run!r}")
    if not isinstance(vary, (Mapping, type(None))):
        raise TypeError(f"vary gives entries lists of values, such as {{'walldist': [afp.cm(30), afp.cm(40)]}}, not {vary!r}")
    numbers = _seeds(seeds)
    each = range(*numbers) if isinstance(numbers, tuple) else numbers
    axes = [_axis(name, given) for name, given in (vary or {}).items()]
    axes += drawn.axes(each, draw, presses, faults)
    stimuli = (drawn.spelled(Press, presses), drawn.spelled(Fault, faults))
    rooms = (drawn.each("world", worlds, each), True) if callable(worlds) else (worlds, False)
    spec = Spec((_worlds(rooms[0]), rooms[1]), numbers, axes, until, _metrics(metrics), stimuli)
    sweeper = spec.sweeper(plan, out is not None or backend != "local")
    if out is not None:
        sweeper.open(os.fspath(out), restart)
    left = sweeper.left()
    tell = teller(progress, sweeper.total)
    try:
        if backend == "local":
            before = sweeper.total - len(left)
            sweeper.run(left, jobs, lambda done: tell(before + done, sweeper.total), on_run, spec.judge(plan.name))
        else:
            from . import cluster

            cluster.run(cluster.Sent.of(plan, spec), sweeper, left, lambda done: tell(done, sweeper.total), on_run)
    finally:
        tell(-1, sweeper.total)
        if out is not None:
            sweeper.write()
    def more(seeds: Any) -> Runs:
        return sweep(
            plan,
            worlds,
            seeds,
            vary,
            draw=draw,
            until=until,
            presses=presses,
            faults=faults,
            metrics=metrics,
            jobs=jobs,
            progress=progress,
            backend=backend,
        )

    return Runs.of(plan, sweeper, until, more)


@dataclass(frozen=True)
class Spec:
    """The arguments of a sweep, for the native half."""

    worlds: tuple[list[World | str | None], bool]
    """The worlds, and whether there is one for each seed."""
    seeds: tuple[int, int] | list[int]
    vary: list[drawn.Axis]
    until: float
    metrics: dict[str, Metric]
    stimuli: tuple[list[str], list[str]] = ([], [])
    """The presses and the faults."""

    def sweeper(self, plan: Plan, is_kept: bool = True) -> Sweeper:
        """The sweep of a plan; fingerprints are needed only if it is kept or sent."""
        parts = dict(self._parts(plan.toolboxes)) if is_kept else {}
        return Sweeper(plan, self.worlds, self.seeds, self.vary, self.until, self.stimuli, list(self.metrics), parts)

    def _parts(self, toolboxes: Iterable[Toolbox]) -> Iterator[tuple[str, Fingerprint]]:
        """The Python parts with their fingerprints."""
        for toolbox in toolboxes:
            yield f"the toolbox '{toolbox.name}'", (digest(toolbox.text), {})
            if isinstance(toolbox, components.Toolbox):
                for template, found in toolbox.fingerprints().items():
                    yield f"the component '{toolbox.name}.{template}'", found
        for name, metric in self.metrics.items():
            yield f"the metric '{name}'", fingerprint(metric)

    def judge(self, plan: str) -> Callable[[Runner, World, int], dict[str, float | None]] | None:
        """A function that computes a run's metrics; `None` without metrics."""
        if not self.metrics:
            return None

        def figures(runner: Runner, world: World, seed: int) -> dict[str, float | None]:
            result = Result(runner, plan, world, seed)
            return {name: _figure(name, metric(result)) for name, metric in self.metrics.items()}

        return figures


def _metrics(metrics: Mapping[str, Metric] | None) -> dict[str, Metric]:
    if not isinstance(metrics, (Mapping, type(None))):
        raise TypeError(f"metrics gives functions names, such as {{'way': lambda result: result.distance}}, not {metrics!r}")
    for name, metric in (metrics or {}).items():
        if not (isinstance(name, str) and name.isidentifier()):
            raise ValueError(f"a metric becomes a column: name it with letters, digits and '_', not {name!r}")
        if not callable(metric):
            raise TypeError(f"the metric '{name}' is a function that gets a Result, not {metric!r}")
    return dict(metrics or {})


def _figure(name: str, value: float | None) -> float | None:
    if value is None:
        return None
    try:
        figure = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"the metric '{name}' gives a number or None, not {value!r}") from None
    # A result that is not a number counts as missing.
    if math.isinf(figure):
        raise ValueError(f"the metric '{name}' returned {figure}; return None if there is no number")
    return None if math.isnan(figure) else figure


def _worlds(worlds: Place | Iterable[Place] | None) -> list[World | str | None]:
    if worlds is None:
        return [None]
    if isinstance(worlds, (World, str, os.PathLike)) or hasattr(worlds, "build"):
        worlds = [worlds]  # type: ignore[list-item]
    if not isinstance(worlds, Iterable):
        raise TypeError(f"worlds are files, strings such as 'random:7', or Worlds, one or several, not {worlds!r}")
    return [_world(world) for world in worlds]


def _world(world: Place) -> World | str:
    place = place_of(world)
    return os.fspath(place.path) if isinstance(place, World) and place.path is not None else place


def _seeds(seeds: int | Iterable[int]) -> tuple[int, int] | list[int]:
    if isinstance(seeds, range) and seeds.step == 1 and seeds:
        return (seed_of(seeds.start), seed_of(seeds.stop))
    if not isinstance(seeds, Iterable) or isinstance(seeds, str):
        return (0, _count(seeds))
    these = [seed_of(seed) for seed in itertools.islice(seeds, MOST_RUNS + 1)]
    if not these:
        raise ValueError(f"there are no seeds in {seeds}")
    if len(these) > MOST_RUNS:
        raise ValueError(f"these are more than {MOST_RUNS} seeds; give a range with a step of 1, or a part of them")
    return these


def _count(seeds: int) -> int:
    wrong = f"seeds is {seeds!r}; give their number, a range or a list of whole numbers"
    if not hasattr(seeds, "__index__"):
        raise TypeError(wrong)
    if seeds < 1:
        raise ValueError(wrong)
    return seed_of(seeds)


def _axis(name: str | Fault | Press, values: Any) -> drawn.Axis:
    if isinstance(name, (Fault, Press)):
        times = list(values) if isinstance(values, Iterable) and not isinstance(values, str) else [values]
        return name._axis, [(name.starting(time)._point(), None) for time in times], False
    return name, _values(name, values), False


def _values(name: str, values: Any) -> str | list[tuple[str, str | None]]:
    """The values of an entry as strings, each with its unit: empty for a bare number, `None` for a
    string.
    """
    if isinstance(values, str):
        return values
    each = values if isinstance(values, Iterable) else [values]
    try:
        texts = [drawn.text_of(value) for value in each]
    except (TypeError, ValueError) as error:
        raise type(error)(f"the values of '{name}': {error}") from None
    if not texts:
        raise ValueError(f"'{name}' has no values")
    return texts
