"""Sweeps on a Ray cluster; it needs ray.

    afp.sweep(plan, seeds=range(10_000), backend="ray", out="runs.parquet")

The runs go out in chunks, as tasks of one CPU each. A chunk whose worker or machine dies is done again elsewhere; each
run counts once, whatever was done twice. Ray is started on this machine unless `ray.init` has been called.

Workers need the package, and the plan's files and worlds under the same paths: a shared folder, or the driver's folder
sent along with `ray.init(runtime_env={"working_dir": "."})` and paths relative to it. A worker that sees other texts
refuses. Components in Python go along by value or, those of modules that workers can import, by reference
(cloudpickle); workers run them in processes of their own, so that they do not wait for one another.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ._afp import AfpError, Plan, Sweeper, Toolbox
from .sweeps import Spec
from .tables import need

__all__ = ["Sent", "run"]

RETRIES = 5
"""How often a chunk is done again when its worker dies."""
WAITING = 64
"""Chunks that are handed to Ray ahead of time."""


@dataclass(frozen=True)
class Sent:
    """What a worker makes the sweep of."""

    text: str
    path: str | None
    name: str
    toolboxes: list[Toolbox]
    spec: Spec

    @staticmethod
    def of(plan: Plan, spec: Spec) -> Sent:
        """For a plan, with its components in Python."""
        path = None if plan.path is None else os.fspath(plan.path)
        return Sent(plan.text, path, plan.name, plan.toolboxes, spec)

    def packed(self) -> bytes:
        """What is sent to workers."""
        try:
            packed: bytes = need("ray.cloudpickle").dumps(self)
        except (TypeError, pickle.PicklingError) as error:
            text = f"the plan's components or the metrics cannot be sent to other processes: {error}"
            help = 'let them make there what cannot be pickled, or use backend="local"'
            raise TypeError(f"{text}\n  help: {help}") from None
        return packed

    def sweeper(self) -> Sweeper:
        """The sweep."""
        return self.spec.sweeper(Plan(self.text, self.path, name=self.name, toolboxes=self.toolboxes))


def run(
    sent: Sent,
    sweeper: Sweeper,
    runs: Sequence[int],
    tell: Callable[[int], Any],
    on_run: Callable[[dict[str, Any]], Any] | None = None,
    *,
    chunk: int | None = None,
) -> None:
    """Does runs on the cluster; `sweeper` keeps their outcomes, `tell` hears how many of all are done, `on_run` of each."""
    ray = need("ray")
    if not ray.is_initialized():
        ray.init(include_dashboard=False, log_to_driver=False)
    cpus = int(ray.cluster_resources().get("CPU", 1))
    size = chunk or max(1, min(100, len(runs) // (4 * max(cpus, 1))))
    chunks = [list(runs[first : first + size]) for first in range(0, len(runs), size)]
    packed, identity = ray.put(sent.packed()), sweeper.identity
    task = ray.remote(num_cpus=1, max_retries=RETRIES)(work)
    done = sweeper.total - len(runs)
    waiting: list[Any] = []
    try:
        while chunks or waiting:
            while chunks and len(waiting) < max(WAITING, 2 * cpus):
                waiting.append(task.remote(packed, identity, chunks.pop(0)))
            # With a limit, so that Ctrl-C is seen.
            ready, waiting = ray.wait(waiting, timeout=0.5)
            for each in ready:
                worker, lines = ray.get(each)
                done += sweeper.accept(lines, on_run)
                collected(worker)
                tell(done)
    finally:
        for each in waiting:
            ray.cancel(each, force=True)


def work(packed: bytes, identity: str, runs: list[int]) -> tuple[int, list[str]]:
    """Does a chunk, in a worker: its process, and outcomes as lines of JSON."""
    sent: Sent = pickle.loads(packed)
    sweeper = sent.sweeper()
    if sweeper.identity != identity:
        text = "this worker has other versions of the package, the plan's files or the worlds than the driver"
        raise AfpError(f"{text}\n  driver: {identity}\n  worker: {sweeper.identity}")
    return os.getpid(), sweeper.lines(runs, 1, sent.spec.judge(sent.name))


def collected(worker: int) -> None:
    """A chunk has come from a worker; for tests that disturb workers."""
