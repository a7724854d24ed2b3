"""`equipoise calibrate-camera`: a lens from pictures of a chessboard with markers."""

from pathlib import Path

from equipoise.app.arguments.options import Flag, Whole
from equipoise.app.console.terminal import counted, show_paths
from equipoise.model.units import MM


def calibrate_camera(
    *pictures: Path,
    out: Path,
    columns: Whole = 8,
    rows: Whole = 6,
    square_mm: float = 30.0,
    marker_mm: float = 22.0,
    dictionary: str = "4X4_50",
    legacy: Flag = False,
) -> int:
    """Calibrate a camera lens from pictures of a ChArUco board.

    Take about 15 pictures with the board filling half of the picture, in all parts of it, tilted by
    20 to 40 deg each way. Keep lens, focus and picture size as they will be used.

    Parameters
    ----------
    pictures
        Picture files, or folders of them.
    out
        TOML file to write, with the lens parameters.
    columns
        Squares of the chessboard from left to right.
    rows
        Squares from top to bottom.
    square_mm
        Side of a square, measured on the print.
    marker_mm
        Side of a marker.
    dictionary
        Marker dictionary: 4X4_50 or another of ArUco or AprilTag.
    legacy
        The print has the legacy pattern, as drawn by OpenCV before 4.6 and by other tools.
    """
    from equipoise.app.arguments.checks import positive
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.runs.captures.lens_calibration import lens_from_files
    from equipoise.app.text.blocks import paragraphs
    from equipoise.hardware.camera.aruco import Charuco
    from equipoise.hardware.camera.eye import settings_of_lens
    from equipoise.io.documents.camera_file import write_camera_keys
    from equipoise.io.files.atomic_file import check_writable

    check_writable(out)
    square, marker = positive("--square-mm", square_mm), positive("--marker-mm", marker_mm)
    board = Charuco(dictionary, columns, rows, square * MM, marker * MM, legacy)
    with counted("finding the board") as on_progress:
        found = lens_from_files(pictures, board, on_progress)
    write_camera_keys(settings_of_lens(found.lens), out)
    lens, sd = found.lens, found.focal_sd
    show(
        paragraphs(
            f"{found.views} pictures used, corners fit to {lens.rms:.3f} px",
            f"focal length {lens.fx:.1f} and {lens.fy:.1f} px, one sd {sd:.1f} px",
        )
    )
    show_paths([out])
    return 0
