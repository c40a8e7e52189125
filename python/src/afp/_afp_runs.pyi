# Stubs of the native half, `_afp`: runs, events, sweeps. It is not a module.

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn, final

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Self, disjoint_base

from ._afp_plans import Plan, World

@final
class Robot:
    """The robot of a component: devices and time, without ground truth.

    Use it only while a component is being called."""

    @property
    def time(self) -> float:
        """The time of this step, in seconds since the start."""
    @property
    def distance(self) -> float | None:
        """The distance to the nearest object ahead of the range sensor, in metres. It is infinite
        without an echo, and `None` before the first ping or if the sensor cannot measure it."""
    @property
    def bearing(self) -> float:
        """The bearing of the range sensor, in radians to the left of the heading."""
    @property
    def odometry(self) -> NDArray[np.float64]:
        """The odometry: x and y in metres and heading in radians, relative to the start, speed, turn
        rate."""
    @property
    def touched(self) -> bool:
        """Whether the bumper is pressed."""
    @property
    def escape(self) -> bool:
        """Whether the escape button is held."""
    @property
    def battery(self) -> tuple[float, float]:
        """The battery's voltage, and the remaining share of its charge."""
    @property
    def color(self) -> NDArray[np.float64] | None:
        """Red, green and blue of the floor, from 0 to 1; `None` before the first measurement."""
    @property
    def glow(self) -> tuple[float, float] | None:
        """Bearing (radians) and strength of the brightest infrared source; `None` without a source."""
    @property
    def camera(self) -> NDArray[np.uint8] | None:
        """A copy of the latest picture, rows x columns x 3; `None` before the first one."""
    def drive(self, speed: float, turn: float = 0.0) -> None:
        """Request a speed (m/s) and a turn rate (rad/s, to the left). It holds for at most a fifth of
        a second, so repeat it."""
    def stop(self) -> None:
        """Request a stop."""
    def point(self, bearing: float) -> None:
        """Point the range sensor, in radians to the left of the heading."""
    def sense(self, signal: str) -> Any:
        """The value of a signal, by device and name: `robot.sense("bumper.left")`. `None` before its
        first value."""
    def __reduce__(self) -> NoReturn: ...

