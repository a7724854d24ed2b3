"""Ctrl-C at any moment of a kernel's call raises KeyboardInterrupt, and never ends the program.

Python's own handler is there, as for those who call the package from a script.
"""

import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from equipoise.maths.kernels.compiled import kernel, part
from tests.support import kernel_calls, thorough

ROOT = Path(__file__).parents[3]
CALLS = kernel_calls.calls()
TIMES = thorough.count(1000, 100)  # of each kernel


class Inner(NamedTuple):
    """What is of one kind: the compiler has another name for these."""

    first: float
    second: float


class Mixed(NamedTuple):
    """An array, a number, a named tuple and a plain one."""

    rows: np.ndarray
    count: int
    inner: Inner
    plain: tuple[np.ndarray, bool]


@kernel
def mixed(rows: np.ndarray, number: float) -> Mixed:
    """Return an array that was given, one that is new, and a view of it."""
    made = np.full((2, 3), number)
    return Mixed(rows, 7, Inner(number, -number), (made[:, 1], True))


@part
def given_back(rows: np.ndarray) -> np.ndarray:
    """Return what was given."""
    return rows


@pytest.fixture(scope="module", autouse=True)
def compiled_anew():
    """Kernels of tests are kept by the compiler's own rule: under their source alone."""
    for function in (mixed, given_back):
        function.compiled.recompile()


def test_results_are_what_python_would_return():
    """Kinds, values and strides; an array that was given is the same one, none is freed early."""
    rows = np.arange(4.0)
    found, wanted = mixed(rows, 2.5), mixed.py_func(rows, 2.5)
    assert isinstance(found, Mixed)
    assert isinstance(found.inner, Inner)
    assert type(found.plain) is tuple
    assert found.rows is rows
    assert given_back(rows) is rows
    assert (found.count, found.inner, found.plain[1]) == (7, (2.5, -2.5), True)
    np.testing.assert_array_equal(found.plain[0], wanted.plain[0])
    assert found.plain[0].strides == wanted.plain[0].strides
    assert found.plain[0].flags.writeable


def test_nothing_is_kept_of_a_result():
    """References to a given array and to the classes are as many after many calls as before."""
    rows, counted = np.zeros(3), (Mixed, Inner, np.ndarray)
    mixed(rows, 1.0)
    before = [sys.getrefcount(what) for what in (rows, *counted)]
    for _ in range(1000):
        mixed(rows, 1.0)
    assert [sys.getrefcount(what) for what in (rows, *counted)] == before


def python_within(call: Any) -> list[str]:
    """Return the functions that Python ran after the last kernel was entered."""
    ran: list[str] = []
    sys.setprofile(
        lambda frame, event, _: ran.append(frame.f_code.co_name) if event == "call" else None
    )
    try:
        call()
    finally:
        sys.setprofile(None)
    return ran


@pytest.mark.parametrize("name", CALLS)
def test_no_line_of_python_runs_within_a_call(name):
    """The compiler tells a profiler of the kernel itself: nothing follows it."""
    CALLS[name]()
    assert python_within(CALLS[name])[-1] == name


def test_no_line_of_python_runs_within_a_call_of_any_kind():
    rows = np.zeros(3)
    mixed(rows, 1.0)
    assert python_within(lambda: mixed(rows, 1.0))[-1] == "mixed"


def test_ctrl_c_at_random_moments_of_every_kernel_only_raises():
    words = [sys.executable, "-m", "tests.support.kernel_calls", str(TIMES)]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=600)
    assert done.stdout.split() == list(CALLS), done.stderr[-2000:]
    assert done.returncode == 0, done.stderr[-2000:]
