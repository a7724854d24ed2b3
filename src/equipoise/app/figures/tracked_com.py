"""Centre of mass as the tracker saw it, masses still (Ivanov 2021 Fig. 12)."""

from matplotlib.figure import Figure

from equipoise.app.figures.com_panels import draw_com
from equipoise.app.figures.style import panels, styled
from equipoise.estimation.tracker import Track
from equipoise.model.arrays import Vector3
from equipoise.model.recording import Recording

CAPTION = (
    "Centre of mass as the tracker (Kalman filter) sees it while the masses stand still, um in "
    "body axes. Bands: two standard deviations. Dashed: the simulated truth."
)


@styled
def draw(track: Track, recording: Recording, truth: Vector3 | None = None) -> Figure:
    """Return the figure; ``truth`` (m) is drawn when the bench is simulated."""
    figure, grid = panels(3, height=1.25)
    draw_com([row[0] for row in grid], track.t, track.com, track.com_sd, recording)
    if truth is not None:
        for (axes,), value in zip(grid, truth, strict=True):
            axes.axhline(value * 1e6, color="black", linestyle="--", linewidth=0.9)
    figure.align_ylabels()
    return figure
