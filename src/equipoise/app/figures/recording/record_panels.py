"""What each channel of a recording shows over time, one panel for each quantity."""

from collections.abc import Callable

import numpy as np

from equipoise.app.figures.base.canvas import Axes
from equipoise.app.figures.base.strokes import course, dash_last, dots
from equipoise.app.figures.base.style import AXES, BLUE, SIX, XYZ
from equipoise.app.text.escaping import for_figure
from equipoise.assessment.findings.channel_content import GAP
from equipoise.assessment.findings.motion_range import AXES as BODY_AXES
from equipoise.assessment.findings.motion_range import heading_rate, most_upright
from equipoise.assessment.record_checks.outliers import outlying_attitudes, outlying_rates
from equipoise.maths.attitude import tilt
from equipoise.model.arrays import Series1, Series3, Vector3
from equipoise.model.recording import Recording, Samples
from equipoise.model.units import DEG, MM, MS, UT

Panel = Callable[[Axes], None]
FEWEST = 3  # rows for a rate
RARE = 0.005  # share of values at either end that may be drawn beyond the range (chosen)
WIDENED = 0.5  # of the range of the others, within which they are not beyond it (chosen)
LEAST = 2.0  # mm, chosen: masses that rest are not drawn as if they moved by hairs
TINY = 1e-9  # deg, deg/s: a range is never empty
# By channel: what is measured of a vector, and the unit in which it is drawn.
VECTORS = {
    "accelerometer": ("specific\nforce, m/s2", 1.0),
    "sun": ("sun sensor,\nunit vector", 1.0),
    "field": ("magnetic\nfield, uT", UT),
}
DECADES = 8.0  # ratio of the longest spacing to the shortest, from which its scale is logarithmic


def panels_of(recording: Recording, up: Vector3 | None) -> list[Panel]:
    """Return a drawing for each panel that the recording has something for."""
    found = panels_of_motion(recording, up)
    attitude, rate = _enough(recording.attitude), _enough(recording.rate)
    if attitude is not None:
        rough = outlying_attitudes(attitude).rough
        found.append(_by_axis(attitude.t, rough, "attitude\nroughness,\ndeg"))
    if rate is not None:
        rough = outlying_rates(rate).rough
        found.append(_by_axis(rate.t, rough, "gyro\nroughness,\ndeg/s"))
    return [*found, _spacing(attitude, rate)]


def panels_of_motion(recording: Recording, up: Vector3 | None) -> list[Panel]:
    """Return the panels of the motion of platform and masses."""
    found: list[Panel] = []
    attitude, rate = _enough(recording.attitude), _enough(recording.rate)
    if attitude is not None:
        found += [_tilt(attitude, up), _heading_rate(attitude)]
    if rate is not None:
        found.append(_by_axis(rate.t, rate.values, "gyro, deg/s"))
    for channel, (label, unit) in VECTORS.items():
        if (vectors := _enough(getattr(recording, channel))) is not None:
            found.append(_by_axis(vectors.t, vectors.values, label, unit))
    if recording.masses is not None and len(recording.masses):
        found.append(_masses(recording.masses, recording.mass_names))
    return found


def _enough(channel: Samples | None) -> Samples | None:
    return channel if channel is not None and len(channel) >= FEWEST else None


def _tilt(attitude: Samples, up: Vector3 | None) -> Panel:
    name = most_upright(attitude)
    axis = BODY_AXES[name] if up is None else up
    of = f"tilt\nof {name}, deg" if up is None else "tilt, deg"

    def draw(axes: Axes) -> None:
        dots(axes, attitude.t, tilt(attitude.values, axis) / DEG, BLUE)
        axes.set_ylabel(of)

    return draw


def _heading_rate(attitude: Samples) -> Panel:
    def draw(axes: Axes) -> None:
        t, rate = heading_rate(attitude)
        _dots_within(axes, t, [rate / DEG], [BLUE], [""])
        axes.set_ylabel("heading\nrate, deg/s")

    return draw


def _by_axis(t: Series1, values: Series3, label: str, unit: float = DEG) -> Panel:
    def draw(axes: Axes) -> None:
        _dots_within(axes, t, list(values.T / unit), list(XYZ), list(AXES))
        _legend(axes)
        axes.set_ylabel(label)

    return draw


def _dots_within(
    axes: Axes, t: Series1, values: list[Series1], colours: list[str], names: list[str]
) -> None:
    """Draw measurements over the range that most take up; those beyond as triangles at its end."""
    low, high = _range(np.concatenate(values))
    for y, colour, name in zip(values, colours, names, strict=True):
        dots(axes, t, np.where((y >= low) & (y <= high), y, np.nan), colour, name)
        for beyond, end, shape in ((y > high, high, "^"), (y < low, low, "v")):
            axes.plot(t[beyond], np.full(beyond.sum(), end), shape, color=colour, markersize=4)
    axes.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))


def _range(values: Series1) -> tuple[float, float]:
    """Return the range of most values, widened, or of all if that is hardly more."""
    values = values[np.isfinite(values)]
    if not len(values):
        return -1.0, 1.0
    least, most = float(values.min()), float(values.max())
    low, high = (float(x) for x in np.quantile(values, (RARE, 1 - RARE)))
    air = max(WIDENED * (high - low), TINY)
    return max(least, low - air) - TINY, min(most, high + air) + TINY


def _masses(masses: Samples, names: tuple[str, ...]) -> Panel:
    def draw(axes: Axes) -> None:
        for i, name in enumerate(names):
            course(axes, masses.t, masses.values[:, i] / MM, SIX[i % len(SIX)], for_figure(name))
            dash_last(axes, i)
        low, high = axes.get_ylim()
        axes.set_ylim(min(low, 0.5 * (low + high - LEAST)), max(high, 0.5 * (low + high + LEAST)))
        axes.set_ylabel("masses, mm")
        _legend(axes)

    return draw


def _spacing(attitude: Samples | None, rate: Samples | None) -> Panel:
    """Return the time from each row to the next: jitter, or gaps on a logarithmic scale."""

    def draw(axes: Axes) -> None:
        steps: list[Series1] = []
        for name, channel, colour in (("attitude", attitude, BLUE), ("gyro", rate, XYZ[1])):
            if channel is not None:
                steps.append(np.diff(channel.t) / MS)
                dots(axes, channel.t[:-1], steps[-1], colour, name)
                gap = steps[-1] > GAP * np.median(steps[-1])
                axes.plot(channel.t[:-1][gap], steps[-1][gap], "o", color=colour)
        axes.set_ylabel("row\nspacing, ms")
        _spacing_scale(axes, np.concatenate(steps))
        _legend(axes)

    return draw


def _spacing_scale(axes: Axes, steps: Series1) -> None:
    low, high = float(steps.min()), float(steps.max())
    if high > DECADES * low:
        axes.set_yscale("log")
        axes.set_ylim(low / 1.5, high * 1.5)
    else:
        air = max(0.1 * (high - low), 0.1 * low)
        axes.set_ylim(low - air, high + air)


def _legend(axes: Axes) -> None:
    """Put the names at the right, where they cover nothing."""
    axes.legend(
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        markerscale=3,
        handlelength=1.7,
        fontsize=7.5,
        labelspacing=0.15,
    )
