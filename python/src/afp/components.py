"""Components in Python: actors, supervisors and computations for plans.

Read a `Toolbox` from a toolbox file and implement its templates, or make one here: decorators and
type hints then declare the templates.

>>> tools = Toolbox("tools")
>>> @tools.computation(states=["Odd", "Even"])
... def Parity(value: int):
...     return "Odd" if value % 2 else "Even"
>>> print(tools.text)
toolbox tools
<BLANKLINE>
computation Parity {
    in value: int
    state Odd
    state Even
}
<BLANKLINE>
"""

from __future__ import annotations

import functools
import inspect
import os
import types
from collections.abc import Awaitable, Callable, Generator, Mapping, Sequence, Set
from pathlib import Path
from typing import Any, TypeVar, overload

from . import _afp
from ._afp import Robot, read_text
from .checks import text
from .declaration import GIVEN, Outcomes, annotated_outcomes, declaration, method_of, named, outcomes_of, parameters_of, start_of, text_of
from .fingerprint import Fingerprint, fingerprint
from .units import spelled_time

__all__ = ["Toolbox", "tick"]

Component = TypeVar("Component", bound=Callable[..., Any])


class _Tick:
    def __await__(self) -> Generator[None, float, float]:
        return (yield)


def tick() -> Awaitable[float]:
    """Await this in an `async def` actor to wait for its next poll.

    It returns how long the actor was suspended in the meantime, in seconds: 0.0 without `suspend`.
    """
    return _Tick()


