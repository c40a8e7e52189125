"""Plans: loading, checking, drawing, changing."""

from __future__ import annotations

import html
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from . import _afp, checks
from ._afp import Toolbox, read_text
from .checks import toolboxes_of
from .picture import Picture
from .units import spelled, spelled_time

__all__ = ["Plan", "load", "new_plan"]


class Plan(_afp.Plan):
    """A plan: its text, what the compiler says of it, its drawings, and changes of it.

    Items are named as in the text: `go`, `go.touch` for a supervisor of an element, `Plan.go` for something of
    another plan than the first one of the file. A change comes to the smallest edits of the text; comments stay. A
    change that would alter more than it says is refused with `AfpError`.

    >>> text = "actor go: Forward(distance = 1 m) { ForwardSuccessful -> terminate }"
    >>> plan = Plan(f"use carbot\\nplan P {{ start go {text} }}")
    >>> plan.ok
    True
    >>> plan.rename("go", "ahead")
    >>> "start ahead" in plan.text
    True
    """

    def __new__(
        cls,
        text: str,
        path: str | os.PathLike[str] | None = None,
        *,
        name: str | None = None,
        toolboxes: Sequence[Toolbox] = (),
    ) -> Plan:
        return super().__new__(cls, checks.text("a plan", text), path, name=name, toolboxes=toolboxes_of(toolboxes))

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), *self._state())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Plan) and self._state() == other._state()

    # It can be changed.
    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        place = self.path or "<text>"
        count = len(self.diagnostics)
        return f"<Plan {place}, {count} diagnostic{'' if count == 1 else 's'}>"

    def _repr_html_(self) -> str:
        lines = [f"<pre>{html.escape(self.report().rstrip())}</pre>"] if self.diagnostics else []
        return "\n".join([self.svg(), *lines])

    def save_svg(self, path: str | os.PathLike[str], *, theme: str = "auto", fold: bool = False) -> None:
        """Writes the drawing to an SVG file."""
        Picture(self.svg(theme=theme, fold=fold)).save(path)

    def coverage(self, log: str | os.PathLike[str]) -> Picture:
        """The drawing with what the run of a log made use of, as `afpc log --coverage` draws it."""
        return Picture(self._coverage(log))

    def use(self, toolbox: str, alias: str | None = None) -> None:
        """Adds `use toolbox as alias`; of another plan file with its path in quotes: `use('"parts/explore.afp"')`."""
        self._change("use", {"toolbox": toolbox, "alias": alias})

    def add_plan(self, text: str) -> None:
        """Adds plans, given as text, below the last one."""
        self._change("add_plan", {"text": text})

    def add(self, text: str, *, plan: str | None = None, owner: str | None = None, before: str | None = None) -> None:
        """Adds entries, elements or supervisors, given as text; supervisors of an element with `owner`."""
        self._change("add", {"text": text, "plan": plan, "owner": owner, "before": before})

    def remove(self, item: str) -> None:
        """Removes an item with its comments and the edges to it."""
        self._change("remove", {"item": item})

    def rename(self, item: str, to: str) -> None:
        """Gives an item another name wherever the files refer to it."""
        self._change("rename", {"item": item, "to": to})

    def connect(self, item: str, outcome: str, to: str) -> None:
        """Leads a state or event to an element, `terminate` or `ignore`."""
        self._change("connect", {"item": item, "outcome": outcome, "to": to})

    def disconnect(self, item: str, outcome: str) -> None:
        """Removes the edge of a state or event."""
        self._change("disconnect", {"item": item, "outcome": outcome})

    def set_start(self, to: str, *, plan: str | None = None) -> None:
        """Lets the plan start with an element."""
        self._change("start", {"to": to, "plan": plan})

    def reorder(self, item: str, before: str | None = None) -> None:
        """Moves an item above another one of its list, or below its like."""
        self._change("reorder", {"item": item, "before": before})

    def bind(self, item: str, port: str, formula: str | float) -> None:
        """Binds an input port to a formula such as `"2 * far"`, or a value such as `afp.cm(30)`.

        A formula may be wrong, which `diagnostics` tells; a value that does not fit the port is refused.
        """
        parts = {"item": item, "port": port, "formula": spelled(formula)}
        self._change("bind", parts, not isinstance(formula, str))

    def bind_output(self, item: str, port: str, entry: str) -> None:
        """Binds an output port to an entry."""
        self._change("bind", {"item": item, "port": port, "entry": entry})

    def unbind(self, item: str, port: str) -> None:
        """Removes the binding of a port."""
        self._change("unbind", {"item": item, "port": port})

    def set_template(self, item: str, template: str) -> None:
        """Makes an element or supervisor from another template."""
        self._change("template", {"item": item, "template": template})

    def set_every(self, supervisor: str, value: str | float | None) -> None:
        """Sets the poll period of a supervisor, such as `"10 ms"` or `afp.ms(10)`; the template's with `None`."""
        self._set_timing(supervisor, "every", value)

    def set_deadline(self, supervisor: str, value: str | float | None) -> None:
        """Sets the deadline of a supervisor, such as `"20 ms"` or `afp.ms(20)`; the template's with `None`."""
        self._set_timing(supervisor, "deadline", value)

    def _set_timing(self, supervisor: str, keyword: str, value: str | float | None) -> None:
        text = None if value is None else spelled_time(value)
        self._change("timing", {"item": supervisor, "keyword": keyword, "value": text})

    def set_entry_kind(self, entry: str, keyword: str) -> None:
        """Makes an entry an `in`, `out`, `var` or `const`."""
        self._change("entry_kind", {"item": entry, "keyword": keyword})

    def set_entry_type(self, entry: str, type: str | None) -> None:
        """Sets or removes the type of an entry."""
        self._change("entry_type", {"item": entry, "type": type})

    def set_entry_value(self, entry: str, value: str | float | None) -> None:
        """Sets or removes the initial value of an entry, a formula or a value such as `afp.cm(30)`, which must fit."""
        parts = {"item": entry, "value": None if value is None else spelled(value)}
        self._change("entry_value", parts, not isinstance(value, (str, type(None))))

    def set_doc(self, item: str, text: str) -> None:
        """Sets the help text above an item; an empty one removes it."""
        self._change("doc", {"item": item, "text": text})

    def move(self, item: str, to_plan: str, owner: str | None = None) -> None:
        """Moves an entry, element or supervisor to another plan, or a supervisor to another element."""
        self._change("move", {"item": item, "to_plan": to_plan, "owner": owner})

    def extract(self, elements: Sequence[str], new_plan: str, element: str, *, plan: str | None = None) -> None:
        """Makes a plan of some elements and puts a sub-plan in their place."""
        parts = {"elements": list(elements), "new_plan": new_plan, "element": element, "plan": plan}
        self._change("extract", parts)

    def inline(self, element: str, *, plan: str | None = None) -> None:
        """Puts the elements of a sub-plan in its place."""
        self._change("inline", {"element": element, "plan": plan})


