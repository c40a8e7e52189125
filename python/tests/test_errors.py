"""Common mistakes and their errors."""

from __future__ import annotations

import math
import re
import statistics
from datetime import timedelta
from functools import partial
from typing import Any, Literal, Optional

import numpy as np
import pytest

import afp
from conftest import ROOT

SAID: list[tuple[str, type[Exception], str]] = [
    ("sim.run('20 s')", TypeError, "until is a time in seconds, such as 2.5 or afp.ms(300), not '20 s'"),
    ("sim.run(afp.cm(3))", TypeError, "until is a time in seconds, not a quantity in m"),
    ("sim.run(until=-1)", ValueError, "-1 is not a time from 0 on, in seconds"),
    ("sim.bump(hold='1 s')", TypeError, "hold is a time"),
    ("sim.fail(afp.Fault('ultrasonic', 'frozen', share=0.3))", ValueError, "a share has no amount 'frozen'"),
    ("sim.fail(afp.Fault('odometry', 'delayed', share=0.3))", ValueError, "a share has no amount 'delayed'"),
    ("sim.fail(afp.Fault('battery', 'low', share=7))", ValueError, "share is 7; give a number from 0 to 1"),
    ("sim.fire('findWallAngle', 'WallFound', {'angle': 'ten'})", TypeError, "expected an angle, not a str"),
    ("simulate(set={'walldist': True})", TypeError, "'walldist' is a length in m, not a bool"),
    ("simulate(set={'walldist': None})", TypeError, "'walldist' is a length in m, not a NoneType"),
    ("simulate(set={'walldist': 10**30})", OverflowError, "more than 64 bits"),
    ("simulate(set='walldist=3')", TypeError, "set gives entries their values, such as {'walldist': afp.cm(35)}"),
    ("simulate(world=3)", TypeError, "a world must be a file, a string such as 'random:7', or a World, not 3"),
    ("simulate(log='nowhere/run.mcap')", FileNotFoundError, "cannot write the log: No such file or directory: 'nowhere/run.mcap'"),
    ("afp.Log('nowhere.mcap')", FileNotFoundError, "cannot read the log: No such file or directory: 'nowhere.mcap'"),
    ("afp.World.load('hall.toml')", FileNotFoundError, "cannot read the world: No such file or directory: 'hall.toml'"),
    ("plan.save('nowhere/plan.afp')", FileNotFoundError, "cannot write the plan: No such file or directory"),
    ("simulate(log='.')", IsADirectoryError, "cannot write the log: it is a folder: '.'"),
    ("afp.sweep(plan, vary=[1])", TypeError, "vary gives entries lists of values, such as {'walldist': [afp.cm(30), afp.cm(40)]}"),
    ("afp.cm(afp.deg(90))", TypeError, "cm() takes a number, not a quantity in rad"),
    ("simulate(set={'walldist': 2 * afp.deg(10)})", TypeError, "'walldist' is a length in m, not a quantity in rad"),
    ("afp.cm('30')", TypeError, "cm() takes a number, not '30'"),
    ("plan.set_every('searchFirstWall.touch', [5])", TypeError, "a time is a time in seconds"),
    ("plan.bind('backupCollision', 'distance', None)", TypeError, "expected a string, a number or a quantity, not None"),
    ("plan.bind('backupCollision', 'distance', afp.deg(3))", TypeError, "expected a length, found an angle"),
    ("plan.bind('backupCollision', 'distance', 3)", TypeError, "found a bare number; give it its unit, as in afp.cm(30)"),
    ("plan.bind('searchFirstWall.touch', 'distance', afp.cm(3))", ValueError, "'CheckTouchSensor' has no port 'distance'"),
    ("plan.set_entry_value('walldist', afp.s(3))", TypeError, "expected a length, found a duration"),
    ("tools.actor(states='Done')", TypeError, "'Done' is one name; states and events are a list: ['Done']"),
    ("tools.computation(states=['Done'])(lambda: 'Done')", TypeError, "has no name: give name="),
    ("tools.supervisor(events=['Seen'])(looks)", TypeError, "'looks' is 'async def'; a supervisor is a plain function"),
    ("tools.actor(states=['Done'])(yields)", TypeError, "'yields' yields; an 'async def' actor awaits afp.tick()"),
    ("tools.computation(states=['Done'])(partial)", TypeError, "is not a plain function: write a function that calls it"),
    ("tools.actor(states=['Done'])(hidden)", TypeError, "names 'Decimal', which is undefined while the program runs"),
    ("tools.actor(states=['Done'])(maybe)", TypeError, "has the hint Optional[float], which matches no type of the language"),
    ("simulate(world=hall)", TypeError, "call build() of <WorldBuilder 'Hall': 1 added> to make a world"),
    ("afp.sweep(plan, hall)", TypeError, "call build() of <WorldBuilder 'Hall': 1 added> to make a world"),
    ("simulate(start=(1,))", TypeError, "start is x, y and perhaps a heading, such as (1.0, 2.0, afp.deg(90)), not (1,)"),
    ("simulate(start=(1, 2, afp.cm(3)))", TypeError, "start is in rad, not a quantity in m"),
    ("afp.sweep(plan, presses='escape@1s')", TypeError, "give a list of afp.Press, not 'escape@1s'"),
    ("afp.sweep(plan, presses=[afp.Press('horn', at=1)])", ValueError, "no control 'horn'; it has 'touch', 'escape'"),
    ("afp.sweep(plan, presses=[afp.Press()])", ValueError, "name the control in a sweep"),
    ("afp.sweep(plan, presses=[afp.Press('touch', hold=1)])", ValueError, "a sweep holds controls for 0.2 s, not for 1.0 s"),
    ("afp.sweep(plan, faults=afp.Fault('touch', 'lost'))", TypeError, "give a list, also for one Fault"),
    ("afp.sweep(plan, faults=[('touch', 'lost')])", TypeError, "give an afp.Fault, such as afp.Fault("),
    ("afp.sweep(plan, faults=[afp.Fault('hat', 'lost', at=1)])", ValueError, "unknown device 'hat'; there are"),
    ("afp.sweep(plan, faults=[afp.Fault('wheels', 'slip', share=7)])", afp.AfpError, "such as 'wheels.slip=0.1@5s..7s'"),
    ("afp.sweep(plan, vary={'wal': [1]})", KeyError, "the plan has no entry 'wal'; there are: "),
    ("afp.sweep(plan, draw={'walldist': 3})", TypeError, "'walldist' is drawn by a function of a random generator"),
    ("afp.sweep(plan, seeds=3, draw={'walldist': [0.3, 0.4]})", ValueError, "'walldist' has 2 values for 3 seeds; give one for each"),
    ("afp.sweep(plan, lambda rng: 3)", TypeError, "a world must be a file, a string such as 'random:7', or a World, not 3"),
    ("hall.polygon('p', [(1, 1), (2, 2)], height=1)", afp.AfpError, "a polygon has three corners or more, not 2"),
    ("simulate(log='')", FileNotFoundError, "cannot write the log: No such file or directory: ''"),
    ("simulate(camera=True)", ValueError, "the log has the camera's pictures, and there is no log: also give log="),
    ("sim.fail(afp.Fault('ultrasonic', 'frozen', lasting=0))", ValueError, "lasting is 0 s, which takes no time"),
    ("sim.press(afp.Press(hold=1e-12))", ValueError, "hold is 0.000000000001 s, which takes no time"),
    ("sim.fail(afp.Fault('wheels', 'slip', share=afp.cm(3)))", TypeError, "share is a plain number, not a quantity in m"),
    ("carbot.drive(afp.deg(3), 0, 1)", TypeError, "speed is a number in m/s, not a quantity in rad"),
    ("carbot.drive(0.1, afp.cm(3), 1)", TypeError, "turn is a number in rad/s, not a quantity in m"),
    ("carbot.drive(0.1, 0, afp.cm(50))", TypeError, "time is a number in s, not a quantity in m"),
    ("afp.sweep(plan, vary={'walldist': afp.deg(3)})", TypeError, "'walldist' is a length in m, not a quantity in rad"),
    ("plan.save_svg('plan.png')", ValueError, "a picture is saved as .svg, not as '.png'"),
    ("afp.Plan('', toolboxes=[tools, afp.Toolbox('tools')])", afp.AfpError, "two toolboxes are called 'tools'"),
    ("afp.Plan('', toolboxes=[afp.Toolbox('carbot')])", afp.AfpError, "another toolbox is called 'carbot', built in or in the project"),
    ("afp.Plan('', toolboxes=tools)", TypeError, "toolboxes must be a list, also with one item: toolboxes=[tools]"),
    ("afp.Plan('', toolboxes='a')", TypeError, "toolboxes must be a list of Toolbox, not 'a'"),
    ("afp.Plan('', toolboxes=['a'])", TypeError, "toolboxes must contain Toolbox, not 'a'"),
    ("afp.Plan(None)", TypeError, "a plan must be a string, not None"),
    ("simulate(camera='no')", TypeError, "camera is True or False, not 'no'"),
    ("plan.rename(None, 'x')", TypeError, "item must be a string, not None"),
    ("plan.rename('escape', 3)", TypeError, "to must be a string, not 3"),
    ("simulate(set={1: 1})", TypeError, "a name in set must be a string, not 1"),
    ("simulate(set=0)", TypeError, "set gives entries their values"),
    ("sim.fire('go', 'Done', '')", TypeError, "outputs gives outputs their values, such as {'angle': afp.deg(10)}, not ''"),
    ("sim.press(afp.Press(3))", TypeError, "a control must be a string, not 3"),
    ("sim[3]", TypeError, "an entry must be a string, not 3"),
    ("sim.fire(3, 'Seen')", TypeError, "an actor or supervisor must be a string, not 3"),
    ("afp.World.random(-1)", ValueError, "-1 is not a seed; seeds go from 0 to 2**64 - 1"),
    ("afp.World.random('a')", TypeError, "a seed is a whole number, not 'a'"),
    ("afp.Carbot(afp.World.random(1), seed=-1)", ValueError, "-1 is not a seed"),
    ("simulate(set={'walldist': '35'})", TypeError, "'walldist' is a length in m, not \"35\"; write its unit, as in \"35 cm\""),
    ("simulate(set={'walldist': 'far'})", TypeError, "not \"far\"; give one such as afp.cm(30)"),
    ("simulate(set={'walldist': [1]})", TypeError, "not a list; give one such as afp.cm(30)"),
    ("simulate(set={'walldist': float('nan')})", ValueError, "'walldist' is nan; give a finite number"),
    ("simulate(set={'walldist': -math.inf})", ValueError, "'walldist' is -inf; give a finite number"),
    ("sim.set('walldist', afp.m(math.inf))", ValueError, "'walldist' is inf; give a finite number"),
    ("plan.set_entry_value('walldist', math.nan)", ValueError, "a value is nan; give a finite number"),
    ("plan.bind('backupCollision', 'distance', afp.m(math.inf))", ValueError, "a value is inf; give a finite number"),
    ("plan.set_every('searchFirstWall.touch', math.inf)", ValueError, "a time is inf; give a finite number of seconds"),
    ("sim.sense('smell')", KeyError, "the robot has no 'smell'; its sensors are: distance"),
    ("sim['wal']", KeyError, "the plan has no entry 'wal'; there are: "),
    ("simulate(start=(1, 2, 90))", ValueError, "start has the heading 90 rad, more than a turn; write degrees as afp.deg(90)"),
    ("afp.WorldBuilder('Hall', start=(1, 2, 90))", ValueError, "write degrees as afp.deg(90)"),
    ("tools.actor(uses=['navigater'])(there)", ValueError, "the robot has no device 'navigater'; did you mean 'navigator'?"),
    ("tools.actor(mute)", TypeError, "the actor 'mute' needs states=[...], or a return annotation"),
    ("tools.implement(3)", TypeError, "a component must be a class or a function, not 3"),
]


