"""What estimator and law say to the board after a row."""

from typing import NamedTuple

from equipoise.model.arrays import Bools, Floats


class Request(NamedTuple):
    """The estimate, and where the masses should go."""

    attitude: Floats  # (4,) w x y z, by the method
    com: Floats  # (3,) m, of the centre of mass with the masses at home
    com_sd: Floats  # (3,) m
    shift: Floats  # (3,) m, wanted of the centre of mass, counted from home
    displacement: Floats  # (k,) m, wanted of the masses: whole motor steps
    finished: Bools  # (1,) the law has done its work
