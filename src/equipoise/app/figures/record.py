"""A recording as it is: attitude, rate and masses over time."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equipoise.app.figures.attitude_fit import COMPONENTS
from equipoise.app.figures.style import AXES, SIX, XYZ, course, dots, panels, styled
from equipoise.app.units import MM, PER_DEG
from equipoise.maths.attitude import continuous
from equipoise.model.recording import Recording, Samples


@styled
def draw(recording: Recording) -> Figure:
    """Return the figure: one panel for each channel that there is."""
    channels = (recording.attitude, recording.rate, recording.masses)
    there = [k for k, channel in enumerate(channels) if channel is not None and len(channel)]
    figure, grid = panels(len(there), height=2.0)
    for (axes,), k in zip(grid, there, strict=True):
        channel = channels[k]
        assert channel is not None
        (_attitude, _rate, _masses)[k](axes, channel, recording.mass_names)
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), markerscale=4)
    figure.align_ylabels()
    return figure


def _attitude(axes: Axes, channel: Samples, _: tuple[str, ...]) -> None:
    q = continuous(channel.values)
    for i, name, colour in COMPONENTS:
        dots(axes, channel.t, q[:, i], colour, name)
    axes.set_ylabel("quaternion")


def _rate(axes: Axes, channel: Samples, _: tuple[str, ...]) -> None:
    for i, colour in enumerate(XYZ):
        dots(axes, channel.t, channel.values[:, i] * PER_DEG, colour, f"$\\omega_{AXES[i]}$")
    axes.set_ylabel("rate, deg/s")


def _masses(axes: Axes, channel: Samples, names: tuple[str, ...]) -> None:
    for i, name in enumerate(names):
        course(axes, channel.t, channel.values[:, i] * MM, SIX[i % len(SIX)], name)
    axes.set_ylabel("masses, mm")
