"""Column maps that are drawn, on tables as people have them: each is read, or refused.

Every key of a map is drawn, with values that it may have and some that it may not; columns are
mostly those of the table. The tables are the guises of a motion, cut to their first rows.
"""

import functools
import json
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.columns.read_options import AS_IT_IS, ReadOptions
from equipoise.io.dialects.dialects import DIALECTS
from equipoise.io.recording.recording_file import read_recording, read_table
from equipoise.io.toml.units import KINDS
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording
from tests.support.fuzz_target import folder
from tests.support.mutated_bytes import mutated
from tests.support.recordings import (
    clock_guises,
    frame_guises,
    reported_guises,
    row_guises,
    shape_guises,
    source_guises,
    unit_guises,
)
from tests.support.recordings.recorded_motion import Motion, turning
from tests.support.recordings.variant import Variant, variants_of

TEXTS = (clock_guises, frame_guises, reported_guises, row_guises, shape_guises, unit_guises)
FILES = (source_guises,)
CUT = frozenset({".csv", ".txt", ".dat"})
ROWS = 120  # of each table
SPOILT = 0.3  # share of the tables that are changed
AXES = ("x", "y", "z", "-x", "-y", "-z")
SEQUENCES = ("ZYX", "XYZ", "zyx", "ZXZ", "XXY", "yxz")
NUMBERS = (1.0, 1e-3, 0.0174533, 1e6, 1e-300, 1e300, 5e-324, 1.7e308)
Draw = np.random.Generator
Table = tuple[Path, tuple[str, ...]]  # a file, and its columns


def mapped_table(seed: bytes) -> None:
    """Read a table by a map, both drawn from a seed.

    What is read can be reckoned with; what is refused has a sentence.
    """
    rng = np.random.default_rng([len(seed), *seed])
    path, columns = tables()[rng.integers(len(tables()))]
    map_path = folder() / "map.toml"
    if rng.random() < SPOILT:
        content, path = mutated(path.read_bytes(), rng), folder() / f"spoilt{path.suffix}"
        path.write_bytes(content)
    keys = drawn_map(rng, columns)
    map_path.write_text("".join(f"{k} = {_toml(v)}\n" for k, v in keys.items()), "utf-8")
    try:
        read = read_recording(path, _options(rng, map_path))
    except InputError as error:
        said = (error.found, error.wanted)
    else:
        said = ("a recording",)
        _check(read)
    assert all(said)


def _check(read: Recording) -> None:
    """Times rise, and numbers are finite."""
    for channel in filter(None, (getattr(read, name) for name in CHANNELS)):
        assert np.all(np.diff(channel.t) > 0)
        assert np.isfinite(channel.t).all()
        assert np.isfinite(channel.values).all()


