"""The lens from pictures of a chessboard with markers (ChArUco), held at many angles.

Z. Zhang (2000), "A flexible new technique for camera calibration", IEEE PAMI 22(11), 1330-1334,
as OpenCV has it. A lens that the pictures do not determine is refused, with what to do: its numbers
would fit the very same pictures, and turn attitudes elsewhere.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera.aruco import ChessView, calibrated, opencv
from equipoise.hardware.camera.lens import Lens
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError

VIEWS = 8  # chosen: four of them leave a lens with five coefficients open
CORNERS = 8  # of a view, chosen: what fewer say of a lens is not worth their ambiguity
ACROSS, DOWN = 4, 3  # parts of a picture, chosen
COVERED = 10  # of these parts, chosen: two corners of the picture may stay empty
LEANT, LEANING = 6, 0.1  # views, and by how much of its distance a board is deeper, chosen
KNOWN = 0.005  # of the focal length, one sd, chosen: then a tilt of 20 deg is known to 0.1 deg
HOW = "the board tilted by 20 to 40 deg each way"
MOST_RMS = 1.0  # px, chosen: more is a blurred picture, a bent board or another one


@dataclass(frozen=True, slots=True)
class Calibration:
    """A lens, and from what it is known."""

    lens: Lens
    views: int  # that were used
    focal_sd: float  # px, one sd of fx and fy, the greater


def lens_from(views: Sequence[ChessView], size: tuple[int, int]) -> Calibration:
    """Return the lens of pictures of a size (width, height, px); InputError if they are poor."""
    useful = [view for view in views if len(view.picture) >= CORNERS]
    if len(useful) < VIEWS:
        found = f"the chessboard in {len(useful)} of {len(views)} pictures"
        wanted = f"at least {VIEWS} with {CORNERS} corners or more"
        raise InputError("pictures", *_without_corners(views, found, wanted))
    _check_coverage(np.concatenate([view.picture for view in useful]), size)
    _check_leaning(useful)
    rms, matrix, distortion, sds = calibrated(
        [view.board for view in useful], [view.picture for view in useful], size
    )
    return _checked(Calibration(_lens(rms, matrix, distortion, size), len(useful), max(sds[:2])))


def _without_corners(views: Sequence[ChessView], found: str, wanted: str) -> tuple[str, str]:
    """Return found and wanted, with markers that were seen without corners, and what to try."""
    bare = [view.markers for view in views if view.markers and not len(view.picture)]
    if bare:
        most = f"{max(bare)} markers" if max(bare) > 1 else "1 marker"
        found += f"; in {len(bare)} up to {most} found and no corner between them"
        wanted += ": try --legacy, or --columns and --rows as the print has them"
    elif not any(view.markers for view in views):
        found += ", and no marker in any"
        wanted += ": try --dictionary as the print has it, or go nearer"
    return found, wanted


def _lens(rms: float, matrix: Floats, distortion: Floats, size: tuple[int, int]) -> Lens:
    focal = (float(matrix[0, 0]), float(matrix[1, 1]))
    middle = (float(matrix[0, 2]), float(matrix[1, 2]))
    return Lens(*focal, *middle, *size, tuple(map(float, distortion)), rms)


def _checked(found: Calibration) -> Calibration:
    """Return a calibration that fits and is known well enough."""
    lens = found.lens
    if not (lens.rms is not None and lens.rms < MOST_RMS):
        wanted = f"at most {MOST_RMS:g} px: sharp pictures of a flat board of the size stated"
        raise InputError("pictures", f"corners {lens.rms:.2f} px off on average", wanted)
    if not found.focal_sd < KNOWN * min(lens.fx, lens.fy):
        text = f"a focal length of {lens.fx:.0f} px with an sd of {found.focal_sd:.1f} px"
        raise InputError("pictures", text, f"at most {KNOWN:.1%}: more pictures, {HOW}")
    return found


def _check_leaning(views: Sequence[ChessView]) -> None:
    """Raise InputError if the board hardly leans.

    Pictures of a board face on fit any focal length, and the wrong one that a fit ends at has a
    small standard deviation; so this is asked of the pictures before.
    """
    leant = sum(depth(view) > LEANING for view in views)
    if leant < LEANT:
        found = f"the board clearly tilted in {leant} of {len(views)} pictures"
        raise InputError("pictures", found, f"at least {LEANT}: {HOW}")


def depth(view: ChessView) -> float:
    """Return by what part of its distance the far side of a board is farther than the near one.

    The third row of the homography, board to picture, is the depth of a point up to scale,
    whatever the focal length.
    """
    flat = view.board[:, :2]
    homography = opencv("camera").findHomography(flat, view.picture)[0]
    if homography is None:  # corners on one line
        return 0.0
    depths: Floats = flat @ homography[2, :2] + homography[2, 2]
    return float(np.ptp(depths) / abs(depths.mean()))


def _check_coverage(corners: Floats, size: tuple[int, int]) -> None:
    """Raise InputError if much of the picture never had a corner in it; name what is empty."""
    column = np.clip(corners[:, 0] / size[0] * ACROSS, 0, ACROSS - 1).astype(int)
    row = np.clip(corners[:, 1] / size[1] * DOWN, 0, DOWN - 1).astype(int)
    observed = np.zeros((DOWN, ACROSS), dtype=bool)
    observed[row, column] = True
    if np.count_nonzero(observed) >= COVERED:
        return
    sides = {
        "left": observed[:, 0],
        "right": observed[:, -1],
        "top": observed[0],
        "bottom": observed[-1],
    }
    empty = [side for side, part in sides.items() if np.count_nonzero(part) < len(part) / 2]
    found = f"corners in {np.count_nonzero(observed)} of {ACROSS * DOWN} parts of the picture"
    where = " and ".join(empty) or "edges"
    wanted = f"at least {COVERED}: hold the board also where the picture is empty, at its {where}"
    raise InputError("pictures", found, wanted)
