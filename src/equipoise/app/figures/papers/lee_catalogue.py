"""Figures 3 to 18 of Lee et al., by the paper's numbers; names, captions, drawings."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.papers import lee_course, lee_slew
from equipoise.app.figures.papers.lee_slew import Shown
from equipoise.model.arrays import Floats
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.units import DEG, KG_CM
from equipoise.study.papers.lee import NEAR, Manoeuvre, angles_of, singular_times, true_values
from equipoise.study.papers.lee_course import Courses, Reported

SINGULAR = f" Grey: the gyros' measure is below {NEAR:g}."
BOTH = (
    " Left: the rows as printed; right: every term averaged alike, free constants. Least squares "
    "of all rows so far"
)
DASHED = f"{BOTH}; dashed: truth."
GYROS = tuple(f"gyro {k}" for k in range(1, 5))
RATES = tuple(f"$\\omega_{axis}$" for axis in "xyz")
Drawn = tuple[Manoeuvre, Courses]


class Unknowns(NamedTuple):
    """Three unknowns, and how the figures show them."""

    names: tuple[str, ...]
    title: str
    short: str
    unit: str
    labels: tuple[str, ...]

    def shown(self, values: Floats, mass: float) -> Floats:
        """Return values from SI in the figures' unit: com (m) as m r in kg cm."""
        return values * (mass / KG_CM) if self.names == COM else values

    def along(self, side: Reported, values: Floats, mass: float) -> lee_course.Reported:
        """Return the columns of these unknowns along a side of the figure."""
        where = [side.names.index(name) for name in self.names]
        return lee_course.Reported(side.t, self.shown(values[:, where], mass))


J = tuple(f"$J_{{{name[-2:]}}}$" for name in INERTIA)
MOI = Unknowns(INERTIA[:3], "Moments of inertia, kg m2", "MOI", "kg m$^2$", J[:3])
POI = Unknowns(INERTIA[3:], "Products of inertia, kg m2", "POI", "kg m$^2$", J[3:])
UNBALANCE = Unknowns(COM, "Mass unbalance m r, kg cm", "mass unbalance", "kg cm",
                     tuple(f"$m r_{axis}$" for axis in "xyz"))  # fmt: skip


def pictures_of(large: Drawn, small: Drawn) -> Iterator[Picture]:
    """Yield all figures."""
    yield from slew_pictures(large[0])
    yield from course_pictures(*large)
    yield from small_pictures(*small)


def slew_pictures(done: Manoeuvre) -> Iterator[Picture]:
    """Yield Figs. 3 to 9."""
    slew, near = done.slew, singular_times(done.slew)
    torque = tuple(f"$u_{axis}$" for axis in "xyz")
    angles = angles_of(done.testbed, slew.q) / DEG
    t = slew.t
    shown: Mapping[str, tuple[str, Shown]] = {
        "figure03_attitude": (
            "Attitude angles, deg, 3-2-1 with the roll axis vertical.",
            Shown(t, angles, "angle, deg", ("roll", "pitch", "yaw")),
        ),
        "figure04_rate": ("Angular velocity measured by the gyro, deg/s.", gyro_rate(done)),
        "figure05_gimbal_angles": (
            "Gimbal angles, deg.",
            Shown(t, slew.angles / DEG, "gimbal angle, deg", GYROS),
        ),
        "figure06_singularity": (
            "Singularity index, the measure sqrt(det D D^T) with the gyros' momentum as unit.",
            Shown(t, slew.measure[:, None], "singularity index", ("measure",), NEAR),
        ),
        "figure07_gimbal_rates": (
            "Commanded gimbal rates, deg/s.",
            Shown(t, slew.rates / DEG, "gimbal rate, deg/s", GYROS),
        ),
        "figure08_required_torque": (
            "Required torque on the platform, N m.",
            Shown(t, slew.required, "torque, N m", torque),
        ),
        "figure09_output_torque": (
            "Torque that the gimbal rates give, N m.",
            Shown(t, slew.output, "torque, N m", torque),
        ),
    }
    for name, (caption, what) in shown.items():
        yield Picture(name, f"{number(name)}{caption}{SINGULAR}", lee_slew.draw(what, near))


def gyro_rate(done: Manoeuvre) -> Shown:
    """Return the rates of a slew measured by the gyro."""
    rate = done.slew.recording.rate
    assert rate is not None
    return Shown(rate.t, rate.values / DEG, "angular velocity, deg/s", RATES)


def number(name: str) -> str:
    """Return the paper's number of a figure."""
    return f"Lee Fig. {int(name[6:8])}. "


def course_pictures(done: Manoeuvre, sides: Courses) -> Iterator[Picture]:
    """Yield Figs. 10 to 16."""
    mass = done.testbed.body.mass
    yield estimates("figure10_unbalance", UNBALANCE, done, sides)
    yield estimates("figure11_moi", MOI, done, sides)
    yield estimates("figure12_poi", POI, done, sides)
    total = [lee_course.Reported(side.t, side.total[:, None]) for side in sides]
    drawn = lee_course.draw_indices(total, ("EI",), "total error index", wide=False)
    yield Picture("figure13_error_index", f"Lee Fig. 13. Total error index (Eq. 9).{BOTH}.", drawn)
    for name, of in (
        ("figure14_moi_index", MOI),
        ("figure15_poi_index", POI),
        ("figure16_unbalance_index", UNBALANCE),
    ):
        reported = [of.along(side, side.parameter, mass) for side in sides]
        drawn = lee_course.draw_indices(reported, of.labels, f"PEI of {of.short}, {of.unit}")
        caption = (
            f"{number(name)}Parameter error index of {of.short} (Eq. 10), in its unit and no "
            f"standard deviation.{BOTH}."
        )
        yield Picture(name, caption, drawn)


def small_pictures(done: Manoeuvre, sides: Courses) -> Iterator[Picture]:
    """Yield Figs. 17 and 18."""
    caption = "Lee Fig. 17. Angular velocity measured by the gyro, deg/s, from small angles."
    drawn = lee_slew.draw(gyro_rate(done), singular_times(done.slew))
    yield Picture("figure17_rate_small", caption, drawn)
    yield estimates("figure18_moi_small", MOI, done, sides, ", from small angles")


def estimates(name: str, of: Unknowns, done: Manoeuvre, sides: Courses, where: str = "") -> Picture:
    """Return a figure of estimates along a slew."""
    mass, truth = done.testbed.body.mass, true_values(done.testbed)
    true = of.shown(np.array([truth[k] for k in of.names]), mass)
    reported = [of.along(side, side.values, mass) for side in sides]
    air = 2.0 * float(np.abs(true).max()) if of is UNBALANCE else 9.0
    drawn = lee_course.draw_estimates(reported, true, of.labels, f"{of.short}, {of.unit}", air)
    return Picture(name, f"{number(name)}{of.title}{where}.{DASHED}", drawn)
