# Stubs of the native half, `_afp`: what runs, and what it says. There is no such module.

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
    """The robot as a component in Python has it: devices and time, not the truth.

    It can be used while a component is being called and not between calls."""

    @property
    def time(self) -> float:
        """The time of this step, seconds since the start."""
    @property
    def distance(self) -> float | None:
        """How far it is to the nearest thing ahead of the range sensor, metres; infinity for silence; `None` before the
        first echo and for one that the sensor cannot measure."""
    @property
    def bearing(self) -> float:
        """Where the range sensor points, radians to the left of the heading."""
    @property
    def odometry(self) -> NDArray[np.float64]:
        """What the wheels have counted: x, y in metres and heading in radians against the start, speed, turn rate."""
    @property
    def touched(self) -> bool:
        """Whether the bumper is pressed."""
    @property
    def escape(self) -> bool:
        """Whether the escape button is held down."""
    @property
    def battery(self) -> tuple[float, float]:
        """The battery's voltage, and the share of its charge that is left."""
    @property
    def color(self) -> NDArray[np.float64] | None:
        """Red, green and blue of the floor, each from 0 to 1; `None` before it was looked at."""
    @property
    def glow(self) -> tuple[float, float] | None:
        """Bearing (radians) and strength of the brightest infrared source; `None` where all is dark."""
    @property
    def camera(self) -> NDArray[np.uint8] | None:
        """The latest picture, rows x columns x 3, a copy; `None` before the first one."""
    def drive(self, speed: float, turn: float = 0.0) -> None:
        """Asks for a speed ahead (m/s) and a turn rate (rad/s, to the left), for a fifth of a second at most: ask again."""
    def stop(self) -> None:
        """Asks for a standstill."""
    def point(self, bearing: float) -> None:
        """Points the range sensor, radians to the left of the heading."""
    def sense(self, signal: str) -> Any:
        """What a signal says, by device and name: `robot.sense("bumper.left")`. `None` before it says anything."""
    def __reduce__(self) -> NoReturn: ...

@final
class Event:
    """One thing that happened in a run."""

    @property
    def time(self) -> float:
        """When, seconds since the start."""
    @property
    def kind(self) -> str:
        """What happened: `started`, `event`, `finished`, `interrupted`, `committed`, `faulted`, `ended`, ..."""
    @property
    def component(self) -> str:
        """Whom it happened to: the path of an element or supervisor; who wrote, for `committed`."""
    @property
    def outcome(self) -> str | None:
        """The state or event."""
    @property
    def target(self) -> str | None:
        """Where the outcome leads."""
    @property
    def supervisor(self) -> str | None:
        """The supervisor that diverted a start, or whose event resumed."""
    @property
    def element(self) -> str | None:
        """The element that was active or being entered when an event was taken."""
    @property
    def on(self) -> bool:
        """Whether that element answered: the target is one of its `on`, not the supervisor's."""
    @property
    def entry(self) -> str | None:
        """The entry that was written."""
    @property
    def port(self) -> str | None:
        """The input port that was read."""
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
        """What came from outside, in the words of scenarios: `press touch.touch`."""
    @property
    def refused(self) -> str | None:
        """Why what came from outside was not done: a reason, or `not reached`."""
    @property
    def lateness(self) -> float | None:
        """By how much a deadline was missed, seconds."""
    @property
    def cause(self) -> str | None:
        """Why a deadline was missed: `late_release` or `long_poll`."""
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    @staticmethod
    def _again(message: bytes, line: str | None) -> Event: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Names:
    """The names of a plan as it ran."""

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
        """The path of a run over its world, as SVG: rows of time, x, y, heading, what happened on the way, and where what
        moves was last."""

