"""`equipoise new`: a preset as a file of one's own."""

from pathlib import Path

from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import stdout
from equipoise.model.errors import InputError


def new(
    preset: str = "sputnix",
    /,
    *,
    out: Path | None = None,
    force: Flag = False,
    schema: Flag = False,
) -> int:
    """Write a preset testbed to a file, to start one's own from.

    Parameters
    ----------
    preset
        Name of the preset, such as sputnix.
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
    path = out or Path(f"{preset}.toml")
    if path.exists() and not force:
        raise InputError(str(path), "a file that is already there", "another --out, or --force")
    write_testbed(text, path)
    stdout().print(f"wrote {path}: what is marked 'assumed' is yours to measure")
    return 0
