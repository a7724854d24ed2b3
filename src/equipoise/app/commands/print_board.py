"""`equipoise print-board`: a board of markers, or a chessboard to calibrate with, at true size."""

from pathlib import Path

from equipoise.app.arguments.options import Flag, Whole
from equipoise.app.console.terminal import show_paths
from equipoise.model.units import MM


def print_board(
    *,
    out: Path,
    columns: Whole = 6,
    rows: Whole = 5,
    marker_mm: float = 40.0,
    gap_mm: float = 10.0,
    dictionary: str = "4X4_50",
    first_id: Whole = 0,
    spacing: float | None = None,
    square_mm: float | None = None,
    legacy: Flag = False,
    keys: Path | None = None,
) -> int:
    """Draw a marker board to print, for a platform under a camera.

    Measure a marker and a gap on the print, and enter what you measured in the settings.

    Parameters
    ----------
    out
        File to write: .pdf or .png.
    columns
        Markers from left to right; with --square-mm: squares. One column and one row: a single
        marker.
    rows
        Markers from top to bottom; with --square-mm: squares.
    marker_mm
        Side of a marker.
    gap_mm
        Gap between neighbours.
    dictionary
        4X4_50 or another dictionary of ArUco or AprilTag.
    first_id
        Id of the upper left marker; of an AprilGrid: of the lower left one.
    spacing
        Draw a Kalibr AprilGrid with this ratio of gap to tag; --gap-mm and --dictionary are
        ignored.
    square_mm
        Draw a chessboard with markers instead, for `calibrate-camera`, with squares of this side.
    legacy
        With --square-mm: the legacy pattern of OpenCV before 4.6.
    keys
        TOML file to write with the board's keys, for `track` and for settings.
    """
    from equipoise.app.arguments.checks import positive
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.figures.base.print_sheet import DPI, check_paper, write_paper
    from equipoise.app.text.blocks import paragraphs
    from equipoise.hardware.camera.aruco import Charuco, charuco_print
    from equipoise.hardware.camera.board_print import board_print
    from equipoise.hardware.camera.board_settings import board_of
    from equipoise.io.documents.camera_file import write_camera_keys
    from equipoise.io.files.atomic_file import check_writable

    check_paper(out)
    for path in (out, *(() if keys is None else (keys,))):
        check_writable(path)
    marker = positive("--marker-mm", marker_mm)
    if square_mm is not None:
        square = positive("--square-mm", square_mm)
        charuco = Charuco(dictionary, columns, rows, square * MM, marker * MM, legacy)
        write_paper(charuco_print(charuco, DPI), out)
        show_paths([out])
        return 0
    lattice = {"columns": columns, "rows": rows, "first_id": first_id, "marker_mm": marker}
    reported = lattice | (
        {"dictionary": dictionary, "gap_mm": gap_mm}
        if spacing is None
        else {"layout": "aprilgrid", "spacing": spacing}
    )
    board = board_of(reported, "print-board")
    write_paper(board_print(board, DPI), out)
    left, bottom, right, top = board.extent
    width, height = (right - left) / MM, (top - bottom) / MM
    show(paragraphs(f"{width:g} x {height:g} mm over all markers"))
    if keys is not None:
        write_camera_keys(reported, keys)
    show_paths([out] if keys is None else [out, keys])
    return 0
