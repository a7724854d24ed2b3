"""`equipoise convert`: a recording from one format into another."""

from pathlib import Path

from equipoise.app.arguments.options import WHOLE, Reading
from equipoise.app.console.terminal import show_paths


def convert(file: str, out: Path, /, *, reading: Reading = WHOLE) -> int:
    """Read a recording of any known format, and write it in another.

    Lines with '~' say what was set right or left aside. Events stay in the file that has them.

    Parameters
    ----------
    file
        Recording: CSV, Parquet, MCAP, MAT, a bag of ROS 1 or 2, or a log of PX4 (ULog).
    out
        File to write: .csv, .parquet, .mcap or .mat.
    """
    from equipoise.app.arguments.inputs import recording_of
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.blocks import items
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.recording.format_registry import format_to_write
    from equipoise.io.recording.recording_file import write_recording

    format_to_write(out)  # refuses a suffix before anything is read
    check_writable(out)
    recording = recording_of(file, reading)
    write_recording(recording, out)
    show(items((*recording.notes, *recording.gaps), "quiet"))
    show_paths([out])
    return 0
