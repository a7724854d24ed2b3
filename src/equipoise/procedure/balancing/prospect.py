"""Whether a law can balance a testbed, and how long it should take, before anything is begun."""

from equipoise.control.laws.registry import LAWS
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.law_card import LawCard, Prospect
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.run_law import lacking


def prospect(card: LawCard, testbed: Testbed, target: Vector3) -> Prospect:
    """Return what to expect of the law of a card with the centre of mass wanted at ``target``."""
    missing, law = tuple(lacking(card, testbed)), LAWS.get(card.name)
    if missing or law is None:
        return Prospect(card.name, missing, None, None)
    try:
        _, params = law.begin(testbed, target)
    except InputError as refused:
        return Prospect(card.name, (), f"{refused.found}; wanted {refused.wanted}", None)
    return Prospect(card.name, (), None, None if law.expected is None else law.expected(params))
