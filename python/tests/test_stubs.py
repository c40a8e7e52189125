"""The stubs of the native half have its documentation, since editors show nothing else.
`AFP_BLESS=1` writes them.
"""

from __future__ import annotations

import ast
import inspect
import os
from collections.abc import Iterator
from typing import Any

from afp import _afp

from conftest import ROOT

STUBS = [ROOT / f"python/src/afp/{name}.pyi" for name in ("_afp", "_afp_plans", "_afp_runs")]

Item = ast.ClassDef | ast.FunctionDef


def items(text: str) -> Iterator[tuple[Item, str | None, int]]:
    """Public classes and methods, each with its runtime documentation and its depth."""
    for node in ast.parse(text).body:
        if not isinstance(node, Item) or node.name.startswith("_"):
            continue
        there = getattr(_afp, node.name, None)
        if there is None:
            # A process with another robot does not have it.
            continue
        yield node, documented(there), 0
        for inner in node.body if isinstance(node, ast.ClassDef) else []:
            if isinstance(inner, ast.FunctionDef) and not inner.name.startswith("_"):
                yield inner, documented(inspect.getattr_static(there, inner.name)), 1


def documented(thing: Any) -> str | None:
    """Its own documentation, without inherited text."""
    thing = getattr(thing, "__func__", thing)
    return inspect.cleandoc(thing.__doc__) if thing.__doc__ else None


def with_documentation(text: str) -> str:
    """The stub with the documentation of the runtime."""
    lines = text.splitlines()
    for node, words, depth in sorted(items(text), key=lambda item: -item[0].lineno):
        if words is None:
            continue
        indent = "    " * (depth + 1)
        quoted = f'"""{words}"""'.replace("\\", "\\\\").splitlines()
        block = [f"{indent}{line}".rstrip() for line in quoted]
        first = node.body[0]
        if ast.get_docstring(node) is not None:
            lines[first.lineno - 1 : first.end_lineno] = block
        elif isinstance(first, ast.Expr) and len(node.body) == 1:
            # Replace the three dots after the colon.
            line = lines[first.lineno - 1]
            lines[first.lineno - 1 : first.end_lineno] = [line[: first.col_offset].rstrip(), *block]
        else:
            begin = min([first.lineno, *(decorator.lineno for decorator in getattr(first, "decorator_list", []))])
            lines[begin - 1 : begin - 1] = [*block, ""]
    return "\n".join(lines) + "\n"


def test_stubs_have_the_documentation_of_the_native_half() -> None:
    told: list[tuple[str, str | None, str | None]] = []
    for stub in STUBS:
        text = stub.read_text(encoding="utf-8")
        if os.environ.get("AFP_BLESS"):
            text = with_documentation(text)
            stub.write_text(text, encoding="utf-8", newline="\n")
        told += [(node.name, ast.get_docstring(node), words) for node, words, _ in items(text)]
    assert len(told) > 150
    wrong = [name for name, stub, words in told if stub != words and words is not None]
    assert not wrong, f"AFP_BLESS=1 pytest {__file__} writes them: {wrong}"
