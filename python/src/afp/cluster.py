"""Sweeps on a Ray cluster; needs ray.

    afp.sweep(plan, seeds=range(10_000), backend="ray", out="runs.parquet")

The runs are sent in chunks, as tasks of one CPU each. If a worker or machine dies, its chunk is
repeated elsewhere; each run counts once. Ray is started on this machine unless you have called
`ray.init`.

Workers need the package, and the plan's files and worlds under the same paths. Use a shared folder,
or relative paths and `ray.init(runtime_env={"working_dir": "."})`, which sends the driver's folder
along. A worker with different files raises an error. Components in Python are sent by value
(cloudpickle), or by reference if workers can import their module. Each worker runs them in separate
processes, so that they do not wait for one another.
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
"""The maximum number of repetitions of a chunk after a worker dies."""
WAITING = 64
"""Chunks that are handed to Ray ahead of time."""


@dataclass(frozen=True)
class Sent:
    """The data from which a worker makes the sweep."""

    text: str
    path: str | None
    name: str
    toolboxes: list[Toolbox]
    spec: Spec

    @staticmethod
    def of(plan: Plan, spec: Spec) -> Sent:
        """Collect the data of a plan, with its components in Python."""
        path = None if plan.path is None else os.fspath(plan.path)
        return Sent(plan.text, path, plan.name, plan.toolboxes, spec)

    def packed(self) -> bytes:
        """Pack the data for workers."""
        try:
            packed: bytes = need("ray.cloudpickle").dumps(self)
        except (TypeError, pickle.PicklingError) as error:
            text = f"the plan's components or the metrics cannot be sent to other processes: {error}"
            help = 'create such objects in the worker, or use backend="local"'
            raise TypeError(f"{text}\n  help: {help}") from None
        return packed

    def sweeper(self) -> Sweeper:
        """Make the sweep."""
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
    """Do runs on the cluster. `sweeper` keeps their outcomes, `tell` receives the number of
    finished runs, and `on_run` receives each row.
    """
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
            # The timeout lets Ctrl-C through.
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
    """Do a chunk in a worker; return its process and outcomes as lines of JSON."""
    sent: Sent = pickle.loads(packed)
    sweeper = sent.sweeper()
    if sweeper.identity != identity:
        text = "this worker has other versions of the package, the plan's files or the worlds than the driver"
        raise AfpError(f"{text}\n  driver: {identity}\n  worker: {sweeper.identity}")
    return os.getpid(), sweeper.lines(runs, 1, sent.spec.judge(sent.name))


def collected(worker: int) -> None:
    """Called for each chunk from a worker; a hook for tests that disturb workers."""