@pytest.mark.parametrize(("tried", "kind", "said"), SAID, ids=[tried for tried, _, _ in SAID])
def test_an_error_has_a_help(tried: str, kind: type[Exception], said: str, wall_following: afp.Plan) -> None:
    def simulate(**options: Any) -> afp.Simulation:
        return afp.Simulation(wall_following, **options)

    async def looks(robot: afp.Robot) -> None: ...

    async def yields(robot: afp.Robot) -> Any:
        yield "Done"

    async def hidden(robot: afp.Robot, far: "Decimal") -> None: ...  # type: ignore[name-defined]  # noqa: F821

    async def maybe(robot: afp.Robot, far: Optional[float]) -> None: ...

    async def there(robot: afp.Robot) -> Literal["There"]:
        return "There"

    async def mute(robot: afp.Robot) -> str:
        return "There"

    components = {"looks": looks, "yields": yields, "hidden": hidden, "maybe": maybe, "partial": partial(looks, 1), "there": there, "mute": mute}
    names = components | {"afp": afp, "math": math, "plan": wall_following, "sim": simulate(), "simulate": simulate, "tools": afp.Toolbox("tools")}
    names["hall"] = afp.WorldBuilder("Hall", start=(1.0, 1.0)).room(4.0, 4.0)
    names["carbot"] = afp.Carbot(afp.World.random(1))
    with pytest.raises(kind) as error:
        eval(tried, names)
    assert said in str(error.value)


