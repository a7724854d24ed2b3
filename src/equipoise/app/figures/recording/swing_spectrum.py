"""The amplitude spectrum of roll and pitch, with the swings that were found in it."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure, laid_out
from equipoise.app.figures.base.strokes import line_of_several
from equipoise.app.figures.base.style import GREY, WIDE, styled
from equipoise.assessment.metrics.swing_modes import swing_rates
from equipoise.model.units import DEG
from equipoise.procedure.identification.assess import Assessment

CAPTION = (
    "Amplitude spectrum of the tilt about the two horizontal axes. Solid: detected "
    "swing modes, with the resolution of the record. Dashed: modes predicted by the "
    "fit (small, without spin)."
)
SHOWN = 6.0  # of the quickest swing, chosen: what is of interest


@styled
def draw(done: Assessment) -> Figure:
    """Return the figure."""
    observed = done.metrics.spectrum
    assert observed is not None
    figure = laid_out(WIDE, 2.8)
    axes = figure.subplots()
    size = float(np.linalg.norm(done.com))
    down = done.com / max(size, 1e-12)
    bed = done.testbed
    predicted = swing_rates(bed.weight * size, bed.body.inertia_P, down) / (2 * np.pi)
    for k, (column, name) in enumerate(zip(observed.amplitude.T, "xy", strict=True)):
        line_of_several(axes, k, observed.frequency, column / DEG, f"vertical along {name}")
    for k, hanging in enumerate(done.metrics.hanging):
        f, half = hanging.swing.frequency, observed.resolution / 2
        axes.axvspan(f - half, f + half, color="black", alpha=0.08, linewidth=0)
        axes.axvline(f, color="black", linewidth=0.9, label=None if k else "found")
    for k, f in enumerate(predicted):
        axes.axvline(float(f), color=GREY, linestyle="--", label=None if k else "predicted")
    last = SHOWN * max(float(predicted.max()), 2 * observed.resolution)
    axes.set(xlim=(0, min(last, float(observed.frequency[-1]))), ylim=(0, None),
             xlabel="frequency, Hz", ylabel="amplitude, deg")  # fmt: skip
    figure.legend(loc="outside upper center", ncols=4)
    return figure
