"""Mass properties out of a text that a CAD program shows, saves or copies.

What is read are labels with numbers behind them, whatever stands between: mass, centre of mass, and
blocks of inertia (Ixx, Lxy, ...) under a heading that names their point and unit. Rows of three
labels with three numbers behind them are read too.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from equipoise.model.arrays import Floats, Vector3
from equipoise.model.errors import InputError
from equipoise.model.units import CM, GRAM, MM

Point = Literal["C", "origin"]
Notation = Literal["tensor", "integrals"]
WANTED = "mass, centre of mass and inertia with their units, as a CAD program shows them"
POUND, INCH, FOOT, TONNE = 0.45359237, 0.0254, 0.3048, 1000.0
SIX = ("xx", "yy", "zz", "xy", "xz", "yz")

MASSES = {"kilogram": 1.0, "kg": 1.0, "gram": GRAM, "g": GRAM, "pound": POUND, "lbmas": POUND,
          "lbm": POUND, "lb": POUND, "tonne": TONNE, "t": TONNE}  # fmt: skip
LENGTHS = {"millimeter": MM, "millimetre": MM, "mm": MM, "centimeter": CM, "centimetre": CM,
           "cm": CM, "meter": 1.0, "metre": 1.0, "m": 1.0, "inche": INCH, "inch": INCH, "in": INCH,
           "foot": FOOT, "feet": FOOT, "ft": FOOT}  # fmt: skip
NUMBER = r"(?<![A-Za-z0-9.^_])[-+\u2212]?(?:[0-9][0-9.,]*|[.][0-9]+)(?:[eE][-+]?[0-9]+)?"
NUMBERS = re.compile(NUMBER)
WORD = re.compile(r"[A-Za-z]+")
ELEMENT = re.compile(r"(?<![A-Za-z])[IL]_?([xyz][xyz])(?![A-Za-z])", re.IGNORECASE)
PRINCIPAL = re.compile(r"(?<![A-Za-z])(P[xyz]|I[123])(?![A-Za-z0-9])", re.IGNORECASE)
COORDINATE = re.compile(r"(?<![A-Za-z])([XYZ])(?![A-Za-z])", re.IGNORECASE)
CENTRE = re.compile(r"cent(?:er|re) of (?:mass|gravity)|centroid", re.IGNORECASE)
ORIGIN = re.compile(r"origin|output coordinate|global|coordinate frame", re.IGNORECASE)
INERTIA = re.compile(r"inertia|mass moments|principal moments", re.IGNORECASE)
REMARK = re.compile(r"\([^()\n]*%\s*\)")  # such as an error that Inventor prints behind a number
MASS = re.compile(rf"^\W*mass\s*[:=]?\s*({NUMBER})\s*([A-Za-z]+)", re.IGNORECASE)
STATED: dict[str, Notation] = {
    "positive tensor notation": "integrals",
    "negative tensor notation": "tensor",
}


@dataclass(slots=True)
class Block:
    """One tensor as printed, kg m^2, by its axes."""

    point: Point
    notation: Notation | None
    elements: dict[str, float] = field(default_factory=dict[str, float])

    @property
    def six(self) -> Floats:
        """The elements xx, yy, zz, xy, xz, yz."""
        return np.array([self.elements[key] for key in SIX])


@dataclass(slots=True)
class MassText:
    """What a text states, SI; products with the sign that is printed."""

    mass: float = np.nan
    com: dict[str, float] = field(default_factory=dict[str, float])
    blocks: list[Block] = field(default_factory=list[Block])
    principal: dict[str, float] = field(default_factory=dict[str, float])

    @property
    def centre(self) -> Vector3:
        """Centre of mass from the origin, m."""
        return np.array([self.com[axis] for axis in "xyz"])


@dataclass(frozen=True, slots=True)
class _Heading:
    """What the lines above say of the numbers below."""

    of: Literal["", "centre", "inertia"] = ""
    point: Point = "C"
    unit: float | None = None  # of the numbers below, in SI
    notation: Notation | None = None


def parse_mass_text(text: str, source: str) -> MassText:
    """Return what a text states; InputError for what it lacks."""
    found, heading, decimal = MassText(), _Heading(), decimal_mark(text)
    for line in REMARK.sub("", text).splitlines():
        before, heading = heading, _headed(heading, line)
        if heading is not before and heading.of == "inertia":
            found.blocks.append(Block(heading.point, heading.notation))
        _take(found, heading, line, decimal)
    found.blocks = [block for block in found.blocks if block.elements]
    _check(found, source)
    return found


def decimal_mark(text: str) -> str:
    """Return the decimal mark: a comma where no number has a point."""
    return "." if any("." in number for number in NUMBERS.findall(text)) else ","


def number_of(text: str, decimal: str) -> float:
    """Return a number; the mark that is not the decimal one groups its digits."""
    grouping = "," if decimal == "." else "."
    plain = text.replace("\u2212", "-").replace(grouping, "")
    return float(plain.replace(decimal, ".").rstrip("."))


def unit_in(text: str, kind: Literal["mass", "length", "inertia"]) -> float | None:
    """Return the first unit of a kind that a text names, in SI; of inertia: mass, then length."""
    words = [word.lower().rstrip("s") for word in WORD.findall(text)]
    if kind != "inertia":
        units = MASSES if kind == "mass" else LENGTHS
        return next((units[word] for word in words if word in units), None)
    for k, word in enumerate(words):
        length = next((LENGTHS[each] for each in words[k + 1 : k + 3] if each in LENGTHS), None)
        if word in MASSES and length is not None:
            return MASSES[word] * length**2
    return None


def labelled(label: re.Pattern[str], line: str, decimal: str) -> Iterator[tuple[str, float]]:
    """Yield labels with their numbers: each with the next one, or three with three behind them."""
    labels = list(label.finditer(line))
    if not labels:
        return
    ends = [*(each.start() for each in labels[1:]), len(line)]
    behind = [
        NUMBERS.findall(line[each.end() : end]) for each, end in zip(labels, ends, strict=True)
    ]
    if not any(behind[:-1]) and len(behind[-1]) >= len(labels):
        behind = [[number] for number in behind[-1][: len(labels)]]
    for each, numbers in zip(labels, behind, strict=True):
        if numbers:
            yield each.group(1).lower(), number_of(numbers[0], decimal)


def _headed(before: _Heading, line: str) -> _Heading:
    """Return the heading that counts from this line on."""
    is_bare = not ELEMENT.search(line) and not PRINCIPAL.search(line)
    if INERTIA.search(line) and is_bare:
        unit = unit_in(line, "inertia")
        says_more = unit is not None or CENTRE.search(line) or ORIGIN.search(line)
        above = _Heading() if says_more else before
        return _placed(replace(above, of="inertia", unit=unit or before.unit), line)
    if before.of == "inertia" and is_bare and (CENTRE.search(line) or ORIGIN.search(line)):
        return _placed(before, line)
    if CENTRE.search(line):
        return _Heading("centre", unit=unit_in(line, "length"))
    return before


def _placed(heading: _Heading, line: str) -> _Heading:
    """Return the heading with the point and the sign of products that a line names."""
    said = next((sign for words, sign in STATED.items() if words in line.lower()), None)
    point = "C" if CENTRE.search(line) else "origin" if ORIGIN.search(line) else heading.point
    return replace(heading, point=point, notation=said or heading.notation)


def _take(found: MassText, heading: _Heading, line: str, decimal: str) -> None:
    """Add what a line states."""
    mass = MASS.match(line)
    if mass is not None and mass.group(2).lower().rstrip("s") in MASSES:
        found.mass = number_of(mass.group(1), decimal) * (unit_in(mass.group(2), "mass") or 1.0)
    elif heading.of == "inertia":
        unit = unit_in(line, "inertia") or heading.unit or np.nan
        for axes, value in labelled(ELEMENT, line, decimal):
            found.blocks[-1].elements.setdefault("".join(sorted(axes)), value * unit)
        for name, value in labelled(PRINCIPAL, line, decimal):
            found.principal.setdefault(name, value * unit)
    elif heading.of == "centre":
        unit = unit_in(line, "length") or heading.unit or np.nan
        found.com |= {axis: value * unit for axis, value in _coordinates(line, decimal)}


def _coordinates(line: str, decimal: str) -> list[tuple[str, float]]:
    """Return x, y and z of a line: with their labels, or three numbers without."""
    stated = list(labelled(COORDINATE, line, decimal))
    plain = NUMBERS.findall(line)
    if stated or len(plain) != 3:
        return stated
    return [(axis, number_of(text, decimal)) for axis, text in zip("xyz", plain, strict=True)]


def _check(found: MassText, source: str) -> None:
    if not found.mass > 0:
        raise InputError(source, "no mass with its unit", WANTED)
    if len(found.com) != 3 or not np.isfinite(found.centre).all():
        raise InputError(source, "no centre of mass with its unit", WANTED)
    found.blocks = [block for block in found.blocks if set(SIX) <= set(block.elements)]
    if not found.blocks or not all(np.isfinite(block.six).all() for block in found.blocks):
        raise InputError(source, "no block of six elements of inertia with their unit", WANTED)
