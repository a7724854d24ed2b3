"""What stands in the files of a generated program for their placeholders, ``@NAME@``."""

import re
from collections.abc import Mapping, Sequence

from equipoise.model.arrays import Floats
from equipoise.onboard.sources.boards import STACK, verdicts
from equipoise.onboard.sources.translated import Translated, beginnings

WITHIN = 0.1  # chosen: of the stated sd, by which single precision may differ
ARGUMENTS = ("q", "rate", "d")


def filled(template: str, values: Mapping[str, str]) -> str:
    """Return a file with its placeholders replaced; what replaces them stays as it is."""
    return re.sub(r"@([A-Z_]+)@", lambda found: values[found[1]], template)


def shown(text: str) -> str:
    """Return a name that may stand in a comment of C: of one line, and no end of the comment."""
    return " ".join(text.replace("*/", "* /").replace("/*", "/ *").split())


def values_of(
    found: Translated, rows: Sequence[Floats], results: Sequence[Floats]
) -> dict[str, str]:
    """Return what stands for the placeholders; rows and results are the test vector."""
    masses = found.testbed.masses
    unused = [f"    (void){name};" for name in ARGUMENTS if not uses(found.call, name)]
    return {
        "METHOD": found.method,
        "LAW": found.law,
        "TESTBED": shown(found.testbed.name),
        "NAMES": ", ".join(shown(mass.name) for mass in masses),
        "MASSES": str(len(masses)),
        "FIELDS": "\n".join(
            f"    {each.kind.element.value} {each.name}[{each.kind.size}];" for each in found.fields
        ),
        "FUNCTIONS": found.functions,
        "BEGINNINGS": "\n".join(f"    {line}" for line in beginnings(found.fields)),
        "ENTRY": "\n".join([*unused, f"    {found.call}"]),
        "WITHIN": f"{WITHIN:g}",
        "ROWS": str(len(rows)),
        "ROW_WIDTH": str(8 + len(masses)),
        "RESULT_WIDTH": str(6 + len(masses)),
        "VECTOR_ROWS": numbers(rows),
        "VECTOR_RESULTS": numbers(results),
        "STATE_BYTES": str(found.state_bytes),
        "TABLE_BYTES": str(found.table_bytes),
        "STACK_BYTES": str(STACK[found.method]),
        "BOARDS": "\n".join(verdicts(found)),
    }


def uses(call: str, name: str) -> bool:
    """Say whether a call is given an argument of the row."""
    return re.search(rf"[(, ]{name}[,)]", call) is not None


def numbers(rows: Sequence[Floats]) -> str:
    """Return rows of numbers as C has them, exact to the last bit."""
    return ",\n".join("    {" + ", ".join(float(x).hex() for x in row) + "}" for row in rows)
