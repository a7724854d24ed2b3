"""Gravity's torque over the tilts that count."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure, laid_out
from equipoise.app.figures.base.style import BLUE, GREY, ORANGE, WIDE, styled
from equipoise.assessment.metrics.torque_range import torque_in_range
from equipoise.model.units import DEG, UN_M
from equipoise.procedure.identification.assess import Assessment

CAPTION = (
    "Gravity torque within a tilt of level: root mean square over all directions "
    "(line, band: 95 % bounds) and maximum (dashed). Dotted: detection limit of this "
    "recording. Grey: the range of the requirement, and the requirement."
)
POINTS = 13


@styled
def draw(done: Assessment) -> Figure:
    """Return the figure."""
    figure = laid_out(WIDE, 3.0)
    axes = figure.subplots()
    tilts = np.linspace(0.02, max(done.torque.tilt, done.testbed.tilt_limit), POINTS)
    bed = done.testbed
    found = [torque_in_range(done.pull, bed.weight, bed.up, float(a)) for a in tilts]
    rms = np.array([each.rms for each in found]) / UN_M
    x = tilts / DEG
    axes.fill_between(x, rms[:, 1], rms[:, 2], color=BLUE, alpha=0.2, linewidth=0)
    axes.plot(x, rms[:, 0], color=BLUE, label="rms")
    worst = [each.worst / UN_M for each in found]
    axes.plot(x, worst, color=ORANGE, linestyle="--", label="worst attitude")
    axes.plot(x, rms[:, 3], color=GREY, linestyle=":", label="detection limit")
    if done.options.require_torque is not None:
        limit = done.options.require_torque / UN_M
        axes.plot([0, done.torque.tilt / DEG], [limit, limit], color="black", label="required")
    axes.axvspan(0, done.torque.tilt / DEG, color="black", alpha=0.05, linewidth=0)
    axes.set(xlim=(0, x[-1]), ylim=(0, None), xlabel="tilt from level, deg",
             ylabel="torque, uN m")  # fmt: skip
    figure.legend(loc="outside upper center", ncols=4)
    return figure