def test_an_error_lists_the_values_of_an_entry() -> None:
    text = "enum Mood { Calm, Wild } plan P { in mood: Mood = Mood.Calm in long: duration = 1 s in n: int = 0 var got: int start c computation c: Assign(value = n, result => got) { Done -> terminate } }"
    plan = afp.Plan(f"use std {text}")
    with pytest.raises(TypeError, match="'mood' is a Mood, not \"wild\"; there are: Calm, Wild"):
        afp.Simulation(plan, set={"mood": "wild"})
    with pytest.raises(TypeError, match=r"not a timedelta; give one such as afp\.s\(3\)"):
        afp.Simulation(plan, set={"long": timedelta(seconds=3)})
    with pytest.raises(TypeError, match="'n' is an int, not \"x\"$"):
        afp.Simulation(plan, set={"n": "x"})


def test_times_and_values_may_have_any_number_type(wall_following: afp.Plan) -> None:
    afp.Simulation(wall_following).run(until=afp.ms(300))
    plan = afp.load(ROOT / "plans/wall_following.afp")
    plan.set_every("searchFirstWall.touch", afp.ms(5))
    plan.bind("backupCollision", "distance", afp.cm(-20))
    plan.set_entry_value("walldist", afp.cm(40))
    assert plan.ok and "every 0.005 s" in plan.text and "distance = -0.2 m" in plan.text and "= 0.4 m" in plan.text
    tools = afp.Toolbox("tools")

    @tools.supervisor(events=["Near"], every=0.02, deadline=afp.ms(10))
    def CheckNear(robot: afp.Robot) -> None:
        return None

    assert "every 0.02 s deadline 0.01 s" in tools.text
    assert afp.new_plan("P", use="carbot").text.startswith("use carbot\n")


