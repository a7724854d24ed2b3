"""A series along a record, and its rms corrected for noise."""

from dataclasses import dataclass

from equipoise.model.arrays import Series, Series1


@dataclass(frozen=True, slots=True, eq=False)
class NoiseCorrectedSeries:
    """A series, and how large it is when noise is taken off."""

    t: Series1  # s
    values: Series  # (n, m) N m, or J
    noise: float  # rms over all columns: what noise alone would leave
    rms: float  # of the vector, noise taken off; 0 where there is no more than noise
    rms_sd: float
    greatest: float  # of the vector, noise and all
