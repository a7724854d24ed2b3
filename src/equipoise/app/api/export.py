"""Export: the mass properties that a run found, in the files of other tools."""

from pathlib import Path

from equipoise.app.arguments.checks import one_of
from equipoise.app.arguments.inputs import AnyTestbed, testbed_from
from equipoise.io.exchange.body_formats import FORMATS
from equipoise.io.exchange.result_file import read_body
from equipoise.io.files.atomic_file import write_whole


def export(
    run: str | Path, to: str, out: str | Path | None = None, *, testbed: AnyTestbed | None = None
) -> Path:
    """Write the mass properties that a run found for another tool, and return the file's path.

    Inertia is about the centre of mass, as simulators want it; the file states the inertia about P,
    the sign of products and every sd, too. The mass is the testbed's, taken as independent of the
    rest.

    Parameters
    ----------
    run
        Folder of a run of ``identify``, ``balance``, ``calibrate`` or ``inertia``, or its JSON
        document.
    to
        urdf, sdf, mjcf, basilisk, 42, matlab, simulink, yaml, csv or ros.
    out
        File to write. None: the run's name with the format's suffix, in this folder.
    testbed
        Testbed with the mass, for a document without testbed.toml beside it.

    Raises
    ------
    InputError
        For a run without an estimate, without a mass, or with a physically inconsistent inertia.
    """
    return exported(run, to, out, testbed)[0]


def exported(
    run: str | Path, to: str, out: str | Path | None, testbed: AnyTestbed | None
) -> tuple[Path, bool]:
    """Return the path that ``export`` wrote, and whether the estimate is usable."""
    form = FORMATS[one_of("to", to, list(FORMATS))]
    stated, is_usable = read_body(run, None if testbed is None else testbed_from(testbed))
    path = Path(out or f"{stated.name}{form.suffix}")
    write_whole(path, form.write(stated))
    return path, is_usable
