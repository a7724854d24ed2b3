"""How recordings are made of arrays and tables in memory, by the rules that a file meets.

Those rules stand in rooms above this one. So the package's root lends a maker (``make_with``),
which is loaded when the first recording is made of something in memory.
"""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import ArrayLike
else:
    ArrayLike = Any  # the root imports this module, and no library
    Self = Any  # what checks types at run time sees functions, and not whose they are

BAD_ROWS = 0.05  # share of the rows that may be left out as faulty (chosen)
# What is lent: a module with ``from_arrays`` and ``from_pandas``.
_lent: list[Callable[[], Any]] = []


def make_with(maker: Callable[[], Any]) -> None:
    """Let recordings be made by what the function returns when the first of them is made."""
    _lent[:] = [maker]


def _maker() -> Any:
    return _lent[-1]()


@runtime_checkable
class PathLike(Protocol):
    """A path of a file, as ``pathlib`` has it; no record may import that."""

    def __fspath__(self) -> str:
        """Return the path as text."""
        ...


class FromMemory:
    """A recording that is made of what is in memory. It adds class methods and nothing else."""

    __slots__ = ()

    @classmethod
    def from_arrays(
        cls,
        t: ArrayLike,
        *,
        q: ArrayLike | None = None,
        order: str = "wxyz",
        euler: ArrayLike | None = None,
        sequence: str | None = None,
        euler_unit: str = "rad",
        turns: str = "body to laboratory",
        rate: ArrayLike | None = None,
        rate_unit: str = "rad/s",
        rate_t: ArrayLike | None = None,
        masses: Mapping[str, ArrayLike] | None = None,
        masses_t: ArrayLike | None = None,
        momentum: ArrayLike | None = None,
        torque: ArrayLike | None = None,
        field: ArrayLike | None = None,
        lab_up: str = "z",
        body: tuple[str, str, str] = ("x", "y", "z"),
        bad_rows: float = BAD_ROWS,
        source: str = "arrays",
    ) -> Self:
        """Return the recording that arrays hold, one row a time, by the rules that a file meets.

        Faulty rows are left out, the clock is set right, quaternions become unit and continuous;
        ``notes`` say so and count rows from 1. A row of NaN is no reading. All is in SI units but
        for what a unit is stated of.

        Parameters
        ----------
        t
            Times (n,), s, or dates (datetime64), which count from the first.
        q
            Quaternions (n, 4) of the attitude.
        order
            Of the quaternion's components: wxyz, or xyzw as in SciPy and ROS.
        euler
            Angles (n, 3) of the attitude, in the order of the sequence.
        sequence
            Axes of the three turns as in SciPy: ZYX about turned axes, zyx about fixed ones.
        euler_unit
            rad or deg.
        turns
            body to laboratory: R(q) takes body components to laboratory components, v_lab = R v.
            laboratory to body: the inverse.
        rate
            Angular rate (n, 3) in body axes.
        rate_unit
            rad/s, deg/s, mrad/s or rpm.
        rate_t
            Times of the rate's rows on the same clock. None: t.
        masses
            Displacements from home (n,), m, by the name of the mass.
        masses_t
            Times of the masses' rows on the same clock. None: t.
        momentum
            Momentum stored in wheels (n, 3), N m s, body axes.
        torque
            Known torque (n, 3), N m, body axes.
        field
            Magnetic field (n, 3), T, body axes.
        lab_up
            Laboratory axis that points up: z, y, x, -x, -y or -z. It becomes Z.
        body
            Axes x, y, z of the platform in terms of the arrays', such as ("x", "-z", "y").
        bad_rows
            Share of the rows that may be left out as faulty; with more they are refused.
        source
            Name of the recording in sentences.

        Raises
        ------
        InputError
            For a shape, unit or word that cannot be used, with the argument's name; for rows that
            a file is refused for.
        """
        return _maker().from_arrays(
            t=t, q=q, order=order, euler=euler, sequence=sequence, euler_unit=euler_unit,
            turns=turns, rate=rate, rate_unit=rate_unit, rate_t=rate_t, masses=masses,
            masses_t=masses_t, momentum=momentum, torque=torque, field=field, lab_up=lab_up,
            body=body, bad_rows=bad_rows, source=source,
        )  # fmt: skip

    @classmethod
    def from_pandas(
        cls,
        frame: Any,
        *,
        columns: str | PathLike | None = None,
        bad_rows: float = BAD_ROWS,
        source: str = "frame",
    ) -> Self:
        """Return the recording that a pandas DataFrame holds, by the rules that a file meets.

        Columns are known by their names, as in a file: the native ones (``time_s``, ``q_w``,
        ``omega_x_rad_s``, ``mass_<name>_mm``), those of other programs, and those of
        ``to_pandas``. Where no column is the time, an index of dates or of floats (s) is. NaN and
        None are no reading.

        Parameters
        ----------
        frame
            DataFrame; a named index counts as a column.
        columns
            Column map (TOML) for columns of other names; dates need no unit.
        bad_rows
            Share of the rows that may be left out as faulty; with more they are refused.
        source
            Name of the recording in sentences.

        Raises
        ------
        InputError
            For columns that are not known, that hold no numbers, or that a file is refused for.
        """
        return _maker().from_pandas(frame, columns=columns, bad_rows=bad_rows, source=source)