@final
class Runner:
    """A plan in a simulated world. `afp.Simulation` is made of it."""

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
        """The time, seconds."""
    @property
    def ending(self) -> str:
        """How the plan ended: `ok`, `interrupted`, `error`; `running` before."""
    @property
    def fault(self) -> tuple[str, str] | None:
        """The code and the text of the fault that ended the plan."""
    @property
    def stopped_by(self) -> str | None:
        """Why the plan stopped though it did not end by itself: `until` or `stop`."""
    def things(self) -> dict[str, list[list[float]]]:
        """Where what moves was last: outlines in metres."""
    @property
    def names(self) -> Names:
        """The names of the plan."""
    @property
    def trace_hash(self) -> str:
        """The hash of the trace so far, as `afpc run` tells it."""
    @property
    def deadline_misses(self) -> int:
        """Deadlines missed so far."""
    @property
    def active(self) -> str | None:
        """The path of the active element, sub-plans left out."""
    @property
    def event_count(self) -> int:
        """How many events there are."""
    @property
    def timeline(self) -> list[str]:
        """The timeline as `afpc run` prints it."""
    @property
    def pose(self) -> tuple[float, float, float]:
        """Where the robot is: x, y, heading."""
    @property
    def collisions(self) -> list[tuple[str, float, float]]:
        """What the robot touched: obstacle, first and last time."""
    def run(self, until: float | None, stop: bool) -> bool:
        """Runs the plan until it ends or until a time, when it is stopped if `stop` is set; whether it still runs."""
    def step(self) -> bool:
        """Makes one step of the plan; whether it still runs."""
    def listen(self, seen: int, until: float | None) -> bool:
        """Goes on until something has happened after the first `seen` events, or until a time; whether the plan still
        runs."""
    def request_stop(self) -> None:
        """Asks the plan to stop at its next step; from any thread."""
    def repeat(self, path: str | os.PathLike[str]) -> None:
        """Asks for all that came from outside in the run of a log."""
    def keyframe(self) -> Runner:
        """The same run at this moment, which goes on by itself; it writes no log."""
    def restore(self, moment: Runner) -> None:
        """Goes on from the moment of another run of the same plan."""
    def events(self, first: int) -> list[Event]:
        """The events from the `first`-th on."""
    def path(self) -> NDArray[np.float64]:
        """Where the robot was every 20 ms: time, x, y, heading."""
    def draw(self, plan: str, world: World, seed: int) -> str:
        """The path so far over the world, as SVG."""
    def sense(self, name: str) -> Any:
        """What a sensor says."""
    def entries(self) -> dict[str, Any]:
        """The entries by name."""
    def get(self, name: str) -> Any:
        """The value of an entry."""
    def set(self, name: str, value: Any, at: float | None = None) -> None:
        """Writes an entry: before the start an `in` entry, later an `in` or `var` entry at the next step."""
    def hold(self, control: str | None, at: float | None, time: float) -> None:
        """Holds a control down for a while."""
    def fail(
        self,
        device: str,
        kind: str,
        at: float | None,
        lasting: float | None,
        delay: float | None,
        share: float | None,
    ) -> None:
        """Breaks something."""
    def fire(self, component: str, outcome: str, outputs: dict[str, Any], at: float | None) -> None:
        """Lets a component report an outcome that it did not see, with its outputs."""
    def idle(self, element: str | None, at: float | None) -> None:
        """Lets an actor, those of a sub-plan, or all of them do nothing from their next start on."""
    def close(self) -> Path | None:
        """Ends the log, where there is one; its path. In a process that was forked there is none."""
    def failures(self, seen: int) -> list[tuple[float, str, str, BaseException]]:
        """The exceptions of components after the first `seen`: time, element or supervisor, template, exception."""
    def __reduce__(self) -> NoReturn: ...

@disjoint_base
class Driven:
    """What drives a run. `step` is here because a function of Python around it takes a twentieth of a step."""

    _runner: Runner
    def __new__(cls, *_args: Any, **_named: Any) -> Self: ...
    def step(self) -> bool:
        """Makes the next step of the plan, which may be a while later; whether the plan still runs."""

@final
class Carbot:
    """The simulated robot in its world, without a plan."""

    half_length: float
    half_width: float
    def __new__(cls, world: World, seed: int = 0) -> Self: ...
    def drive(self, speed: float, turn: float, time: float) -> None:
        """Drives with a speed (m/s) and a turn rate (rad/s, to the left) for some seconds; Ctrl-C interrupts it."""
    def stop(self) -> None:
        """Stops the wheels."""
    @property
    def time(self) -> float:
        """The time, seconds."""
    @property
    def pose(self) -> tuple[float, float, float]:
        """Where the robot truly is: x, y in metres, heading in radians."""
    @property
    def touched(self) -> list[str]:
        """What the robot has run into, in order of time; what it touches at different times counts each time."""
    def sense(self, name: str) -> Any:
        """What a sensor says: see `Robot`."""
    def __reduce__(self) -> NoReturn: ...

