"""Figures in the manner of Ivanov 2021, one a file, each a function of records.

They are drawn for files, by matplotlib's Agg, SVG and PDF, whatever ``MPLBACKEND`` names. A
notebook sets it for all programs that it starts, and matplotlib cannot be imported where the
backend that it names is not installed.
"""

import os
import sys
from contextlib import suppress

BACKEND = "MPLBACKEND"


def _import_despite(backend: str) -> None:
    """Import matplotlib, with the backend that was named where there is one."""
    del os.environ[BACKEND]
    try:
        import matplotlib as mpl
    finally:
        os.environ[BACKEND] = backend
    with suppress(ValueError):
        mpl.rcParams["backend"] = backend


if os.environ.get(BACKEND) and "matplotlib" not in sys.modules:
    _import_despite(os.environ[BACKEND])
