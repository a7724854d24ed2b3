"""A reason: a code for programs, what it is about, its numbers in SI, and its sentence for people.

The sentence of a code is a template. It names the numbers with the unit and digits in which people
read them, ``{tilt:deg .1f}``, or takes the unit from a parameter, ``{sd:{2} .2g}``. ``{0}`` is the
first of the parameters, ``{names}`` all of them with commas, ``{both}`` with "and", ``{choices}``
with semicolons, ``{rest}`` all but the first. No program reads a sentence: it reads the code, whose
word belongs to one enumeration only.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from equipoise.model.units import DEG, MINUTE, MM, MN_M, MS, PERCENT, UM, UN_M

UNITS = {"": 1.0, "deg": DEG, "um": UM, "mm": MM, "ms": MS, "uN m": UN_M, "mN m s": MN_M,
         "%": PERCENT, "min": MINUTE, "kg m2": 1.0, "um/min": UM / MINUTE}  # fmt: skip
Number = int | float  # a count, or a quantity
LISTS = {"names": ", ", "both": " and ", "choices": "; "}
PLAIN = "plain"  # three digits, or whole where there are more before the point
WHOLE, MOST = 100.0, 1e6  # between them a plain number is whole, without an exponent


class Code(StrEnum):
    """A code of an enumeration, with its sentence beside it."""

    template: str

    def __new__(cls, value: str, template: str) -> "Code":
        """Make a member of its value and the sentence's template."""
        member = str.__new__(cls, value)
        member._value_ = value
        member.template = template
        return member


class Quantity(float):
    """A number in SI that is formatted in another unit: ``um .2g``."""

    def __format__(self, spec: str) -> str:
        """Return the number in the unit that is named first, with the digits that follow."""
        unit, _, digits = spec.rpartition(" ")
        value = float(self) / UNITS[unit]
        if digits == PLAIN:
            digits = ".0f" if WHOLE <= abs(value) < MOST else ".3g"
        return format(value, digits)


@dataclass(frozen=True, slots=True)
class Reason:
    """Why something came out as it did."""

    code: Code
    parameters: tuple[str, ...] = ()  # names: of estimated parameters, masses, devices, methods
    numbers: Mapping[str, Number] = field(default_factory=dict[str, Number])  # SI

    @property
    def sentence(self) -> str:
        """Return it for a person."""
        lists = {name: between.join(self.parameters) for name, between in LISTS.items()}
        lists["rest"] = ", ".join(self.parameters[1:])
        numbers = {name: Quantity(value) for name, value in self.numbers.items()}
        return self.code.template.format(*self.parameters, **lists, **numbers)


class Reasoned:
    """A record that reasons explain, the main one first."""

    __slots__ = ()
    reasons: tuple[Reason, ...]

    @property
    def sentence(self) -> str:
        """All of it for a person."""
        return sentence_of(self.reasons)


class Coded(Reasoned):
    """A record whose main reason stands for it."""

    __slots__ = ()

    @property
    def code(self) -> Code:
        """The main reason's."""
        return self.reasons[0].code


def one_reason(code: Code, *parameters: str, **numbers: Number) -> tuple[Reason, ...]:
    """Return one reason, as what comes of one; numbers are in SI."""
    return (Reason(code, parameters, numbers),)


def sentence_of(reasons: Iterable[Reason]) -> str:
    """Return several reasons for a person, one after the other."""
    return " ".join(reason.sentence for reason in reasons)


def distinct(reasons: Iterable[Reason]) -> tuple[Reason, ...]:
    """Return reasons without those that say again what one before them says."""
    found: list[Reason] = []
    for reason in reasons:
        if reason not in found:
            found.append(reason)
    return tuple(found)


def axes_of(name: str, values: Iterable[float]) -> dict[str, float]:
    """Return a vector as numbers named ``name_x``, ``name_y`` and ``name_z``."""
    return {f"{name}_{axis}": float(value) for axis, value in zip("xyz", values, strict=True)}