def test_a_default_has_the_unit_of_its_type() -> None:
    tools = afp.Toolbox("tools")
    with pytest.raises(TypeError, match="the parameter 'far' of '.*Far' is length in m, its default a quantity in rad"):

        @tools.computation(states=["Done"])
        def Far(far: afp.Length = afp.deg(30)) -> str:
            return "Done"


def test_numbers_of_numpy_are_numbers(wall_following: afp.Plan) -> None:
    plan = afp.Plan("plan P { in g: float = 1.0 in n: int = 1 in b: bool = false }\n")
    for value, text in ((np.float64(2.0), "2.0"), (np.float32(0.5), "0.5"), (np.int64(3), "3")):
        plan.set_entry_value("g", value)
        assert f"g: float = {text}" in plan.text
    text = "use std\nplan P { in n: int = 1 in f: float = 1.0 in b: bool = false in t: duration = 1 s start w actor w: Wait(duration = t) { Elapsed -> terminate } }"
    values = {"n": np.int64(3), "f": np.float32(0.5), "b": np.bool_(True), "t": np.float64(0.5)}
    simulation = afp.Simulation(afp.Plan(text), set=values)
    assert simulation.entries == {"n": 3, "f": 0.5, "b": True, "t": 0.5}
    simulation.step()
    simulation["n"] = np.int32(7)
    simulation.step()
    assert simulation["n"] == 7
    tools = afp.Toolbox("tools")

    @tools.computation(states=["Done"])
    def Scale(by: float = np.float64(0.5), times: int = np.int64(2)) -> str:
        return "Done"

    assert "by: float = 0.5" in tools.text and "times: int = 2" in tools.text


