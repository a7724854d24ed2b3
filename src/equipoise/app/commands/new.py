"""`equipoise new`: a preset as a file of one's own."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import stdout
from equipoise.model.errors import InputError


def new(
    preset: str = "sputnix",
    /,
    *,
    from_: Annotated[Path | None, Parameter(name="--from")] = None,
    products: Literal["tensor", "integrals"] | None = None,
    out: Path | None = None,
    force: Flag = False,
    schema: Flag = False,
) -> int:
    """Write a testbed file to start from.

    Parameters
    ----------
    preset
        Preset to start from, such as sputnix.
    from_
        File with mass properties to put into it: a text of SolidWorks, Fusion, Inventor, Creo,
        Onshape or FreeCAD, a URDF, SDF or MJCF file. Its origin is taken as the centre of rotation.
    products
        What products of inertia are in that text, where nothing shows it: elements of the tensor
        (J_xy = -integral of x y dm) or integrals.
    out
        File to write. Left out: PRESET.toml in this folder.
    force
        Write over a file that is already there.
    schema
        Print the JSON Schema of testbed files instead, for editors that check keys.
    """
    import json

    from equipoise.io.testbed.presets import preset_text
    from equipoise.io.testbed.testbed_file import json_schema, write_testbed

    if schema:
        stdout().out(json.dumps(json_schema(), indent=2), highlight=False)
        return 0
    text = preset_text(preset)
    found = ""
    if from_ is not None:
        from equipoise.io.exchange.body_file import read_foreign_body
        from equipoise.io.testbed.testbed_file import with_stated_body

        body, found = read_foreign_body(from_, products)
        text = with_stated_body(text, body, from_.name, preset)
    path = out or Path(f"{preset}.toml")
    if path.exists() and not force:
        raise InputError(str(path), "an existing file", "another --out, or --force")
    write_testbed(text, path)
    stdout().print(f"wrote {path}: replace the values marked 'assumed' by measured ones")
    if found:
        stdout().print(found)
    return 0
