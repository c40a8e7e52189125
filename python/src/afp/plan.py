"""Plans: loading, checking, drawing, changing."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from . import _afp, checks
from ._afp import Toolbox, read_text
from .checks import toolboxes_of
from .picture import Picture
from .structure import Edge, Element, Entry
from .units import spelled, spelled_time

__all__ = ["Plan", "load", "new_plan"]


class Plan(_afp.Plan):
    """A plan: its text, diagnostics, drawings and changes.

    Items are named as in the text: `go`, `go.touch` for a supervisor of an element, `Plan.go` for
    an item of a plan other than the file's first. A change makes the smallest edits of the text and
    keeps comments. `AfpError` rejects a change that would also alter other parts.

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

    # It is mutable.
    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        place = self.path or "<text>"
        count = len(self.diagnostics)
        return f"<Plan {place}, {count} diagnostic{'' if count == 1 else 's'}>"

    def _repr_html_(self) -> str:
        lines = [f"<pre>{html.escape(self.report().rstrip())}</pre>"] if self.diagnostics else []
        return "\n".join([self.svg(), *lines])

    @property
    def elements(self) -> list[Element]:
        """The elements of the plan that runs, in the order of the text.

        Raises:
            PlanError: the plan has errors.
        """
        return [Element._of(given) for given in self._graph()["actors"]]

    @property
    def entries(self) -> list[Entry]:
        """The entries of the plan that runs, in the order of the text.

        Raises:
            PlanError: the plan has errors.
        """
        known = ("name", "kind", "type", "init", "doc")
        return [Entry(*(given.get(name, "") for name in known)) for given in self._graph().get("entries", [])]

    @property
    def edges(self) -> list[Edge]:
        """The edges of the plan that runs, from a state or event to an element or an end.

        Raises:
            PlanError: the plan has errors.
        """
        graph = self._graph()
        begin = Edge("", "start", graph["first"])
        outer = [Edge(it["name"], event, to) for it in graph.get("global_supervisors", []) for event, to in it["events"].items()]
        return [begin, *(edge for element in self.elements for edge in element.edges), *outer]

    def _graph(self) -> dict[str, Any]:
        self.check()
        graph: dict[str, Any] = json.loads(self.json())
        return graph

    def save_svg(self, path: str | os.PathLike[str], *, theme: str = "auto", fold: bool = False) -> None:
        """Write the drawing to an SVG file."""
        Picture(self.svg(theme=theme, fold=fold)).save(path)

    def coverage(self, log: str | os.PathLike[str]) -> Picture:
        """The drawing with the coverage of a logged run, as drawn by `afpc log --coverage`."""
        return Picture(self._coverage(log))

    def use(self, toolbox: str, alias: str | None = None) -> None:
        """Add `use toolbox as alias`; for another plan file give its path in quotes:
        `use('"parts/explore.afp"')`.
        """
        self._change("use", {"toolbox": toolbox, "alias": alias})

    def add_plan(self, text: str) -> None:
        """Add plans and computations, given as text."""
        self._change("add_plan", {"text": text})

    def add(self, text: str, *, plan: str | None = None, owner: str | None = None, before: str | None = None) -> None:
        """Add entries, elements or supervisors, given as text; `owner` names the element of
        supervisors.
        """
        self._change("add", {"text": text, "plan": plan, "owner": owner, "before": before})

    def remove(self, item: str) -> None:
        """Remove an item with its comments and the edges to it."""
        self._change("remove", {"item": item})

    def rename(self, item: str, to: str) -> None:
        """Rename an item in all files."""
        self._change("rename", {"item": item, "to": to})

    def connect(self, item: str, outcome: str, to: str) -> None:
        """Connect a state or event to an element, `terminate` or `ignore`."""
        self._change("connect", {"item": item, "outcome": outcome, "to": to})

    def disconnect(self, item: str, outcome: str) -> None:
        """Remove the edge of a state or event."""
        self._change("disconnect", {"item": item, "outcome": outcome})

    def set_start(self, to: str, *, plan: str | None = None) -> None:
        """Set the first element of a plan."""
        self._change("start", {"to": to, "plan": plan})

    def reorder(self, item: str, before: str | None = None) -> None:
        """Move an item before another one of its list, or after the last of its kind."""
        self._change("reorder", {"item": item, "before": before})

    def bind(self, item: str, port: str, formula: str | float) -> None:
        """Bind an input port to a formula such as `"2 * far"`, or to a value such as `afp.cm(30)`.

        `diagnostics` reports an invalid formula; an invalid value raises.
        """
        parts = {"item": item, "port": port, "formula": spelled(formula)}
        self._change("bind", parts, not isinstance(formula, str))

    def bind_output(self, item: str, port: str, entry: str) -> None:
        """Bind an output port to an entry."""
        self._change("bind", {"item": item, "port": port, "entry": entry})

    def unbind(self, item: str, port: str) -> None:
        """Remove the binding of a port."""
        self._change("unbind", {"item": item, "port": port})

    def set_template(self, item: str, template: str) -> None:
        """Change the template of an element or supervisor."""
        self._change("template", {"item": item, "template": template})

    def set_every(self, supervisor: str, value: str | float | None) -> None:
        """Set the poll period of a supervisor, such as `"10 ms"` or `afp.ms(10)`; `None` restores
        the template's.
        """
        self._set_timing(supervisor, "every", value)

    def set_deadline(self, supervisor: str, value: str | float | None) -> None:
        """Set the deadline of a supervisor, such as `"20 ms"` or `afp.ms(20)`; `None` restores the
        template's.
        """
        self._set_timing(supervisor, "deadline", value)

    def _set_timing(self, supervisor: str, keyword: str, value: str | float | None) -> None:
        text = None if value is None else spelled_time(value)
        self._change("timing", {"item": supervisor, "keyword": keyword, "value": text})

    def set_entry_kind(self, entry: str, keyword: str) -> None:
        """Make an entry an `in`, `out`, `var` or `const`."""
        self._change("entry_kind", {"item": entry, "keyword": keyword})

    def set_entry_type(self, entry: str, type: str | None) -> None:
        """Set or remove the type of an entry."""
        self._change("entry_type", {"item": entry, "type": type})

    def set_entry_value(self, entry: str, value: str | float | None) -> None:
        """Set or remove the initial value of an entry: a formula, or a valid value such as
        `afp.cm(30)`.
        """
        parts = {"item": entry, "value": None if value is None else spelled(value)}
        self._change("entry_value", parts, not isinstance(value, (str, type(None))))

    def set_condition(self, computation: str, state: str, condition: str | None) -> None:
        """Set the condition of a state of a declared computation, such as `"error > 2 cm"`; `None`
        removes it.
        """
        self._change("condition", {"computation": computation, "state": state, "condition": condition})

    def assign(self, computation: str, state: str, output: str, formula: str | float | None) -> None:
        """Set the formula that a state of a declared computation assigns to an output: a formula or a
        value such as `afp.deg(10)`; `None` removes the assignment.
        """
        parts = {"computation": computation, "state": state, "output": output}
        written = None if formula is None else spelled(formula)
        self._change("assign", {**parts, "formula": written}, not isinstance(formula, (str, type(None))))

    def set_doc(self, item: str, text: str) -> None:
        """Set the help text of an item; an empty one removes it."""
        self._change("doc", {"item": item, "text": text})

    def move(self, item: str, to_plan: str, owner: str | None = None) -> None:
        """Move an entry, element or supervisor to another plan, or a supervisor to another element."""
        self._change("move", {"item": item, "to_plan": to_plan, "owner": owner})

    def extract(self, elements: Sequence[str], new_plan: str, element: str, *, plan: str | None = None) -> None:
        """Move elements into a new plan, with a sub-plan in their place."""
        parts = {"elements": list(elements), "new_plan": new_plan, "element": element, "plan": plan}
        self._change("extract", parts)

    def inline(self, element: str, *, plan: str | None = None) -> None:
        """Replace a sub-plan by its elements."""
        self._change("inline", {"element": element, "plan": plan})


