"""Fingerprints of functions and classes: their code, and everything that they read.

The code is the compiled code. The inputs are global variables, variables of enclosing functions,
defaults and attributes of the class. Functions and classes among them count with their own code and
inputs. Library code counts by its name and version. Hashes are equal in every process.
"""

from __future__ import annotations

import copyreg
import functools
import hashlib
import os
import site
import sys
import sysconfig
import types
from collections.abc import Callable, Iterator
from enum import Enum
from typing import Any

import numpy as np

__all__ = ["Fingerprint", "digest", "fingerprint"]

Fingerprint = tuple[str, dict[str, str]]
"""The hash of an object's behaviour, and the hash of each value that it reads, by name."""

_PLAIN = (type(None), bool, int, float, complex, str, bytes, type(...))

# The attributes of every class.
_OF_CLASSES = {
    *("__dict__", "__weakref__", "__module__", "__qualname__", "__doc__", "__annotations__", "__firstlineno__"),
    *("__static_attributes__", "__annotate__", "__annotate_func__", "__annotations_cache__", "__slotnames__"),
    *("__abstractmethods__", "_abc_impl", "__orig_bases__", "__parameters__"),
}


def fingerprint(component: Callable[..., Any]) -> Fingerprint:
    """The fingerprint of a callable, such as a function or a class."""
    functions, reads = _anatomy(component)
    if not functions:
        return digest(component), {}
    for owner, function in functions.items():
        for name, value in _reads(function, owner).items():
            # Different methods of a class may use one name for different things.
            reads[name if reads.get(name, value) is value else f"{owner}.{name}"] = value
    does = digest([(name, function.__code__) for name, function in functions.items()])
    return does, {name: digest(value) for name, value in sorted(reads.items())}


def digest(value: Any) -> str:
    """The hash of a value with everything that it refers to."""
    walk = _Walk()
    try:
        walk.see(value)
    except RecursionError:
        # At that depth only the type counts.
        return digest(f"deep {type(value).__qualname__}")
    return walk.hash.hexdigest()[:16]


def _anatomy(component: Any) -> tuple[dict[str, types.FunctionType], dict[str, Any]]:
    """The functions of a component by name, and the class attributes that it reads."""
    if isinstance(component, types.FunctionType):
        return {component.__qualname__: component}, {}
    functions: dict[str, types.FunctionType] = {}
    reads: dict[str, Any] = {}
    for kind in component.__mro__ if isinstance(component, type) else ():
        if kind is object:
            continue
        if kind is not component and _is_of_library(kind.__module__):
            reads[kind.__qualname__] = kind
            continue
        for name, value in _written(kind):
            name = f"{kind.__qualname__}.{name}"
            inner = list(_inner(value))
            functions.update((f"{name}{number or ''}", each) for number, each in enumerate(inner))
            if not inner:
                reads[name] = value
    return functions, reads


def _written(kind: type) -> Iterator[tuple[str, Any]]:
    """The attributes written in a class."""
    return ((name, value) for name, value in sorted(vars(kind).items()) if name not in _OF_CLASSES)


def _inner(value: Any) -> Iterator[types.FunctionType]:
    """The functions of a class attribute: a method, or the parts of a property and similar."""
    value = getattr(value, "__func__", value)
    parts = (value.fget, value.fset, value.fdel) if isinstance(value, property) else (value,)
    return (part for part in parts if isinstance(part, types.FunctionType))


def _reads(function: types.FunctionType, owner: str) -> dict[str, Any]:
    """The variables around a function, and its defaults, that it may read."""
    names = set(_names(function.__code__))
    reads = dict(_globals(function.__globals__, names))
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        try:
            reads[name] = cell.cell_contents
        except ValueError:
            # The variable is unset.
            reads[name] = None
    # The class of 'super' is the method's own.
    reads.pop("__class__", None)
    takes, defaults = function.__code__.co_varnames, function.__defaults__ or ()
    last = function.__code__.co_argcount
    named = dict(zip(takes[last - len(defaults) : last], defaults, strict=True)) | (function.__kwdefaults__ or {})
    return reads | {f"{owner}.{name}": value for name, value in named.items()}


