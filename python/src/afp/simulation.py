"""Simulations: a plan in a world, run in virtual time."""

from __future__ import annotations

import os
import traceback
from collections.abc import Iterator, Mapping, Sequence
from types import TracebackType
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from ._afp import Driven, Event, Plan, Runner, World
from .checks import flag, keys, text
from .picture import Picture
from .places import Place, changed, place_of
from .result import ComponentError, Result
from .seeds import seed_of
from .snapshot import Snapshot
from .units import moment, seconds
from .watch import watch

__all__ = ["Simulation"]


class Simulation(Driven):
    """A plan in a world. The same plan, world, seed and stimuli give the same run, bit for bit.

    `world` is a `World`, the path of its file, or `None` for the one that `afpc run` would take. `set` gives `in`
    entries their values: `afp.cm(30)`, plain floats in SI units, texts as on the command line (`"30cm"`), names of
    enum values; and values of the world's file theirs: `{"world.robot.charge": 0.5}`. `start` is where the robot starts
    instead of where the world says: x, y in metres and a heading in radians. `log` is the MCAP file to be written: whole once the plan has ended or the simulation is closed, which
    `with` does; nothing can be driven on then. With `camera` it gets what the camera sees, twice a second.

    While it runs, other threads of Python run too; a simulation itself belongs to one caller at a time. Meanwhile others
    may read `time`, `ending`, `active` and `pose` (and print it): as they were at most a few hundredths of a second ago.
    """

    def __init__(
        self,
        plan: Plan,
        world: Place | None = None,
        *,
        seed: int = 0,
        set: Mapping[str, Any] | None = None,
        start: Sequence[float] | None = None,
        log: str | os.PathLike[str] | None = None,
        camera: bool = False,
    ) -> None:
        if not isinstance(plan, Plan):
            raise TypeError(f"a simulation needs a Plan, not a {type(plan).__name__}: afp.load() reads one")
        place = World.of_plan(plan.path or "plan.afp") if world is None else place_of(world)
        world = place if isinstance(place, World) else World.load(place)
        values = keys("set", set, "gives entries their values, such as {'walldist': afp.cm(35)}")
        world, entries, settings = changed(world, values, start)
        self.plan = plan
        self.world = world
        self.seed = seed
        self._failures: list[ComponentError] = []
        self._runner = Runner(plan, world, seed_of(seed), entries, settings, log, flag("camera", camera))

    @classmethod
    def _of(cls, runner: Runner, plan: Plan, world: World, seed: int) -> Simulation:
        """Around a run that has been made."""
        self = cls.__new__(cls)
        self.plan, self.world, self.seed = plan, world, seed
        self._failures = []
        self._runner = runner
        return self

    # Driving

    def run(self, until: float = 60.0) -> Result:
        """Runs the plan to its end, or to `until` (seconds since the start), where it is stopped.

        Ctrl-C interrupts it; the simulation can be driven on afterwards.
        """
        self._runner.run(seconds("until", until), True)
        return self.result()

    def run_to(self, time: float) -> bool:
        """Lets time pass up to `time` (seconds since the start) and leaves the plan running; whether it still runs."""
        return self._runner.run(seconds("time", time), False)

    def watch(self, until: float = 60.0, *, speed: float = 1.0) -> Result:
        """Runs the plan as `run` does and shows it meanwhile in the cell of a notebook: robot, plan and entries.

        It goes on `speed` times as fast as the clock on the wall. Interrupting the kernel interrupts it; it can be
        driven on then.
        """
        until = seconds("until", until)
        watch(self, until, speed)
        return self.run(until)

    def stream(self, until: float | None = None) -> Iterator[Event]:
        """Drives the plan and yields its events as they happen, up to `until` (seconds since the start)."""
        until = moment("until", until)
        seen = self._runner.event_count
        while True:
            running = self._runner.listen(seen, until)
            news = self._runner.events(seen)
            seen += len(news)
            yield from news
            if not running or not news:
                return

    def __iter__(self) -> Iterator[Event]:
        return self.stream()

    def request_stop(self) -> None:
        """Asks the plan to stop, from any thread."""
        self._runner.request_stop()

    def result(self) -> Result:
        """What has come of it so far."""
        return Result(self._runner, self.plan.name, self.world, self.seed, self.errors)

    def close(self) -> None:
        """Ends the log, where there is one."""
        self._runner.close()

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Simulation cannot be pickled; make it anew from its plan, world and seed")

    def __enter__(self) -> Simulation:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # Moments

    def save(self) -> Snapshot:
        """The simulation as it is now: plan, robot, world, noise and what is to come. `restore` goes back to it.

        Components written in Python cannot be copied, so that plans with such cannot be saved.
        """
        return Snapshot(self._runner.keyframe(), self.plan, self.world, self.seed)

    def restore(self, snapshot: Snapshot) -> None:
        """Goes back, or forth, to a moment that this simulation or a clone of it saved; what comes then is the same.

        A simulation with a log cannot: what is in the log has happened.
        """
        if not isinstance(snapshot, Snapshot):
            raise TypeError(f"a simulation is restored from what save() gave, not from {snapshot!r}")
        if not snapshot._is_of(self.plan, self.world, self.seed):
            raise ValueError(f"{snapshot!r} is of another simulation; restore goes to a moment of this one")
        self._runner.restore(snapshot._runner)

    def clone(self) -> Simulation:
        """Another simulation that goes on from here as this one would; it writes no log."""
        return Simulation._of(self._runner.keyframe(), self.plan, self.world, self.seed)

    def __copy__(self) -> Simulation:
        return self.clone()

    # Looking

    @property
    def time(self) -> float:
        """The time, seconds since the start."""
        return self._runner.time

    @property
    def ending(self) -> str:
        """How the plan ended: `ok`, `interrupted`, `error`; `running` before."""
        return self._runner.ending

    @property
    def active(self) -> str | None:
        """The active element of the outermost plan."""
        return self._runner.active

    @property
    def pose(self) -> tuple[float, float, float]:
        """Where the robot truly is: x, y in metres, heading in radians."""
        return self._runner.pose

    @property
    def events(self) -> list[Event]:
        """What has happened so far."""
        return self._runner.events(0)

    @property
    def path(self) -> NDArray[np.float64]:
        """Where the robot was every 20 ms: rows of time, x, y, heading."""
        return self._runner.path()

    @property
    def trace_hash(self) -> str:
        """The hash of the trace so far; `afpc run` tells the same one for the same run."""
        return self._runner.trace_hash

    def picture(self) -> Picture:
        """The path so far in its world, as `afpc run --svg` draws it."""
        return Picture(self._runner.draw(self.plan.name, self.world, self.seed))

    def sense(self, sensor: str) -> Any:
        """What a sensor says: see `afp.Robot`. Arrays are copies."""
        return self._runner.sense(text("a sensor", sensor))

    @property
    def camera(self) -> NDArray[np.uint8] | None:
        """The latest picture, rows x columns x 3, a copy; `None` before the first one."""
        picture: NDArray[np.uint8] | None = self._runner.sense("camera")
        return picture

    # Entries

    def __getitem__(self, entry: str) -> Any:
        return self._runner.get(text("an entry", entry))

    def __contains__(self, entry: object) -> bool:
        return entry in self._runner.entries()

    def __setitem__(self, entry: str, value: Any) -> None:
        self._runner.set(text("an entry", entry), value)

    @property
    def entries(self) -> dict[str, Any]:
        """The values of all entries of the plan; `None` for those that nobody has written."""
        return self._runner.entries()

    def set(self, entry: str, value: Any, *, at: float | None = None) -> None:
        """Writes an entry, now (at the next step) or at a time to come."""
        self._runner.set(text("an entry", entry), value, moment("at", at))

    # Stimuli

    def press(self, control: str | None = None, *, at: float | None = None, hold: float = 0.2) -> None:
        """Presses a control of the robot, now or at a time to come; without a name, the one that ends what runs.

        The Carbot has the button `escape` and the bumper, `touch`.
        """
        control = None if control is None else text("a control", control)
        self._runner.hold(control, moment("at", at), seconds("hold", hold))

    def bump(self, *, at: float | None = None, hold: float = 0.2) -> None:
        """Presses the bumper, now or at a time to come: `press("touch")`."""
        self.press("touch", at=at, hold=hold)

    def fire(
        self,
        component: str,
        outcome: str,
        outputs: Mapping[str, Any] | None = None,
        *,
        at: float | None = None,
    ) -> None:
        """Lets an active actor or supervisor report an outcome that it did not see, at its next poll.

        `outputs` are the values that come with it, one for each output of it that the plan has connected:
        `fire("find", "WallFound", {"angle": afp.deg(10)})`.
        """
        component, outcome = text("an actor or supervisor", component), text("an outcome", outcome)
        values = keys("outputs", outputs, "gives outputs their values, such as {'angle': afp.deg(10)}")
        self._runner.fire(component, outcome, values, moment("at", at))

    def idle(self, element: str | None = None, *, at: float | None = None) -> None:
        """Lets an actor, those of a sub-plan, or all actors do nothing from their next start on, as in scenarios.

        They are active until they are interrupted, or `fire` lets them report a state.
        """
        element = None if element is None else text("an element", element)
        self._runner.idle(element, moment("at", at))

    def fail(
        self,
        device: str,
        kind: str,
        *,
        at: float | None = None,
        lasting: float | None = None,
        delay: float | None = None,
        share: float | None = None,
    ) -> None:
        """Breaks something, for good or for `lasting` seconds: `fail("ultrasonic", "frozen")`.

        `delay` is for `delayed` and `slow`, `share` for `slip` and `low`; `afp.faults()` has all pairs.
        """
        times = (moment("at", at), moment("lasting", lasting), moment("delay", delay))
        self._runner.fail(text("a device", device), text("a kind", kind), *times, share)

    @property
    def errors(self) -> list[ComponentError]:
        """The exceptions of components written in Python, in the order in which they were raised."""
        for time, element, template, error in self._runner.failures(len(self._failures)):
            lines = "".join(traceback.format_exception(type(error), error, error.__traceback__))
            self._failures.append(ComponentError(time, element, template, error, lines, error.__traceback__))
        return list(self._failures)

    def __repr__(self) -> str:
        return f"<Simulation of {self.plan.name} in '{self.world.name}', {self.time:.3f} s, {self.ending}>"
