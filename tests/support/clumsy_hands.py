"""A person who errs while placing weights."""

import numpy as np

from equipoise.simulation.hands import SimulatedHands


class Clumsy(SimulatedHands):
    """A person who forgets the largest pile that was asked for first, and does not notice."""

    forgotten = 0

    def place(self, wanted):
        if not np.any(self.forgotten):
            self.forgotten = np.where(wanted == wanted.max(), wanted, 0)
        super().place(wanted - self.forgotten)
        return wanted
