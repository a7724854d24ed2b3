"""`equipoise methods`: what there is to choose from."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Flag

if TYPE_CHECKING:
    from equipoise.app.views.card_views import CardKind
    from equipoise.model.law_card import LawCard
    from equipoise.model.method_card import Card


def methods(name: str | None = None, /, *, json: Flag = False) -> int:
    """List the methods of `equipoise identify`, or show the whole card of one.

    Errata that a source names are entries of docs/errata.md.

    Parameters
    ----------
    name
        Method to show. Left out: list them all.
    json
        Print one JSON document instead.
    """
    from equipoise.estimation.methods.registry import METHODS

    return print_cards("method", {key: method.card for key, method in METHODS.items()}, name, json)


def print_cards(
    kind: "CardKind", every: "Mapping[str, Card] | Mapping[str, LawCard]", name: str | None,
    json: bool,
) -> int:  # fmt: skip
    """Print the card of a name, or all of them."""
    from equipoise.app.arguments.checks import one_of
    from equipoise.app.logbook.output import print_result
    from equipoise.app.views.card_views import blocks, document

    names = list(every) if name is None else [one_of(kind, name, list(every))]
    cards = [every[each] for each in names]
    print_result(document(kind, cards), blocks(kind, cards), json)
    return 0
