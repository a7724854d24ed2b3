"""Which columns may be the attitude: four whose squares add up to one, or three angles.

Of four columns each may be the scalar, and the turn may be of body or of laboratory components. An
order of the vector's components other than the table's is a relabelling of axes (and, if it is
left-handed, the other direction), so it is no hypothesis of its own.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from equipoise.assessment.hypotheses.number_table import NumberTable, varies, words_of
from equipoise.maths.attitude import conjugate, exponential, multiply, normalise
from equipoise.model.arrays import Floats, Series1, Series4
from equipoise.model.units import DEG

UNIT = 0.02  # by which a length may miss one (chosen)
MOST = 14  # columns up to which any four are tried; beyond, neighbours alone (chosen)
SIGNS = [(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]
SEQUENCES = ("ZYX", "XYZ", "ZXY", "YXZ", "XZY", "YZX")
# Words of angles about the first, the second and the third axis.
ANGLE_WORDS = (
    frozenset({"roll", "phi", "bank", "rx"}),
    frozenset({"pitch", "theta", "elevation", "ry"}),
    frozenset({"yaw", "psi", "heading", "azimuth", "rz"}),
)
TURN = 2 * np.pi
WORSE, ROUNDED = 5.0, 1e-4  # of lengths' sd, up to which four columns are as good (chosen)


@dataclass(frozen=True, slots=True)
class AttitudeGuess:
    """Columns that may be the attitude, and how they are read."""

    columns: tuple[str, ...]  # of a quaternion in the table's order, or three angles
    scalar: int = 0  # of a quaternion: which of the four is w
    inverse: bool = False  # the table's turn takes laboratory into body components
    sequence: str = ""  # of angles, as in SciPy
    degrees: bool = False
    signs: tuple[int, int, int] = (1, 1, 1)

    @property
    def order(self) -> str:
        """Return the order of a quaternion's four columns, such as 'xyzw'."""
        letters = iter("xyz")
        return "".join("w" if k == self.scalar else next(letters) for k in range(4))

    @property
    def named_as_read(self) -> bool:
        """Say whether the columns' names do not speak against the order."""
        last = [words_of(name)[-1:] for name in self.ordered]
        letters = [word[0][-1] for word in last if word]
        return letters == list("wxyz") or not set("wxyz") <= set(letters)

    @property
    def ordered(self) -> tuple[str, ...]:
        """Return the columns of a quaternion, scalar first."""
        rest = [name for k, name in enumerate(self.columns) if k != self.scalar]
        return (self.columns[self.scalar], *rest)


def quaternion_sets(table: NumberTable) -> list[tuple[str, ...]]:
    """Return sets of four columns whose squares add up to one, in the table's order."""
    small = [n for n in table.names if _is_component(table.column(n))]
    fours = combinations(small, 4) if len(small) <= MOST else _neighbours(small)
    found = [four for four in fours if _is_unit(table, four)]
    spread = {four: norm_sd(table, four) for four in found}
    least = min(spread.values(), default=0.0)
    return [four for four in found if spread[four] <= max(WORSE * least, ROUNDED)]


def norm_sd(table: NumberTable, columns: tuple[str, ...]) -> float:
    """Return the sd of the lengths of a quaternion's rows, those near one."""
    values = np.stack([table.column(name) for name in columns], axis=1)
    length = np.linalg.norm(values[np.isfinite(values).all(axis=1)], axis=1)
    return float(np.std(length[np.abs(length - 1) < UNIT]))


def quaternion_guesses(columns: tuple[str, ...]) -> Iterator[AttitudeGuess]:
    """Yield the readings of four columns."""
    for scalar, inverse in product(range(4), (False, True)):
        yield AttitudeGuess(columns, scalar, inverse)


def angle_sets(table: NumberTable) -> list[tuple[str, ...]]:
    """Return sets of three columns that are named as angles, in the order roll, pitch, yaw."""
    named = [n for n in table.names if varies(table.column(n))]
    by_axis = [[n for n in named if set(words_of(n)) & words] for words in ANGLE_WORDS]
    return list(zip(*by_axis, strict=False))


def angle_guesses(table: NumberTable, columns: tuple[str, ...]) -> Iterator[AttitudeGuess]:
    """Yield the readings of three angles: orders, signs and units.

    The other direction is the reverse order with all signs changed, so it is among them.
    """
    values = np.stack([table.column(name) for name in columns], axis=1)
    largest = float(np.nanmax(np.abs(values)))
    stated = {word for name in columns for word in (*words_of(name), table.unit(name))}
    units = (True, False) if largest <= TURN else (True,)
    if stated & {"deg", "degree", "degrees"}:
        units = (True,)
    elif stated & {"rad", "radian", "radians"}:
        units = (False,)
    for degrees, sequence, sign in product(units, SEQUENCES, SIGNS):
        yield AttitudeGuess(columns, 0, False, sequence, degrees, sign)


def attitude_of(table: NumberTable, guess: AttitudeGuess) -> Series4:
    """Return the attitude (n, 4), scalar first, body to laboratory; NaN where there is none."""
    if guess.sequence:
        q = _from_angles(table, guess)
    else:
        q = np.stack([table.column(name) for name in guess.ordered], axis=1)
    length = np.linalg.norm(q, axis=1)
    good = np.abs(length - 1) < 0.05
    q = normalise(np.where(good[:, None], q, np.array([1.0, 0.0, 0.0, 0.0])))
    q[~good] = np.nan
    return conjugate(q) if guess.inverse else q


def _from_angles(table: NumberTable, guess: AttitudeGuess) -> Series4:
    unit = DEG if guess.degrees else 1.0
    turns: dict[str, Floats] = {}
    for letter, name, sign in zip("XYZ", guess.columns, guess.signs, strict=True):
        angle = table.column(name) * unit * sign
        turns[letter] = exponential(angle[:, None] * np.eye(3)["XYZ".index(letter)])
    first, second, third = (turns[letter] for letter in guess.sequence)
    return multiply(first, multiply(second, third))


def _is_component(values: Floats) -> bool:
    finite = values[np.isfinite(values)]
    return len(finite) > 2 and float(np.quantile(np.abs(finite), 0.9)) <= 1 + UNIT


def _is_unit(table: NumberTable, columns: tuple[str, ...]) -> bool:
    values: Floats = np.stack([table.column(name) for name in columns], axis=1)
    full = np.isfinite(values).all(axis=1)
    if full.sum() < 3:
        return False
    kept: Floats = values[full]
    misses: Series1 = np.abs(np.linalg.norm(kept, axis=1) - 1)
    return _moves(kept) and float(np.quantile(misses, 0.9)) < UNIT


def _moves(values: Floats) -> bool:
    return bool(np.any(values != values[0]))


def _neighbours(names: list[str]) -> Iterator[tuple[str, ...]]:
    return (tuple(names[k : k + 4]) for k in range(len(names) - 3))