@final
class Event:
    """An event of a run."""

    @property
    def time(self) -> float:
        """The time in seconds since the start."""
    @property
    def kind(self) -> str:
        """Its kind: `started`, `event`, `finished`, `interrupted`, `committed`, `faulted`, `ended`,
        ..."""
    @property
    def component(self) -> str:
        """The path of the element or supervisor; for `committed`, the author."""
    @property
    def outcome(self) -> str | None:
        """The state or event."""
    @property
    def target(self) -> str | None:
        """The target of the outcome."""
    @property
    def supervisor(self) -> str | None:
        """The supervisor that diverted a start, or whose event resumed."""
    @property
    def element(self) -> str | None:
        """The element that was active or starting when an event was taken."""
    @property
    def on(self) -> bool:
        """Whether the element's own `on` gave the target, and not the supervisor."""
    @property
    def entry(self) -> str | None:
        """The written entry."""
    @property
    def port(self) -> str | None:
        """The input port."""
    @property
    def old(self) -> Any:
        """The value before a commit."""
    @property
    def value(self) -> Any:
        """The value of an entry after a commit, or of an input."""
    @property
    def unit(self) -> str | None:
        """The SI unit of the values."""
    @property
    def ending(self) -> str | None:
        """How a plan ended: `ok`, `interrupted`, `error`."""
    @property
    def fault(self) -> str | None:
        """The code of a fault."""
    @property
    def fault_text(self) -> str | None:
        """The fault in words."""
    @property
    def request(self) -> str | None:
        """The stimulus in the words of scenarios: `press touch.touch`."""
    @property
    def refused(self) -> str | None:
        """The reason why a stimulus was not applied, or `not reached`."""
    @property
    def lateness(self) -> float | None:
        """The lateness of a missed deadline, in seconds."""
    @property
    def cause(self) -> str | None:
        """The reason for a missed deadline: `late_release` or `long_poll`."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    @staticmethod
    def _again(message: bytes, line: str | None) -> Event: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Names:
    """The names of a plan at its run."""

    def draw(
        self,
        plan: str,
        world: World,
        seed: int,
        time: float,
        path: NDArray[np.float64],
        events: Sequence[Event],
        things: dict[str, list[list[float]]],
    ) -> str:
        """The path of a run over its world, as SVG: rows of time, x, y, heading, the events, and the
        last outlines of moving things."""

@final
class Runner:
    """A plan in a simulated world, the base of `afp.Simulation`."""

    def __new__(
        cls,
        plan: Plan,
        world: World,
        seed: int,
        set: dict[str, Any],
        settings: list[tuple[str, str]],
        log: str | os.PathLike[str] | None,
        camera: bool = False,
    ) -> Self: ...
    @property
    def time(self) -> float:
        """The time in seconds."""
    @property
    def ending(self) -> str:
        """How the plan ended: `ok`, `interrupted`, `time_limit`, `error`; `running` before."""
    @property
    def fault(self) -> tuple[str, str] | None:
        """The code and the text of the fault that ended the plan."""
    @property
    def stopped_by(self) -> str | None:
        """The reason why the plan stopped before its own end: `until` or `stop`."""
    def things(self) -> dict[str, list[list[float]]]:
        """The last outlines of moving things, in metres."""
    @property
    def names(self) -> Names:
        """The names of the plan."""
    @property
    def trace_hash(self) -> str:
        """The hash of the trace so far, as in `afpc run`."""
    @property
    def deadline_misses(self) -> int:
        """The number of missed deadlines so far."""
    @property
    def active(self) -> str | None:
        """The path of the active element, without sub-plans."""
    @property
    def event_count(self) -> int:
        """The number of events."""
    @property
    def timeline(self) -> list[str]:
        """The timeline as printed by `afpc run`."""
    @property
    def pose(self) -> tuple[float, float, float]:
        """The robot's pose: x, y, heading."""
    @property
    def collisions(self) -> list[tuple[str, float, float]]:
        """The robot's contacts: obstacle, first and last time."""
    def run(self, until: float | None, stop: bool) -> bool:
        """Run the plan until it ends or until a time; with `stop`, stop it at that time. Return
        whether it is still running."""
    def step(self) -> bool:
        """Make one step of the plan; return whether it is still running."""
    def listen(self, seen: int, until: float | None) -> bool:
        """Continue until there are more than `seen` events, or until a time; return whether the plan
        is still running."""
    def request_stop(self) -> None:
        """Request the plan to stop at its next step; callable from any thread."""
    def repeat(self, path: str | os.PathLike[str]) -> None:
        """Request all stimuli of a logged run."""
    def keyframe(self) -> Runner:
        """A copy of the run at this moment, which continues independently; it writes no log."""
    def restore(self, moment: Runner) -> None:
        """Continue from the moment of another run of the same plan."""
    def events(self, first: int) -> list[Event]:
        """The events from index `first` on."""
    def path(self) -> NDArray[np.float64]:
        """The robot's pose every 20 ms: time, x, y, heading."""
    def draw(self, plan: str, world: World, seed: int) -> str:
        """The path so far over the world, as SVG."""
    def sense(self, name: str) -> Any:
        """The value of a sensor."""
    def entries(self) -> dict[str, Any]:
        """The entries by name."""
    def get(self, name: str) -> Any:
        """The value of an entry."""
    def set(self, name: str, value: Any, at: float | None = None) -> None:
        """Write an entry: before the start an `in` entry, later an `in` or `var` entry at the next
        step."""
    def hold(self, control: str | None, at: float | None, time: float) -> None:
        """Hold a control for a while."""
    def fail(
        self,
        device: str,
        kind: str,
        at: float | None,
        lasting: float | None,
        delay: float | None,
        share: float | None,
    ) -> None:
        """Inject a fault."""
    def fire(self, component: str, outcome: str, outputs: dict[str, Any], at: float | None) -> None:
        """Make a component report an outcome with its outputs."""
    def idle(self, element: str | None, at: float | None) -> None:
        """Make an actor, the actors of a sub-plan, or all of them do nothing from their next start on."""
    def close(self) -> Path | None:
        """End the log and return its path. A forked process has no log."""
    def failures(self, seen: int) -> list[tuple[float, str, str, BaseException]]:
        """The exceptions of components after the first `seen`: time, element or supervisor, template,
        exception."""
    def __reduce__(self) -> NoReturn: ...

@disjoint_base
class Driven:
    """A driver of a run. It contains `step`, because a Python wrapper would cost a twentieth of a
    step."""

    _runner: Runner
    def __new__(cls, *_args: Any, **_named: Any) -> Self: ...
    def step(self) -> bool:
        """Make the next step of the plan, which may be later; return whether it is still running."""

@final
class Carbot:
    """The simulated robot in its world, without a plan."""

    half_length: float
    half_width: float
    def __new__(cls, world: World, seed: int = 0) -> Self: ...
    def drive(self, speed: float, turn: float, time: float) -> None:
        """Drive at a speed (m/s) and a turn rate (rad/s, to the left) for some seconds; Ctrl-C
        interrupts it."""
    def stop(self) -> None:
        """Stop the wheels."""
    @property
    def time(self) -> float:
        """The time in seconds."""
    @property
    def pose(self) -> tuple[float, float, float]:
        """The robot's true pose: x and y in metres, heading in radians."""
    @property
    def touched(self) -> list[str]:
        """The robot's contacts in order of time; repeated contacts count separately."""
    def sense(self, name: str) -> Any:
        """The value of a sensor; see `Robot`."""
    def __reduce__(self) -> NoReturn: ...

