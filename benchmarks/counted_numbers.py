"""Floating-point operations of a kernel, counted by running its Python with numbers that count.

Every sum, difference, product, quotient, power and elementary function counts as one; so a fused
multiply-add is two. What fills a block of sensitivities up counts too: the machine computes it.
Comparisons, changes of sign and integers count nothing.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, ClassVar

import numpy as np

from equipoise.maths.kernels.compiled import Kernel

BINARY = ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "pow", "rpow")


class Number(float):
    """A number whose operations are counted."""

    operations: ClassVar[int] = 0

    def __array_ufunc__(self, function: np.ufunc, method: str, *given: Any, **more: Any) -> Any:
        found = getattr(function, method)(*(float(x) for x in given), **more)
        if not isinstance(found, float):
            return found
        Number.operations += 1
        return Number(found)

    def __neg__(self) -> "Number":
        return Number(-float(self))

    def __abs__(self) -> "Number":
        return Number(abs(float(self)))


def _counting(name: str) -> Callable[[Number, Any], Any]:
    plain = getattr(float, f"__{name}__")

    def operation(self: Number, other: Any) -> Any:
        found = plain(self, float(other)) if np.isscalar(other) else NotImplemented
        if found is NotImplemented:
            return found
        Number.operations += 1
        return Number(found)

    return operation


for _name in BINARY:
    setattr(Number, f"__{_name}__", _counting(_name))


class Numbers(np.ndarray):
    """An array that holds nothing but such numbers."""

    def __setitem__(self, key: Any, value: Any) -> None:
        super().__setitem__(key, _wrapped(value))


def _wrapped(value: Any) -> Any:
    if isinstance(value, (Number, Numbers)):
        return value
    return Number(value) if np.isscalar(value) else counting(np.asarray(value, dtype=float))


def counting(value: Any) -> Any:
    """Return a copy of what a kernel is given, made of numbers that count."""
    if isinstance(value, float):
        return Number(value)
    if isinstance(value, np.ndarray) and value.dtype == np.float64:
        flat = np.array([Number(x) for x in value.ravel()], dtype=object)
        return flat.reshape(value.shape).view(Numbers)
    if isinstance(value, tuple):
        parts = [counting(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value


def plain(value: Any) -> Any:
    """Return what a kernel returns as it is without counting."""
    if isinstance(value, Number):
        return float(value)
    if isinstance(value, Numbers):
        return value.astype(float)
    if isinstance(value, tuple):
        parts = [plain(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value


def write_back(counted: Any, original: Any) -> None:
    """Write what a kernel has written into the arrays that it was given."""
    if isinstance(counted, Numbers):
        original[...] = counted.astype(float)
    elif isinstance(counted, tuple):
        for one, other in zip(counted, original, strict=True):
            write_back(one, other)


@contextmanager
def arrays_that_count() -> Iterator[None]:
    """Have arrays that a kernel makes hold numbers that count."""
    empty, zeros = np.empty, np.zeros

    def made(shape: Any, dtype: Any = float) -> Any:
        blank = zeros(shape, dtype)
        return counting(blank) if blank.dtype == np.float64 else blank

    np.empty, np.zeros = made, made  # pyright: ignore
    try:
        yield
    finally:
        np.empty, np.zeros = empty, zeros


@contextmanager
def kernels_called(call: Callable[..., Any]) -> Iterator[None]:
    """Have every kernel that Python calls go through ``call(kernel, *arguments)``."""
    usual = Kernel.__call__
    Kernel.__call__ = call  # pyright: ignore
    try:
        yield
    finally:
        Kernel.__call__ = usual


def operations(run: Callable[[], Any], name: str) -> tuple[int, Counter[str]]:
    """Return the operations of a kernel within ``run``, and how often each function was called."""
    calls: Counter[str] = Counter()
    begun = False

    def call(kernel: Kernel, *arguments: Any) -> Any:
        nonlocal begun
        if begun:
            calls[kernel.py_func.__name__] += 1
            return kernel.py_func(*arguments)
        if kernel.py_func.__name__ != name:
            return kernel.compiled(*arguments)
        given, begun = counting(arguments), True
        with arrays_that_count():
            found = plain(kernel.py_func(*given))
        begun = False
        write_back(given, arguments)
        return found

    before = Number.operations
    with kernels_called(call):
        run()
    return Number.operations - before, calls