class Toolbox(_afp.Toolbox):
    """A toolbox with templates implemented in Python: a new one by name, or `Toolbox.load(path)`."""

    def __new__(cls, name: str, *, version: str | None = None, doc: str = "") -> Toolbox:
        lines = "".join(f"/// {line}\n" for line in text("doc", doc).splitlines())
        known = text("version", version or "")
        head = f"{lines}toolbox {text('the name of a toolbox', name)}{f' version {text_of(known)}' if known else ''}\n"
        return super().__new__(cls, head)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Toolbox:
        """Read a toolbox file; `implement` adds the implementations."""
        return cls.parse(read_text("cannot read the toolbox", path), path)

    @classmethod
    def parse(cls, text: str, path: str | os.PathLike[str] | None = None) -> Toolbox:
        """Read the text of a toolbox file."""
        toolbox = _afp.Toolbox.__new__(cls, text, path)
        toolbox._path = path
        return toolbox

    _path: str | os.PathLike[str] | None = None
    _components: dict[str, Callable[..., Any]]
    """The implementation of each template."""

    def implement(self, component: Component, template: str | None = None) -> Component:
        """Set the class or function that implements a template; the default name is its own.

        You can use it as a decorator. Parameters are the template's inputs by name, and `robot`
        except for computations; `poll` takes the live inputs.
        """
        name = _name(component) if template is None else text("a template", template)
        about = self._template(name)
        _fits(about["kind"], name, component)
        if about["resumable"]:
            _continues(about["kind"], name, component, True)
        self._implement(name, _maker(about["kind"], component, about["inputs"], about["live"]))
        self._components = {**getattr(self, "_components", {}), name: component}
        return component

    def fingerprints(self) -> dict[str, Fingerprint]:
        """Hashes of the implementations, by template."""
        known = getattr(self, "_components", {})
        return {template: fingerprint(component) for template, component in sorted(known.items())}

    def __reduce__(self) -> tuple[Any, ...]:
        # Components go into the state, since they may refer back to their toolbox.
        return _again, (type(self), self.text, self._path), getattr(self, "_components", {})

    def __setstate__(self, components: dict[str, Component]) -> None:
        for template, component in components.items():
            self.implement(component, template)

    @overload
    def actor(self, component: Component, /) -> Component: ...
    @overload
    def actor(
        self,
        /,
        *,
        states: Outcomes | None = None,
        name: str | None = None,
        uses: str | Sequence[str] = (),
        every: str | float = "10 ms",
        stop: str | float | None = None,
        icon: str | None = None,
        resumable: bool = False,
    ) -> Callable[[Component], Component]: ...

    def actor(
        self,
        component: Any = None,
        /,
        *,
        states: Outcomes | None = None,
        name: str | None = None,
        uses: str | Sequence[str] = (),
        every: str | float = "10 ms",
        stop: str | float | None = None,
        icon: str | None = None,
        resumable: bool = False,
    ) -> Any:
        """Declare and implement an actor: a class with `poll`, or an `async def` function.

        A plan can suspend a class with `suspend` and `resume`, and an `async def` with `resumable`.
        Without `states`, a return annotation such as `-> Literal["There", "Blocked"]` declares them.
        `@tools.actor` alone does that, too.
        """
        declare = self._declarer("actor", states, name, uses, _timing(every=every, stop=stop), icon, resumable)
        return declare if component is None else declare(component)

    @overload
    def supervisor(self, component: Component, /) -> Component: ...
    @overload
    def supervisor(
        self,
        /,
        *,
        events: Outcomes | None = None,
        name: str | None = None,
        uses: str | Sequence[str] = (),
        every: str | float = "10 ms",
        deadline: str | float | None = None,
        budget: str | float | None = None,
        icon: str | None = None,
    ) -> Callable[[Component], Component]: ...

    def supervisor(
        self,
        component: Any = None,
        /,
        *,
        events: Outcomes | None = None,
        name: str | None = None,
        uses: str | Sequence[str] = (),
        every: str | float = "10 ms",
        deadline: str | float | None = None,
        budget: str | float | None = None,
        icon: str | None = None,
    ) -> Any:
        """Declare and implement a supervisor: a class with `poll`, or a function for each poll.

        A class with `resume` keeps its instance while its element is suspended.
        Without `events`, a return annotation such as `-> Literal["Near"] | None` declares them.
        `@tools.supervisor` alone does that, too.
        """
        timing = _timing(every=every, deadline=every if deadline is None else deadline, budget=budget)
        declare = self._declarer("supervisor", events, name, uses, timing, icon)
        return declare if component is None else declare(component)

    @overload
    def computation(self, component: Component, /) -> Component: ...
    @overload
    def computation(self, /, *, states: Outcomes | None = None, name: str | None = None, icon: str | None = None) -> Callable[[Component], Component]: ...

    def computation(
        self, component: Any = None, /, *, states: Outcomes | None = None, name: str | None = None, icon: str | None = None
    ) -> Any:
        """Declare and implement a computation: a function.

        Without `states`, a return annotation such as `-> Literal["Odd", "Even"]` declares them.
        `@tools.computation` alone does that, too.
        """
        declare = self._declarer("computation", states, name, (), "", icon)
        return declare if component is None else declare(component)

    def _declarer(
        self, kind: str, given: Outcomes | None, name: str | None, uses: str | Sequence[str], timing: str, icon: str | None, resumable: bool = False
    ) -> Callable[[Component], Component]:
        declared_here = None if given is None else outcomes_of(given)
        devices = [text("a device", device) for device in ([uses] if isinstance(uses, str) else uses)]
        icon = None if icon is None else text("icon", icon)

        def declare(component: Component) -> Component:
            template = _name(component) if name is None else text("name", name)
            if not template.isidentifier():
                raise ValueError(f"{template!r} is not the name of a template; give letters, digits and '_'")
            _fits(kind, template, component)
            outcomes = annotated_outcomes(kind, component) if declared_here is None else declared_here
            continues = _continues(kind, template, component, resumable)
            declared = declaration(kind, template, component, outcomes, devices, timing, icon, continues)
            _maker(kind, component, *_own_ports(kind, component))
            try:
                self._declare(template, declared)
            except _afp.AfpError as why:
                raise _afp.AfpError(f"the {kind} '{template}' has an invalid declaration:\n{self._alone(declared, why)}") from None
            return self.implement(component, template)

        return declare

    def _alone(self, template: str, why: _afp.AfpError) -> str:
        """The errors of a template, without those of other templates; `why` adds a reason."""
        try:
            _afp.Toolbox.__new__(_afp.Toolbox, f"toolbox {self.name}\n{template}", "its declaration")
        except _afp.AfpError as alone:
            return str(alone)
        return str(why)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Toolbox) or self.text != other.text:
            return False
        return self is other or self.fingerprints() == other.fingerprints()

    def __hash__(self) -> int:
        return hash(self.name)

    def __repr__(self) -> str:
        return f"<Toolbox {self.name}: {', '.join(self.templates)}>"


