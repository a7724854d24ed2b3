"""OpenCV's ArUco, as this package uses it: all that differs between its releases 4.8 to 5 is here.

Markers: S. Garrido-Jurado et al. (2014), "Automatic generation and detection of highly reliable
fiducial markers under occlusion", Pattern Recognition 47(6), 2280-2292.

Coordinates of pixels: whole numbers are centres, (0, 0) that of the first.
"""

import io
import warnings
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError, nearest
from equipoise.model.optional_libraries import extra_library

Picture = NDArray[np.uint8]
PREFIX = "DICT_"
# px, window of the adaptive threshold, chosen: one size, for markers of 20 to 200 px.
THRESHOLD = 23
# px, sd, chosen: all tags of an AprilGrid of 50 to 160 px are then found, sharp or out of focus.
ROUNDED = 1.5
SIDE = 10_000  # px, of a square as large as any picture may be (chosen: twice the largest camera's)


def opencv(where: str) -> Any:
    """Return OpenCV; InputError says how to install it."""
    return extra_library("cv2", where, "pictures of markers", "camera")


def floats(values: Any) -> Floats:
    """Return what OpenCV gave as numbers in double precision."""
    return np.asarray(values, np.float64)


def dictionary(name: str, where: str) -> Any:
    """Return the markers of a dictionary such as 4X4_50 or APRILTAG_36H11."""
    aruco = opencv(where).aruco
    known = sorted(key[len(PREFIX) :] for key in dir(aruco) if key.startswith(PREFIX))
    wanted = name.upper().removeprefix(PREFIX)
    if wanted not in known:
        raise InputError(where, f"dictionary '{name}'", nearest(wanted, known))
    return aruco.getPredefinedDictionary(getattr(aruco, PREFIX + wanted))


@dataclass(frozen=True, slots=True, eq=False)
class Seeker:
    """What finds the markers of a dictionary."""

    detector: Any
    blur: float  # px, sd, of the picture before it is searched; 0: none


def seeker_of(markers: Any, border: int = 1, touching: bool = False) -> Seeker:
    """Return what finds markers with a black border of so many cells.

    ``touching``: other black squares touch their corners. One contour would then go round all of
    them, if a blur did not round the corners off.
    """
    aruco = opencv("camera").aruco
    how = aruco.DetectorParameters()
    how.adaptiveThreshWinSizeMin = how.adaptiveThreshWinSizeMax = THRESHOLD
    how.markerBorderBits = border
    how.cornerRefinementMethod = (
        aruco.CORNER_REFINE_NONE
    )  # borders determine a pose better, see ``borders``
    return Seeker(aruco.ArucoDetector(markers, how), ROUNDED if touching else 0.0)


def found(seeker: Seeker, picture: Picture) -> list[tuple[int, Floats]]:
    """Return id and corners (4, 2) px of each marker in a picture."""
    if seeker.blur > 0:
        picture = opencv("camera").GaussianBlur(picture, (0, 0), seeker.blur)
    corners, ids, _ = seeker.detector.detectMarkers(picture)
    if ids is None:
        return []
    numbers = np.asarray(ids, np.int64).ravel().tolist()
    fours = [floats(four).reshape(4, 2) for four in corners]
    return list(zip(numbers, fours, strict=True))


def drawn(markers: Any, number: int, side: int, border: int = 1) -> Picture:
    """Return the picture of one marker, its black border of so many cells included."""
    return opencv("camera").aruco.generateImageMarker(markers, number, side, borderBits=border)


def cells(markers: Any, border: int = 1) -> int:
    """Return of how many cells a marker's side consists, its black border included."""
    return int(markers.markerSize) + 2 * border


def count_of(markers: Any) -> int:
    """Return how many markers a dictionary has."""
    return len(markers.bytesList)


def _pixels(data: bytes) -> int:
    """Return how many pixels a picture says that it has; 0 for what is no picture."""
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of sizes, which are checked here
            width, height = Image.open(io.BytesIO(data)).size
    except Exception:  # a parser of broken bytes raises anything
        return 0
    return width * height


def decoded(data: bytes) -> Picture | None:
    """Return an encoded picture in greys; None for what is none, or larger than any camera's."""
    cv2 = opencv("camera")
    if not 0 < _pixels(data) <= SIDE**2:
        return None
    try:
        return cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_GRAYSCALE)
    except cv2.error:
        return None


def encoded(picture: Picture, quality: int) -> bytes:
    """Return a picture as JPEG."""
    cv2 = opencv("camera")
    return cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])[1].tobytes()


def calibrated(
    points: Sequence[Floats], observed: Sequence[Floats], size: tuple[int, int]
) -> tuple[float, Floats, Floats, Floats]:
    """Return rms (px), camera matrix, five coefficients of distortion and the matrix's sds (px).

    Points are on the plane z = 0 of a board (m) and in the pictures (px), view by view.
    """
    cv2 = opencv("camera")
    reported = [np.asarray(p, np.float32).reshape(-1, 1, 3) for p in points]
    views = [np.asarray(v, np.float32).reshape(-1, 1, 2) for v in observed]
    rms, matrix, distortion, _, _, sds, *_ = cv2.calibrateCameraExtended(
        reported, views, size, None, None
    )
    return float(rms), floats(matrix), floats(distortion).ravel()[:5], floats(sds).ravel()[:4]


@dataclass(frozen=True, slots=True)
class Charuco:
    """A chessboard with markers in its white squares, for calibrating a lens."""

    dictionary: str
    columns: int  # squares
    rows: int  # squares
    square: float  # m, side
    marker: float  # m, side
    legacy: bool = False  # as OpenCV drew it before 4.6: another colour begins if rows are even

    def board(self, where: str) -> Any:
        """Return OpenCV's own board."""
        size, markers = (self.columns, self.rows), dictionary(self.dictionary, where)
        board = opencv(where).aruco.CharucoBoard(size, self.square, self.marker, markers)
        board.setLegacyPattern(self.legacy)
        return board


@dataclass(frozen=True, slots=True, eq=False)
class ChessView:
    """What one picture shows of a chessboard."""

    board: Floats  # (n, 3) m, corners of its squares on the board
    picture: Floats  # (n, 2) px, the same in the picture
    markers: int  # of the dictionary, seen at all


def chess_views(charuco: Charuco, pictures: Iterable[Picture]) -> Iterator[ChessView]:
    """Return what each picture shows of a chessboard."""
    board = charuco.board("calibrate-camera")
    seeker = opencv("camera").aruco.CharucoDetector(board)
    corners = floats(board.getChessboardCorners()).reshape(-1, 3)
    for picture in pictures:
        observed, ids, _, markers = seeker.detectBoard(picture)
        there = 0 if markers is None else len(markers)
        if ids is None or len(ids) == 0:
            yield ChessView(np.empty((0, 3)), np.empty((0, 2)), there)
        else:
            numbers = np.asarray(ids, np.int64).ravel()
            yield ChessView(corners[numbers], floats(observed).reshape(-1, 2), there)


def charuco_print(charuco: Charuco, dpi: int) -> Picture:
    """Return the chessboard at its true size, half a square of paper around it."""
    board = charuco.board("print-board")
    squares, margin = (charuco.columns, charuco.rows), charuco.square / 2
    width, height = (dots(n * charuco.square + 2 * margin, dpi) for n in squares)
    return board.generateImage((width, height), marginSize=dots(margin, dpi))


def dots(length: float, dpi: int) -> int:
    """Return a length (m) in dots of a printer."""
    return round(length / 0.0254 * dpi)
