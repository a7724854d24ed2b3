"""The camera's attitudes on drawn pictures: errors beside the truth and beside what is stated.

Pictures are drawn by code of their own (``hardware.emulated.rendering``): 1280 x 960 px, the board
0.7 m away, leaning up to 30 deg, any heading, through a lens that bends.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equipoise.hardware.camera.aruco import decoded, encoded
from equipoise.hardware.camera.eye import Eye
from equipoise.hardware.camera.layouts import grid
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.pose import Pose
from equipoise.hardware.camera.sight import Sight
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


def of_seed(seed: int) -> list[Observed]:
    """Return all looks of one seed."""
    return [observed(measurement, PICTURES, seed) for measurement in MEASUREMENTS.values()]


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


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Return the result for seeds."""
    found = spread(of_seed, seeds)
    rows = [
        row
        for k, name in enumerate(MEASUREMENTS)
        for row in rows_of(name, [each[k] for each in found])
    ]
    claim = (
        f"Attitudes from drawn pictures of 6 x 5 markers of 40 mm, {AWAY:g} m away, 1280 x 960 px, "
        f"leaning up to {LEANING:g} deg, after JPEG; {PICTURES * len(seeds)} pictures of each look."
    )
    worst = max(float(each.errors.max()) for seed in found for each in seed)
    return Result("camera", claim, tuple(rows), (f"Greatest error of all: {worst:.3f} deg.",))
