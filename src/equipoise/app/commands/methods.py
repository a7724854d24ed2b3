"""`equipoise methods`: what there is to choose from."""

from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Json

if TYPE_CHECKING:
    from equipoise.app.api.catalogues import Catalogue


def methods(name: str | None = None, /, *, json: Json = False) -> int:
    """List the estimation methods, or describe one.

    Errata cited by a source are entries of docs/errata.md.

    Parameters
    ----------
    name
        Method to describe. If omitted: list all.
    """
    from equipoise.app.api import catalogues

    return print_cards(catalogues.methods(), name, json)


def print_cards(catalogue: "Catalogue", name: str | None, json: bool) -> int:
    """Print the card of a name, or all of them."""
    from equipoise.app.logbook.output import print_result
    from equipoise.app.views.card_views import blocks, document

    cards = list(catalogue.cards.values()) if name is None else [catalogue[name]]
    print_result(document(catalogue.kind, cards), blocks(catalogue.kind, cards), json)
    return 0
