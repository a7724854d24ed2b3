"""The gallery: a page, and the figures that it shows, drawn when the site is built."""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from docs.site.gallery_figures import assessed, balanced, designed, identified
from equipoise.app.figures.base.files import rendered
from equipoise.app.figures.catalogue import Picture

PLACE = "gallery"
HEAD = """# Gallery

Every figure was drawn from simulated records when this site was built, by the functions that draw
the reports. The testbed is the preset `sputnix`, after Ivanov et al. (2021).
"""


class Part(NamedTuple):
    """A section of the gallery: what makes such figures, and how they are drawn here."""

    title: str
    command: str
    draw: Callable[[], Sequence[Picture]]


PARTS = (
    Part("Identify", "equipoise identify run.csv --testbed my.toml --out identified", identified),
    Part("Balance", "equipoise balance my.toml --out balanced", balanced),
    Part("Assess", "equipoise assess run.csv --testbed my.toml --out assessed", assessed),
    Part("Design", "equipoise design my.toml --out designed", designed),
)


def gallery() -> Iterator[tuple[str, bytes]]:
    """Yield each figure and the page, by their paths in the site."""
    lines = [HEAD]
    for part in PARTS:
        lines.append(f"## {part.title}\n\n```text\n{part.command}\n```\n")
        for picture in part.draw():
            yield f"{PLACE}/{picture.name}.png", rendered(picture.figure)
            lines.append(shown(picture))
    yield f"{PLACE}/index.md", "\n".join(lines).encode()


def shown(picture: Picture) -> str:
    """Return a figure as a page has it: the caption says all that it shows."""
    title = " ".join(picture.name.split("_")).capitalize()
    return (
        f"```{{figure}} {picture.name}.png\n:alt: {title}, described by the caption\n"
        f":figclass: drawn\n\n{picture.caption}\n```\n"
    )
