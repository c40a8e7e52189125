"""Declarations of Python components as text, from signatures and type hints."""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, get_args, get_origin, get_type_hints

from . import _afp
from .units import UNITS, Quantity, plain

__all__ = ["GIVEN", "Outcomes", "annotated_outcomes", "declaration", "method_of", "named", "outcomes_of", "parameters_of", "start_of", "text_of"]

Outcomes = Sequence[str] | Mapping[str, Mapping[str, Any]]

# The names that a component may request in addition to its ports.
GIVEN = ("robot", "wanted")

_TYPES = {bool: "bool", int: "int", float: "float", str: "string"}


def declaration(
    kind: str,
    name: str,
    component: Callable[..., Any],
    outcomes: Outcomes,
    uses: Sequence[str],
    timing: str,
    icon: str | None,
    resumable: bool,
) -> str:
    """The text of a template."""
    if isinstance(component, type):
        start = start_of(component)
        ports = _ports(start, False) if start else []
        ports += _ports(method_of(component, "poll"), True)
    else:
        ports = _ports(component, kind == "supervisor")
    by_state: Mapping[str, Mapping[str, Any]]
    by_state = outcomes if isinstance(outcomes, Mapping) else {outcome: {} for outcome in outcomes}
    carried: dict[str, tuple[str, list[str]]] = {}
    for state, outputs in by_state.items():
        for port, hint in outputs.items():
            type_ = _type(hint, f"the output '{port}' of '{name}'")
            known, states = carried.setdefault(port, (type_, []))
            if known != type_:
                what = f"the output '{port}' of '{name}' is {known} with '{states[0]}' and {type_} with '{state}'"
                raise TypeError(f"{what}; an output has one type: give one of them another name")
            states.append(state)
    lines = [f"icon {text_of(icon)}"] if icon else []
    lines += [f"uses {device}" for device in uses]
    lines += ports
    lines += [f"out {port}: {type_} on {' | '.join(states)}" for port, (type_, states) in carried.items()]
    lines += [timing] if timing else []
    word = "event" if kind == "supervisor" else "state"
    lines += [f"{word} {state}" for state in by_state]
    doc = "".join(f"/// {line.strip()}\n" for line in (inspect.getdoc(component) or "").splitlines() if line.strip())
    body = "".join(f"    {line}\n" for line in lines)
    return f"{doc}{kind} {name}{' resumable' if resumable else ''} {{\n{body}}}\n"


def outcomes_of(given: Any) -> Outcomes:
    """A list of the given states or events."""
    if isinstance(given, str):
        raise TypeError(f"'{given}' is one name; states and events are a list: [{given!r}]")
    if not isinstance(given, Iterable):
        raise TypeError(f"states and events are a list of names, not {given!r}")
    names = list(given)
    for name in names:
        if not isinstance(name, str):
            raise TypeError(f"the name of a state or event must be a string, not {name!r}")
        if names.count(name) > 1:
            raise ValueError(f"'{name}' appears twice in {names}")
    if not isinstance(given, Mapping):
        return [str.__str__(name) for name in names]
    for name, outputs in given.items():
        if not isinstance(outputs, Mapping) or not all(isinstance(port, str) for port in outputs):
            raise TypeError(f"the outputs of '{name}' are ports with their types, such as {{'x': float}}, not {outputs!r}")
    return {str.__str__(name): outputs for name, outputs in given.items()}


def annotated_outcomes(kind: str, component: Callable[..., Any]) -> Outcomes:
    """The states or events of a return annotation with `Literal`."""
    function = method_of(component, "poll") if isinstance(component, type) else component
    names = list(_literals(_hints(function).get("return")))
    if not names:
        word = "events" if kind == "supervisor" else "states"
        what = f"the {kind} '{named(component)}' needs {word}=[...]"
        raise TypeError(f'{what}, or a return annotation such as -> Literal["There", "Blocked"]')
    return outcomes_of(dict.fromkeys(names, {}))


def _literals(hint: Any) -> Iterable[str]:
    """The strings of a Literal, also inside of a union."""
    for part in get_args(hint):
        if isinstance(part, str):
            yield part
        elif get_origin(part) is not None:
            yield from _literals(part)


def start_of(component: type) -> Callable[..., Any] | None:
    """The constructor, if the class itself defines it."""
    start: Callable[..., Any] = getattr(component, "__init__")
    return None if start is object.__init__ else start


