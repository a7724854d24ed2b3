"""Results of kernels, made without a line of Python, so that no signal can interrupt it.

A signal's handler runs between two lines of Python (bytecodes). For an array that is returned, the
compiler's own way ("boxing", ``numba/core/boxing.py``) looks the array's class up in Python; for a
named tuple it also calls the class's ``__new__``, which is Python. A handler that raises there, as
the one for Ctrl-C does, leaves a null pointer that nobody checks, and the interpreter crashes.

Here both are made by C functions alone: the class is a constant of the compiled function, and a
named tuple is made by ``tuple.__new__``, as its own ``__new__`` does it. Plain tuples and numbers
are handed over in C already. An argument of a kind that is not known yet is looked at in Python,
but the compiler checks what comes of that. Functions of other packages are left alone.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

from llvmlite import ir
from numba.core import boxing, cgutils, pythonapi, types
from numba.np import numpy_support

Boxer = Callable[[Any, Any, Any], Any]  # of a type, a native value, a context: a Python object
ADAPTER = "NRT_adapt_ndarray_to_python_acqref"  # numba/core/runtime/_nrt_python.c
MODULES: set[str] = set()  # with kernels
native: Any = cgutils
usual: Any = boxing


def _constant(context: Any, what: object) -> Any:
    """Return a borrowed reference to an object that the compiled function keeps."""
    manager = context.env_manager
    return manager.read_const(manager.add_const(what))


def _array_in_c(typ: Any, value: Any, context: Any) -> Any:
    """Make an array of a native one, whose memory it takes over."""
    if not context.context.enable_nrt:  # a part's: the very array that it was given
        return usual.box_array(typ, value, context)
    api, builder, number = context.pyapi, context.builder, ir.IntType(32)
    signature = ir.FunctionType(api.pyobj, [api.voidptr, api.pyobj, number, number, api.pyobj])
    made = builder.call(
        native.get_or_insert_function(builder.module, signature, ADAPTER),
        [
            builder.bitcast(native.alloca_once_value(builder, value), api.voidptr),
            _constant(context, typ.box_type),
            number(typ.ndim),
            number(int(typ.mutable)),
            _constant(context, numpy_support.as_dtype(typ.dtype)),
        ],
    )
    context.context.nrt.decref(builder, typ, value)
    return made


def _named_tuple_in_c(typ: Any, value: Any, context: Any) -> Any:
    """Make a named tuple of a native one."""
    make = _constant(context, partial(tuple.__new__, typ.instance_class))
    plain = usual.box_tuple(typ, value, context)
    made = context.pyapi.call_function_objargs(make, [plain])
    context.pyapi.decref(plain)
    return made


def _only_ours(in_c: Boxer, before: Boxer) -> Boxer:
    def box(typ: Any, value: Any, context: Any) -> Any:
        ours = context.env_manager.env.globals.get("__name__") in MODULES
        return (in_c if ours else before)(typ, value, context)

    return box


def install() -> None:
    """Let the compiler return the results of kernels in C."""
    boxers = pythonapi._boxers.functions  # pyright: ignore # its one list of ways
    named = _only_ours(_named_tuple_in_c, usual.box_namedtuple)
    boxers[types.Array] = _only_ours(_array_in_c, usual.box_array)
    boxers[types.NamedTuple] = boxers[types.NamedUniTuple] = named
