"""The papers that can be reproduced, and all that they ask for, for terminal and JSON."""

from collections.abc import Mapping

from equipoise.app.text.blocks import Blocks, Column, Pairs, prose, tabulated
from equipoise.app.text.json_lists import REPRODUCE_ITEMS
from equipoise.app.text.json_shape import View
from equipoise.study.papers.items import ITEMS, Item

NOTE = (
    "I: Ivanov et al. 2021. R: da Silva et al. 2021, the review. L: Lee et al. A test "
    "or a decision in the repository shows each item."
)


def blocks(papers: Mapping[str, str]) -> Blocks:
    """Return the papers by name, and the table of items."""
    works = sum(item.works for item in ITEMS)
    title = f"Items of the papers: {works} of {len(ITEMS)} work, the others are decided"
    items = tabulated(
        title,
        ITEMS,
        (Column("item"), lambda item: item.name),
        (Column("place"), lambda item: item.place),
        (prose("what"), lambda item: item.what),
        (Column("state"), state_of),
        (Column("shown by"), lambda item: item.shown_by),
        notes=(NOTE,),
    )
    return (Pairs(tuple(papers.items())), items)


def state_of(item: Item) -> str:
    """Return whether an item works, or a decision says why not."""
    return "works" if item.works else "decided"


def document_of(papers: Mapping[str, str]) -> View:
    """Return papers and items as JSON."""
    return REPRODUCE_ITEMS.write({"papers": papers, "items": ITEMS})
