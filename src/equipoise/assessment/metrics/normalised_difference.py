"""How far two independent estimates of one quantity are from each other."""

import math

from equipoise.model.estimate import Parameter


def normalised_difference(parameter: Parameter, other: Parameter) -> float:
    """Return (a - b) / sqrt(sd_a^2 + sd_b^2); NaN where neither has an sd.

    Beyond 2 to 3 the quantity has changed, or one of the two sd is too small. An estimate that
    shares data with the other is nearer to it than this says.
    """
    sd = math.hypot(parameter.sd, other.sd)
    return (parameter.value - other.value) / sd if sd > 0 else math.nan
