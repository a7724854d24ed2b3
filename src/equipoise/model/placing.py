"""A placing: where weights are to lie, and what that should do to the centre of mass."""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Ints, Matrix3, Vector3


@dataclass(frozen=True, slots=True, eq=False)
class Placing:
    """A prediction that the next recording tests; see ``model.weights`` for loadings."""

    before: Ints  # (places, kinds) counts
    after: Ints
    predicted_com: Vector3  # m, afterwards
    predicted_covariance: Matrix3  # m^2, of the estimate and of masses and places

    @property
    def handled(self) -> int:
        """Return how many weights are in the person's hands: a moved one counts once."""
        change = self.after - self.before
        off, on = (np.maximum(way * change, 0).sum(axis=0) for way in (-1, 1))
        return int(np.maximum(off, on).sum())
