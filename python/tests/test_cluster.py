"""Sweeps on a local Ray give the local engine's outcomes, even if a worker dies."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import afp
from afp import cluster
from afp.sweeps import Spec

if not os.environ.get("AFP_RAY"):
    pytest.skip("AFP_RAY is not set; the nightly suite 'python long' sets it", allow_module_level=True)

import ray

ROOT = Path(__file__).resolve().parents[2]
GRID: dict[str, Any] = {"seeds": 20, "vary": {"walldist": ["30cm", "40cm"]}, "until": 5.0}


@pytest.fixture(scope="module", autouse=True)
def local() -> Iterator[None]:
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


def rows(runs: afp.Runs) -> list[dict[str, Any]]:
    return [{**runs[row], "took_s": 0} for row in range(len(runs))]


def test_after_the_death_of_a_worker_each_run_counts_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    plan = afp.load(ROOT / "plans/wall_following.afp")
    killed: list[int] = []
    marks, work = tmp_path / "marks", cluster.work
    marks.mkdir()

    def watched(spec: bytes, identity: str, runs: list[int]) -> tuple[int, list[str]]:
        """Leave a mark for each chunk in work, with the number of its attempts."""
        mark = marks / f"{os.getpid()}.{runs[0]}"
        mark.touch()
        with open(marks.parent / "begun", "a") as begun:
            begun.write(f"{runs[0]}\n")
        done = work(spec, identity, runs)
        mark.unlink()
        return done

    def collected(worker: int) -> None:
        while not killed:
            for mark in marks.iterdir():
                killed.append(int(mark.name.split(".")[0]))
                os.kill(killed[0], signal.SIGKILL)
                return
            time.sleep(0.01)

    monkeypatch.setattr(cluster, "work", watched)
    monkeypatch.setattr(cluster, "collected", collected)
    told: list[int] = []
    out = tmp_path / "runs.parquet"
    spread = afp.sweep(plan, **GRID, backend="ray", out=out, progress=lambda done, total: told.append(done))
    begun = (tmp_path / "begun").read_text().split()
    assert len(killed) == 1 and len(begun) > len(set(begun)), "a chunk was torn and begun again"
    assert told == sorted(set(told)) and told[-1] == 40
    assert len(out.with_suffix(".parquet.journal").read_text().splitlines()) == 41
    assert rows(spread) == rows(afp.sweep(plan, **GRID, progress=False))


def test_a_worker_with_another_plan_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "go.afp"
    file.write_text("use carbot\nplan Go { start go actor go: Forward(distance = 1 m) { ForwardSuccessful -> terminate } }")
    spec = cluster.Sent.of(afp.load(file), Spec([None], (0, 1), [], 5.0, {}))
    with pytest.raises(afp.AfpError, match="other versions"):
        cluster.work(spec.packed(), "another", [0])


def creeping(kept: Any) -> afp.Plan:
    """A plan with an actor that no module exports, and that refers back to its toolbox."""
    tools = afp.Toolbox("tools", doc="Sent along.")

    @tools.actor(states={"There": {"went": afp.Length}}, uses=["navigator"])
    async def Creep(robot: afp.Robot, far: afp.Length) -> Any:
        assert kept is not None and "Creep" in tools.implemented
        while robot.odometry[0] < far:
            robot.drive(0.2)
            await afp.tick()
        return "There", {"went": float(robot.odometry[0])}

    text = "actor go: Creep(far = far, went => went) { There -> terminate }"
    return afp.Plan(
        f"use tools\nplan P {{ in far: length = 20 cm var went: length start go {text} }}", toolboxes=[tools]
    )


def test_components_in_python_are_sent_to_workers() -> None:
    grid: dict[str, Any] = {"seeds": 6, "vary": {"far": ["10cm", "20cm"]}, "until": 5.0, "progress": False}
    plan = creeping([1, 2])
    spread = afp.sweep(plan, **grid, backend="ray")
    assert rows(spread) == rows(afp.sweep(plan, **grid)) and spread.endings == {"ok": 12}


def test_unsendable_components_are_reported() -> None:
    with pytest.raises(TypeError, match="sent to other processes: cannot pickle '_thread.lock' object\n  help: let them"):
        afp.sweep(creeping(threading.Lock()), backend="ray", progress=False)
