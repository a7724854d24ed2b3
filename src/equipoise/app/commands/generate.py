"""`equipoise generate`: estimator and law as a program for a micro-controller."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from equipoise.app.arguments.options import Triple
from equipoise.app.console.terminal import announced, show_paths, stdout


def generate(
    language: str,
    /,
    *,
    method: Annotated[str, Parameter(required=True)],
    law: Annotated[str, Parameter(required=True)],
    testbed: Annotated[str, Parameter(required=True)],
    out: Annotated[Path, Parameter(required=True)],
    target_um: Triple = (0.0, 0.0, -100.0),
) -> int:
    """Write estimator and law as C99 for a micro-controller.

    The program takes rows of attitude, rate and mass displacements, and returns the centre of mass
    and the displacements that the masses should have. It uses no heap. A test vector and a CMake
    file are written beside it. Two test programs run on a computer. See docs/microcontroller.md.

    Parameters
    ----------
    language
        Language of the program: c.
    method
        ekf_9 or momentum_recursive.
    law
        pid or ivanov_25s.
    testbed
        Testbed file, or a preset's name. Its numbers become constants of the program.
    out
        Folder to write into.
    target_um
        Target of the centre of mass from the centre of rotation, as in `equipoise balance`.
    """
    from equipoise.app.arguments.checks import one_of, vector
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.app.runs.generation import generate as generated
    from equipoise.model.units import UM
    from equipoise.onboard.program.board import LAWS, METHODS

    one_of("language", language, ["c"])
    method, law = one_of("--method", method, list(METHODS)), one_of("--law", law, list(LAWS))
    target = vector("--target-um", target_um, UM)
    found = generated(method, law, announced(testbed_from(testbed)), target, out)
    show_paths(found.paths)
    stdout().print("RAM in single precision:")
    for line in found.boards:
        stdout().print(line.removeprefix("- "))
    return 0
