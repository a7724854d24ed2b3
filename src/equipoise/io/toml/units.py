"""Units as they are written in keys and column names, and how large they are in SI."""

from equipoise.model import units as si
from equipoise.model.errors import InputError, nearest

# As written in a column map's ``unit`` or as said of a key: the factor to SI.
TO_SI = {
    "s": 1.0,
    "ms": si.MS,
    "us": si.US,
    "ns": si.NS,
    "100 ns": si.NS_100,
    "min": si.MINUTE,
    "rad": 1.0,
    "deg": si.DEG,
    "rad/s": 1.0,
    "deg/s": si.DEG,
    "mrad/s": si.MILLI,
    "mdeg/s": si.MILLI * si.DEG,
    "rpm": si.RPM,
    "m": 1.0,
    "cm": si.CM,
    "mm": si.MM,
    "um": si.UM,
    "N m s": 1.0,
    "mN m s": si.MN_M,
    "N m": 1.0,
    "mN m": si.MN_M,
    "uN m": si.UN_M,
    "A m2": 1.0,
    "mA m2": si.MILLI,
    "T": 1.0,
    "mT": si.MT,
    "uT": si.UT,
    "nT": si.NT,
    "N m s2": 1.0,
    "N s/m": 1.0,
    "kg m2": 1.0,
    "kg": 1.0,
    "g": si.GRAM,
    "mg": si.GRAM * si.MILLI,
    "m/s2": 1.0,
    "mm/s2": si.MM,
    "g0": si.G0,
    "mg0": si.G0 * si.MILLI,
    "1": 1.0,
    "m/s": 1.0,
    "cm/s": si.CM,
    "mm/s": si.MM,
    "um/min": si.UM / si.MINUTE,
    "deg/s per root Hz": si.DEG,
    "Hz": 1.0,
    "kHz": 1e3,
    "percent": si.PERCENT,
    "K": 1.0,
    "um/K": si.UM,
}
KINDS = {
    "time": ("s", "ms", "us", "ns", "100 ns", "min"),
    "angle": ("rad", "deg"),
    "rate": ("rad/s", "deg/s", "mrad/s", "mdeg/s", "rpm"),
    "length": ("m", "cm", "mm", "um"),
    "momentum": ("N m s", "mN m s"),
    "torque": ("N m", "mN m", "uN m"),
    "dipole": ("A m2", "mA m2"),
    "magnetic": ("T", "mT", "uT", "nT"),
    "acceleration": ("m/s2", "mm/s2", "g0", "mg0"),
    "share": ("1",),
}
AS_SAID = ("rpm", "percent", "deg", "rad", "kg", "um", "uT", "mm", "cm", "ms", "mg", "g", "m", "s",
           "K")  # fmt: skip
# As they end a key: how to say them.
SPOKEN = {
    "deg_s_rthz": "deg/s per root Hz",
    "N_m_s2": "N m s2",
    "N_m_s": "N m s",
    "N_s_m": "N s/m",
    "kg_m2": "kg m2",
    "um_min": "um/min",
    "um_K": "um/K",
    "deg_s": "deg/s",
    "rad_s": "rad/s",
    "mm_s": "mm/s",
    "cm_s": "cm/s",
    "m_s2": "m/s2",
    "m_s": "m/s",
    "A_m2": "A m2",
    "N_m": "N m",
    "hz": "Hz",
    "khz": "kHz",
} | {unit: unit for unit in AS_SAID}


def factor(unit: str, kind: str, where: str) -> float:
    """Return what one ``unit`` is in SI, or say which units a ``kind`` of column may have."""
    if unit not in KINDS[kind]:
        raise InputError(where, f"unit '{unit}'", nearest(unit, list(KINDS[kind])))
    return TO_SI[unit]


def split_unit(key: str) -> tuple[str, str]:
    """Return a key without its unit, and the unit ('' if it has none)."""
    for unit in SPOKEN:  # longest first, so that deg_s is not taken for s
        if key.endswith(f"_{unit}"):
            return key.removesuffix(f"_{unit}"), unit
    return key, ""


def key_factor(key: str) -> float:
    """Return what one of a key's unit is in SI; 1 for a key without a unit."""
    unit = split_unit(key)[1]
    return TO_SI[SPOKEN[unit]] if unit else 1.0
