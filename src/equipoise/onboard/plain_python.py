"""A kernel as the interpreter runs it: the arithmetic that C is compared with, bit for bit.

The compiler of the library may join and vectorise operations; the interpreter does not, and takes
sine and power from the same mathematical library as a program in C does.
"""

from collections.abc import Callable
from types import FunctionType
from typing import Any

from equipoise.onboard.translation.values import source_function


def plain_python(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a kernel, and all that it calls, as plain functions."""
    return _plain(function, {})


def _plain(function: Callable[..., Any], made: dict[int, Callable[..., Any]]) -> Callable[..., Any]:
    found = source_function(function)
    assert isinstance(found, FunctionType)
    if id(found) in made:
        return made[id(found)]
    names: dict[str, Any] = dict(found.__globals__)
    copy = FunctionType(
        found.__code__, names, found.__name__, found.__defaults__, found.__closure__
    )
    made[id(found)] = copy
    for name in found.__code__.co_names:
        thing: Any = names.get(name)
        if hasattr(thing, "py_func") or isinstance(thing, FunctionType):
            names[name] = _plain(thing, made)
    return copy