def _again(kind: type[Toolbox], text: str, path: str | os.PathLike[str] | None) -> Toolbox:
    return kind.parse(text, path)


def _name(component: Callable[..., Any]) -> str:
    name = getattr(component, "__name__", None)
    if isinstance(component, functools.partial):
        raise TypeError(f"{component!r} is not a plain function: write a function that calls it, with its ports as parameters")
    if not callable(component) or not isinstance(name, str):
        raise TypeError(f"a component must be a class or a function, not {component!r}")
    if not name.isidentifier():
        raise TypeError(f"the component {component!r} has no name: give name=")
    return name


def _fits(kind: str, name: str, component: Callable[..., Any]) -> None:
    """Raise at once if a component can never work."""
    if not callable(component):
        raise TypeError(f"a component must be a class or a function, not {component!r}")
    is_class = isinstance(component, type)
    if is_class and kind == "computation":
        raise TypeError(f"the computation '{name}' is a class; a computation is a function")
    steps = getattr(component, "poll", component) if is_class else component
    if inspect.isasyncgenfunction(steps):
        raise TypeError(f"'{name}' yields; an 'async def' actor awaits afp.tick() and returns its state")
    if inspect.isgeneratorfunction(steps):
        raise TypeError(f"'{name}' yields; a component returns its result")
    if inspect.iscoroutinefunction(steps) and (kind != "actor" or is_class):
        what = "a 'poll'" if is_class else f"a {kind}"
        raise TypeError(f"'{name}' is 'async def'; {what} is a plain function, called at each poll")
    if is_class and kind == "actor":
        for method in ("interrupt", "suspend"):
            taken = _fits_method(name, component, method)
            if len(taken) > 1:
                raise TypeError(f"the '{method}' of '{name}' takes {', '.join(taken)}; it gets the robot, or nothing")
    if is_class:
        others = [taken for taken in _fits_method(name, component, "resume") if taken not in _RESUME]
        if others:
            raise TypeError(f"the 'resume' of '{name}' takes {', '.join(others)}; it gets 'away', in seconds, and 'robot'")


_RESUME = ("away", "robot")
"""The parameters that a `resume` can have."""


def _fits_method(name: str, component: Callable[..., Any], called: str) -> list[str]:
    """The parameters of an optional method; raise at once if it can never work."""
    method = getattr(component, called, None)
    if method is None:
        return []
    if not callable(method):
        raise TypeError(f"the '{called}' of '{name}' is a method, not {method!r}")
    lazy = (inspect.iscoroutinefunction, inspect.isgeneratorfunction, inspect.isasyncgenfunction)
    if any(is_lazy(method) for is_lazy in lazy):
        raise TypeError(f"the '{called}' of '{name}' is 'async def' or yields; it is a plain function, called once")
    return [taken for taken in inspect.signature(method).parameters if taken != "self"]


def _continues(kind: str, name: str, component: Callable[..., Any], wanted: bool) -> bool:
    """Whether a component can continue after a suspension; raise if it is `wanted` and cannot."""
    if not isinstance(component, type):
        return wanted
    needed = ("suspend", "resume") if kind == "actor" else ("resume",)
    missing = [method for method in needed if not hasattr(component, method)]
    if missing and (wanted or len(missing) < len(needed)):
        why = "it is resumable" if wanted else f"it has '{'resume' if missing == ['suspend'] else 'suspend'}'"
        raise TypeError(f"the {kind} '{name}' has no method '{missing[0]}', but {why}")
    return not missing


