"""How records show themselves: in few lines, as a table, as a document, as a figure.

A record knows its numbers; what draws and sets them stands in rooms above this one, and needs
libraries that no record may import. So the package's root lends a presenter (``present_with``),
which is loaded when a record is first shown.
"""

from collections.abc import Callable
from typing import Any

# What is lent: a module with ``text``, ``html``, ``document``, ``frame``, ``dataset``, ``figure``.
_lent: list[Callable[[], Any]] = []


def present_with(presenter: Callable[[], Any]) -> None:
    """Let records be shown by what the function returns when the first of them is shown."""
    _lent[:] = [presenter]


def _presenter() -> Any:
    return _lent[-1]()


class Shown:
    """A record that shows itself. It adds methods and nothing else."""

    __slots__ = ()

    def __repr__(self) -> str:
        """Return a few lines: what it is, and the numbers that count, in the bench's units."""
        return _presenter().text(self)

    def _repr_html_(self) -> str:
        """Return tables for a notebook, in the bench's units."""
        return _presenter().html(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the document that the command prints with ``--json``.

        Numbers are in SI units; None stands for what is not finite.
        """
        return _presenter().document(self)

    def to_pandas(self) -> Any:
        """Return a ``pandas.DataFrame`` in SI units; units stand in a column or in its name.

        Raises InputError that names the extra where pandas is missing.
        """
        return _presenter().frame(self)

    def to_xarray(self) -> Any:
        """Return an ``xarray.Dataset`` in SI units; ``attrs["units"]`` names each unit.

        Raises InputError that names the extra where xarray is missing.
        """
        return _presenter().dataset(self)


class Plotted(Shown):
    """A record of which there is a figure, too."""

    __slots__ = ()

    def plot(self) -> Any:
        """Return a ``matplotlib.figure.Figure`` in the bench's units; its caption says which.

        Raises InputError where the record holds nothing to draw.
        """
        return _presenter().figure(self)
