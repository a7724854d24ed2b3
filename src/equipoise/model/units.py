"""Units, each as its size in SI: multiply by one to read a number, divide by one to show it.

``0.2 * DEG`` is 0.2 deg in rad, ``com / UM`` a centre of mass (m) in um.
"""

import math

CM, MM, UM = 1e-2, 1e-3, 1e-6  # m
GRAM = 1e-3  # kg
G0 = 9.80665  # m/s^2, standard gravity
KG_CM, G_CM = 1e-2, 1e-5  # kg m
MINUTE, MS, US, NS = 60.0, 1e-3, 1e-6, 1e-9  # s
NS_100 = 1e-7  # s, of the clocks of Windows and .NET
DEG = math.pi / 180  # rad; deg/s in rad/s
RPM = math.pi / 30  # rad/s
MN_M, UN_M = 1e-3, 1e-6  # N m; times s: N m s
MILLIJOULE = 1e-3  # J
MT, UT, NT = 1e-3, 1e-6, 1e-9  # T
LITRE = 1e-3  # m^3
MEGABYTE = 1e6  # byte
PERCENT, PPM = 1e-2, 1e-6  # -
MILLI = 1e-3  # of any other unit: mA m2, mrad/s


def in_si(number: float, unit: float) -> float:
    """Return a number of units in SI, rounded once: ``1 / MM`` is 1000, ``MM`` not quite 1/1000."""
    return number / (1 / unit)
