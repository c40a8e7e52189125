"""The pytest plug-in: scenarios of `.afp` files as tests, and fixtures for plans, worlds and
simulations.

pytest collects every `.afp` file with scenarios in its folders; `-k` selects scenarios by words of
their names. A scenario runs on the engine of `afpc test`. A failure shows the broken line with its
place and the timeline around it, and the run is recorded below `target/afp/tests`.

A `conftest.py` can define the plans' components in Python:

    def pytest_afp_toolboxes(path):
        return [tools]
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Generator, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

import pytest

from . import Simulation, World, load
from ._afp import Plan, PlanError, Scenario, Toolbox, Verdict
from .places import Place
from .plan import Plan as TypedPlan

LOGS = Path("target/afp/tests")


class Hooks:
    """The hooks for a `conftest.py`."""

    @pytest.hookspec
    def pytest_afp_toolboxes(self, path: Path) -> list[Toolbox] | None:
        """The Python toolboxes for the plans of a file."""


def pytest_addhooks(pluginmanager: pytest.PytestPluginManager) -> None:
    pluginmanager.add_hookspecs(Hooks)


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("afp", "scenarios of Action Flow Plans")
    group.addoption("--no-afp", action="store_true", help="do not collect scenarios of .afp files")
    parser.addini("afp_logs", "folder for the logs of failed scenarios", default=str(LOGS))


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> AfpFile | None:
    if file_path.suffix != ".afp" or parent.config.getoption("--no-afp"):
        return None
    text = file_path.read_text(encoding="utf-8", errors="replace")
    if not any(line.lstrip().startswith("scenario ") for line in text.splitlines()):
        return None
    file: AfpFile = AfpFile.from_parent(parent, path=file_path)
    return file


def _toolboxes(node: pytest.Collector | pytest.Item, path: Path) -> list[Toolbox]:
    given: Iterable[list[Toolbox]] = node.ihook.pytest_afp_toolboxes(path=path)
    return [toolbox for some in given for toolbox in some]


class AfpFile(pytest.File):
    """A file with scenarios."""

    def collect(self) -> Iterator[AfpScenario | InvalidScenario]:
        plan = load(self.path, toolboxes=_toolboxes(self, self.path))
        invalid = plan._invalid()
        if not plan.ok and not invalid:
            raise self.CollectError(plan.report().rstrip())
        for scenario in plan.scenarios:
            item: AfpScenario = AfpScenario.from_parent(self, name=scenario.name, scenario=scenario)
            yield item
        for name, line, said in invalid:
            broken: InvalidScenario = InvalidScenario.from_parent(self, name=name, line=line, said=said)
            yield broken


class Failed(Exception):
    """A failed scenario."""

    def __init__(self, verdict: Verdict, log: Path | None) -> None:
        super().__init__(verdict.report)
        self.verdict = verdict
        self.log = log


class AfpScenario(pytest.Item):
    """A scenario as a test."""

    def __init__(self, *, scenario: Scenario, **options: Any) -> None:
        super().__init__(**options)
        self.scenario = scenario
        self.add_marker("afp")

    def runtest(self) -> None:
        verdict = self.scenario.run()
        self.user_properties.append(("simulated_s", verdict.time))
        self.user_properties.append(("trace", verdict.trace_hash))
        if verdict.passed:
            return
        # Repeat the run, since passing tests need no log.
        log = _log(self.config, self.nodeid)
        if log is not None:
            self.scenario.run(log=log)
        raise Failed(verdict, log)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        error = excinfo.value
        if not isinstance(error, Failed):
            return super().repr_failure(excinfo, style)
        lines = [f'scenario "{self.name}" of the plan {self.scenario.plan}']
        for broken in error.verdict.broken:
            place = os.path.relpath(broken.file, self.config.invocation_params.dir)
            lines.append(f"{place}:{broken.line}:{broken.column}: {broken.text}")
        lines += ["", error.verdict.report.rstrip()]
        if error.log is not None:
            lines.append(f"  log: {error.log}")
        return "\n".join(lines)

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, self.scenario.line - 1, f"scenario: {self.name}"


class InvalidScenario(pytest.Item):
    """An invalid scenario: a failing test next to the valid ones of its file."""

    def __init__(self, *, line: int, said: str, **options: Any) -> None:
        super().__init__(**options)
        self.line = line
        self.said = said
        self.add_marker("afp")

    def runtest(self) -> None:
        raise PlanError(self.said)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        return self.said

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, self.line - 1, f"scenario: {self.name}"


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "afp: a scenario of an .afp file")


def _log(config: pytest.Config, nodeid: str) -> Path | None:
    """The log file of a test; `None` if it cannot have one."""
    folder = config.rootpath / str(config.getini("afp_logs"))
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    readable = re.sub(r"[^a-z0-9.]+", "_", nodeid.lower()).strip("_.")
    # Replaced characters may make names equal.
    return folder / f"{readable}-{hashlib.sha256(nodeid.encode()).hexdigest()[:8]}.mcap"


# Fixtures


class _PlanMaker(Protocol):
    def __call__(self, path: str | os.PathLike[str], *, plan: str | None = None) -> TypedPlan: ...


class _SimulationMaker(Protocol):
    def __call__(
        self,
        plan: Plan | str | os.PathLike[str],
        world: Place | None = None,
        *,
        seed: int = 0,
        set: Mapping[str, Any] | None = None,
    ) -> Simulation: ...


class _WorldMaker(Protocol):
    def __call__(self, path: str | os.PathLike[str]) -> World: ...


def _find(request: pytest.FixtureRequest, path: str | os.PathLike[str]) -> Path:
    """Find a file next to the test, or else below pytest's root folder."""
    beside = request.path.parent / path
    return beside if beside.exists() else request.config.rootpath / path


