"""The structure of a checked plan as values: elements, entries and edges."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["Edge", "Element", "Entry"]


@dataclass(frozen=True)
class Edge:
    """An edge from a state or event to its target."""

    source: str
    """The element or supervisor, by its path; empty for the plan's start."""
    outcome: str
    """The state or event; `start` for the plan's start."""
    target: str
    """The next element, or a word such as `terminate`."""


@dataclass(frozen=True)
class Entry:
    """An entry of a plan."""

    name: str
    """Its name."""
    kind: str
    """`in`, `out` or `var`."""
    type: str
    """Its type."""
    initial: str
    """The formula of its first value; empty if it has none."""
    doc: str
    """Its comment."""


@dataclass(frozen=True)
class Element:
    """An actor, computation or sub-plan of a plan."""

    name: str
    """Its name."""
    kind: str
    """`actor`, `computation` or the kind of sub-plan."""
    template: str
    """The template or plan that it runs."""
    inputs: Mapping[str, str]
    """The formulas of its inputs, by port."""
    edges: tuple[Edge, ...]
    """The edges of its states and of its supervisors' events."""

    @classmethod
    def _of(cls, given: Mapping[str, Any]) -> Element:
        name = given["name"]
        edges = [Edge(name, state, to) for state, to in given.get("states", {}).items()]
        for supervisor in given.get("supervisors", []):
            path = f"{name}.{supervisor['name']}"
            edges += [Edge(path, event, to) for event, to in supervisor["events"].items()]
        inputs = given.get("ports", {}).get("in", {})
        return cls(name, given["kind"], given.get("template", ""), inputs, tuple(edges))
