"""How a board may differ from what was declared: unknowns with a prior, as constant as the board.

    point = declared point + W e,    e ~ N(0, diag(sd^2)) before any picture

Printed on one sheet, e = (a, b): the print is longer by a along X and by b along Y, so
W = (x, 0, 0), (0, y, 0). Tags at measured places were printed alike, each longer by a and b along
its own axes about its middle; and each has five more: its place along X, Y, Z, its rotation, and
its own length. A longer tag looks nearer, and so leans a board of few.

A common scale of one sheet only brings the board nearer: it turns nothing. A difference a - b
looks like a lean, cos(lean) = (1 + a) / (1 + b), that is

    d(lean) = (a - b) / tan(lean)     where perspective does not tell them apart,

so 0.1 % is 0.33 deg at a lean of 10 deg. Perspective tells them apart in a near board of many
markers; one that is small or far has to be told by its prior, or by leaning in other ways.

``SCALE_SD`` is for a board whose ``marker_mm`` was measured as `print-board` asks. Prints that were
not may be off by more: the engine of early laser printers was allowed 2 % along either side (users
in comp.laser-printers, 1988 to 1990).

What it cannot see: a board that is bent, tags that do not lie flat.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera.tag_board import Borders, Marker, TagBoard, borders_of
from equipoise.model.arrays import Floats

SCALE_SD = 0.003  # chosen: that of anything within +-0.5 %, 1 mm by a ruler on a sheet of 200 mm
OWN = 5  # errors of each measured tag: along X, Y, Z, rotation, length
WEAR = 0.01  # of a prior's sd, chosen: what was learnt grows uncertain again by so much with each
# picture that taught; 0.003 % of a board of 250 mm is 0.01 px, as paper and lenses err


@dataclass(frozen=True, slots=True, eq=False)
class BoardErrors:
    """What is known of a board's errors."""

    mean: Floats  # (k,)
    covariance: Floats  # (k, k)


def prior_of(board: TagBoard) -> BoardErrors:
    """Return what is known of a board before any picture; lengths in m, turns in rad."""
    sds = [SCALE_SD, SCALE_SD]
    if board.place_sd > 0:
        for marker in board.markers:
            turn = np.sqrt(2) * board.place_sd / marker.side  # both ends of a side are measured
            sds += [board.place_sd] * 3 + [float(turn), SCALE_SD]
    return BoardErrors(np.zeros(len(sds)), np.diag(np.square(sds)))


def worn(errors: BoardErrors, prior: BoardErrors) -> BoardErrors:
    """Return what was learnt as it holds for the next picture."""
    return BoardErrors(errors.mean, errors.covariance + WEAR**2 * prior.covariance)


def borders_on(board: TagBoard) -> tuple[dict[int, int], Borders]:
    """Return the row of each id, and the borders of all markers, a row each."""
    found = [borders_of(marker) for marker in board.markers]
    points, along, outward = (np.array(each) for each in zip(*found, strict=True))
    count = len(board.markers)
    ink = np.array([board.ink(marker) for marker in board.markers])
    ways = np.array(
        [_ways(marker, points[k], k, count, board) for k, marker in enumerate(board.markers)]
    )
    rows = {marker.number: k for k, marker in enumerate(board.markers)}
    return rows, Borders(points, along, outward, ink[:, None].repeat(points.shape[1], 1), ways)


def _ways(marker: Marker, points: Floats, row: int, count: int, board: TagBoard) -> Floats:
    """Return W (n, 3, k) at the points (n, 3) of one marker."""
    if board.place_sd == 0:
        return points[:, :, None] * np.eye(3)[:, :2]
    ways = np.zeros((len(points), 3, 2 + OWN * count))
    off = points - marker.middle
    ways[:, :, :2] = (off @ marker.axes)[:, None, :2] * marker.axes[:, :2]
    own = ways[:, :, 2 + OWN * row : 2 + OWN * (row + 1)]
    own[:, :, :3] = np.eye(3)
    own[:, :, 3] = np.cross([0.0, 0.0, 1.0], off)
    own[:, :, 4] = off
    return ways