@final
class Courses:
    """Some episodes side by side."""

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
        """The least and the greatest of what is observed."""
    @property
    def commands(self) -> int:
        """How many numbers an action has."""
    def reset(self, starts: Sequence[tuple[int, tuple[Any, ...]]]) -> NDArray[np.float32]:
        """Lets some of the episodes begin anew; what is observed in all of them."""
    def step(
        self, actions: NDArray[np.float64], again: Sequence[tuple[int, tuple[Any, ...]]]
    ) -> tuple[NDArray[np.float32], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_]]:
        """Makes a step in all of them, an action each; those that are named begin anew instead."""
    def step_first(
        self, action: NDArray[np.float64]
    ) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Makes a step in the first of them; what came of it, and what `info` tells. Most of the time of a single robot's step
        would go into arrays otherwise."""
    def info(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
        """Of all of them the time, the robot's true pose, and how often it ran into something."""
    def place(self, index: int) -> tuple[str, tuple[float, float] | None]:
        """Where an episode takes place, and where there is something to reach."""
    def moving(self, index: int) -> list[tuple[int, NDArray[np.float64]]]:
        """What moves in one of them: the numbers of the obstacles, and their corners as they are now."""
    def sense(self, index: int, name: str) -> Any:
        """What a sensor of one of them says."""
    def __reduce__(self) -> NoReturn: ...

@final
class Judge:
    """Looks at a running plan and says what driving was worth since the last look."""

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
        worlds: Sequence[World | str | None],
        seeds: tuple[int, int] | list[int],
        vary: Sequence[tuple[str, str | list[tuple[str, str | None]]]],
        until: float,
        stimuli: tuple[list[str], list[str]],
        metrics: list[str],
        parts: Mapping[str, tuple[str, Mapping[str, str]]],
    ) -> Self: ...
    @property
    def total(self) -> int:
        """How many runs there are."""
    @property
    def is_quiet(self) -> bool:
        """Whether its runs call nothing that is written in Python."""
    @property
    def identity(self) -> str:
        """What makes it this sweep: program, plan, worlds, grid and what is written in Python, as in its journal, all but the
        first by its hash. What Python reads is left out: where runs are done by other processes it goes along."""
    def open(self, out: str, restart: bool) -> None:
        """Keeps outcomes in a journal beside the table `out`, and takes up those that are there."""
    def left(self) -> list[int]:
        """The numbers of the runs that are not done."""
    def run(
        self,
        runs: list[int],
        jobs: int | None = None,
        progress: Callable[[int], Any] | None = None,
        on_run: Callable[[dict[str, Any]], Any] | None = None,
        judge: Callable[[Runner, World, int], dict[str, float | None]] | None = None,
    ) -> None:
        """Does runs and keeps their outcomes; tells `progress` how many of this call are done, and `on_run` the row of
        each. `judge` gives further figures of a run: its number, its end, its world and its seed go in, numbers by name
        come out."""
    def lines(
        self,
        runs: list[int],
        jobs: int | None = None,
        judge: Callable[[Runner, World, int], dict[str, float | None]] | None = None,
    ) -> list[str]:
        """Does runs for another process; their outcomes as lines of JSON."""
    def accept(self, lines: list[str], on_run: Callable[[dict[str, Any]], Any] | None = None) -> int:
        """Keeps outcomes of another process, and passes their rows to `on_run`; those of runs that are done are dropped. How many
        were new."""
    def runner(
        self, run: int, log: str | os.PathLike[str] | None = None, camera: bool = False
    ) -> tuple[Runner, World]:
        """A run about to begin again, and its world; its log is written to a file, perhaps with what the camera sees."""
    def write(self) -> list[Path]:
        """Writes the table, if it is written anywhere, and closes the journal; its paths."""
    def columns(self) -> dict[str, tuple[list[Any], str]]:
        """The outcomes so far by column, in the order of the runs; the second of a pair is the type."""
    def __reduce__(self) -> NoReturn: ...
