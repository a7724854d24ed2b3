"""`equipoise inertia`: mass properties from a list of parts and from swings about known axes."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Flag, Json
from equipoise.app.console.terminal import announced, print_whole, show_paths
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.model.mass_budget import MassBudget
    from equipoise.model.testbed import Testbed


def inertia(
    parts: Path | None = None,
    /,
    *,
    testbed: str | None = None,
    write: Path | None = None,
    schema: Flag = False,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Sum a list of parts to mass properties, and combine them with swing tests.

    Exit code 1: no body can have these properties, swings and parts contradict each other, or
    swings leave part of an unknown inertia open; then nothing is written.

    Parameters
    ----------
    parts
        Parts file (TOML): everything that floats, masses at home included, and its swing tests.
    testbed
        Testbed file, or a preset's name, that receives the mass properties.
    write
        Testbed file to write; comments are kept.
    schema
        Print the JSON Schema of parts files instead, for editors that check keys.
    out
        Folder for report and inertia.json, with the testbed and this body.
    """
    if schema:
        return _print_schema()
    if parts is None:
        raise InputError("inertia", "no parts file", "a file, or --schema for its format")
    if testbed is None and (write is not None or out is not None):
        wanted = "the testbed of these mass properties"
        raise InputError("--write and --out", "no --testbed", wanted)
    from equipoise.app.api.inertia import inertia as summed
    from equipoise.app.arguments.checks import check_outputs
    from equipoise.app.logbook.output import hand_over
    from equipoise.app.views.inertia_views import output_of

    check_outputs(out, write)
    found = summed(parts)
    bed, text = (None, "") if testbed is None else _with_body(found, testbed)
    hand_over(output_of(found, bed), json, out)
    if not found.is_whole:
        return 1
    if write is not None:
        from equipoise.io.files.atomic_file import write_whole

        write_whole(write, text)
        show_paths([write], json)
    return 0


def _print_schema() -> int:
    """Print the JSON Schema of parts files."""
    from equipoise.app.text.json_document import dump
    from equipoise.io.documents.parts_file import parts_schema

    print_whole(dump(parts_schema()))
    return 0


def _with_body(found: "MassBudget", name: str) -> "tuple[Testbed, str]":
    """Return the testbed with the mass properties found, and its text; as it is if part is open."""
    from equipoise.app.arguments.inputs import testbed_from, testbed_text_of
    from equipoise.io.testbed.testbed_file import parse_testbed, with_body

    bed, text = announced(testbed_from(name)), testbed_text_of(name)
    if not found.is_whole:
        return bed, text
    text = with_body(text, found.estimate, found.body.inertia_C, name)
    return parse_testbed(text, name), text
