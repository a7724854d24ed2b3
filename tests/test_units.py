"""One module says how large a unit is: nothing else holds a unit's size, under any name."""

import ast
import math
import re
from fractions import Fraction
from pathlib import Path

import pytest

from equipoise.io.toml.units import TO_SI
from equipoise.model import units

ROOT = Path(__file__).parents[1]
UNITS = ROOT / "src" / "equipoise" / "model" / "units.py"
PLACES = ("src", "tests", "verification", "benchmarks")
# Whole nanoseconds of a log's clock are counted in integers, which no size in SI can do exactly.
WHOLE_NANOSECONDS = {"io/formats/clock_units.py"}

SIZES = {name for name in vars(units) if name.isupper()}
OTHER_NAMES = {"MICRO", "NANO", "KILO", "MEGA", "KM", "HOUR", "MB", "MRAD"}
PER = re.compile(r"_?PER_[A-Z]+")
POWERS = {1e3, 1e6, 1e9, 1e-3, 1e-6, 1e-9}
IN_A_UNIT = re.compile(r".*_(um|mm|cm|deg|deg_s|g|ms|us|ns|uT|min|rpm)|um|mm|ms|us|deg")


def is_number(node: ast.expr) -> bool:
    """Say whether an expression is made of literals and pi alone."""
    leaves = (ast.Constant, ast.Name, ast.Attribute)
    found = [part for part in ast.walk(node) if isinstance(part, leaves)]
    return bool(found) and all(
        (isinstance(part, ast.Constant) and isinstance(part.value, int | float))
        or (isinstance(part, ast.Attribute) and part.attr == "pi")
        or (isinstance(part, ast.Name) and part.id in {"pi", "math", "np"})
        for part in found
    )


def pairs_of(tree: ast.Module) -> list[tuple[str, ast.expr]]:
    """Return every name that a module binds at its top, with its value."""
    found: list[tuple[str, ast.expr]] = []
    for node in tree.body:
        targets = node.targets if isinstance(node, ast.Assign) else []
        if isinstance(node, ast.AnnAssign) and node.value is not None:
            targets = [node.target]
        for target in targets:
            if isinstance(target, ast.Name):
                found.append((target.id, node.value))
            elif isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
                names = [n for n in target.elts if isinstance(n, ast.Name)]
                found += [(n.id, v) for n, v in zip(names, node.value.elts, strict=False)]
    return found


def unit_constants(source: str) -> list[str]:
    """Return the names of units to which a module gives a size of its own."""
    return [
        name
        for name, value in pairs_of(ast.parse(source))
        if (name.lstrip("_") in SIZES | OTHER_NAMES or PER.fullmatch(name)) and is_number(value)
    ]


def names_in(node: ast.AST) -> set[str]:
    names = {part.id for part in ast.walk(node) if isinstance(part, ast.Name)}
    return names | {part.attr for part in ast.walk(node) if isinstance(part, ast.Attribute)}


def is_half_turn(node: ast.BinOp) -> bool:
    """Say whether this is pi / 180 or 180 / pi."""
    sides = (node.left, node.right)
    return any(isinstance(s, ast.Constant) and s.value == 180 for s in sides) and any(
        "pi" in names_in(s) for s in sides
    )


def bare_factors(source: str) -> list[str]:
    """Return conversions by a bare literal: of a number named by its unit, or in a sentence."""
    tree = ast.parse(source)
    shown = {
        id(part)
        for text in ast.walk(tree)
        if isinstance(text, ast.FormattedValue)
        for part in ast.walk(text.value)
    }
    found: list[str] = []
    for node in ast.walk(tree):
        if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.Mult | ast.Div):
            continue
        for one, other in ((node.left, node.right), (node.right, node.left)):
            power = isinstance(one, ast.Constant) and one.value in POWERS
            named = any(IN_A_UNIT.fullmatch(name) for name in names_in(other))
            if power and (named or id(node) in shown):
                found.append(f"line {node.lineno}: {ast.unparse(node)}")
        if is_half_turn(node):
            found.append(f"line {node.lineno}: {ast.unparse(node)}")
    return found


def modules(*places: str) -> list[Path]:
    return [path for place in places for path in sorted((ROOT / place).rglob("*.py"))]


def excused(path: Path) -> bool:
    return path == UNITS or any(path.as_posix().endswith(each) for each in WHOLE_NANOSECONDS)


def test_no_other_module_defines_a_unit():
    found = {
        path.relative_to(ROOT).as_posix(): names
        for path in modules(*PLACES)
        if not excused(path) and (names := unit_constants(path.read_text(encoding="utf-8")))
    }
    assert not found, "import it from equipoise.model.units"


def test_no_bare_literal_converts_a_unit():
    found = {
        path.relative_to(ROOT).as_posix(): lines
        for path in modules("src")
        if not excused(path) and (lines := bare_factors(path.read_text(encoding="utf-8")))
    }
    assert not found, "multiply or divide by a unit of equipoise.model.units"


@pytest.mark.parametrize(
    "line",
    [
        "UM, MM, GRAM, MICRO = 1e6, 1e3, 1e3, 1e6",
        "PER_DEG = 180 / math.pi",
        "DEG = 0.017453292519943295",
        "DEG: float = np.pi / 180",
        "PERCENT = 100.0",
        "MILLI = 1e3",
        "PER_UT, PER_MS, PER_RPM = 1e6, 1e3, 30 / math.pi",
        "G_CM = 1e5  # g cm in a kg m",
    ],
)
def test_a_second_definition_of_a_unit_is_found(line):
    assert unit_constants(line)


@pytest.mark.parametrize(
    "line", ["DOWN = 100e-6", "TINY = 1e-9", "UM = read(1)", "MOST = 60 * DEG"]
)
def test_other_numbers_are_no_units(line):
    assert not unit_constants(line)


@pytest.mark.parametrize(
    "line",
    [
        'text = f"{1e6 * c:.1f} um"',
        "x = travel_mm * 1e-3",
        "x = {n: number(mm) * 1e-3 for n, mm in pairs}",
        "lever = exposure.lever_mm / 1e3",
        "tilt = 3.0 * (pi / 180)",
        "low = 180 / math.pi",
    ],
)
def test_a_bare_conversion_is_found(line):
    assert bare_factors(line)


@pytest.mark.parametrize(
    "line", ["order = 1.0 + 1e-3 * k", "x = travel_mm * MM", "t = 2 * math.pi / w", "y = a / 1e-9"]
)
def test_other_arithmetic_is_no_conversion(line):
    assert not bare_factors(line)


def test_a_number_is_read_as_the_double_nearest_to_it():
    """A product with the double 1e-3, which is not quite 1/1000, may be off by a last bit."""
    tenths = [k / 10 for k in range(1, 2000)]
    exact = [float(Fraction(x) / 1000) for x in tenths]
    assert [units.in_si(x, units.MM) for x in tenths] == exact
    assert [x * units.MM for x in tenths] != exact
    assert units.in_si(90.0, units.DEG) == pytest.approx(math.pi / 2)


@pytest.mark.parametrize(
    ("unit", "size"),
    [("um", units.UM), ("min", units.MINUTE), ("rpm", units.RPM), ("uN m", units.UN_M)],
)
def test_a_column_maps_units_are_those_of_the_module(unit, size):
    assert TO_SI[unit] == size
