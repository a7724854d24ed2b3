"""The one door to the compiler, so that the type checker keeps seeing plain functions.

A kernel is a pure function of arrays, compiled on first use and cached on disk. Fused
multiply-add and reassociation are allowed; NaN and infinity keep their meaning.
"""

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from equipoise.maths.kernel_cache import drop_stale

Function = TypeVar("Function", bound=Callable[..., Any])
FAST = {"contract", "reassoc", "nsz", "arcp"}

drop_stale()


def kernel(function: Function) -> Function:
    """Compile a function of arrays and numbers; it runs without the interpreter's lock."""
    compile_ = numba.njit(cache=True, nogil=True, fastmath=FAST, error_model="numpy")
    return cast(Function, compile_(function))


def part(function: Function) -> Function:
    """Compile a function that other kernels call; it is merged into each caller.

    Without this, every call would copy the descriptors of all arrays it is given.
    """
    compile_ = numba.njit(
        cache=True, nogil=True, fastmath=FAST, error_model="numpy", forceinline=True
    )
    return cast(Function, compile_(function))