def test_quantities_stay_quantities_in_computations() -> None:
    angle = afp.deg(10)
    alike = [2 * angle, np.float64(2) * angle, np.int64(2) * angle, angle * np.float32(2), angle / 0.5, sum([angle, angle]), angle + angle]
    assert all(isinstance(it, afp.Quantity) and it.unit == "rad" and it == pytest.approx(2 * float(angle)) for it in alike)
    assert (round(angle, 1), +angle, -angle) == (afp.rad(0.2), angle, afp.deg(-10)) and (+angle).unit == round(angle, 1).unit == "rad"
    assert all(type(it) is float for it in (angle + 0.1, 0.1 + angle, 1 - angle, 2 / angle, angle / angle))
    assert isinstance(np.array([1.0, 2.0]) * angle, np.ndarray) and isinstance(angle * np.arange(2), np.ndarray)
    assert afp.cm(30) != afp.rad(0.3) and afp.cm(30) == 0.3 == afp.mm(300) and len({afp.cm(30), 0.3}) == 1
    assert afp.cm(30) < 0.4 and afp.cm(30) <= afp.m(1) and not afp.cm(30) > afp.m(1) and 1 >= afp.cm(30)
    assert sorted([afp.m(1), afp.cm(30)]) == [0.3, 1] and (afp.cm(30) < np.array([0.1, 1.0])).tolist() == [False, True]
    with pytest.raises(TypeError, match="in m and one in rad cannot be compared"):
        afp.cm(30) < angle
    for wrong in (lambda: afp.cm(30) - angle, lambda: angle + afp.s(1), lambda: sum([afp.cm(1), angle])):
        with pytest.raises(TypeError, match="cannot be added or subtracted"):
            wrong()
    with pytest.raises(TypeError):
        "a" * angle  # type: ignore[operator]


@pytest.mark.parametrize(
    ("entry", "value", "said"),
    [
        ("n", 0.5, "'n' is an int, not 0.5"),
        ("n", 1.0, "'n' is an int, not 1.0"),
        ("n", "x" * 500, "'n' is an int, not \"" + "x" * 79 + "..."),
        ("n", True, "'n' is an int, not a bool"),
        ("b", 2, "'b' is a bool, not 2"),
        ("b", np.float32(0.5), "'b' is a bool, not 0.5"),
        ("t", 3, "'t' is a string, not 3"),
    ],
)
def test_an_error_shows_the_number_as_written(entry: str, value: object, said: str) -> None:
    entries = 'in n: int = 1 in b: bool = true in t: string = "a"'
    plan = afp.Plan(f"use std\nplan P {{ {entries} start w actor w: Wait(duration = 1 s) {{ Elapsed -> terminate }} }}")
    with pytest.raises(TypeError, match=f"^{re.escape(said)}$"):
        afp.Simulation(plan, set={entry: value})


@pytest.mark.parametrize(
    ("hint", "value", "kind", "said"),
    [
        (int, 2**63, OverflowError, "an integer of more than 64 bits"),
        (float, 10**400, OverflowError, "an integer that is too large for a float"),
        (str, "\ud800", ValueError, "a string with half of a surrogate pair"),
        (str, "a" * 65, ValueError, "a string has at most 64 bytes of UTF-8, not 65"),
        (int, 1.5, TypeError, "expected an int, not a float"),
        (float, "1", TypeError, "expected a float, not a str"),
    ],
)
def test_an_invalid_output_is_explained(hint: Any, value: Any, kind: type[Exception], said: str) -> None:
    tools = afp.Toolbox("tools")

    @tools.computation(states={"Done": {"y": hint}})
    def Gives() -> Any:
        return "Done", {"y": value}

    type_ = {int: "int", float: "float", str: "string"}[hint]
    text = f"use tools plan P {{ var y: {type_} start c computation c: Gives(y => y) {{ Done -> terminate }} }}"
    [error] = afp.Simulation(afp.Plan(text, toolboxes=[tools])).run().errors
    assert type(error.error) is kind and str(error.error) == f"the output 'y' of 'Gives': {said}"