def method_of(component: type, name: str) -> Callable[..., Any]:
    """A method that a class must have."""
    method = getattr(component, name, None)
    if not callable(method):
        raise TypeError(f"'{named(component)}' has no method '{name}'")
    return method  # type: ignore[no-any-return]


def named(component: Any) -> str:
    """The name of a component without its enclosing function."""
    return re.sub(r".*<locals>\.", "", getattr(component, "__qualname__", None) or repr(component))


def _type(hint: Any, where: str) -> str:
    """The language's type for a hint."""
    for extra in getattr(hint, "__metadata__", ()):
        if isinstance(extra, str):
            return extra
    if hint in _TYPES:
        return _TYPES[hint]
    if isinstance(hint, str):
        return hint
    known = "bool, int, float, str, afp.Length, afp.Angle, afp.Duration, afp.Speed, afp.AngularSpeed"
    if hint is not None:
        raise TypeError(f"{where} has the hint {_shown(hint)}, which matches no type of the language; there are: {known}")
    raise TypeError(f"{where} needs a type hint: one of {known}, or, for example, Annotated[float, 'force']")


def _shown(hint: Any) -> str:
    return hint.__name__ if isinstance(hint, type) else str(hint).replace("typing.", "")


def _constant(value: Any, type: str, where: str) -> str:
    """A default value as a literal of a toolbox file."""
    value = plain(value)
    unit = UNITS.get(type, "")
    what = f"{where} is {type}{f' in {unit}' if unit else ''}, its default"
    if isinstance(value, Quantity) and value.unit != unit:
        raise TypeError(f"{what} a quantity in {value.unit}")
    if type == "bool" and isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return text_of(value) if type == "string" else _literal(value, type, what)
    if type in {"bool", "string"} or isinstance(value, bool) or not hasattr(value, "__float__"):
        raise TypeError(f"{what} {value!r}")
    if not math.isfinite(value):
        raise ValueError(f"{what} {value!r}; give a finite number")
    if type == "int" and value != int(value):
        raise TypeError(f"{what} {value!r}")
    return repr(int(value)) if type == "int" else f"{float(value)!r} {unit}".rstrip()


def _literal(text: str, type: str, what: str) -> str:
    """A string as a literal of a type, `30 cm`; raises if the type does not match."""
    if type in _TYPES.values() or type in UNITS:
        try:
            _afp.Toolbox.__new__(_afp.Toolbox, f"toolbox t\ncomputation C {{\nin x: {type} = {text}\nstate S\n}}\n")
        except _afp.AfpError as why:
            message = str(why).splitlines()[0].partition(": ")[2]
            raise ValueError(f"{what} {text!r}: {message}") from None
    return text


def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    """The hints of a function, also if they are strings."""
    try:
        return get_type_hints(function, include_extras=True)
    except NameError as error:
        what = f"a hint of '{named(function)}' names '{error.name}', which is undefined while the program runs"
        raise TypeError(f"{what}: import it outside of 'if TYPE_CHECKING'") from None


def parameters_of(function: Callable[..., Any]) -> Mapping[str, inspect.Parameter]:
    """The parameters of a function; all must be usable by name."""
    parameters = inspect.signature(function).parameters
    for name, parameter in parameters.items():
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
            raise TypeError(f"'{named(function)}' takes *{name}; its parameters are ports and need names")
        if parameter.kind == parameter.POSITIONAL_ONLY and name != "self":
            raise TypeError(f"'{named(function)}' takes '{name}' only by position; ports are passed by name: leave out the '/'")
    return parameters


def _ports(function: Callable[..., Any], live: bool) -> list[str]:
    hints = _hints(function)
    lines = []
    for name, parameter in parameters_of(function).items():
        if name in GIVEN or name == "self":
            continue
        where = f"the parameter '{name}' of '{named(function)}'"
        type = _type(hints.get(name), where)
        default = parameter.default
        end = "" if default is parameter.empty else f" = {_constant(default, type, where)}"
        lines.append(f"in {'live ' if live else ''}{name}: {type}{end}")
    return lines


def text_of(value: str) -> str:
    """A string as a quoted literal."""
    return '"' + value.translate(_ESCAPES) + '"'


_ESCAPES = str.maketrans({"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t"})
