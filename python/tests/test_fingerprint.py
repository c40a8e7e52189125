"""Fingerprints of metrics and components."""

from __future__ import annotations

import enum
import functools
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import afp
from afp.fingerprint import digest, fingerprint

# Programs that make 'it', which reads or contains K; each K gives another fingerprint.
SOURCES = {
    "what it does": "def it(r): return K * r.time",
    "a global": "k = K\ndef it(r): return k * r.time",
    "a global of an inner function": "k = K\ndef it(r): return (lambda: k)()",
    "a closure": "def make(k):\n return lambda r: k\nit = make(K)",
    "a default": "def it(r, k=K): return k",
    "a default by name": "def it(r, *, k=K): return k",
    "a function that it calls": "def f(): return K\ndef it(r): return f()",
    "what that reads": "k = K\ndef f(): return k\ndef it(r): return f()",
    "a decorator": "def two(f):\n import functools\n @functools.wraps(f)\n def g(r): return K * f(r)\n return g\n@two\ndef it(r): return 1",
    "a list": "k = [1, [2, {'a': (K,)}]]\ndef it(r): return k",
    "a set": "k = {'a', 'b', 'c', K}\ndef it(r): return k",
    "an array": "import numpy as np\nk = np.array([1.0, K])\ndef it(r): return k",
    "an object": "class A:\n def __init__(self, k): self.k = k\na = A(K)\ndef it(r): return a.k",
    "a class": "class A:\n def f(self): return K\na = A()\ndef it(r): return a.f()",
    "a method": "class A:\n k = K\n def f(self, r): return self.k\nit = A().f",
    "a partial": "import functools\ndef f(k, r): return k\nit = functools.partial(f, K)",
    "a method of a class": "class it:\n def poll(self): return K",
    "an attribute of a class": "class it:\n k = K\n def poll(self): return self.k",
    "a property": "class it:\n @property\n def k(self): return K\n def poll(self): return self.k",
    "a base class": "class A:\n def poll(self): return K\nclass it(A): pass",
    "a cache": "import functools\n@functools.lru_cache\ndef f(): return K\ndef it(r): return f()",
    "a quantity": "import afp\nk = afp.cm(K)\ndef it(r): return k",
    "a cycle": "k = [K]\nk.append(k)\ndef it(r): return k",
}


def made(source: str, k: int) -> Any:
    space: dict[str, Any] = {"K": k, "__name__": "made"}
    exec(source.replace("K", str(k)), space)
    return space["it"]


@pytest.mark.parametrize("source", SOURCES.values(), ids=SOURCES)
def test_code_and_inputs_change_the_fingerprint(source: str) -> None:
    assert fingerprint(made(source, 1)) == fingerprint(made(source, 1))
    assert fingerprint(made(source, 1)) != fingerprint(made(source, 5))


def test_places_and_comments_do_not_change_the_fingerprint() -> None:
    assert fingerprint(made("def it(r): return 1", 1)) == fingerprint(made("\n# one\ndef it(r):\n    return 1", 1))


def test_fingerprints_are_equal_in_other_processes() -> None:
    tell = "import test_fingerprint as it\nprint([it.fingerprint(it.made(source, 3)) for source in it.SOURCES.values()])"
    command, here = [sys.executable, "-c", tell], Path(__file__).parent
    ran = [subprocess.run(command, check=True, capture_output=True, cwd=here).stdout for _ in range(2)]
    assert ran[0] == ran[1]


def test_every_value_has_a_fingerprint() -> None:
    class Side(enum.Enum):
        LEFT = 1

    deep: list[Any] = []
    for _ in range(100_000):
        deep = [deep]
    values = [np, len, [].append, threading.Lock(), Side.LEFT, Side, open(__file__), (x for x in ()), deep, object(), afp.sweep]
    values += [np.sin, np.float64(1), np.random.default_rng(1), functools.cached_property(len), afp.Plan(""), Path("a"), type]
    assert len({digest(value) for value in values}) == len(values)


def make(wait: int) -> afp.Toolbox:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    async def Wait() -> str:
        for _ in range(wait):
            await afp.tick()
        return "Done"

    return tools


def test_other_variables_change_the_fingerprint_of_a_toolbox() -> None:
    assert make(5) == make(5) and make(5) != make(50)


GO = "use carbot\nplan Go { start go actor go: Forward(distance = 20 cm) { ForwardSuccessful -> terminate } }"


def scaled(k: float) -> Callable[[afp.Result], float]:
    return lambda result: k * result.time


def twice(result: afp.Result) -> float:
    return 2 * result.time


METRICS: list[tuple[dict[str, Any], str]] = [
    ({"q": scaled(5.0)}, "'k', which the metric 'q' reads, has changed since"),
    ({"q": twice}, "the metric 'q' has changed since"),
    ({}, "it was started with the metric 'q'"),
    ({"q": scaled(1.0), "p": twice}, "it was started without the metric 'p'"),
]


@pytest.mark.parametrize(("metrics", "wanted"), METRICS)
def test_a_sweep_reports_its_changed_part(tmp_path: Path, metrics: dict[str, Any], wanted: str) -> None:
    grid: dict[str, Any] = {"seeds": 2, "until": 1.0, "progress": False, "out": tmp_path / "runs.csv"}
    first = afp.sweep(afp.Plan(GO), **grid, metrics={"q": scaled(1.0)})
    assert first == afp.sweep(afp.Plan(GO), **grid, metrics={"q": scaled(1.0)})
    with pytest.raises(afp.AfpError, match=f"belongs to another sweep: {wanted}") as raised:
        afp.sweep(afp.Plan(GO), **grid, metrics=metrics)
    assert "restart=True" in str(raised.value) and "--restart" not in str(raised.value)
    assert afp.sweep(afp.Plan(GO), **grid, metrics=metrics, restart=True).columns["run"] == [0, 1]


def test_other_variables_of_a_component_make_another_sweep(tmp_path: Path) -> None:
    def sweep(wait: int) -> afp.Runs:
        text = "use tools\nplan P { start go actor go: Wait { Done -> terminate } }"
        return afp.sweep(afp.Plan(text, toolboxes=[make(wait)]), until=2.0, progress=False, out=tmp_path / "runs.csv")

    assert sweep(5).columns == sweep(5).columns
    with pytest.raises(afp.AfpError, match="'wait', which the component 'tools.Wait' reads, has changed since"):
        sweep(50)
