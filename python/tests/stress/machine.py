"""A state machine over the whole API: everything in any order, with valid and invalid values."""

from __future__ import annotations

import copy
import gc
import os
import pickle
import signal
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

import afp
from components import ACTIONS, ERRORS, TEXT, toolbox
from values import Planned, opened, value

T = TypeVar("T")
ROOT = Path(__file__).resolve().parents[3]
SHIPPED = sorted(path.read_text(encoding="utf-8") for path in (ROOT / "plans").glob("*.afp"))
LONG = 0.2
"""Seconds after which a call is interrupted, as Ctrl-C does it."""
DOCUMENTED = (afp.AfpError, TypeError, ValueError, KeyError, OverflowError, RuntimeError, OSError)
FORBIDDEN = ("panick", "broke in an earlier call", "has no attribute '_", "NoneType' object has no")
# These draw, need other packages that are tested elsewhere, or write to any path.
LEFT_OUT = ("plot", "to_", "save")
# Only the package makes these.
MADE = (afp.Result, afp.Runs, afp.Collision, afp.ComponentError)

few = st.integers(0, 5)
time = st.sampled_from([0.0, 0.05, 0.3, 2.0])
names = st.sampled_from(["go", "ask", "first", "watch", "ask.touch", "nobody", "P.go", "number", "far"])
outcomes = st.sampled_from(["Done", "Told", "Seen", "TouchSensorPressed", "Error", "Nothing"])


class TooLong(BaseException):
    """A call took too long and was interrupted."""