def test_a_string_that_does_not_fit_is_explained() -> None:
    plan = afp.Plan('use std\nplan P { in t: string = "a" start w actor w: Wait(duration = 1 s) { Elapsed -> terminate } }')
    for value, said in (("a" * 65, "'t': a string has at most 64 bytes"), ("\ud800", "half of a surrogate pair")):
        with pytest.raises(ValueError, match=said):
            afp.Simulation(plan, set={"t": value})


def test_a_missing_state_is_explained() -> None:
    tools = afp.Toolbox("tools")

    @tools.computation(states=["S"])
    def Computes() -> Any:
        return [1] * 1_000_000

    @tools.actor(states=["S"])
    async def Awaits() -> str:
        return "Nope"

    @tools.actor(states=["S"])
    class Polls:
        def poll(self) -> str:
            return "Nope"

    said = {"Computes": "return one of S, or a pair", "Awaits": "return one of S, or a pair", "Polls": "return None, one of S, or a pair"}
    for template, wanted in said.items():
        kind = "computation" if template == "Computes" else "actor"
        text = f"use tools plan P {{ start it {kind} it: {template} {{ S -> terminate }} }}"
        [error] = afp.Simulation(afp.Plan(text, toolboxes=[tools])).run().errors
        assert wanted in str(error.error) and len(str(error.error)) < 200


def test_a_missing_input_names_the_argument() -> None:
    plan = afp.Plan("use std\nplan P { in n: int start w actor w: Wait(duration = 1 s) { Elapsed -> terminate } }")
    with pytest.raises(afp.AfpError, match=re.escape('give it one, set={"n": ...}')):
        afp.Simulation(plan).run()
    assert afp.Simulation(plan, set={"n": 1}).run().ending == "ok"


def test_a_default_keeps_its_line_breaks() -> None:
    tools = afp.Toolbox("tools")

    @tools.computation(states=["Done"])
    def Tells(x: str = 'a\n\t"\\b') -> str:
        said.append(x)
        return "Done"

    said: list[str] = []
    text = "use tools plan P { start c computation c: Tells { Done -> terminate } }"
    assert afp.Simulation(afp.Plan(text, toolboxes=[tools])).run().ok and said == ['a\n\t"\\b']


def test_numpy_and_statistics_take_quantities() -> None:
    length, angle = afp.cm(30), afp.deg(30)
    plain = [np.sin(angle), np.clip(length, 0.0, 0.1), np.hypot(length, 0.4), np.maximum(length, 0.1), np.sqrt(length)]
    assert plain == pytest.approx([0.5, 0.1, 0.5, 0.3, math.sqrt(0.3)]) and bool(np.isfinite(length))
    assert isinstance(np.abs(-length), afp.Quantity) and np.linspace(length, afp.m(1), 2).tolist() == [0.3, 1.0]
    array = np.array([1.0, 2.0])
    array += length
    assert array.tolist() == [1.3, 2.3] and np.sum([length, length]) == 0.6
    assert statistics.mean([afp.cm(3), afp.cm(4)]) == 0.035 and statistics.stdev([length, length]) == 0.0
    assert statistics.median([afp.cm(3), afp.cm(5)]) == afp.cm(4)
    for wrong in (lambda: np.maximum(length, angle), lambda: np.hypot(length, angle), lambda: np.arctan2(length, angle)):
        with pytest.raises(TypeError, match="takes quantities of one unit, not one in m and one in rad"):
            wrong()
    with pytest.raises(TypeError, match="cannot be added or subtracted"):
        np.add(length, angle)


def test_an_output_has_one_type() -> None:
    tools = afp.Toolbox("tools")
    declared = tools.computation(states={"A": {"y": afp.Length}, "B": {"y": afp.Angle}})
    with pytest.raises(TypeError, match="the output 'y' of 'Both' is length with 'A' and angle with 'B'"):

        @declared
        def Both() -> str:
            return "A"


