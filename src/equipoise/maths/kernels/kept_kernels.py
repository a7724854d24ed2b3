"""Kernels on the disk, with what running them takes and no more.

The compiler keeps two things beside the machine code that a kernel of ours, which no other kernel
links, has no use for. Each took as long to load as the compiler itself:

- the code before it was machine code (LLVM IR), to be linked: only the names in it are kept;
- all functions that the compiler knows, SciPy's linear algebra among them, were registered before
  the first kernel was loaded. Compiling does so by itself.
"""

from collections.abc import Iterable
from typing import Any

from llvmlite import binding, ir
from numba.core.caching import CompileResultCacheImpl, FunctionCache
from numba.core.runtime.nrt import rtsys

NOTHING: Any = ir.FunctionType(ir.VoidType(), [])


def names_alone(bitcode: bytes) -> bytes:
    """Return code that defines the same names, each as a function that does nothing."""
    module: Any = binding.parse_bitcode(bitcode)
    named = (*module.functions, *module.global_variables)
    return _empty_functions(each.name for each in named if not each.is_declaration)


def _empty_functions(names: Iterable[str]) -> bytes:
    module = ir.Module()
    for name in names:
        function: Any = ir.Function(module, NOTHING, name)
        ir.IRBuilder(function.append_basic_block()).ret_void()
    made: Any = binding.parse_assembly(str(module))
    return made.as_bitcode()


class CodeAlone(CompileResultCacheImpl):
    """What is kept of a compiled function."""

    def reduce(self, cres: Any) -> Any:
        """Return what is written."""
        usual: Any = super()
        library, *rest = usual.reduce(cres)
        name, kind, (code, bitcode) = library
        return (name, kind, (code, names_alone(bitcode))), *rest


class KeptKernels(FunctionCache):
    """The kernels of a function on the disk."""

    _impl_class = CodeAlone

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the kernel for argument types; None: it is not kept."""
        own: Any = self
        rtsys.initialize(target_context)
        with own._guard_against_spurious_io_errors():
            return own._load_overload(sig, target_context)
