"""`equipoise track`: attitudes from a video, pictures or a camera that shows a board of markers."""

import math
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import announced, counted, show_paths

if TYPE_CHECKING:
    from equipoise.app.runs.captures.camera_tracking import Track
    from equipoise.app.text.blocks import Blocks
    from equipoise.model.arrays import Vector3

CAMERAS = ("camera:", "http:")


def track(
    source: str,
    /,
    *,
    out: Path | None = None,
    board: Path | None = None,
    lens: Path | None = None,
    testbed: str | None = None,
    rate_hz: float | None = None,
    duration_s: float = 60.0,
    level: Flag = False,
) -> int:
    """Track a marker board in a video or from a camera, and record its attitude.

    Parameters
    ----------
    source
        Video file, folder of pictures, or a camera: camera:0, http://HOST:PORT/PATH.
    out
        Recording to write: .csv, .parquet, .mcap or .mat.
    board
        File with the board's keys, as `print-board` writes it.
    lens
        File with the lens parameters, as `calibrate-camera` writes it.
    testbed
        Testbed file with the camera's settings and alignment; --board and --lens take precedence.
    rate_hz
        Pictures per second, of a folder or of a video that states it wrongly.
    duration_s
        Duration of a camera recording.
    level
        The board lies level, face up: print the camera's vertical, for the settings.
    """
    from equipoise.app.arguments.checks import positive
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.runs.captures import camera_tracking
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.recording.format_registry import format_to_write
    from equipoise.io.recording.recording_file import write_recording
    from equipoise.model.errors import InputError

    if out is None and not level:
        raise InputError("--out", "nothing", "a recording to write, or --level")
    if out is not None:
        format_to_write(out)
        check_writable(out)
    bed = None if testbed is None else announced(testbed_from(testbed))
    unit = camera_tracking.unit_of(
        bed, [file for file in (board, lens) if file is not None], source
    )
    rate = positive("--rate-hz", rate_hz)
    duration = positive("--duration-s", duration_s)
    with counted("tracking") as on_progress:
        if source.startswith(CAMERAS):
            found = camera_tracking.watched_camera(unit, duration, on_progress)
        else:
            found = camera_tracking.tracked(Path(source), unit, rate, on_progress)
    recording = camera_tracking.recording_of_track(found, source)
    show(_track_blocks(found))
    if level:
        show(_up_blocks(*camera_tracking.up_from(found, unit)))
    if out is not None:
        write_recording(recording, out)
        show_paths([out])
    return 0


def _track_blocks(found: "Track") -> "Blocks":
    """Return how many pictures gave an attitude, and how well."""
    import numpy as np

    from equipoise.app.text.blocks import items, paragraphs

    lost = [f"{each.count} pictures: {each.reason.sentence}" for each in found.unseen]
    lost += [f"{found.broken} pictures damaged or dropped"] if found.broken else []
    stated = ""
    if found.sds:
        whole, common = (math.degrees(float(np.median(each))) for each in (found.sds, found.common))
        stated = (
            f"stated error of an attitude: {whole:.4f} deg per axis, median; "
            f"{common:.4f} deg of it is common to all pictures (board print)"
        )
    attitudes = f"an attitude was found in {len(found.t)} of {found.pictures} pictures"
    return (*paragraphs(attitudes, stated), *items(lost, "quiet"))


def _up_blocks(up: "Vector3", spread: float) -> "Blocks":
    """Return which way is up for the camera, as keys of its settings."""
    from equipoise.app.text.blocks import items, paragraphs

    keys = zip(("up_x", "up_y", "up_z"), up, strict=True)
    off = f"spread {math.degrees(spread):.3f} deg from picture to picture"
    return (*paragraphs(*(f"{key} = {value:.6f}" for key, value in keys)), *items((off,), "quiet"))
