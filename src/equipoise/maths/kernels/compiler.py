"""The compiler (Numba) as it is used here; loaded when the first kernel is called.

Fused multiply-add and reassociation are allowed; NaN and infinity keep their meaning.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from numba.core import registry

from equipoise.maths.kernels import compile_events, kernel_cache, returned_in_c
from equipoise.maths.kernels.kept_kernels import KeptKernels
from equipoise.maths.kernels.kernel_lock import alone
from equipoise.maths.kernels.linked import Linked

FAST = {"contract", "reassoc", "nsz", "arcp"}
CODE: dict[str, Any] = {
    "nopython": True,
    "boundscheck": None,
    "nogil": True,
    "fastmath": FAST,
    "error_model": "numpy",
}
LINKED: dict[str, Any] = {**CODE, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
MERGED: dict[str, Any] = {**LINKED, "forceinline": True, "_nrt": False}


class Waiting(registry.CPUDispatcher):
    """A kernel that is loaded where another process has compiled it."""

    _cache: Any

    def enable_caching(self) -> None:
        """Keep what is compiled."""
        self._cache = KeptKernels(self.py_func)

    def _compilation_chain_init_hook(self) -> None:
        """Leave extensions of the compiler to compiling, which loads them before it begins."""

    def compile(self, sig: Any) -> Any:
        """Return the address of its machine code."""
        with alone(Path(self._cache.cache_path), self.py_func.__qualname__):
            return super().compile(sig)


def callable_kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that Python calls."""
    returned_in_c.MODULES.add(function.__module__)
    made = Waiting(function, targetoptions=CODE)
    made.enable_caching()
    return made


def linked_kernel(function: Callable[..., Any], merged: bool) -> Linked:
    """Return a function that kernels call."""
    returned_in_c.MODULES.add(function.__module__)
    return Linked(function, MERGED if merged else LINKED)


kernel_cache.install()
returned_in_c.install()
compile_events.install()
