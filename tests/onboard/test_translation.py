"""What is translated gives the same numbers in C, bit for bit; what cannot be is refused."""

import math
import re
import struct
import subprocess
from typing import NamedTuple

import numpy as np
import pytest

from equipoise.app.runs.generation import board_templates
from equipoise.onboard.translation.functions import new_unit
from equipoise.onboard.translation.literals import real_literal
from equipoise.onboard.translation.unit import NotTranslatable
from equipoise.onboard.translation.values import ArrayType, RecordType, Scalar, known_type
from tests.support.c_program import COMPILER, LONGEST, STRICT, needs_compiler

SIX = ArrayType(Scalar.REAL, (6,))
THREES = ArrayType(Scalar.REAL, (2, 3))
GAIN = 0.1
REAL, MACROS = (
    re.search(r"#ifdef EQUIPOISE_FLOAT\n.*?#endif\n", board_templates()[name], re.DOTALL)[0]
    for name in ("equipoise.h", "equipoise.c")
)


class Rig(NamedTuple):
    """A record with an array, a switch and a number."""

    m: np.ndarray
    doubled: bool
    size: float


def ordered(x, out):
    """Differences that rounding makes visible."""
    out[0] = x[0] + x[1] + x[2]
    out[1] = x[0] - (x[1] - x[2])
    out[2] = x[0] / x[1] / x[2]
    out[3] = x[0] * x[1] - x[2] * x[3]
    out[4] = -x[4] * GAIN + x[5] ** 0.5
    out[5] = x[0] / 3 + (1.0 * (x[1] < x[2])) - x[3] / (2 * 3)


def swapped(x, out):
    """Both sides are read before either is written."""
    a, b = x[0], x[1]
    a, b = b, a + b
    out[0], out[1] = a, b
    out[2], out[3] = x[2], x[3]
    out[2], out[3] = out[3], out[2]
    out[4] = out[5] = x[4] + a
    out[4] -= x[5]