def _timing(**times: str | float | None) -> str:
    """The given times of a template."""
    return " ".join(f"{word} {spelled_time(time)}" for word, time in times.items() if time is not None)


# Running components


def _maker(kind: str, component: Callable[..., Any], inputs: Sequence[str], live: Sequence[str]) -> Callable[..., Any]:
    """The function that the native half calls to make a component."""
    if kind == "computation":
        takes = _takes(component, inputs, (), dict.fromkeys(GIVEN, "a computation has only its inputs"))
        return lambda values: component(**{name: values[name] for name in takes})
    if isinstance(component, type):
        return _class_maker(kind, component, inputs, live)
    if kind == "supervisor":
        return _function_maker(component, inputs, live)
    if not inspect.iscoroutinefunction(component):
        raise TypeError(f"the actor '{named(component)}' must be a class with 'poll', or 'async def'")
    return _coroutine_maker(component, inputs, live)


_AN_ACTOR = {"wanted": "only supervisors receive the wanted events"}
"""Names that an actor cannot request, with the reasons."""


def _takes(
    function: Callable[..., Any], ports: Sequence[str], given: Sequence[str], others: Mapping[str, str]
) -> list[str]:
    """The parameters of a function, each of which must be a port or a known name; `others` explains
    why some are neither.
    """
    names = [name for name in parameters_of(function) if name != "self"]
    for name in names:
        if name in ports or name in given:
            continue
        known = [*given, *ports]
        there = f"there are only: {', '.join(known)}" if known else "it has no parameters"
        raise TypeError(f"'{named(function)}' takes '{name}', but {others.get(name, there)}")
    return names


def _own_ports(kind: str, component: Callable[..., Any]) -> tuple[list[str], list[str]]:
    """The inputs declared by a component's parameters: those read once, and live ones."""
    if isinstance(component, type):
        start = start_of(component)
        return _ports(start) if start else [], _ports(method_of(component, "poll"))
    return ([], _ports(component)) if kind == "supervisor" else (_ports(component), [])


def _ports(function: Callable[..., Any]) -> list[str]:
    return [name for name in parameters_of(function) if name != "self" and name not in GIVEN]


class _Running:
    """A running component, in the form that the native half polls."""

    __slots__ = ("interrupt", "poll", "resume", "suspend")

    def __init__(
        self,
        poll: Callable[..., Any],
        interrupt: Callable[[], Any],
        suspend: Callable[[], Any],
        resume: Callable[[float], Any],
    ) -> None:
        self.poll = poll
        self.interrupt = interrupt
        self.suspend = suspend
        self.resume = resume


def _poll(method: Callable[..., Any], takes: Sequence[str], robot: Robot, has_live: bool) -> Callable[..., Any]:
    """Poll with the live inputs, if there are any, and pass on the wanted parameters."""
    if not has_live:
        if not takes:
            return method
        return lambda: method(robot)
    wanted = [name for name in takes if name != "robot"]
    if "robot" in takes:
        return lambda values: method(robot=robot, **{name: values[name] for name in wanted})
    return lambda values: method(**{name: values[name] for name in wanted})