@pytest.fixture
def afp_plan(request: pytest.FixtureRequest) -> _PlanMaker:
    """Load plans: `afp_plan("plans/patrol.afp")`, relative to the test's folder or to pytest's root
    folder.
    """

    def make(path: str | os.PathLike[str], *, plan: str | None = None) -> TypedPlan:
        file = _find(request, path)
        loaded = load(file, plan=plan, toolboxes=_toolboxes(request.node, file))
        loaded.check()
        return loaded

    return make


@pytest.fixture
def afp_world(request: pytest.FixtureRequest) -> _WorldMaker:
    """Load worlds: `afp_world("worlds/hall.toml")`, `afp_world("random:7")`."""

    def make(path: str | os.PathLike[str]) -> World:
        return World.load(path if str(path).startswith("random:") else _find(request, path))

    return make


@pytest.fixture
def afp_simulation(
    request: pytest.FixtureRequest, afp_plan: _PlanMaker, afp_world: _WorldMaker, tmp_path: Path
) -> Iterator[_SimulationMaker]:
    """Make simulations: `afp_simulation("plans/patrol.afp", seed=3)`.

    They are recorded into the test's `tmp_path`. If the test fails, their timelines are shown with
    the paths of the logs.
    """
    made: list[tuple[Simulation, Path]] = []

    def make(
        plan: Plan | str | os.PathLike[str],
        world: Place | None = None,
        *,
        seed: int = 0,
        set: Mapping[str, Any] | None = None,
    ) -> Simulation:
        loaded = plan if isinstance(plan, Plan) else afp_plan(plan)
        room = world if world is None or isinstance(world, World) else afp_world(world)
        log = tmp_path / f"simulation-{len(made) + 1}.mcap"
        simulation = Simulation(loaded, room, seed=seed, set=set, log=log)
        made.append((simulation, log))
        return simulation

    request.node.stash[_MADE] = made
    yield make
    for simulation, _ in made:
        simulation.close()


_MADE = pytest.StashKey[list[tuple[Simulation, Path]]]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Add the timelines of the simulations to the report of a failed test."""
    report = yield
    if report.when == "call" and report.failed:
        for simulation, log in item.stash.get(_MADE, []):
            timeline = "\n".join([*simulation._runner.timeline, f"log: {log}"])
            report.sections.append((f"timeline of {simulation!r}", timeline))
    return report