def branched(x, out):
    """Branches, choices and chains of comparisons."""
    for k in range(6):
        y = x[k]
        if 0.25 < y <= 0.75:
            out[k] = 1.0 if k in (1, 3) else 2.0
        elif y > 0.75 and not (k == 2):  # noqa: SIM201 - to be translated
            out[k] = min(max(y, 0.8), 0.9, x[0])
        else:
            out[k] = abs(y - 1) * (k // 2)


def part_of(rows, k):
    """A tuple whose index is a variable."""
    v = (rows[0], rows[1], rows[2])
    return v[k] * 2, v[k - 1 + 1] + v[2]


def viewed(x, out):
    """Rows, parts and new arrays of a function's own."""
    own = np.zeros((2, 3))
    line = np.array([0.5, x[0], 2.0])
    for j in range(3):
        own[0, j], own[1, j] = x[j], x[3 + j] * line[j]
    for k in range(2):
        first, other = part_of(own[k], k)
        out[3 * k] = first
        out[3 * k + 1] = other
    tail = out[4:]
    tail[1] = own[-1, 2]
    out[2] = 0.0
    k = 0
    while k < 4:
        k += 1
        out[2] += 1 / k


def rigged(x, out, rig=None):
    """A record: its switch decides which branch there is."""
    turned = math.sin(x[0]) * rig.size
    matrix = rig.m if x[0] > 0.5 else rig.m  # noqa: RUF034 - to be translated
    for i in range(2):
        for j in range(3):
            out[3 * i + j] = rig.m[i, j] * turned + matrix[i, 0]
    if rig.doubled and x[0] > -1.0:
        out[0] *= 2
    rig.m[1, 2] = math.atan2(x[1], x[2])
    out[5] += rig.m[1, 2]


def program_of(function, more):
    """Return a program in C that prints what a function makes of six numbers, bit by bit."""
    unit = new_unit()
    entry = unit.instance(function, {"x": SIX, "out": SIX, **more})
    given = {"x": "x", "out": "out", "rig_m": "m"}
    call = f"{entry.name}({', '.join(given[leaf.name] for leaf in entry.leaves)});"
    return f"""
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
{REAL}
{MACROS}
{unit.text_for(entry.name, call)}
int main(int count, char **texts)
{{
    real_t x[6], out[6] = {{0}}, m[6] = {{R(0.5), R(1.5), R(2.5), R(3.5), R(4.5), R(5.5)}};
    (void)count;
    (void)m;
    for (int k = 0; k < 6; k++) {{
        x[k] = strtod(texts[k + 1], NULL);
    }}
    {call}
    for (int k = 0; k < 6; k++) {{
        printf("%a\\n", out[k]);
    }}
    return 0;
}}
"""


def bits(values):
    return [struct.pack("d", value) for value in values]


@needs_compiler
@pytest.mark.parametrize("function", [ordered, swapped, branched, viewed, rigged])
def test_c_gives_the_same_bits_as_python(function, tmp_path):
    more = {}
    if function is rigged:
        fields = (("m", THREES), ("doubled", known_type(True)), ("size", known_type(0.3)))
        more = {"rig": RecordType(Rig, fields)}
    (tmp_path / "a.c").write_text(program_of(function, more), encoding="utf-8")
    command = [COMPILER, *STRICT, "-O2", "a.c", "-o", "a", "-lm"]
    subprocess.run(command, cwd=tmp_path, timeout=LONGEST, check=True)
    rng = np.random.default_rng(3)
    for x in rng.uniform(0.0, 1.0, (20, 6)):
        out = np.zeros(6)
        rig = Rig(np.array([[0.5, 1.5, 2.5], [3.5, 4.5, 5.5]]), True, 0.3)
        function(x, out, *([rig] if more else []))
        said = subprocess.run(
            [tmp_path / "a", *(float(value).hex() for value in x)],
            capture_output=True, text=True, timeout=LONGEST, check=True,
        )  # fmt: skip
        assert bits(float.fromhex(line) for line in said.stdout.split()) == bits(out)


def test_a_switch_that_is_off_leaves_no_branch():
    unit = new_unit()
    fields = (("m", THREES), ("doubled", known_type(False)), ("size", known_type(0.3)))
    entry = unit.instance(rigged, {"x": SIX, "out": SIX, "rig": RecordType(Rig, fields)})
    text = unit.text_for(entry.name, "")
    assert "R(2.0)" not in text
    assert "R(0.3)" in text
    assert [leaf.name for leaf in entry.leaves] == ["x", "out", "rig_m"]
    assert entry.written == {"out", "rig_m"}


def test_what_is_only_read_is_const_and_what_is_not_read_is_not_passed():
    unit = new_unit()
    entry = unit.instance(swapped, {"x": SIX, "out": SIX})
    assert "const real_t *x, real_t *out" in unit.text_for(entry.name, "")


def with_a_list(x, out):
    out[0] = sum([x[0], x[1]])


def with_a_string(x, out):
    out[0] = float(f"{x[0]}")


def with_a_try(x, out):
    try:
        out[0] = 1 / x[0]
    except ZeroDivisionError:
        out[0] = 0.0


@pytest.mark.parametrize("function", [with_a_list, with_a_string, with_a_try])
def test_what_has_no_counterpart_is_refused_with_its_line(function):
    with pytest.raises(NotTranslatable, match="line 2"):
        new_unit().instance(function, {"x": SIX, "out": SIX})


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.1, "R(0.1)"), (-2, "(-R(2.0))"), (-0.0, "(-R(0.0))"), (np.inf, "R(INFINITY)"),
     (-np.inf, "(-R(INFINITY))"), (np.nan, "R(NAN)"), (1e-300, "R(1e-300)")],
)  # fmt: skip
def test_literals_are_exact(value, text):
    assert real_literal(value) == text