def _class_maker(kind: str, component: type, inputs: Sequence[str], live: Sequence[str]) -> Callable[..., Any]:
    begins = start_of(component)
    given = GIVEN if kind == "supervisor" else ("robot",)
    no_start = _AN_ACTOR | dict.fromkeys(live, "it is live: 'poll' takes it")
    no_poll = _AN_ACTOR | dict.fromkeys([*inputs, *given], "it is fixed at the start: '__init__' takes it")
    start = _takes(begins, inputs, given, no_start) if begins else []
    poll = _takes(method_of(component, "poll"), live, ("robot",), no_poll)

    def make(robot: Robot, values: dict[str, Any], wanted: Set[str] = frozenset()) -> _Running:
        all = {"robot": robot, "wanted": wanted, **values}
        instance = component(**{name: all[name] for name in start})

        def stop(method: str) -> Callable[[], None]:
            return _stop(instance, method, robot) if kind == "actor" else _nothing

        return _Running(_poll(instance.poll, poll, robot, bool(live)), stop("interrupt"), stop("suspend"), _resume(instance, robot))

    return make


def _stop(instance: Any, method: str, robot: Robot) -> Callable[[], None]:
    """Call the actor's method for an interruption or a suspension; the robot stops in any case."""

    def stop() -> None:
        try:
            called = getattr(instance, method, None)
            if called is not None:
                called(robot) if inspect.signature(called).parameters else called()
        finally:
            robot.stop()

    return stop


def _resume(instance: Any, robot: Robot) -> Callable[[float], None]:
    """Call the component's method at its return."""

    def resume(away: float) -> None:
        called = getattr(instance, "resume", None)
        if called is not None:
            all = {"away": away, "robot": robot}
            called(**{name: all[name] for name in inspect.signature(called).parameters})

    return resume


def _nothing(*_: Any) -> None:
    pass


def _function_maker(function: Callable[..., Any], inputs: Sequence[str], live: Sequence[str]) -> Callable[..., Any]:
    takes = _takes(function, [*inputs, *live], GIVEN, {})

    def make(robot: Robot, values: dict[str, Any], wanted: Set[str] = frozenset()) -> _Running:
        all = {"robot": robot, "wanted": wanted, **values}
        fixed = {name: all[name] for name in takes if name in all}
        read = [name for name in takes if name in live]
        if not live:
            return _Running(lambda: function(**fixed), _nothing, _nothing, _nothing)
        return _Running(lambda news: function(**fixed, **{name: news[name] for name in read}), _nothing, _nothing, _nothing)

    return make


def _coroutine_maker(function: Callable[..., Any], inputs: Sequence[str], live: Sequence[str]) -> Callable[..., Any]:
    no_port = _AN_ACTOR | dict.fromkeys(live, "it is live: a class takes it in its 'poll'")
    takes = _takes(function, inputs, ("robot",), no_port)

    def make(robot: Robot, values: dict[str, Any]) -> _Running:
        all = {"robot": robot, **values}
        coroutine = function(**{name: all[name] for name in takes})
        end = _advance(coroutine, None)
        done = [] if end is None else [end]
        away = 0.0

        def poll(news: dict[str, Any] | None = None) -> Any:
            nonlocal away
            said = done.pop() if done else _advance(coroutine, away)
            away = 0.0
            return None if said is None else said[0]

        def resume(time: float) -> None:
            nonlocal away
            away += time

        def interrupt() -> None:
            try:
                coroutine.close()
            finally:
                robot.stop()

        return _Running(poll, interrupt, robot.stop, resume)

    # Its return value is its end; the native half then accepts None.
    setattr(make, "ends", True)
    return make


def _advance(coroutine: types.CoroutineType[Any, Any, Any], away: float | None) -> tuple[Any] | None:
    """Run a coroutine up to its next `tick`, and pass the result of the last one. Return the
    coroutine's result in a tuple if it has ended.
    """
    try:
        waits = coroutine.send(away)
    except StopIteration as end:
        if end.value is None:
            raise TypeError(f"the actor '{named(coroutine)}' returned None, not a state") from None
        return (end.value,)
    except RuntimeError as why:
        # The error of asyncio for an await here.
        if str(why) != "no running event loop":
            raise
        raise TypeError("an actor can only await afp.tick(); asyncio's event loop does not run it") from why
    if waits is not None:
        raise TypeError(f"an actor can only await afp.tick(), not {waits!r}")
    return None
