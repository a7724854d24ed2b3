"""The camera's attitudes on drawn pictures: errors beside the truth and beside what is stated.

Pictures are drawn by code of their own (``hardware.emulated.rendering``): 1280 x 960 px, the board
0.7 m away, leaning up to 30 deg, any heading, through a lens that bends.

Boards of another scale: each is drawn longer or shorter by up to 0.5 % along X and along Y, or with
tags elsewhere than measured, and seen in a few pictures one after the other, as a bench does.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from equipoise.hardware.camera.aruco import decoded, encoded
from equipoise.hardware.camera.eye import Eye
from equipoise.hardware.camera.layouts import april_grid, grid, measured
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.pose import Pose
from equipoise.hardware.camera.sight import Sight
from equipoise.hardware.camera.tag_board import Marker, TagBoard
from equipoise.hardware.emulated.camera import QUALITY, renderer_of
from equipoise.hardware.emulated.rendering import Appearance
from equipoise.maths.attitude import difference, exponential, from_matrix, to_matrix
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn

LEANING, AWAY = 30.0, 0.7  # deg, m
MEDIAN = 0.05  # deg, what is asked for
NEES = (0.7, 1.4)  # chosen: mean of e^T C^-1 e / 3; stated errors true within a fifth
OBSERVED = 0.97  # of pictures, chosen; what covers half of a board may cover all but one marker
PICTURES = 20  # of each look, for a seed
EYE = Eye(
    grid("4X4_50", (6, 5), 0.040, 0.010),
    Lens(1200.0, 1195.0, 645.3, 471.9, 1280, 960, (-0.12, 0.05, 0.001, -0.0007, 0.0)),
    np.eye(3),
)
SCALE = 0.005  # greatest error of scale along each axis
HELD = (0.92, 0.98)  # of 95 % intervals of an attitude's components, what is asked for
VIEWS = 4  # pictures of each drawn board
TAGS = (
    Marker(3, 0.05, -0.08, 0.05, 0.0, 0.3),
    Marker(9, 0.06, 0.07, 0.04, 0.0, -0.8),
    Marker(11, 0.04, 0.02, -0.07, 0.0, 1.7),
)
BOARDS = {  # and how many of each are drawn, for a seed
    "6 x 5 markers": (EYE.board, 5),
    "AprilGrid of 4 x 3 tags": (april_grid((4, 3), 0.050, 0.3), 3),
    "2 markers": (grid("4X4_50", (2, 1), 0.040, 0.010), 5),
    "one tag of 120 mm": (grid("4X4_50", (1, 1), 0.120, 0.020), 5),
    "3 tags measured to 0.2 mm": (measured("4X4_50", TAGS, 0.0002), 5),
}
MEASUREMENTS = {
    "sharp": Appearance(finer=2),
    "out of focus": Appearance(blur=1.5, finer=2),
    "moved by 4 px": Appearance(smear=4.0, finer=2),
    "noisy": Appearance(noise=6.0, finer=2),
    "partly covered": Appearance(blur=1.2, noise=4.0, covered=0.4, finer=2),
}


@dataclass(frozen=True, slots=True, eq=False)
class Observed:
    """What pictures of one look gave."""

    errors: NDArray[np.float64]  # deg, angles
    nees: NDArray[np.float64]  # e^T C^-1 e
    pictures: int


def leaning(rng: np.random.Generator) -> NDArray[np.float64]:
    """Return a turn, board to camera: any heading, any lean up to the greatest alike by area."""
    heading, side = rng.uniform(0, 2 * np.pi, 2)
    lean = np.radians(LEANING) * np.sqrt(rng.uniform())
    over = to_matrix(exponential(lean * np.array([np.cos(side), np.sin(side), 0.0])))
    spun = to_matrix(exponential(np.array([0.0, 0.0, heading])))
    return over @ np.diag([1.0, -1.0, -1.0]) @ spun


def observed(measurement: Appearance, count: int, seed: int) -> Observed:
    """Return errors on pictures of one look."""
    rng = np.random.default_rng(seed)
    renderer, sight = renderer_of(EYE, measurement, seed), Sight(EYE.board, EYE.lens, "camera")
    errors: list[float] = []
    nees: list[float] = []
    for _ in range(count):
        turn = leaning(rng)
        position = np.array([*rng.uniform(-0.05, 0.05, 2), AWAY])
        picture = decoded(encoded(renderer.picture(turn, position), QUALITY))
        assert picture is not None
        pose = sight.observe(picture)
        if isinstance(pose, Pose):
            off = difference(from_matrix(pose.turn), from_matrix(turn))
            errors.append(float(np.degrees(np.linalg.norm(off))))
            nees.append(float(off @ np.linalg.solve(pose.covariance, off)))
    return Observed(np.array(errors), np.array(nees), count)


@dataclass(frozen=True, slots=True, eq=False)
class Scaled:
    """What pictures of boards with errors gave."""

    errors: NDArray[np.float64]  # (n, 3) deg
    sds: NDArray[np.float64]  # (n, 3) deg, as stated

    @property
    def scores(self) -> NDArray[np.float64]:
        """Errors in units of their stated sd."""
        return self.errors / self.sds


def with_errors(board: TagBoard, rng: np.random.Generator) -> TagBoard:
    """Return a board whose tags stand where they were not measured; a print stays as it is."""
    sd = board.place_sd

    def moved(tag: Marker) -> Marker:
        x, y, turn = sd * rng.standard_normal(3)
        side = tag.side * (1 + rng.uniform(-SCALE, SCALE))
        rotation = tag.rotation + np.sqrt(2) * turn / tag.side
        return replace(tag, x=tag.x + x, y=tag.y + y, rotation=rotation, side=side)

    return replace(board, markers=tuple(map(moved, board.markers))) if sd else board


def scaled(board: TagBoard, boards: int, seed: int) -> Scaled:
    """Return errors on pictures of boards that are drawn with errors."""
    rng = np.random.default_rng(seed)
    errors: list[NDArray[np.float64]] = []
    sds: list[NDArray[np.float64]] = []
    for k in range(boards):
        drawn = replace(EYE, board=with_errors(board, rng))
        renderer = renderer_of(drawn, Appearance(finer=2), boards * seed + k)
        longer = np.zeros(2) if board.place_sd else rng.uniform(-SCALE, SCALE, 2)
        sight = Sight(board, EYE.lens, "camera")
        for _ in range(VIEWS):
            turn = leaning(rng)
            position = np.array([*rng.uniform(-0.05, 0.05, 2), AWAY])
            stretched = turn * [*(1 + longer), 1.0]  # the renderer takes points of the sheet there
            pose = sight.observe(renderer.picture(stretched, position))
            if isinstance(pose, Pose):
                errors.append(difference(from_matrix(pose.turn), from_matrix(turn)))
                sds.append(np.sqrt(np.diag(pose.covariance)))
    return Scaled(np.degrees(errors), np.degrees(sds))


@dataclass(frozen=True, slots=True, eq=False)
class OfSeed:
    """All of one seed."""

    measurements: list[Observed]
    boards: list[Scaled]


def of_seed(seed: int) -> OfSeed:
    """Return all looks and all boards of one seed."""
    measurements = [observed(measurement, PICTURES, seed) for measurement in MEASUREMENTS.values()]
    return OfSeed(measurements, [scaled(board, count, seed) for board, count in BOARDS.values()])


def rows_of(name: str, all_seeds: Sequence[Observed]) -> tuple[Row, ...]:
    """Return the rows of one look."""
    errors = np.concatenate([each.errors for each in all_seeds])
    nees = np.concatenate([each.nees for each in all_seeds])
    share = len(errors) / sum(each.pictures for each in all_seeds)
    return (
        at_most(f"{name}: median error, deg", float(np.median(errors)), MEDIAN, ".4f"),
        between(f"{name}: mean NEES / 3", float(nees.mean() / 3), NEES, ".2f"),
        at_least(f"{name}: pictures in which the board is seen", share, OBSERVED, ".1%"),
    )


def rows_of_board(name: str, all_seeds: Sequence[Scaled]) -> tuple[Row, ...]:
    """Return the rows of boards of one layout."""
    scores = np.concatenate([each.scores for each in all_seeds])
    held = float(np.mean(np.abs(scores) < 1.96))
    return (between(f"{name}, not as declared: in 95 % intervals", held, HELD, ".1%"),)


def note_of_board(name: str, all_seeds: Sequence[Scaled]) -> str:
    """Return how large the errors of one layout are, and of how many pictures."""
    errors = np.linalg.norm(np.concatenate([each.errors for each in all_seeds]), axis=1)
    return f"{name}: median error {np.median(errors):.4f} deg in {len(errors)} pictures."


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Return the result for seeds."""
    found = spread(of_seed, seeds)
    rows = [
        row
        for k, name in enumerate(MEASUREMENTS)
        for row in rows_of(name, [each.measurements[k] for each in found])
    ]
    rows += [
        row
        for k, name in enumerate(BOARDS)
        for row in rows_of_board(name, [each.boards[k] for each in found])
    ]
    notes = tuple(
        note_of_board(name, [each.boards[k] for each in found]) for k, name in enumerate(BOARDS)
    )
    claim = (
        f"Attitudes from drawn pictures of 6 x 5 markers of 40 mm, {AWAY:g} m away, 1280 x 960 px, "
        f"leaning up to {LEANING:g} deg, after JPEG; {PICTURES * len(seeds)} of each look. Boards "
        f"not as declared have scales wrong by up to {SCALE:.1%} along each axis, or tags that "
        "stand elsewhere than measured."
    )
    worst = max(float(each.errors.max()) for seed in found for each in seed.measurements)
    return Result(
        "camera", claim, tuple(rows), (f"Greatest error of all looks: {worst:.3f} deg.", *notes)
    )
