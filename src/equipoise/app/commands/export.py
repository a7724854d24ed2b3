"""`equipoise export`: the mass properties that a run found, in the file of another tool."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from equipoise.app.console.terminal import show_paths, stdout


def export(
    run: Path,
    /,
    *,
    to: Annotated[str, Parameter(required=True)],
    out: Path | None = None,
    testbed: str | None = None,
) -> int:
    """Write the mass properties that a run found for a simulator or another tool.

    Inertia is about the centre of mass, and the centre of mass from the centre of rotation P. The
    file states the sign of products, the inertia about P, and every standard deviation. Ends with 1
    when the run's estimate is not usable; the file says so too.

    Parameters
    ----------
    run
        Folder of a run of identify, balance, calibrate or inertia, or its JSON document.
    to
        urdf, sdf, mjcf, basilisk, 42, matlab, simulink, yaml, csv or ros.
    out
        File to write. If omitted: the run's name with the format's suffix, in this folder.
    testbed
        Testbed with the mass, for a document without testbed.toml beside it.
    """
    from equipoise.app.api.export import exported

    path, is_usable = exported(run, to, out, testbed)
    show_paths([path])
    if not is_usable:
        stdout().print("The estimate is not usable; the first lines of the file state the outcome.")
    return 0 if is_usable else 1
