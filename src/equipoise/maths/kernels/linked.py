"""Functions that exist only within the kernels that call them: their code is made once, in each.

The compiler makes a function that others call ready to run by itself: it optimises it, turns it
into machine code, and wraps it for Python. Whoever calls it does the same again with a copy of its
code, and whoever calls that. Of the time that compiling took, half went there.

Here such a function stops at the code before optimisation (LLVM IR), which kernels link.
"""

from collections.abc import Callable
from typing import Any

from numba.core import compiler, registry, types
from numba.core.codegen import JITCodeLibrary

plain: Callable[[Any], Any] = types.unliteral  # pyright: ignore # takes any type


class LinkedLibrary(JITCodeLibrary):
    """Code that other libraries link, and nobody runs."""

    _linking_libraries: Any
    _reload_init: Any
    _final_module: Any

    def finalize(self) -> None:
        """Link what this code calls; optimise nothing."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalize_dynamic_globals()
        self._finalized = True


class LinkedCompiler(compiler.Compiler):
    """The usual steps, without those that make code ready to run."""

    def define_pipelines(self) -> list[Any]:
        """Return the steps."""
        state: Any = self.state
        state.flags.no_compile = True
        state.library = LinkedLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return super().define_pipelines()


class Linked(registry.CPUDispatcher):
    """A function that kernels call, and nobody else."""

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]) -> None:
        super().__init__(
            py_func=function,
            targetoptions=options,
            pipeline_class=LinkedCompiler,
        )

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Compile for types: a constant is an argument like another, not a function of its own."""
        usual: Any = super().get_call_template
        return usual(tuple(map(plain, args)), {name: plain(typ) for name, typ in kws.items()})

    def add_overload(self, cres: Any) -> None:
        """Know a compiled function by a name of its own: it has no address that would be one."""
        known = cres._replace(entry_point=[].append)
        self.targetctx.insert_user_function(known.entry_point, known.fndesc, [known.library])
        super().add_overload(known)
