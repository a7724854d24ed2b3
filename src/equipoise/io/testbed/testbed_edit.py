"""A testbed file's text with other drives of its masses; comments and all else stay as they are.

Keys that change are lines of their own within a mass's table: the old line goes, the new one stands
in its place or at the table's end. The text is read back before it counts, so that a layout that
this does not understand (a list of inline tables, say) is told and nothing is written.
"""

import json
import re
from itertools import pairwise

import numpy as np

from equipoise.io.testbed.testbed_file import parse_testbed
from equipoise.io.toml.write_toml import Value, number, numbers
from equipoise.model.errors import InputError
from equipoise.model.testbed import SlidingMass, Testbed

TABLE = re.compile(r"^\s*\[\[\s*sliding_mass\s*\]\]")
HEAD = re.compile(r"^\s*\[{1,2}\s*[A-Za-z_][\w.\s]*\]{1,2}\s*(#.*)?$")
PER_MM = 1e3
SAME = 1e-12  # relative, chosen: far below what any calibration tells


def with_drives(text: str, testbed: Testbed, remarks: dict[str, str], source: str) -> str:
    """Return the text with gain, axis and backlash of a testbed's masses, each with its remark.

    ``remarks`` are by key and mass: 'gain x1'. InputError if the text cannot be edited so.
    """
    stated = parse_testbed(text, source)
    lines, index = list[str](), -1
    for block in blocks_of(text):
        if TABLE.match(block[0]) and index + 1 < len(stated.masses):
            index += 1
            lines += edited(block, stated.masses[index], testbed.masses[index], remarks)
        else:
            lines += block
    new = "\n".join(lines) + "\n"
    check(parse_testbed(new, source), testbed, source)
    return new


def blocks_of(text: str) -> list[list[str]]:
    """Return the lines of each table, and those before the first."""
    lines = text.splitlines()
    starts = [0, *(k for k, line in enumerate(lines) if k and HEAD.match(line)), len(lines)]
    return [lines[a:b] for a, b in pairwise(starts) if b > a]


def edited(
    block: list[str], before: SlidingMass, after: SlidingMass, remarks: dict[str, str]
) -> list[str]:
    """Return the lines of one mass's table with what changed."""
    for key, value in changes(before, after).items():
        remark = remarks.get(f"{key} {after.name}", "")
        line = f"{key} = {json.dumps(value)}" + (f"  # {remark}" if remark else "")
        at = [k for k, old in enumerate(block) if re.match(rf"\s*{key}\s*=", old)]
        place = at[0] if at else last_key(block) + 1
        block = [*block[:place], line, *block[place + len(at) :]]
    return block


def last_key(block: list[str]) -> int:
    """Return the last line of a table that is neither empty nor a comment."""
    reported = [
        k for k, line in enumerate(block) if line.strip() and not line.lstrip().startswith("#")
    ]
    return reported[-1]


def changes(before: SlidingMass, after: SlidingMass) -> dict[str, Value]:
    """Return the keys of a mass that differ, as they are written."""
    found: dict[str, Value] = {}
    if after.gain != before.gain:
        found["gain"] = number(after.gain)
    if not np.array_equal(after.axis, before.axis):
        found["axis"] = numbers(after.axis)
    if after.backlash != before.backlash:
        found["backlash_mm"] = number(after.backlash, PER_MM)
    return found


def check(read: Testbed, wanted: Testbed, source: str) -> None:
    """Raise InputError unless the masses read are those wanted."""
    for found, mass in zip(read.masses, wanted.masses, strict=True):
        pairs = ((found.gain, mass.gain), (found.backlash, mass.backlash))
        near = all(abs(a - b) <= SAME + SAME * abs(b) for a, b in pairs)
        if not near or not np.allclose(found.axis, mass.axis, rtol=0, atol=SAME):
            raise InputError(f"{source}: sliding_mass '{mass.name}'", "a layout that cannot be "
                             "edited", "one key on each line of [[sliding_mass]]")  # fmt: skip