def _again(
    kind: type[Plan],
    text: str,
    path: str | os.PathLike[str] | None,
    name: str | None,
    toolboxes: Sequence[Toolbox],
    others: dict[str, str],
) -> Plan:
    """A plan as it was pickled or copied."""
    plan = kind(text, path, name=name, toolboxes=toolboxes)
    plan._set_others(others)
    return plan


def _scenario(state: tuple[Any, ...], index: int) -> _afp.Scenario:
    """A scenario as it was pickled: of a plan, by its place there."""
    return _again(Plan, *state).scenarios[index]


def load(path: str | os.PathLike[str], *, plan: str | None = None, toolboxes: Sequence[Toolbox] = ()) -> Plan:
    """Reads a plan file. It may have errors: `diagnostics` has them, `check()` raises them.

    `plan` names the plan that runs, where it is not the first one. Toolboxes of an `afp.toml` are found as `afpc`
    finds them; `toolboxes` are those written in Python.
    """
    text = read_text("cannot read the plan", path)
    return Plan(text, Path(path), name=plan, toolboxes=toolboxes)


def new_plan(name: str, *, use: str | Sequence[str] = ("std", "carbot"), toolboxes: Sequence[Toolbox] = ()) -> Plan:
    """An empty plan, to be filled with `add`, `connect` and the like.

    >>> plan = new_plan("Patrol", use=["carbot"])
    >>> plan.add("actor go: Forward(distance = 1 m) { ForwardSuccessful -> terminate }")
    >>> plan.set_start("go")
    >>> plan.ok
    True
    """
    heads = "".join(f"use {toolbox}\n" for toolbox in ([use] if isinstance(use, str) else use))
    gap = "\n" if heads else ""
    return Plan(f"{heads}{gap}plan {name} {{\n}}\n", toolboxes=toolboxes)
