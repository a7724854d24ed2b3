"""`equipoise laws`: how a platform can be balanced."""

from equipoise.app.arguments.options import Json, Triple
from equipoise.app.console.terminal import announced


def laws(
    name: str | None = None,
    /,
    *,
    testbed: str | None = None,
    target_um: Triple = (0.0, 0.0, -100.0),
    json: Json = False,
) -> int:
    """List the control laws, or describe one.

    Errata cited by a source are entries of docs/errata.md.

    Parameters
    ----------
    name
        Law to describe. If omitted: list all.
    testbed
        Testbed file, or a preset's name: states whether each law can balance it, and the expected
        time where the law can calculate it.
    target_um
        With --testbed: target of the centre of mass, as in `equipoise balance`.
    """
    from equipoise.app.api import catalogues
    from equipoise.app.commands.methods import print_cards

    catalogue = catalogues.laws()
    if testbed is None:
        return print_cards(catalogue, name, json)
    from equipoise.app.arguments.checks import vector
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.app.logbook.output import print_result
    from equipoise.app.views.balancing.prospect_views import blocks, document
    from equipoise.model.units import UM
    from equipoise.procedure.balancing.catalogue import CARDS
    from equipoise.procedure.balancing.prospect import prospect

    if name is not None:
        catalogue[name]  # or says which is meant
    bed, target = announced(testbed_from(testbed)), vector("--target-um", target_um, UM)
    cards = [card for card in CARDS.values() if name in (None, card.name)]
    prospects = [prospect(card, bed, target) for card in cards]
    print_result(document(cards, prospects), blocks(bed.name, cards, prospects), json)
    return 0
