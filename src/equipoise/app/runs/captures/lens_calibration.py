"""A lens from picture files: what `equipoise calibrate-camera` does."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from equipoise.hardware.camera.aruco import Charuco, Picture, chess_views
from equipoise.hardware.camera.calibration import Calibration, lens_from
from equipoise.hardware.camera.pictures import SUFFIXES, picture_at
from equipoise.model.errors import InputError
from equipoise.model.units import MM

LEAST = 3  # squares each way, chosen: fewer have no corner in between


def lens_from_files(
    files: Sequence[Path], board: Charuco, reported: Callable[[float], None]
) -> Calibration:
    """Return the lens; InputError if files are no pictures of one size, or do not determine it."""
    if min(board.columns, board.rows) < LEAST or not board.marker < board.square:
        found = f"{board.columns} x {board.rows} squares of {board.square / MM:g} mm"
        wanted = f"at least {LEAST} each way, and markers smaller than a square"
        raise InputError("--columns, --rows, --marker-mm", found, wanted)
    paths = _paths(files)
    sizes: list[tuple[int, int]] = []

    def pictures() -> Iterator[Picture]:
        for k, path in enumerate(paths):
            picture = picture_at(path)
            sizes.append((picture.shape[1], picture.shape[0]))
            if sizes[-1] != sizes[0]:
                wanted = "pictures of one size ({} x {} px)".format(*sizes[0])
                raise InputError(str(path), "{} x {} px".format(*sizes[-1]), wanted)
            yield picture
            reported((k + 1) / len(paths))

    return lens_from(list(chess_views(board, pictures())), sizes[0])


def _paths(files: Sequence[Path]) -> list[Path]:
    found: list[Path] = []
    for file in files:
        inside = sorted(file.iterdir()) if file.is_dir() else [file]
        found += [p for p in inside if not file.is_dir() or p.suffix.lower() in SUFFIXES]
    if not found:
        raise InputError("pictures", "none", "picture files, or a folder of them")
    return found
