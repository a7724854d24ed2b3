"""Where a recording is odd: numbers above the panels, shades in them, and the list beneath."""

import textwrap
from collections.abc import Sequence

from equipoise.app.figures.base.canvas import Axes, Figure
from equipoise.app.figures.base.style import GREY, ORANGE
from equipoise.app.text.escaping import for_figure
from equipoise.model.finding import Finding

ODD = {"wrong": ORANGE, "problem": ORANGE, "motion": GREY, "content": GREY, "mended": GREY}
SIGNS = {"wrong": "!", "problem": "!", "mended": "~", "content": "", "motion": ""}
WHOLE = 0.9  # of the record: a finding that holds that long is not marked (chosen)
LEAST = 0.002  # of the record: a shade is at least that wide, to be visible (chosen)
SHELVES = 3  # rows of numbers above the panels, where they would cover each other
LETTER = 0.011  # of the record: the width of a letter of a label (measured on the page)
CHARACTERS = 128  # of a line of the list (measured: DejaVu Sans 7.5 over the page's width)
SIZE = 7.5  # points
LINE = 0.148  # inches, of a line of the list


def numbered(found: Sequence[Finding], span: tuple[float, float]) -> list[Finding]:
    """Return the findings that hold at a part of the record, in order of time."""
    start, end = span
    parts = [
        f for f in found if f.span is not None and f.span[1] - f.span[0] < WHOLE * (end - start)
    ]
    return sorted(parts, key=lambda f: (0.0, 0.0) if f.span is None else f.span)


def shade(every: Sequence[Axes], marked: Sequence[Finding], span: tuple[float, float]) -> None:
    """Shade the spans of the numbered findings."""
    least = LEAST * (span[1] - span[0])
    for finding in marked:
        assert finding.span is not None  # only findings with a span are numbered
        start, end = finding.span
        wider = max(0.0, 0.5 * (least - (end - start)))
        for axes in every:
            axes.axvspan(
                start - wider, end + wider, color=ODD[finding.kind], alpha=0.22, linewidth=0,
                zorder=0,
            )  # fmt: skip


def number(axes: Axes, marked: Sequence[Finding], span: tuple[float, float]) -> None:
    """Write the numbers and labels above a panel, on shelves so that they do not cover others."""
    length = span[1] - span[0]
    free = [-1e300] * SHELVES
    for k, finding in enumerate(marked, start=1):
        assert finding.span is not None  # only findings with a span are numbered
        at = min(max(0.5 * sum(finding.span), span[0]), span[1])
        text = for_figure(f"{k} {finding.label}")
        half = 0.5 * LETTER * len(text) * length
        shelf = next((s for s in range(SHELVES) if free[s] <= at - half), None)
        if shelf is None:
            continue  # no room: its shade and its line in the list are there
        free[shelf] = at + half + 0.5 * LETTER * length
        axes.annotate(
            text, (at, 1.0), xytext=(0, 3 + 9 * shelf), textcoords="offset points",
            xycoords=("data", "axes fraction"), ha="center", va="bottom", fontsize=SIZE,
            color=ODD[finding.kind], annotation_clip=False,
        )  # fmt: skip


def listed(found: Sequence[Finding], marked: Sequence[Finding]) -> list[tuple[str, str, str]]:
    """Return lines of sign, number and text, wrapped: those with a number first."""
    rest = [finding for finding in found if finding not in marked]
    order = sorted(
        rest, key=lambda f: ("wrong", "problem", "motion", "content", "mended").index(f.kind)
    )
    lines: list[tuple[str, str, str]] = []
    for k, finding in enumerate([*marked, *order], start=1):
        sign, head = SIGNS[finding.kind], str(k) if k <= len(marked) else ""
        for text in textwrap.wrap(for_figure(finding.sentence), CHARACTERS):
            lines.append((sign, head, text))
            sign = head = ""
    return lines


def write_list(
    figure: Figure, lines: Sequence[tuple[str, str, str]], most: int, left: float, top: float
) -> None:
    """Write the list down the page from ``top``; what does not fit is counted."""
    height = float(figure.get_figheight())
    shown = list(lines[:most])
    if len(lines) > most:
        more = len(lines) - most + 1
        shown[-1] = ("", "", f"and {more} more lines, which `equipoise inspect` prints.")
    for k, (sign, head, text) in enumerate(shown):
        y = top - k * LINE / height
        for x, word, align in ((left, sign, "left"), (left + 0.03, head, "right"),
                               (left + 0.04, text, "left")):  # fmt: skip
            if word.strip():
                colour = ORANGE if word == "!" else "black"
                figure.text(x, y, word, ha=align, va="top", fontsize=SIZE, color=colour)
