"""Where the masses stood in the process of automatic balancing (Ivanov 2021 Fig. 15)."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import course, dash_last, panels
from equipoise.app.figures.base.style import AXES, SEVERAL, styled
from equipoise.model.recording import Recording
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.model.units import MM

CAPTION = "Displacements of the balancing masses from home, mm; dotted: ends of the rails."


@styled
def draw(recording: Recording, testbed: Testbed) -> Figure:
    """Return the figure: one panel for each body axis along which masses move."""
    tracks = recording.masses
    groups = [(axis, g) for axis in range(3) if (g := _along(axis, recording, testbed))]
    figure, column = panels(max(len(groups), 1), height=0.95)
    for axes, (along, group) in zip(column, groups, strict=False):
        assert tracks is not None
        for k, (of, mass) in enumerate(group):
            y = tracks.values[:, of] / MM
            course(axes, tracks.t, y, SEVERAL[k % len(SEVERAL)], mass.name)
            dash_last(axes, k)
            for end in mass.travel:
                axes.axhline(end / MM, color="#888888", linestyle=":", linewidth=0.9)
        axes.set_ylabel(f"along {AXES[along]}, mm")
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def _along(axis: int, recording: Recording, testbed: Testbed) -> list[tuple[int, SlidingMass]]:
    """Return column and mass of all that mainly move along a body axis."""
    named = [(k, testbed.mass_named(name)) for k, name in enumerate(recording.mass_names)]
    return [(k, mass) for k, mass in named if int(abs(mass.axis).argmax()) == axis]
