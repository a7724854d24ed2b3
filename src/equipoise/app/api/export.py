"""Export: the mass properties that a run found, in the files of other tools."""

from pathlib import Path

from equipoise.app.arguments.checks import one_of
from equipoise.app.arguments.inputs import AnyTestbed, testbed_from
from equipoise.io.exchange.body_formats import FORMATS
from equipoise.io.exchange.result_file import read_body
from equipoise.io.files.atomic_file import write_whole
from equipoise.model.stated_body import StatedBody


def export(
    run: str | Path, to: str, out: str | Path | None = None, *, testbed: AnyTestbed | None = None
) -> StatedBody:
    """Write the mass properties that a run found for another tool, and return them.

    Inertia is about the centre of mass, as every simulator wants it; both points and all sd stand
    in the file's comment. The mass is the testbed's, taken as independent of the rest.

    Parameters
    ----------
    run
        Folder of a run, or its JSON document.
    to
        urdf, sdf, mjcf, basilisk, 42, matlab, simulink, yaml, csv or ros.
    out
        File to write. None: the run's name with the format's suffix, in this folder.
    testbed
        Testbed with the mass, for a document without testbed.toml beside it.

    Raises
    ------
    InputError
        For a run without an estimate, without a mass, or with an inertia that no body can have.
    """
    form = FORMATS[one_of("to", to, list(FORMATS))]
    bed = None if testbed is None else testbed_from(testbed)
    stated, _ = read_body(run, bed)
    write_whole(out or f"{stated.name}{form.suffix}", form.write(stated))
    return stated
