"""Pictures of runs; they need matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._afp import Event
from .tables import need

# Distinct also for colour-blind readers; the same as in the pictures of `afpc run`.
PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#6a3d9a", "#56b4e9", "#7f7f7f")


def spans(events: Sequence[Event], end: float) -> list[tuple[str, float, float]]:
    """The activity of elements, without supervisors: component, begin, end."""
    left = {"finished", "interrupted", "faulted"}
    done: list[tuple[str, float, float]] = []
    begun: dict[str, float] = {}
    elements = {event.component for event in events if event.kind in {"finished", "interrupted", "diverted"}}
    watching = {event.component for event in events if event.kind in {"event", "already_there", "missed"}}
    started = [event.component for event in events if event.kind == "started"]
    last = next((name for name in reversed(started) if name not in watching), None)
    for event in events:
        if event.kind == "started" and (event.component in elements or event.component == last):
            begun[event.component] = event.time
        elif event.kind in left and event.component in begun:
            done.append((event.component, begun.pop(event.component), event.time))
    return done + [(component, begin, end) for component, begin in begun.items()]


def path(
    path: NDArray[np.float64],
    outlines: Sequence[NDArray[np.float64]],
    events: Sequence[Event],
    title: str,
    ax: Any = None,
) -> Any:
    """The robot's path in its world, with the events that were taken."""
    pyplot = need("matplotlib.pyplot")
    ax = ax if ax is not None else pyplot.subplots(figsize=(6, 5), layout="constrained")[1]
    for corners in outlines:
        closed = np.vstack([corners, corners[:1]])
        ax.fill(closed[:, 0], closed[:, 1], facecolor="#dddddd", edgecolor="#555555", linewidth=0.8)
    ax.plot(path[:, 1], path[:, 2], color=PALETTE[0], linewidth=1.5, label="path")
    if len(path):
        ax.plot(path[0, 1], path[0, 2], "o", color=PALETTE[2], label="start")
    taken = [event.time for event in events if event.kind == "event"]
    if taken and len(path):
        at = np.clip(np.searchsorted(path[:, 0], taken), 0, len(path) - 1)
        ax.plot(path[at, 1], path[at, 2], "x", color=PALETTE[1], label="event")
    ax.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title=title)
    ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return ax


def timeline(events: Sequence[Event], end: float, title: str, ax: Any = None) -> Any:
    """The activity over time, a row per element, with the events that were taken."""
    pyplot = need("matplotlib.pyplot")
    active = spans(events, end)
    rows = list(dict.fromkeys(component for component, _, _ in active))
    if ax is None:
        ax = pyplot.subplots(figsize=(8, 0.6 + 0.35 * max(len(rows), 2)), layout="constrained")[1]
    for component, begin, stop in active:
        row = rows.index(component)
        ax.barh(row, stop - begin, left=begin, height=0.6, color=PALETTE[row % len(PALETTE)])
    for event in events:
        if event.kind == "event":
            ax.axvline(event.time, color="#555555", linewidth=0.6, linestyle=":")
    ax.set(yticks=range(len(rows)), yticklabels=rows, xlabel="time [s]", title=title, xlim=(0, max(end, 1e-9)))
    ax.invert_yaxis()
    return ax


def label(column: str, units: Mapping[str, str]) -> str:
    """The name of a column with its unit in parentheses; `units` has those of entries."""
    name, _, end = column.rpartition("_")
    unit = units.get(name, "") if end == "si" else {"s": "s", "m": "m"}.get(end)
    if not name or unit is None:
        return column.replace("_", " ")
    return f"{name.replace('_', ' ')} [{unit}]" if unit else name.replace("_", " ")


def runs(x: Sequence[Any], y: Sequence[Any], endings: Sequence[str], labels: tuple[str, str, str], ax: Any = None) -> Any:
    """A measure of many runs, with a dot for each, coloured by its ending."""
    pyplot = need("matplotlib.pyplot")
    ax = ax if ax is not None else pyplot.subplots(figsize=(6, 4), layout="constrained")[1]
    for number, ending in enumerate(dict.fromkeys(endings)):
        dots = [(a, b) for a, b, e in zip(x, y, endings, strict=True) if e == ending and a is not None and b is not None]
        color = PALETTE[number % len(PALETTE)]
        ax.plot([a for a, _ in dots], [b for _, b in dots], "o", color=color, alpha=0.6, label=ending)
    ax.set(xlabel=labels[0], ylabel=labels[1], title=labels[2])
    ax.legend(frameon=False)
    return ax


def outcome_map(cells: Mapping[tuple[Any, Any], list[Any]], texts: bool, labels: tuple[str, str, str, str], ax: Any = None) -> Any:
    """Cells over two axes: the most frequent string of the cell's runs, or the mean of a measure."""
    pyplot = need("matplotlib.pyplot")
    ax = ax if ax is not None else pyplot.subplots(figsize=(6, 4.5), layout="constrained")[1]
    columns, rows = (list(_ordered({key[axis] for key in cells})) for axis in (0, 1))
    shown = _texts(ax, cells, columns, rows) if texts else _means(ax, cells, columns, rows, labels[2])
    for (column, row), words in shown.items():
        ax.text(column, row, words, ha="center", va="center", fontsize=8, color="white" if texts else "black")
    ax.set(xticks=range(len(columns)), yticks=range(len(rows)))
    ax.set_xticklabels([_tick(column) for column in columns])
    ax.set_yticklabels([_tick(row) for row in rows])
    ax.set(xlabel=labels[0], ylabel=labels[1], title=f"{labels[3]}: {labels[2]}")
    return ax


Shown = dict[tuple[int, int], str]


def _texts(ax: Any, cells: Mapping[tuple[Any, Any], list[Any]], columns: list[Any], rows: list[Any]) -> Shown:
    """Draw the most frequent strings; return the texts of the cells."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    names = list(dict.fromkeys(text for texts in cells.values() for text in texts))
    colors = [PALETTE[number % len(PALETTE)] for number in range(len(names))]
    picture = np.full((len(rows), len(columns)), np.nan)
    shown: Shown = {}
    for (x, y), texts in cells.items():
        most = max(names, key=texts.count)
        place = (columns.index(x), rows.index(y))
        picture[place[1], place[0]] = names.index(most)
        shown[place] = f"{texts.count(most) / len(texts):.0%}"
    ax.imshow(picture, origin="lower", aspect="auto", cmap=ListedColormap(colors), vmin=-0.5, vmax=len(names) - 0.5)
    patches = [Patch(color=color, label=name) for color, name in zip(colors, names, strict=True)]
    ax.legend(handles=patches, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return shown


def _means(
    ax: Any, cells: Mapping[tuple[Any, Any], list[Any]], columns: list[Any], rows: list[Any], label: str
) -> Shown:
    """Draw means; return nothing."""
    picture = np.full((len(rows), len(columns)), np.nan)
    for (x, y), values in cells.items():
        known = [value for value in values if value is not None]
        if known:
            picture[rows.index(y), columns.index(x)] = sum(known) / len(known)
    known = picture[~np.isnan(picture)]
    # A constant value would get a scale around it that includes impossible values.
    bounds = {"vmin": known[0], "vmax": known[0] + 1} if known.size and (known == known[0]).all() else {}
    image = ax.imshow(picture, origin="lower", aspect="auto", cmap="cividis", **bounds)
    ax.figure.colorbar(image, ax=ax, label=label)
    return {}


def _ordered(values: set[Any]) -> list[Any]:
    """Sort numbers by value and strings by name, with missing ones last."""
    return sorted(values, key=lambda value: (value is None, value if value is not None else 0))


def _tick(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