class Stress(RuleBasedStateMachine):
    """See the module."""

    steps: Any = None
    """The file that tells what is being done."""

    def __init__(self) -> None:
        super().__init__()
        self.plans: list[afp.Plan] = []
        self.sims: list[afp.Simulation] = []
        self.results: list[afp.Result] = []
        self.tools: list[afp.Toolbox] = []
        self.robots: list[afp.Robot] = []
        self.worlds: list[afp.World] = [afp.World.random(1)]
        self.cars: list[afp.Carbot] = []
        self.arrays: list[tuple[Any, Any]] = []
        self.driven: list[afp.Simulation] = []
        self.raised: set[type[BaseException]] = {Planned, TooLong, KeyboardInterrupt}
        self.nested = 0
        self.told = 0
        self.gone = 0
        self.note("---- a new example", anew=True)

    # Actions and their possible results

    def note(self, text: str, anew: bool = False) -> None:
        """Record the next action, in case it is the last one."""
        if self.steps is not None:
            if anew:
                self.steps.seek(0)
                self.steps.truncate()
            self.steps.write(ascii(text)[1:-1] + "\n")
            self.steps.flush()

    def attempt(self, what: str, call: Callable[[], T], alarm: bool = True) -> T | None:
        """Do something that may be refused in a documented way."""
        self.note(what)
        self.nested, self.told = 4, 0
        main = alarm and threading.current_thread() is threading.main_thread()
        try:
            if not main:
                return call()
            signal.setitimer(signal.ITIMER_REAL, LONG, 0.05)
            try:
                return call()
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0)
        except BaseException as error:
            self.judge(what, error)
            return None

    def judge(self, what: str, error: BaseException) -> None:
        """Pass on undocumented exceptions."""
        text = str(error)
        expected = isinstance(error, (*DOCUMENTED, *self.raised))
        # Unknown attributes raise AttributeError, as usual in Python.
        expected |= isinstance(error, AttributeError) and "'smell'" in text
        expected |= isinstance(error, StopIteration) and "iterate" in what
        # Any exception of a component.
        expected |= isinstance(error, Exception) and what == "check"
        if not expected or any(word in text for word in FORBIDDEN):
            raise AssertionError(f"{what} raised {type(error).__name__}: {text}") from error
        self.note(f"  = {type(error).__name__}: {text}")

    def drive(self, sim: afp.Simulation, drive: Callable[[afp.Simulation], T]) -> T:
        """Drive a simulation, which its components find in `driven`."""
        self.driven.append(sim)
        try:
            return drive(sim)
        finally:
            self.driven.pop()

    def sim(self, which: int) -> afp.Simulation | None:
        return self.sims[which % len(self.sims)] if self.sims else None

    # Making things

    @rule(actions=st.lists(st.sampled_from(ACTIONS), min_size=1, max_size=8), error=st.sampled_from(ERRORS))
    def plan_with_components(self, actions: list[str], error: str) -> None:
        self.note(f"plan with {actions} {error!r}")
        tools = toolbox(self, actions)
        self.tools = [*self.tools[-3:], tools]
        plan = afp.Plan(TEXT.format(error=error), toolboxes=[tools])
        assert plan.ok, plan.report()
        self.plans.append(plan)

    @rule(text=st.sampled_from(SHIPPED), cut=st.integers(0, 4000), whole=st.booleans())
    def shipped_plan(self, text: str, cut: int, whole: bool) -> None:
        plan = self.attempt("plan", lambda: afp.Plan(text if whole else text[:cut]))
        if plan is not None:
            self.plans.append(plan)

    @rule(which=few, seed=st.integers(0, 3), at=st.sampled_from([None, 0]), set=value, log=st.booleans(), good=st.booleans())
    def simulation(self, which: int, seed: int, at: int | None, set: Any, log: bool, good: bool) -> None:
        if not self.plans:
            return
        plan = self.plans[which % len(self.plans)]
        world = None if at is None else self.worlds[at]
        chosen = None if good else opened(set)
        file = f"{len(self.sims)}.mcap" if log else None
        sim = self.attempt(
            f"simulation of plan {which} set={chosen!r}",
            lambda: afp.Simulation(plan, world, seed=seed, set=chosen, log=file),
        )
        if sim is not None:
            self.sims = [*self.sims[-5:], sim]

    @rule(seed=few, speed=value, time=time)
    def carbot(self, seed: int, speed: Any, time: float) -> None:
        car = afp.Carbot(self.worlds[0], seed)
        self.attempt(f"carbot drives {speed!r}", lambda: car.drive(opened(speed), 0.1, time))
        self.cars = [*self.cars[-2:], car]

    # Driving

    @rule(which=few, steps=st.integers(1, 30))
    def step(self, which: int, steps: int) -> None:
        sim = self.sim(which)
        if sim is not None:
            self.attempt(f"{steps} steps of {which}", lambda: self.drive(sim, lambda sim: [sim.step() for _ in range(steps)]))

    @rule(which=few, time=time, stop=st.booleans())
    def run(self, which: int, time: float, stop: bool) -> None:
        sim = self.sim(which)
        if sim is None:
            return
        if not stop:
            self.attempt(f"run {which} to {time}", lambda: self.drive(sim, lambda sim: sim.run_to(time)))
            return
        result = self.attempt(f"run {which} until {time}", lambda: self.drive(sim, lambda sim: sim.run(time)))
        if result is not None:
            self.results = [*self.results[-3:], result]
            self.attempt("check", result.check)

    @rule(which=few, count=st.integers(1, 20))
    def iterate(self, which: int, count: int) -> None:
        sim = self.sim(which)
        if sim is not None:
            self.attempt(f"iterate {which}", lambda: self.drive(sim, lambda sim: [e for e, _ in zip(sim, range(count))]))

    @rule(which=few)
    def run_for_ever(self, which: int) -> None:
        sim = self.sim(which)
        if sim is not None:
            self.attempt(f"run {which} for ever", lambda: self.drive(sim, lambda sim: sim.run_to(1e300)))

    @rule(which=few)
    def close(self, which: int) -> None:
        sim = self.sim(which)
        if sim is not None:
            self.attempt(f"close {which}", sim.close)
            if os.path.exists("0.mcap"):
                self.attempt("log", lambda: len(afp.Log("0.mcap").events))

    # Stimuli

    @rule(which=few, name=names, outcome=outcomes, outputs=st.one_of(st.none(), value, st.just({"told": 1.0})))
    def fire(self, which: int, name: str, outcome: str, outputs: Any) -> None:
        sim = self.sim(which)
        if sim is not None:
            self.attempt(f"fire {name}.{outcome} {outputs!r}", lambda: sim.fire(name, outcome, opened(outputs)))

    @rule(which=few, fault=st.sampled_from(afp.faults()), at=st.one_of(st.none(), value), share=value)
    def fail(self, which: int, fault: tuple[str, str], at: Any, share: Any) -> None:
        sim = self.sim(which)
        if sim is not None:
            self.attempt(f"fail {fault} {at!r} {share!r}", lambda: sim.fail(afp.Fault(*fault, at=opened(at), share=opened(share))))
            self.attempt("bump", lambda: sim.bump(hold=opened(share)))

    @rule(which=few, entry=st.sampled_from(["number", "far", "walldist", "nix"]), to=value, at=st.one_of(st.none(), time))
    def write(self, which: int, entry: str, to: Any, at: float | None) -> None:
        sim = self.sim(which)
        if sim is not None:
            self.attempt(f"write {entry} {to!r}", lambda: sim.set(entry, opened(to), at=at))
            self.attempt("read", lambda: (sim[entry], sim.entries))

    # Changing plans

    @rule(which=few, data=st.data())
    def change(self, which: int, data: st.DataObject) -> None:
        if not self.plans:
            return
        plan = self.plans[which % len(self.plans)]
        kind = data.draw(st.sampled_from(["rename", "remove", "set_start", "connect", "bind", "add", "move", "inline"]))
        wanted = {"remove": 1, "set_start": 1, "connect": 3, "bind": 3, "add": 1, "inline": 1}.get(kind, 2)
        parts = [data.draw(st.one_of(names, value)) for _ in range(wanted)]
        self.attempt(f"{kind} {parts!r}", lambda: getattr(plan, kind)(*map(opened, parts)))
        self.attempt("report", lambda: (plan.report(), plan.ok, repr(plan), plan._repr_html_()))

    # Anything with anything

    @rule(which=st.integers(0, 40), member=st.integers(0, 60), given=st.lists(value, max_size=3), key=st.booleans())
    def anything(self, which: int, member: int, given: list[Any], key: bool) -> None:
        scenarios = [s for plan in self.plans[:2] for s in (self.attempt("scenarios", lambda: plan.scenarios) or [])]
        things = [*self.plans[:3], *self.sims, *self.results, *self.tools, *self.worlds, *self.cars, *self.robots[-1:]]
        things += [*scenarios, afp]
        thing = things[which % len(things)]
        public = [name for name in dir(thing) if not name.startswith(("_", *LEFT_OUT))]
        name = public[member % len(public)]
        what = f"{type(thing).__name__}.{name} {given!r}"
        found = self.attempt(f"get {what}", lambda: getattr(thing, name))
        if callable(found) and not isinstance(found, (type, type(os))):
            if key and isinstance(thing, afp.Simulation) and given:
                self.attempt(f"at {what}", lambda: found("escape", at=opened(given[0])))
            self.attempt(what, lambda: found(*map(opened, given)))
        elif isinstance(found, type) and not issubclass(found, (BaseException, *MADE)):
            self.attempt(what, lambda: found(*map(opened, given)))

    @rule(which=few, sensor=st.sampled_from(["camera", "odometry", "color", "distance", "smell"]))
    def sense(self, which: int, sensor: str) -> None:
        things = [*self.sims, *self.cars]
        if things:
            thing = things[which % len(things)]
            told = self.attempt(f"sense {sensor}", lambda: thing.sense(sensor))
            if isinstance(told, np.ndarray):
                self.arrays.append((told, told.copy()))

    # Threads, processes, pickles

    @rule(which=few, ways=st.lists(st.sampled_from(["run", "step", "look", "write", "iterate", "stop", "fire"]), max_size=4))
    def threads(self, which: int, ways: list[str]) -> None:
        sim = self.sim(which)
        if sim is None:
            return
        deeds: dict[str, Callable[[], object]] = {
            "run": lambda: self.drive(sim, lambda sim: sim.run_to(sim.time + 0.5)),
            "step": lambda: [sim.step() for _ in range(50)],
            "look": lambda: [(sim.time, sim.active, sim.events, sim.camera) for _ in range(20)],
            "write": lambda: [sim.set("number", 2.0) for _ in range(50)],
            "iterate": lambda: [event for event, _ in zip(sim, range(30))],
            "stop": sim.request_stop,
            "fire": lambda: sim.fire("go", "Done"),
        }
        failed: list[BaseException] = []

        def work(way: str) -> None:
            try:
                self.attempt(f"in a thread: {way} (iterate)", deeds[way], alarm=False)
            except BaseException as error:
                failed.append(error)

        workers = [threading.Thread(target=work, args=(way,)) for way in ways]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        if failed:
            raise failed[0]

    @rule(which=few)
    def fork(self, which: int) -> None:
        sim = self.sim(which)
        if sim is None or not hasattr(os, "fork"):
            return
        self.note("fork")
        child = os.fork()
        if child == 0:
            try:
                sim.step()
            except RuntimeError as error:
                os._exit(0 if "forked" in str(error) else 1)
            except BaseException:
                os._exit(1)
            os._exit(2)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0, "a forked process"

    @rule(which=few)
    def pickled(self, which: int) -> None:
        for thing in [*self.plans[-1:], *self.worlds]:
            ways: list[Callable[[Any], Any]] = [copy.copy, copy.deepcopy]
            # Pickle cannot find its components, which are classes inside a function.
            if not getattr(thing, "toolboxes", []):
                ways.append(lambda thing: pickle.loads(pickle.dumps(thing)))
            for way in ways:
                assert way(thing).text == thing.text, thing
        for thing in [*self.sims[-1:], *self.cars[-1:], *self.robots[-1:]]:
            # A copy of a simulation is a clone.
            ways = [pickle.dumps, copy.deepcopy]
            if isinstance(thing, afp.Simulation):
                self.attempt("copy", lambda thing=thing: copy.copy(thing).time)
            else:
                ways.append(copy.copy)
            for how in ways:
                try:
                    how(thing)
                except TypeError as error:
                    assert "pickle" in str(error), error
                else:
                    raise AssertionError(f"{how.__name__} of {thing!r} was not refused")

    @rule(which=few)
    def let_go(self, which: int) -> None:
        self.note("let go")
        if self.sims:
            self.sims.pop(which % len(self.sims))
        if self.plans:
            self.plans.pop(which % len(self.plans))
        gc.collect()

    @invariant()
    def sound(self) -> None:
        """Read everything that is always readable."""
        for sim in self.sims:
            assert 0.0 <= sim.time and sim.ending in {"running", "ok", "interrupted", "time_limit", "error"}, sim
        del self.robots[:-5]

    def teardown(self) -> None:
        self.note("teardown")
        for all in (self.sims, self.plans, self.results, self.tools, self.robots, self.cars):
            all.clear()
        gc.collect()
        for array, before in self.arrays:
            assert np.array_equal(array, before), "an array changed after its simulation was gone"