def test_an_array_of_one_number_is_a_number() -> None:
    plan = afp.Plan("use std\nplan P { in f: float = 1.0 in n: int = 1 start w actor w: Wait(duration = 1 s) { Elapsed -> terminate } }")
    entries = afp.Simulation(plan, set={"f": np.array(4.5), "n": np.array(3)}).entries
    assert entries == {"f": 4.5, "n": 3}
    with pytest.raises(TypeError, match="'f' is a float, not a ndarray"):
        afp.Simulation(plan, set={"f": np.array([1.0, 2.0])})


@pytest.mark.parametrize(
    ("hint", "default", "said"),
    [
        (float, float("nan"), "is float, its default nan; give a finite number"),
        (float, "fast", "is float, its default 'fast': there is no entry 'fast'"),
        (float, None, "is float, its default None"),
        (int, 1.5, "is int, its default 1.5"),
        (bool, 1, "is bool, its default 1"),
        (str, 3, "is string, its default 3"),
        (afp.Length, "30", "is length in m, its default '30': expected a length, found a bare number"),
        (afp.Length, True, "is length in m, its default True"),
    ],
)
def test_a_default_has_the_type_of_its_port(hint: Any, default: Any, said: str) -> None:
    """Previously each was accepted, or was reported at a place of generated text."""
    tools = afp.Toolbox("tools")

    def Far(x: Any = default) -> str:
        return "Done"

    Far.__annotations__["x"] = hint
    with pytest.raises((TypeError, ValueError), match="the parameter 'x' of 'Far' " + re.escape(said)):
        tools.computation(states=["Done"])(Far)


def test_an_invalid_declaration_is_reported_without_the_rest_of_the_toolbox() -> None:
    tools = afp.Toolbox("tools")

    @tools.computation(states=["Done"])
    def Rounds(x: int = 2) -> str:
        return "Done"

    def Near(robot: afp.Robot) -> None:
        return None

    with pytest.raises(afp.AfpError) as raised:
        tools.supervisor(events=["E"], every="10 parsecs")(Near)
    assert str(raised.value).startswith("the supervisor 'Near' has an invalid declaration:\nerror[E0236]: 'parsecs' is not a unit\n")
    assert "its declaration:3:14" in str(raised.value) and "Rounds" not in str(raised.value)
    with pytest.raises(ValueError, match="'E' appears twice in"):
        tools.supervisor(events=["E", "E"])
    with pytest.raises(ValueError, match="'near by' is not the name of a template"):
        tools.supervisor(events=["E"], name="near by")(Near)

    def Half(x: float, /) -> str:
        return "Done"

    with pytest.raises(TypeError, match="'Half' takes 'x' only by position"):
        tools.computation(states=["Done"])(Half)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"seeds": 1.5}, "seeds is 1.5; give their number"),
        ({"seeds": "2"}, "seeds is '2'; give their number"),
        ({"seeds": [1.5]}, "a seed is a whole number, not 1.5"),
        ({"worlds": 3}, "worlds are files, strings such as 'random:7', or Worlds"),
        ({"worlds": [3]}, "a world must be a file, a string such as 'random:7', or a World, not 3"),
        ({"metrics": [len]}, "metrics gives functions names"),
        ({"on_run": 3}, "on_run is a function that gets the row of a run, not 3"),
    ],
)
def test_a_sweep_names_an_invalid_argument(given: dict[str, Any], said: str) -> None:
    with pytest.raises(TypeError, match=re.escape(said)):
        afp.sweep(afp.load(ROOT / "plans/wall_following.afp"), **given)


def test_a_start_outside_of_the_room_is_reported(wall_following: afp.Plan) -> None:
    with pytest.warns(UserWarning, match=r"start is \(-3, 1\): the robot starts outside of its world"):
        afp.Simulation(wall_following, start=(-3.0, 1.0))


def test_a_decorator_needs_no_parentheses() -> None:
    tools = afp.Toolbox("tools")

    @tools.computation
    def Parity(value: int) -> Literal["Odd", "Even"]:
        return "Odd" if value % 2 else "Even"

    @tools.supervisor
    def Near(robot: afp.Robot) -> Literal["Close"] | None:
        return None

    @tools.actor
    async def Creep(robot: afp.Robot) -> Literal["There"]:
        return "There"

    assert Parity(3) == "Odd" and tools.templates == ["Parity", "Near", "Creep"]