@final
class Courses:
    """Episodes that advance together."""

    speed: float
    turn: float
    range: float
    step_time: float
    def __new__(
        cls,
        count: int,
        observe: Sequence[str],
        fan: tuple[Sequence[float], bool],
        reward: Sequence[tuple[str, float]],
        ends: Sequence[str],
        reach: str | None,
        steps: int,
    ) -> Self: ...
    @property
    def bounds(self) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Minimum and maximum of each observed number."""
    @property
    def commands(self) -> int:
        """The length of an action."""
    def reset(self, starts: Sequence[tuple[int, tuple[Any, ...]]]) -> NDArray[np.float32]:
        """Start some of the episodes again and return all observations."""
    def step(
        self, actions: NDArray[np.float64], again: Sequence[tuple[int, tuple[Any, ...]]]
    ) -> tuple[NDArray[np.float32], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_]]:
        """Make a step with an action in each episode; the named ones start again instead."""
    def step_first(
        self, action: NDArray[np.float64]
    ) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Make a step in the first episode and return its result and `info`. For a single robot,
        arrays would take most of the time."""
    def info(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
        """The time, the robot's true pose and the number of collisions, for all episodes."""
    def place(self, index: int) -> tuple[str, tuple[float, float] | None]:
        """The world of an episode, and its target."""
    def moving(self, index: int) -> list[tuple[int, NDArray[np.float64]]]:
        """The moving obstacles of an episode: their indices and current corners."""
    def sense(self, index: int, name: str) -> Any:
        """The value of a sensor in an episode."""
    def save(self) -> Moment:
        """Copy all episodes at this moment."""
    def restore(self, moment: Moment) -> NDArray[np.float32]:
        """Go back, or forwards, to a moment of episodes of the same task, and return all observations."""
    def __deepcopy__(self, _memo: Any) -> Courses: ...
    def __reduce__(self) -> NoReturn: ...

@final
class Moment:
    """Episodes at a moment, from which they can continue any number of times."""

    def __reduce__(self) -> NoReturn: ...

@final
class Judge:
    """Observes a running plan and computes the reward since the last look."""

    def __new__(
        cls,
        runner: Runner,
        reward: Sequence[tuple[str, float]],
        ends: Sequence[str],
        reach: tuple[str, tuple[float, float]] | None,
        world: World,
    ) -> Self: ...
    def look(self, runner: Runner) -> tuple[float, bool]:
        """The reward since the last look, and whether an episode would be over."""

@final
class Sweeper:
    """A sweep: its grid, and the outcomes so far."""

    def __new__(
        cls,
        plan: Plan,
        worlds: tuple[Sequence[World | str | None], bool],
        seeds: tuple[int, int] | list[int],
        vary: Sequence[tuple[str, str | list[tuple[str, str | None]], bool]],
        until: float,
        stimuli: tuple[list[str], list[str]],
        metrics: list[str],
        parts: Mapping[str, tuple[str, Mapping[str, str]]],
    ) -> Self: ...
    @property
    def total(self) -> int:
        """The number of runs."""
    @property
    def is_quiet(self) -> bool:
        """Whether its runs call no Python code."""
    @property
    def identity(self) -> str:
        """The identity of the sweep: program, plan, worlds, grid and Python code, as in its journal,
        all but the first by its hash. Files read by Python are not included; they are sent along to
        other processes."""
    def open(self, out: str, restart: bool) -> None:
        """Keep outcomes in a journal next to the table `out`, and load earlier ones."""
    def left(self) -> list[int]:
        """The numbers of the remaining runs."""
    def run(
        self,
        runs: list[int],
        jobs: int | None = None,
        progress: Callable[[int], Any] | None = None,
        on_run: Callable[[dict[str, Any]], Any] | None = None,
        judge: Callable[[Runner, World, int], dict[str, float | None]] | None = None,
    ) -> None:
        """Do runs and keep their outcomes. `progress` receives the number of runs done by this call,
        and `on_run` the row of each. `judge` computes metrics: it receives the run's number,
        simulation, world and seed, and returns numbers by name."""
    def lines(
        self,
        runs: list[int],
        jobs: int | None = None,
        judge: Callable[[Runner, World, int], dict[str, float | None]] | None = None,
    ) -> list[str]:
        """Do runs for another process and return their outcomes as lines of JSON."""
    def accept(self, lines: list[str], on_run: Callable[[dict[str, Any]], Any] | None = None) -> int:
        """Keep outcomes of another process, and pass their rows to `on_run`. Drop outcomes of finished
        runs, and return the number of new ones."""
    def runner(
        self, run: int, log: str | os.PathLike[str] | None = None, camera: bool = False
    ) -> tuple[Runner, World]:
        """A run at its start, and its world; optionally with a log and the camera's pictures."""
    def write(self) -> list[Path]:
        """Write the table, if one is wanted, and close the journal; return the paths."""
    def columns(self) -> dict[str, tuple[list[Any], str]]:
        """The outcomes so far by column, in the order of runs; each pair ends with the type."""
    def __reduce__(self) -> NoReturn: ...