def _again(
    kind: type[Plan],
    text: str,
    path: str | os.PathLike[str] | None,
    name: str | None,
    toolboxes: Sequence[Toolbox],
    others: dict[str, str],
) -> Plan:
    """Restore a plan from a pickle or a copy."""
    plan = kind(text, path, name=name, toolboxes=toolboxes)
    plan._set_others(others)
    return plan


def _scenario(state: tuple[Any, ...], index: int) -> _afp.Scenario:
    """Restore a scenario from a pickle: its plan, and its index there."""
    return _again(Plan, *state).scenarios[index]


def load(path: str | os.PathLike[str], *, plan: str | None = None, toolboxes: Sequence[Toolbox] = ()) -> Plan:
    """Read a plan file. It may have errors: `diagnostics` lists them, and `check()` raises them.

    `plan` names the plan that runs; the default is the first one. Toolboxes of an `afp.toml` are
    found like in `afpc`; `toolboxes` are written in Python.
    """
    text = read_text("cannot read the plan", path)
    return Plan(text, Path(path), name=plan, toolboxes=toolboxes)


def new_plan(name: str, *, use: str | Sequence[str] = ("std", "carbot"), toolboxes: Sequence[Toolbox] = ()) -> Plan:
    """An empty plan, to fill with `add`, `connect` and other methods.

    >>> plan = new_plan("Patrol", use=["carbot"])
    >>> plan.add("actor go: Forward(distance = 1 m) { ForwardSuccessful -> terminate }")
    >>> plan.set_start("go")
    >>> plan.ok
    True
    """
    heads = "".join(f"use {toolbox}\n" for toolbox in ([use] if isinstance(use, str) else use))
    gap = "\n" if heads else ""
    return Plan(f"{heads}{gap}plan {name} {{\n}}\n", toolboxes=toolboxes)
