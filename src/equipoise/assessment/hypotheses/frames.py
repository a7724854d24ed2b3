"""Which axis of the laboratory points up, and which axis of the body stays near it.

    cos tilt = e_lab . R e_body        of all pairs of axes the one with the least median tilt

A platform on a bearing stays near upright, whatever its heading, so its own upright axis keeps its
angle to the vertical while every other axis turns about. A record without a turn about the
vertical shows less: several pairs then stay alike.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Series4

AXES = ("z", "y", "x", "-z", "-y", "-x")  # as people choose them
ALIKE = 1.5  # times the least tilt, up to which another pair is as likely (chosen)
LEAST = 0.02  # rad: smaller tilts are alike (chosen)


@dataclass(frozen=True, slots=True)
class FrameGuess:
    """What points up."""

    lab_up: str
    body_up: str
    tilt: float  # rad, the median

    def is_up(self, lab_axis: str, body_axis: str) -> bool:
        """Say whether two axes are these."""
        return (lab_axis, body_axis) == (self.lab_up, self.body_up)


def frame_guesses(q: Series4) -> list[FrameGuess]:
    """Return the pairs of axes that may be up, the likeliest first; those much worse are absent."""
    turn = to_matrix(q[np.isfinite(q).all(axis=1)])
    guesses = [FrameGuess(lab, body, _tilt(turn, lab, body)) for lab in AXES for body in AXES]
    # A pair and its opposite are the same turn: the laboratory's axis is taken as positive if the
    # body's can be.
    least = min(guess.tilt for guess in guesses)
    near = [g for g in guesses if g.tilt <= max(ALIKE * least, LEAST)]
    return sorted(near, key=lambda g: (g.lab_up.startswith("-"), g.body_up != g.lab_up))


def _tilt(turn: np.ndarray, lab: str, body: str) -> float:
    sign = (-1.0 if lab.startswith("-") else 1.0) * (-1.0 if body.startswith("-") else 1.0)
    cosine = sign * turn[:, "xyz".index(lab[-1]), "xyz".index(body[-1])]
    return float(np.median(np.arccos(np.clip(cosine, -1.0, 1.0))))
