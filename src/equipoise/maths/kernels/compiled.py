"""The one door to the compiler, so that the type checker keeps seeing plain functions.

A kernel is a pure function of arrays, compiled on first use and cached on disk. Nothing of the
compiler is loaded before: a command that computes nothing does not wait for it.
"""

from collections.abc import Callable
from functools import cached_property, update_wrapper
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])


class Kernel:
    """A function that is compiled when it is first called, or first met in another kernel."""

    def __init__(self, function: Callable[..., Any], merged: bool) -> None:
        update_wrapper(self, function)
        self.py_func, self._merged = function, merged

    @cached_property
    def compiled(self) -> Callable[..., Any]:
        """The same function as Python calls it (a Numba dispatcher)."""
        from equipoise.maths.kernels.compiler import callable_kernel

        return callable_kernel(self.py_func)

    @cached_property
    def linked(self) -> Callable[..., Any]:
        """The same function as kernels call it: nothing is made for it but in them."""
        from equipoise.maths.kernels.compiler import linked_kernel

        return linked_kernel(self.py_func, self._merged)

    @property
    def _numba_type_(self) -> Any:
        """What the compiler reads where a kernel names this function."""
        from numba.core import types

        return types.Dispatcher(self.linked)

    def __call__(self, *arguments: Any) -> Any:
        """Run the machine code for arguments of these types."""
        return self.compiled(*arguments)

    def __reduce__(self) -> str:
        """Pickle by name, as a plain function is."""
        return self.py_func.__qualname__


def kernel(function: Function) -> Function:
    """Compile a function of arrays and numbers; it runs without the interpreter's lock."""
    return cast(Function, Kernel(function, merged=False))


def part(function: Function) -> Function:
    """Compile a function that other kernels call; it is merged into each caller.

    Without this, every call would copy the descriptors of all arrays it is given. A part makes no
    arrays and keeps no count of who uses which: counting, two atomic operations for each view of
    an array, took half the time of a fit.
    """
    return cast(Function, Kernel(function, merged=True))
