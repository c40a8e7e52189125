"""Shared parts of the tests."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import afp

ROOT = Path(__file__).resolve().parents[2]
PLANS = sorted((ROOT / "plans").glob("*.afp"))


def interrupted(work: Callable[[], object], after: float = 0.3) -> float:
    """Seconds from Ctrl-C to its exception; Ctrl-C comes some seconds after the work has begun."""
    sent: list[float] = []

    def send() -> None:
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(after, send).start()
    with pytest.raises(KeyboardInterrupt):
        work()
    return time.perf_counter() - sent[0]


@pytest.fixture(autouse=True)
def interruptible() -> Iterator[None]:
    """Make Ctrl-C raise, even if a shell has started the tests in the background with SIGINT
    ignored.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def wall_following() -> afp.Plan:
    """The plan of the paper."""
    return afp.load(ROOT / "plans/wall_following.afp")


@pytest.fixture
def afpc() -> str:
    """The command line for comparisons."""
    path = os.environ.get("AFPC")
    if path is None:
        pytest.skip("AFPC does not name an afpc; 'cargo xtask test python' sets it")
    return path
