"""`equipoise new`: a testbed file of one's own, from a preset or from five answers."""

from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import stdout
from equipoise.model.errors import InputError
from equipoise.model.units import MM

if TYPE_CHECKING:
    from equipoise.app.arguments.first_questions import FirstChoice
    from equipoise.app.console.questions import Question
    from equipoise.io.testbed.first_testbed import StatedRails

BASE = "sputnix"  # the preset that a body from a file goes into


def new(
    preset: str | None = None,
    /,
    *,
    from_: Annotated[Path | None, Parameter(name="--from")] = None,
    products: Literal["tensor", "integrals"] | None = None,
    out: Path | None = None,
    yes: Flag = False,
    force: Flag = False,
    schema: Flag = False,
) -> int:
    """Write a testbed file to start from.

    Without a preset and without --from, five questions at the terminal make the file.

    Parameters
    ----------
    preset
        Preset to start from, such as sputnix. With --from: sputnix if omitted.
    from_
        File with mass properties to put into it: a text of SolidWorks, Fusion, Inventor, Creo,
        Onshape or FreeCAD, a URDF, SDF or MJCF file. Its origin is taken as the centre of rotation.
    products
        What products of inertia are in that text, where nothing shows it: elements of the tensor
        (J_xy = -integral of x y dm) or integrals.
    out
        File to write. If omitted: PRESET.toml in this folder, or my.toml of the five answers.
    yes
        Take the default of each question, for scripts.
    force
        Write over a file that is already there.
    schema
        Print the JSON Schema of testbed files instead, for editors that check keys.
    """
    import json

    from equipoise.io.testbed.testbed_file import json_schema

    if schema:
        stdout().out(json.dumps(json_schema(), indent=2), highlight=False)
        return 0
    if preset is None and from_ is None:
        return _by_questions(_free(out or Path("my.toml"), force), yes)
    base = preset or BASE
    return _by_preset(base, from_, products, _free(out or Path(f"{base}.toml"), force))


def _free(path: Path, force: bool) -> Path:
    if path.exists() and not force:
        raise InputError(str(path), "a file that is already there", "another --out, or --force")
    return path


def _by_preset(
    preset: str, from_: Path | None, products: Literal["tensor", "integrals"] | None, path: Path
) -> int:
    """Write a preset, with the body of a file if there is one."""
    from equipoise.io.testbed.presets import preset_text
    from equipoise.io.testbed.testbed_file import write_testbed

    text, found = preset_text(preset), ""
    if from_ is not None:
        from equipoise.io.exchange.body_file import read_foreign_body
        from equipoise.io.testbed.testbed_file import with_stated_body

        body, found = read_foreign_body(from_, products)
        text = with_stated_body(text, body, from_.name, preset)
    write_testbed(text, path)
    _say_written(path)
    if found:
        stdout().print(found)
    return 0


def _by_questions(path: Path, yes: bool) -> int:
    """Write what five answers state, and say which command comes next."""
    from equipoise.app.arguments.first_questions import first_choice
    from equipoise.app.console.questions import answered, is_person_there
    from equipoise.io.testbed.first_testbed import first_testbed
    from equipoise.io.testbed.testbed_file import write_testbed

    if not yes and not is_person_there():
        wanted = "a preset, such as `equipoise new sputnix`, or --yes for the defaults"
        raise InputError("equipoise new", "no terminal to ask five questions", wanted)
    choice = first_choice(_default if yes else answered)
    write_testbed(first_testbed(choice.answers), path)
    _say_written(path)
    for line in _next(choice, path):
        stdout().print(line, soft_wrap=True)
    return 0


def _default(question: "Question[Any]", _number: int) -> Any:
    return question.read(question.default)


def _say_written(path: Path) -> None:
    stdout().print(f"wrote {path}: what is marked 'assumed' is yours to measure")


def _next(choice: "FirstChoice", path: Path) -> tuple[str, ...]:
    """Return the commands that come next."""
    from equipoise.app.arguments.first_questions import ON_BENCH, SIMULATED

    bed = quote(str(path))
    if choice.origin == ON_BENCH:
        return ("next: state the ports in [hardware] (docs/real-bench.md), then",
                f"  equipoise check {bed}")  # fmt: skip
    if choice.origin != SIMULATED:
        return ("next:",
                f"  equipoise import {quote(str(choice.origin))} --testbed {bed} --out run.csv",
                f"  equipoise identify run.csv --testbed {bed} --prior")  # fmt: skip
    move, prior = _first_move(choice.answers.rails)
    return ("next:", f"  equipoise simulate {bed} --out run.csv --duration-s 60{move}",
            f"  equipoise identify run.csv --testbed {bed}{prior}")  # fmt: skip


def _first_move(rails: "StatedRails") -> tuple[str, str]:
    """Return the options by which the scale is determined: a known move down, or the prior."""
    down = [name for name in rails.names if name.startswith("z")]
    targets = " ".join(f"{name}={-rails.travel / 2 / MM:g}" for name in down)
    return (f' --move "30: {targets}"', "") if down else ("", " --prior")
