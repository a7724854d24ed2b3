"""Unscented Kalman filter of rate and the centre of mass along the up axis.

Gravity turns a centre of mass that is d off across up, and not known to be, as it turns one that
is d / sin(tilt) off along up: rows of the platform's swing cannot tell the two from each other
(``docs/derivations.md``, the filter of the height). As published, com across up is nought and
certain, and its interval knows nothing of that. Here com across up is considered with the
testbed's com_sd: its share is in the interval, and where it hides com along up the filter keeps
the testbed's value.

``STRAYS`` was measured on 20 swings of four presets with rms tilts of 2 to 43 deg: median 1.2.
"""

from equipoise.estimation.filters.conclusion import filter_method
from equipoise.estimation.filters.model import Kind
from equipoise.model.method_card import Card

STRAYS = (0.6, 1.8)  # d com along up / d com across up, times the sine of the rms tilt
KIND = Kind(attitude=False, estimated=4, unscented=True, upright=True)
METHOD = filter_method(
    Card(
        "ukf_4",
        "Euler's equation, attitude as an input; w and com along up (com_z where z is up)",
        "unscented Kalman filter, 2n points; com across up and J are considered",
        "Chesi 2014, second step; da Silva 2021 section 4.1",
        "a gyro and a camera; com across up balanced and known (com_sd); J with its sd",
        (
            "com across up, which is taken from the testbed: each um beyond com_sd shifts "
            f"com along up by {STRAYS[0]:g} to {STRAYS[1]:g} um / sin(rms tilt), 6 to 17 "
            "um at 6 deg; the interval includes com_sd, and if it exceeds some um, com "
            "along up keeps its prior; com along gravity until it has tilted"
        ),
        "levelled",
    ),
    KIND,
)