def _toml(value: Any) -> str:
    """Return a value as TOML, tables in one line: the package's writer takes ten times as long."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(value)


def _options(rng: Draw, map_path: Path) -> ReadOptions:
    share = _one(rng, (0.0, 0.05, 0.5, 1.0))
    kind = rng.random()
    if kind < 0.85:
        return ReadOptions(columns=read_column_map(map_path), bad_rows=share)
    if kind < 0.95:
        return ReadOptions(dialect=_one(rng, tuple(DIALECTS)), bad_rows=share)
    return ReadOptions(body="Platform", bad_rows=share)


@functools.cache
def tables() -> list[Table]:
    """Return the guises of a motion as files, cut to their first rows, and their columns."""
    whole = turning()
    few = replace(whole, t=whole.t[:ROWS], q=whole.q[:ROWS], w=whole.w[:ROWS])
    written = [(each, whole) for each in variants_of(*TEXTS)]
    written += [(each, few) for each in variants_of(*FILES)]
    return [table for each, motion in written if (table := _table(each, motion)) is not None]


def _table(variant: Variant, motion: Motion) -> Table | None:
    """Return the table of a guise; None if it is a folder."""
    with tempfile.TemporaryDirectory() as place:
        path = variant.write(motion, Path(place))
        if path.is_dir():
            return None
        content, kept = path.read_bytes(), folder() / f"{variant.name}{path.suffix}"
    if path.suffix in CUT and len(motion.t) > ROWS:
        content = b"".join(content.splitlines(keepends=True)[:ROWS])
    kept.write_bytes(content)
    return kept, _columns(kept)


def _columns(path: Path) -> tuple[str, ...]:
    """Return the columns of a table; of one that is none, those of a table without a header."""
    try:
        return read_table(path, AS_IT_IS)[0].names
    except InputError:
        return tuple(map(str, range(1, 9)))


def drawn_map(rng: Draw, names: tuple[str, ...]) -> dict[str, Any]:
    """Return the keys of a column map."""
    whole: dict[str, Any] = {
        "separator": (",", ";", "tab"),
        "decimal": (",", "."),
        "skip_rows": (0, 1, 2, 7, 500),
        "no_header": (True, False),
        "units_row": (True, False),
        "lab_up": AXES,
        "mean_of_frames": (True, False),
    }
    keys = {key: _one(rng, values) for key, values in whole.items() if rng.random() < 0.15}
    if rng.random() < 0.2:
        keys["body"] = _axes(rng)
    keys["time"] = _time(rng, names)
    if rng.random() < 0.85:
        keys["attitude"] = _attitude(rng, names)
    for key, kind in TRIADS.items():
        if rng.random() < (0.7 if key == "rate" else 0.08):
            keys[key] = _triad(rng, names, kind)
    return keys | _others(rng, names)


TRIADS = {
    "rate": "rate",
    "momentum": "momentum",
    "torque": "torque",
    "field": "magnetic",
    "accelerometer": "acceleration",
    "sun": "share",
}
REPORTS = {"wheel": "rate", "gimbal": "angle", "dipole": "dipole", "jet": "torque"}


def _time(rng: Draw, names: tuple[str, ...]) -> dict[str, Any]:
    column = names[0] if rng.random() < 0.7 and names[0] else _one_of(rng, names)
    if rng.random() < 0.2:
        return {"column": column, "format": _one(rng, ("ISO", "clock of the day"))}
    return {"column": column, "unit": _one(rng, KINDS["time"])}


def _attitude(rng: Draw, names: tuple[str, ...]) -> dict[str, Any]:
    turns = _one(rng, ("body to laboratory", "laboratory to body"))
    kind = rng.random()
    if kind < 0.6:
        order = _one(rng, ("wxyz", "xyzw"))
        return {"columns": _several(rng, names, 4, 1), "order": order, "turns": turns}
    if kind < 0.8:
        unit, sequence = _one(rng, KINDS["angle"]), _one(rng, SEQUENCES)
        signs = rng.choice([1, -1], 3).tolist()
        angles = {"columns": _several(rng, names, 3, 1), "unit": unit, "sequence": sequence}
        return angles | {"signs": signs, "compass": bool(rng.integers(2))}
    if kind < 0.9:
        unit = _one(rng, KINDS["angle"])
        return {"columns": _several(rng, names, 3, 1), "unit": unit, "kind": "rotation vector"}
    return {"columns": _several(rng, names, 9, 1), "turns": turns}


def _triad(rng: Draw, names: tuple[str, ...], kind: str) -> dict[str, Any]:
    keys: dict[str, Any] = {"columns": _several(rng, names, 3, 5), "unit": _one(rng, KINDS[kind])}
    if rng.random() < 0.2:
        keys["axes"] = _axes(rng)
    if rng.random() < 0.2:
        keys["factor"] = _one(rng, NUMBERS)
    if rng.random() < 0.2:
        keys["offset"] = _one(rng, (*NUMBERS, -1.0, [1.0, -1.7e308, 0.0]))
    return keys


def _others(rng: Draw, names: tuple[str, ...]) -> dict[str, Any]:
    """Return masses, devices, temperature and lamp, some of them."""
    keys: dict[str, Any] = {}
    if rng.random() < 0.1:
        unit = _one(rng, KINDS["length"])
        masses = [("x1", _one_of(rng, names)), (_one(rng, ("y1", "x1")), _one_of(rng, names))]
        keys["mass"] = [{"name": n, "column": c, "unit": unit} for n, c in masses]
    if rng.random() < 0.1:
        reports = _one(rng, tuple(REPORTS))
        unit = _one(rng, KINDS[REPORTS[reports]])
        device = {"name": "x", "reports": reports, "column": _one_of(rng, names), "unit": unit}
        keys["device"] = [device]
    if rng.random() < 0.05:
        keys["temperature"] = {"column": _one_of(rng, names), "unit": "degC"}
    if rng.random() < 0.05:
        keys["lamp"] = {"column": _one_of(rng, names)}
    return keys


def _several(rng: Draw, names: tuple[str, ...], count: int, begin: int) -> list[str]:
    """Return so many columns: mostly those in a row from a place on."""
    if rng.random() < 0.7 and begin + count <= len(names):
        return list(names[begin : begin + count])
    return [_one_of(rng, names) for _ in range(count)]


def _one_of(rng: Draw, names: tuple[str, ...]) -> str:
    return "none of them" if rng.random() < 0.02 else _one(rng, names)


def _axes(rng: Draw) -> list[str]:
    """Return three axes, mostly each letter once."""
    if rng.random() < 0.2:
        return [_one(rng, AXES) for _ in range(3)]
    return [("-" if rng.random() < 0.5 else "") + "xyz"[k] for k in rng.permutation(3)]


def _one(rng: Draw, values: Any) -> Any:
    return values[int(rng.integers(len(values)))]
