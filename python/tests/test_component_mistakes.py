"""Components and declarations that could never work are rejected at their definition, with a
suggestion.
"""

from __future__ import annotations

import functools
from enum import Enum
from typing import Any

import pytest

import afp

HAND = """toolbox hand
actor Go { in far: length in live speed: speed = 0.1 m/s uses navigator every 10 ms state Done }
actor Rests resumable { every 10 ms state Done }
supervisor Keeps resumable { every 10 ms deadline 10 ms event Seen }
supervisor Sees { in near: length in live n: int = 0 every 10 ms deadline 10 ms event Seen }
computation Twice { in n: int state Done }
computation Ends { state Done }
"""


class Polled:
    def poll(self) -> str:
        return "Done"


class Waits(Polled):
    async def interrupt(self) -> None: ...


class Yields(Polled):
    def interrupt(self) -> Any:
        yield


class TakesTwo(Polled):
    def interrupt(self, robot: afp.Robot, why: str) -> None: ...


class Suspends(Polled):
    def suspend(self) -> None: ...


class Resumes(Polled):
    def suspend(self) -> None: ...

    def resume(self, time: float) -> None: ...


class Slow:
    async def poll(self) -> str:
        return "Done"


class Inherits(Slow): ...


class Wanted(Polled):
    def __init__(self, wanted: Any) -> None: ...


class StartsLive(Polled):
    def __init__(self, speed: float) -> None: ...


class PollsOnce:
    def poll(self, far: float) -> str:
        return "Done"


class ByPlace(Polled):
    def __init__(self, far: float, /) -> None: ...


class WantedLate:
    def poll(self, wanted: Any) -> str:
        return "Seen"


async def lives(speed: float) -> str:
    return "Done"


async def asks(wanted: Any) -> str:
    return "Done"


def drives(robot: afp.Robot) -> str:
    return "Done"


def guesses(m: int) -> str:
    return "Done"


def yields(n: int) -> Any:
    yield "Done"


@pytest.mark.parametrize(
    ("component", "template", "said"),
    [
        (Waits, "Go", "the 'interrupt' of 'Go' is 'async def' or yields; it is a plain function, called once"),
        (Yields, "Go", "the 'interrupt' of 'Go' is 'async def' or yields"),
        (TakesTwo, "Go", "the 'interrupt' of 'Go' takes robot, why; it gets the robot, or nothing"),
        (Polled, "Rests", "the actor 'Rests' has no method 'suspend', but it is resumable"),
        (Suspends, "Rests", "the actor 'Rests' has no method 'resume', but it is resumable"),
        (Polled, "Keeps", "the supervisor 'Keeps' has no method 'resume', but it is resumable"),
        (Resumes, "Rests", "the 'resume' of 'Rests' takes time; it gets 'away', in seconds, and 'robot'"),
        (Slow, "Go", "'Go' is 'async def'; a 'poll' is a plain function, called at each poll"),
        (Inherits, "Sees", "'Sees' is 'async def'; a 'poll' is a plain function"),
        (yields, "Twice", "'Twice' yields; a component returns its result"),
        (Polled, "Twice", "the computation 'Twice' is a class; a computation is a function"),
        (ByPlace, "Go", "takes 'far' only by position; ports are passed by name: leave out the '/'"),
        (Wanted, "Go", "takes 'wanted', but only supervisors receive the wanted events"),
        (asks, "Go", "'asks' takes 'wanted', but only supervisors receive the wanted events"),
        (WantedLate, "Sees", "takes 'wanted', but it is fixed at the start: '__init__' takes it"),
        (StartsLive, "Go", "takes 'speed', but it is live: 'poll' takes it"),
        (PollsOnce, "Go", "takes 'far', but it is fixed at the start: '__init__' takes it"),
        (lives, "Go", "'lives' takes 'speed', but it is live: a class takes it in its 'poll'"),
        (drives, "Twice", "'drives' takes 'robot', but a computation has only its inputs"),
        (guesses, "Twice", "'guesses' takes 'm', but there are only: n"),
        (guesses, "Ends", "'guesses' takes 'm', but it has no parameters"),
        (functools.partial(guesses, 1), "Go", "must be a class with 'poll', or 'async def'"),
        (3, "Go", "a component must be a class or a function, not 3"),
    ],
)
def test_invalid_implementations_are_explained(component: Any, template: str, said: str) -> None:
    tools = afp.Toolbox.parse(HAND)
    with pytest.raises(TypeError) as error:
        tools.implement(component, template)
    assert said in str(error.value) and tools.implemented == []


@pytest.mark.parametrize(("kind", "component"), [("actor", Waits), ("actor", Wanted), ("computation", drives), ("actor", asks)])
def test_an_invalid_declaration_does_not_change_the_toolbox(kind: str, component: Any) -> None:
    tools = afp.Toolbox("tools")
    with pytest.raises(TypeError, match="interrupt|wanted|a computation has only its inputs"):
        getattr(tools, kind)(states=["Done"])(component)
    assert tools.text == "toolbox tools\n" and tools.templates == []


def test_states_are_read_once() -> None:
    tools = afp.Toolbox("tools")

    class Side(str, Enum):
        LEFT = "Left"
        RIGHT = "Right"

    @tools.computation(states=(state for state in ("Odd", "Even")))
    def Parity(n: int) -> str:
        return "Odd" if n % 2 else "Even"

    @tools.computation(states=Side)
    def Choose(n: int) -> str:
        return Side.LEFT if n else Side.RIGHT

    assert "state Odd\n    state Even\n" in tools.text and "state Left\n    state Right\n" in tools.text
    text = "use tools plan P { start c computation c: Choose(n = 1) { Left -> terminate Right -> fail } }"
    assert afp.Simulation(afp.Plan(text, toolboxes=[tools])).run().ending == "ok"


class Plain(Enum):
    LEFT = 1


@pytest.mark.parametrize(
    ("declare", "said"),
    [
        (lambda tools: tools.actor(states=Plain), "the name of a state or event must be a string, not <Plain.LEFT: 1>"),
        (lambda tools: tools.actor(states=3), "states and events are a list of names, not 3"),
        (lambda tools: tools.actor(states={"Y": ["x"]}), "the outputs of 'Y' are ports with their types, such as {'x': float}, not ['x']"),
        (lambda tools: tools.actor(states=["Y"], name=3), "name must be a string, not 3"),
        (lambda tools: tools.actor(states=["Y"], icon=3), "icon must be a string, not 3"),
        (lambda tools: tools.actor(states=["Y"], uses=[3]), "a device must be a string, not 3"),
        (lambda tools: tools.implement(Polled, 3), "a template must be a string, not 3"),
        (lambda tools: afp.Toolbox("tools", version=1.0), "version must be a string, not 1.0"),
        (lambda tools: afp.Toolbox(None), "the name of a toolbox must be a string, not None"),
    ],
)
def test_declarations_consist_of_strings(declare: Any, said: str) -> None:
    with pytest.raises(TypeError) as error:
        declare(afp.Toolbox("tools"))(Polled)
    assert said in str(error.value)