def _names(code: types.CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _names(constant)


def _globals(among: dict[str, Any], names: set[str], of: str = "") -> Iterator[tuple[str, Any]]:
    """The variables with these names; for a module of the user, its variables."""
    for name in sorted(names & among.keys()):
        value = among[name]
        if isinstance(value, types.ModuleType) and not _is_of_library(value.__name__):
            yield from _globals(vars(value), names - {name}, f"{of}{name}.")
        else:
            yield f"{of}{name}", value


@functools.lru_cache(maxsize=None)
def _libraries() -> tuple[str, ...]:
    """The folders of library code: Python's own, installed packages, and this package."""
    folders = [sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib")]
    folders += [*site.getsitepackages(), site.getusersitepackages(), os.path.dirname(__file__)]
    return tuple({os.path.join(os.path.realpath(folder), "") for folder in folders if folder})


def _is_of_library(module: str | None) -> bool:
    """Whether a module is library code."""
    there = sys.modules.get(module or "")
    if module is None or module == "__main__" or there is None:
        return False
    file: str | None = getattr(there, "__file__", None)
    if file is None:
        return getattr(there, "__spec__", None) is not None
    return os.path.realpath(file).startswith(_libraries())


class _Walk:
    """Hashes a value with everything that it refers to."""

    def __init__(self) -> None:
        self.hash = hashlib.sha256()
        self._within: list[int] = []
        # Values stay alive, so that their ids are not reused.
        self._done: dict[int, tuple[str, Any]] = {}

    def see(self, value: Any) -> None:
        """Add a value."""
        number = id(value)
        if type(value) in _PLAIN:
            self._say(type(value).__name__, repr(value))
        elif number in self._within:
            self._say("within", str(len(self._within) - self._within.index(number)))
        elif number in self._done:
            self._say(self._done[number][0])
        else:
            self._within.append(number)
            around, self.hash = self.hash, hashlib.sha256()
            self._inside(value)
            self._done[number] = (self.hash.hexdigest(), value)
            self._within.pop()
            self.hash = around
            self._say(self._done[number][0])

    def _inside(self, value: Any) -> None:
        kind = type(value)
        self._say(kind.__module__, kind.__qualname__)
        if kind in (list, tuple):
            self._sequence(value)
        elif kind in (set, frozenset):
            self._say(*sorted(map(digest, value)))
        elif kind is dict:
            self._sequence(tuple(each for item in value.items() for each in item))
        elif isinstance(value, np.ndarray) and not value.dtype.hasobject:
            self._say(value.dtype.str, str(value.shape))
            self.hash.update(np.ascontiguousarray(value).tobytes())
        else:
            self._other(value)

    def _say(self, *words: str) -> None:
        for word in words:
            # With its length, so that two words cannot merge.
            self.hash.update(f"{len(word)} {word}".encode("utf-8", "surrogatepass"))

    def _sequence(self, values: list[Any] | tuple[Any, ...]) -> None:
        self._say(str(len(values)))
        if all(type(value) in _PLAIN for value in values):
            return self._say(repr(values))
        for value in values:
            self.see(value)

    def _other(self, value: Any) -> None:
        if isinstance(value, types.CodeType):
            self._code(value)
        elif isinstance(value, types.ModuleType):
            self._say(value.__name__, _version(value.__name__))
        elif isinstance(value, (type, types.FunctionType, types.BuiltinFunctionType)):
            self._named(value)
        elif isinstance(value, types.MethodType):
            self.see((value.__func__, value.__self__))
        elif isinstance(value, (staticmethod, classmethod)):
            self.see(value.__func__)
        elif isinstance(value, property):
            self.see((value.fget, value.fset, value.fdel))
        elif isinstance(value, Enum):
            self.see((type(value), value.name, value.value))
        else:
            self._object(value)

    def _code(self, code: types.CodeType) -> None:
        self.hash.update(code.co_code + getattr(code, "co_exceptiontable", b""))
        self._say(*code.co_names, *code.co_varnames, *code.co_freevars)
        self._sequence(code.co_consts)

    def _named(self, value: Any) -> None:
        """Add a function or a class: library code by name, other code with its inputs."""
        module = getattr(value, "__module__", None)
        self._say(str(module), value.__qualname__)
        bound = getattr(value, "__self__", None)
        if isinstance(value, types.BuiltinFunctionType):
            self.see(None if isinstance(bound, types.ModuleType) else bound)
        elif _is_of_library(module):
            self._say(_version(module))
        elif isinstance(value, types.FunctionType):
            self._code(value.__code__)
            self.see(_reads(value, ""))
            self.see({name: each for name, each in vars(value).items() if name != "__wrapped__"})
        else:
            self.see(value.__bases__)
            self.see(dict(_written(value)))

    def _object(self, value: Any) -> None:
        """Add any other value by its pickled form, or else by its attributes."""
        inner = getattr(value, "__wrapped__", None)
        try:
            copied = value.__reduce_ex__(4)
        except Exception:
            copied = (type(value), getattr(value, "__dict__", None))
        if isinstance(copied, str):
            return self.see((copied, inner))
        made_by, *rest = copied
        if made_by not in (copyreg.__newobj__, copyreg.__newobj_ex__):  # type: ignore[attr-defined]
            self.see(made_by)
        # Items may be iterators.
        self.see((inner, *(list(each) if isinstance(each, Iterator) else each for each in rest)))


def _version(module: str | None) -> str:
    """The version of a module's package, if it has one."""
    package = sys.modules.get((module or "").partition(".")[0])
    return str(getattr(package, "__version__", ""))
