"""Files that describe a board of markers or a lens, both ways: flat TOML.

The same keys stand in a testbed file under [hardware.sensor.settings] of a sensor with the driver
camera; ``hardware.camera.eye`` says what they mean.
"""

from collections.abc import Mapping
from pathlib import Path

from equipoise.io.files.atomic_file import write_whole
from equipoise.io.toml.key_types import Positive, Table
from equipoise.io.toml.read_toml import read_toml
from equipoise.io.toml.write_toml import Value, toml_text
from equipoise.model.hardware import Setting

WANTED = "a TOML file with the keys of a board or a lens"


class Tag(Table):
    """One tag of a board whose tags were measured."""

    id: int
    x_mm: float
    y_mm: float
    z_mm: float | None = None
    rotation_deg: float | None = None
    marker_mm: Positive


class CameraKeys(Table):
    """Any of the keys."""

    layout: str | None = None
    dictionary: str | None = None
    columns: int | None = None
    rows: int | None = None
    first_id: int | None = None
    marker_mm: Positive | None = None
    gap_mm: Positive | None = None
    spacing: Positive | None = None
    place_sd_mm: Positive | None = None
    tag: list[Tag] | None = None
    width_px: int | None = None
    height_px: int | None = None
    fx_px: Positive | None = None
    fy_px: Positive | None = None
    cx_px: float | None = None
    cy_px: float | None = None
    k1: float | None = None
    k2: float | None = None
    p1: float | None = None
    p2: float | None = None
    k3: float | None = None
    rms_px: float | None = None
    up_x: float | None = None
    up_y: float | None = None
    up_z: float | None = None


def read_camera_keys(path: Path) -> dict[str, Setting]:
    """Return the keys of a file."""
    keys = read_toml(path, CameraKeys, WANTED)
    found: dict[str, Setting] = keys.model_dump(exclude_none=True, exclude={"tag"})
    if keys.tag is not None:
        found["tag"] = tuple(tag.model_dump(exclude_none=True) for tag in keys.tag)
    return found


def write_camera_keys(keys: Mapping[str, Value], path: Path) -> None:
    """Write keys to a file, whole or not at all."""
    write_whole(path, toml_text(keys))
