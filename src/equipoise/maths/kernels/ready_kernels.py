"""Kernels that an installation brings along, compiled for this computer or for a family of it.

A wheel's kernels are compiled for a family of processors (an LLVM "CPU name"), which this computer
belongs to if it has all that the family has. They are found under the same hash of their sources
as all others: with another version of the sources, of Numba or of Python nothing is found, and
each kernel is compiled when it is first called.
"""

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from llvmlite import binding
from numba.core.caching import IndexDataCacheFile
from numba.core.registry import cpu_target

READY = Path(__file__).resolve().parent / "ready"
INDEX = ".nbi"
# System V psABI for x86-64, "micro-architecture levels": desktop processors since 2013 to 2015.
FAMILIES = {"x86-64-v3": ("avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe", "xsave")}


def take_ready(folder: Path, stamp: str, ready: Path = READY) -> None:
    """Copy into a folder of kernels those of its sources that came along and run here."""
    for index in (ready / folder.name).glob(f"*{INDEX}"):
        ours: Any = IndexDataCacheFile(str(index.parent), index.stem, stamp)
        taken = usable(ours._load_index())
        for name in set(taken.values()):
            shutil.copyfile(index.with_name(name), folder / name)
        if taken:
            here: Any = IndexDataCacheFile(str(folder), index.stem, stamp)
            here._save_index(taken)


def usable(index: Mapping[Any, str]) -> dict[Any, str]:
    """Return the entries of an index for this computer, under the name of its own processor."""
    here = this_computer()
    return {
        (signature, here, code): name
        for (signature, there, code), name in index.items()
        if there == here or _is_of(there)
    }


def _is_of(there: tuple[str, str, str]) -> bool:
    """Say whether this computer runs what was compiled for a triple, a family and no more."""
    triple, family, more = there
    needed, alike = FAMILIES.get(family), triple == this_computer()[0]
    has: dict[str, bool] = dict(binding.get_host_cpu_features())  # pyright: ignore # untyped
    return needed is not None and alike and not more and all(has.get(each) for each in needed)


def this_computer() -> tuple[str, str, str]:
    """Return what the compiler compiles for: a triple, a processor, what that has and has not."""
    context: Any = cpu_target.target_context
    return context.codegen().magic_tuple()
