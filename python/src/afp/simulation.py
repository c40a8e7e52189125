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
from .result import ComponentError, Ending, Result
from .seeds import seed_of
from .snapshot import Snapshot
from .stimuli import HOLD, Fault, Press
from .units import moment, seconds
from .watch import watch

__all__ = ["Simulation"]


class Simulation(Driven):
    """A plan in a world. The same plan, world, seed and stimuli give the same run, bit for bit.

    `world` is a `World`, the path of its file, or `None` for the default of `afpc run`. `set` gives
    `in` entries their values: `afp.cm(30)`, plain floats in SI units, strings as on the command
    line (`"30cm"`), or names of enum values. It also sets values of the world's file:
    `{"world.robot.charge": 0.5}`. `start` overrides the world's start: x, y in metres and a heading
    in radians.

    `log` is an MCAP file to write. It is complete after the end of the plan, or after `close`,
    which `with` calls; the run cannot continue then. With `camera` the log contains the camera's
    pictures, twice a second.

    During a run other Python threads continue, but only one caller at a time can drive a
    simulation. Others may meanwhile read `time`, `ending`, `active` and `pose`, and print the
    simulation; these values are at most a few hundredths of a second old.
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
        self.seed = seed_of(seed)
        self._failures: list[ComponentError] = []
        self._runner = Runner(plan, world, self.seed, entries, settings, log, flag("camera", camera))

    @classmethod
    def _of(cls, runner: Runner, plan: Plan, world: World, seed: int) -> Simulation:
        """Wrap a run."""
        self = cls.__new__(cls)
        self.plan, self.world, self.seed = plan, world, seed
        self._failures = []
        self._runner = runner
        return self

    # Driving

    def run(self, until: float = 60.0) -> Result:
        """Run the plan to its end, or to `until` (seconds since the start), where it is stopped.

        Ctrl-C interrupts it; you can continue the simulation afterwards.

        Raises:
            RuntimeError: an earlier call has stopped the plan before `until`.
        """
        until = seconds("until", until)
        if self.ending == "time_limit" and until > self.time:
            what = f"the plan was stopped at {self.time:g} s and does not continue to {until:g} s"
            raise RuntimeError(f"{what}: run_to() does not stop it, and restore() goes back")
        self._runner.run(until, True)
        return self.result()

    def run_to(self, time: float) -> bool:
        """Advance to `time` (seconds since the start) without stopping the plan; return whether it
        is still running.
        """
        return self._runner.run(seconds("time", time), False)

    def watch(self, until: float = 60.0, *, speed: float = 1.0) -> Result:
        """Run the plan like `run`, and show robot, plan and entries in a notebook cell.

        It runs at `speed` times real time. Interrupting the kernel interrupts it; you can continue
        it then.
        """
        until = seconds("until", until)
        watch(self, until, speed)
        return self.run(until)

    def stream(self, until: float | None = None) -> Iterator[Event]:
        """Drive the plan and yield its events as they happen, up to `until` (seconds since the
        start).
        """
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
        """Request the plan to stop, from any thread."""
        self._runner.request_stop()

    def result(self) -> Result:
        """The result so far."""
        return Result(self._runner, self.plan.name, self.world, self.seed, self.errors)

    def close(self) -> None:
        """End the log, if there is one."""
        self._runner.close()

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Simulation cannot be pickled; make it again from its plan, world and seed")

    def __enter__(self) -> Simulation:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # Moments

    def save(self) -> Snapshot:
        """Save the current state: plan, robot, world, noise and pending stimuli. `restore` goes
        back to it.

        Components written in Python cannot be copied, so plans with them cannot be saved.
        """
        return Snapshot(self._runner.keyframe(), self.plan, self.world, self.seed)

    def restore(self, snapshot: Snapshot) -> None:
        """Go back, or forwards, to a moment saved by this simulation or a clone; the continuation
        is the same.

        A simulation with a log cannot be restored, because its log cannot be undone.
        """
        if not isinstance(snapshot, Snapshot):
            raise TypeError(f"a simulation is restored from a result of save(), not from {snapshot!r}")
        if not snapshot._is_of(self.plan, self.world, self.seed):
            raise ValueError(f"{snapshot!r} belongs to another simulation; restore() needs a moment of this simulation")
        self._runner.restore(snapshot._runner)

    def clone(self) -> Simulation:
        """An independent copy that continues from here; it writes no log."""
        return Simulation._of(self._runner.keyframe(), self.plan, self.world, self.seed)

    def __copy__(self) -> Simulation:
        return self.clone()

    # Looking

    @property
    def time(self) -> float:
        """The time, in seconds since the start."""
        return self._runner.time

    @property
    def ending(self) -> Ending:
        """How the plan ended: `ok`, `interrupted`, `time_limit` or `error`; `running` before."""
        return self._runner.ending  # type: ignore[return-value]

    @property
    def active(self) -> str | None:
        """The active element of the outermost plan."""
        return self._runner.active

    @property
    def pose(self) -> tuple[float, float, float]:
        """The robot's true pose: x, y in metres, heading in radians."""
        return self._runner.pose

    @property
    def events(self) -> list[Event]:
        """The events so far."""
        return self._runner.events(0)

    @property
    def path(self) -> NDArray[np.float64]:
        """The robot's pose every 20 ms: rows of time, x, y, heading."""
        return self._runner.path()

    @property
    def trace_hash(self) -> str:
        """The hash of the trace so far, as in `afpc run`."""
        return self._runner.trace_hash

    def picture(self) -> Picture:
        """The path so far in its world, as drawn by `afpc run --svg`."""
        return Picture(self._runner.draw(self.plan.name, self.world, self.seed))

    def sense(self, sensor: str) -> Any:
        """The value of a sensor; see `afp.Robot`. Arrays are copies."""
        return self._runner.sense(text("a sensor", sensor))

    @property
    def camera(self) -> NDArray[np.uint8] | None:
        """A copy of the latest picture, rows x columns x 3; `None` before the first one."""
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
        """The values of all entries of the plan; `None` for unset ones."""
        return self._runner.entries()

    def set(self, entry: str, value: Any, *, at: float | None = None) -> None:
        """Write an entry, now (at the next step) or at a later time."""
        self._runner.set(text("an entry", entry), value, moment("at", at))

    # Stimuli

    def press(self, press: Press | None = None) -> None:
        """Press a control of the robot, now or at a later time: `press(afp.Press("touch", at=1.5))`.

        The default is the control that ends a run, now.
        """
        press = Press() if press is None else press
        if not isinstance(press, Press):
            raise TypeError(f'press takes an afp.Press, such as afp.Press("touch", at=1.5), not {press!r}')
        self._runner.hold(press.control, press.at, press.hold)

    def bump(self, *, at: float | None = None, hold: float = HOLD) -> None:
        """Press the bumper, now or at a later time: `press(afp.Press("touch"))`."""
        self.press(Press("touch", at=at, hold=hold))

    def fire(
        self,
        component: str,
        outcome: str,
        outputs: Mapping[str, Any] | None = None,
        *,
        at: float | None = None,
    ) -> None:
        """Make an active actor or supervisor report an outcome at its next poll.

        `outputs` are its values, one for each connected output: `fire("find", "WallFound",
        {"angle": afp.deg(10)})`.
        """
        component, outcome = text("an actor or supervisor", component), text("an outcome", outcome)
        values = keys("outputs", outputs, "gives outputs their values, such as {'angle': afp.deg(10)}")
        self._runner.fire(component, outcome, values, moment("at", at))

    def idle(self, element: str | None = None, *, at: float | None = None) -> None:
        """Make an actor, the actors of a sub-plan, or all actors do nothing from their next start
        on, as in scenarios.

        They are active until they are interrupted, or until `fire` makes them report a state.
        """
        element = None if element is None else text("an element", element)
        self._runner.idle(element, moment("at", at))

    def fail(self, fault: Fault) -> None:
        """Break a device: `fail(afp.Fault("ultrasonic", "frozen", at=2.0, lasting=1.0))`."""
        if not isinstance(fault, Fault):
            raise TypeError(f'fail takes an afp.Fault, such as afp.Fault("wheels", "slip", share=0.3), not {fault!r}')
        self._runner.fail(fault.device, fault.kind, fault.at, fault.lasting, fault.delay, fault.share)

    @property
    def errors(self) -> list[ComponentError]:
        """The exceptions of components written in Python, in order."""
        for time, element, template, error in self._runner.failures(len(self._failures)):
            lines = "".join(traceback.format_exception(type(error), error, error.__traceback__))
            self._failures.append(ComponentError(time, element, template, error, lines, error.__traceback__))
        return list(self._failures)

    def __repr__(self) -> str:
        return f"<Simulation of {self.plan.name} in '{self.world.name}', {self.time:.3f} s, {self.ending}>"
