"""The one door to the compiler, so that the type checker keeps seeing plain functions.

A kernel is a pure function of arrays, compiled on first use and cached on disk. Fused
multiply-add and reassociation are allowed; NaN and infinity keep their meaning. No signal can
interrupt its call: within it, no line of Python is run (``boxing.py``).
"""

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from equipoise.maths import boxing, kernel_cache

Function = TypeVar("Function", bound=Callable[..., Any])
FAST = {"contract", "reassoc", "nsz", "arcp"}
OPTIONS: dict[str, Any] = {
    "cache": True,
    "nogil": True,  # runs without the interpreter's lock
    "fastmath": FAST,
    "error_model": "numpy",
}
MERGED: dict[str, Any] = {**OPTIONS, "forceinline": True, "_nrt": False}

kernel_cache.install()
boxing.install()


def kernel(function: Function) -> Function:
    """Compile a function of arrays and numbers; it runs without the interpreter's lock."""
    return _compiled(function, OPTIONS)


def part(function: Function) -> Function:
    """Compile a function that other kernels call; it is merged into each caller.

    Without this, every call would copy the descriptors of all arrays it is given. A part makes no
    arrays and keeps no count of who uses which: counting, two atomic operations for each view of
    an array, took half the time of a fit.
    """
    return _compiled(function, MERGED)


def _compiled(function: Function, options: dict[str, Any]) -> Function:
    boxing.MODULES.add(function.__module__)
    return cast(Function, numba.njit(**options)(function))
